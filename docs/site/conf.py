"""The documentation as a site for a browser, without a network: `./mudline docs` builds it by Sphinx and MyST from
the Markdown of the repository. A link to what is not there, a missing picture, a formula that cannot be drawn and a
page that the navigation lacks are warnings, and with `-W` errors.

Formulas become MathML, which browsers draw by themselves. The search runs in the browser, from files too.
"""
import pathlib
import re
import sys

from docutils import nodes
from docutils.utils.math.latex2mathml import tex2mathml
from sphinx.util import logging

FOLDER = pathlib.Path(__file__).resolve().parent
ROOT = FOLDER.parent.parent
sys.path.insert(0, str(FOLDER))
import gallery  # noqa: E402

VERSION = re.search(r"project\(mudline VERSION (\S+)", (ROOT / "CMakeLists.txt").read_text(encoding="utf-8"))[1]

project = "mudline"
copyright = "mudline authors, BSD-3-Clause"
version = release = VERSION
extensions = ["myst_parser"]
myst_enable_extensions = ["dollarmath"]
myst_heading_anchors = 6
root_doc = "docs/index"
include_patterns = ["*.md", "docs/**.md", "inputs/README.md", "inputs/plugins/*/README.md"]
exclude_patterns = ["build", "install", "results", ".git", ".github", "packages", "apps", "python", "tests"]
highlight_language = "none"
suppress_warnings = ["misc.highlighting_failure"]

html_theme = "alabaster"
html_theme_options = {"description": "large-deformation dynamics of saturated soil", "page_width": "1320px",
                      "sidebar_width": "270px", "body_max_width": "1000px",
                      "fixed_sidebar": True, "font_size": "16px"}
html_static_path = [str(FOLDER / "static")]
html_css_files = ["site.css"]
html_math_renderer = "mathml"
html_show_search_summary = False  # it would fetch the pages, which a browser refuses for files
html_copy_source = html_show_sourcelink = False

# What stands in the navigation, besides what is found: caption, pages and patterns of pages
NAVIGATION = [
    ("Start", ["README.md", "docs/where.md", "docs/tutorials/*.md", "docs/gallery.md"]),
    ("Guide", ["docs/user_guide.md", "docs/bodies.md", "docs/contact.md", "docs/mesh_motion.md",
               "docs/penetration.md", "docs/output_format.md", "docs/python.md",
               "docs/decks_from_others.md", "inputs/README.md"]),
    ("Reference", ["docs/parameters.md", "docs/materials.md", "docs/theory.md"]),
    ("Evidence", ["docs/validation.md", "docs/measurements/*.md", "docs/benchmarks/*.md", "docs/reliability.md"]),
    ("Own code", ["docs/developer_guide.md", "docs/physics_in_an_hour.md", "inputs/plugins/*/README.md"]),
    ("Project", ["docs/decisions.md", "CHANGELOG.md", "CONTRIBUTING.md", "CODE_OF_CONDUCT.md",
                 "docs/third_party.md"]),
]

# LaTeX that docutils does not know, or takes otherwise, in what it knows: figures count one by one (\frac12, x^10),
# an accent belongs to one letter (\dot\gamma_0), a prime is raised beside the index
SPELLINGS = [(re.compile(pattern), replacement) for pattern, replacement in (
    (r"\\[bB]ig(?![a-zA-Z])", ""),
    (r"\\mathrel\{([^}]*)\}", r"\1"),
    ("°", r"^{\\circ}"),
    (r"(\\[td]?frac) ?(\d) ?(\d)", r"\1{\2}{\3}"),
    (r"(\\[td]?frac|\\sqrt|[_^]) ?(\d)", r"\1{\2}"),
    (r"(\\d?dot|\\hat|\\bar|\\tilde) ?(?:\{([^{}]*)\}|((?:\\(?:mathbf|boldsymbol) ?)?(?:\\[a-zA-Z]+|[a-zA-Z])))",
     lambda found: f"{{{found[1]}{{{found[2] or found[3]}}}{{}}}}"),
    ("'", r"^{\\prime}"))]


def mathml(tex, inline):
    for pattern, replacement in SPELLINGS:
        tex = pattern.sub(replacement, tex)
    return tex2mathml(tex, inline=inline)


def show_formula(inline):
    def visit(translator, node):
        try:
            formula = mathml(node.astext(), inline)
        except SyntaxError as error:
            logging.getLogger(__name__).warning("%s", f"this formula cannot be drawn: {error}", location=node)
            formula = translator.encode(node.astext())
        translator.body.append(formula if inline else f'<div class="formula">{formula}</div>\n')
        raise nodes.SkipNode

    return visit


def navigation():
    """The table of contents as MyST's directives, which the first page gets."""
    parts = []
    for caption, patterns in NAVIGATION:
        pages = [path for pattern in patterns for path in sorted(ROOT.glob(pattern))]
        lines = "\n".join(f"/{path.relative_to(ROOT).with_suffix('')}" for path in pages)
        parts.append(f"```{{toctree}}\n:caption: {caption}\n:maxdepth: 1\n:hidden:\n\n{lines}\n```")
    return "\n\n".join(parts)


def complete_page(_, page, source):
    """What no page of the repository says twice: the navigation, and the gallery of decks."""
    if page == root_doc:
        source[0] += "\n\n" + navigation() + "\n"
    elif page == "docs/gallery":
        source[0] += "\n\n" + gallery.page(ROOT) + "\n"


def always_anew(*_):
    """Pages that follow from more than their own text."""
    return [root_doc, "docs/gallery"]


def write_entrance(app, error):
    """index.html of the site's folder leads to the first page."""
    if not error and app.builder.format == "html":
        text = f'<!DOCTYPE html><meta http-equiv="refresh" content="0; url={root_doc}.html"><title>mudline</title>\n'
        pathlib.Path(app.outdir, "index.html").write_text(text, encoding="utf-8")


def setup(app):
    app.add_html_math_renderer("mathml", (show_formula(True), None), (show_formula(False), None))
    app.connect("source-read", complete_page)
    app.connect("env-get-outdated", always_anew)
    app.connect("build-finished", write_entrance)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
