import pathlib, sys
sys.path.insert(0, str(pathlib.Path(__file__).parent))
project = "mudline"
extensions = ["myst_parser"]
root_doc = "docs/user_guide"
include_patterns = ["README.md", "CHANGELOG.md", "CONTRIBUTING.md", "docs/**.md", "inputs/README.md", "inputs/plugins/*/README.md"]
exclude_patterns = ["build", ".git", "results"]
myst_enable_extensions = ["dollarmath"]
myst_heading_anchors = 6
highlight_language = "none"
html_show_search_summary = False
