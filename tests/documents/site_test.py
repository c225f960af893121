"""The documentation for a browser: it builds without a warning, has every deck, a search, and formulas as meant."""
import importlib.util
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
SITE = ROOT / "docs" / "site"
MISSING = [name for name in ("sphinx", "myst_parser") if importlib.util.find_spec(name) is None]


@unittest.skipIf(MISSING, f"Python has no {' and no '.join(MISSING)}: `./mudline docs` installs them")
class Site(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.holder = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.holder.name)
        command = [sys.executable, "-B", "-m", "sphinx", "-q", "-b", "html", "-W", "--keep-going", "-j", "auto", "-c",
                   SITE, "-d", cls.folder / "doctrees", ROOT, cls.folder / "site"]
        cls.done = subprocess.run(command, capture_output=True, text=True)

    @classmethod
    def tearDownClass(cls):
        cls.holder.cleanup()

    def page(self, name):
        return (self.folder / "site" / name).read_text(encoding="utf-8")

    def test_it_builds_without_a_warning(self):
        self.assertEqual(self.done.returncode, 0, self.done.stderr)
        self.assertEqual(self.done.stderr, "")
        self.assertIn('url=docs/index.html', self.page("index.html"))

    def test_the_gallery_has_every_deck(self):
        gallery = self.page("docs/gallery.html")
        decks = [path for path in (ROOT / "inputs").rglob("*.xml")
                 if ROOT / "inputs" / "plugins" not in path.parents]
        self.assertGreater(len(decks), 90)
        for deck in decks:
            self.assertIn(f"inputs/{os.path.relpath(deck, ROOT / 'inputs')}", gallery)
        self.assertIn("run inputs/torpedo/tresca.xml inputs/torpedo/remeshing.xml inputs/torpedo/deep_torpedo.xml", gallery)
        self.assertIn("sweep inputs/cpt/backbone.xml", gallery)
        self.assertIn("point inputs/point/mcc_triaxial.xml", gallery)
        for picture in ("pile.png", "torpedo.png", "backbone.png"):
            self.assertIn(picture, gallery)

    def test_it_needs_no_network(self):
        for page in (self.folder / "site").rglob("*.html"):
            self.assertNotRegex(page.read_text(encoding="utf-8"),
                                r'<(?:script|img|link)[^>]*(?:src|href)="(?:https?:)?//', page.name)

    def test_the_search_finds_the_new_pages(self):
        index = self.page("searchindex.js")
        for page in ("docs/bodies", "docs/contact", "docs/mesh_motion", "docs/tutorials/anchor", "docs/where"):
            self.assertIn(f'"{page}"', index)


@unittest.skipIf(MISSING, f"Python has no {' and no '.join(MISSING)}: `./mudline docs` installs them")
class Formulas(unittest.TestCase):
    """What docutils would take otherwise than LaTeX does."""

    @classmethod
    def setUpClass(cls):
        sys.path.insert(0, str(SITE))
        import conf
        cls.mathml = staticmethod(lambda tex: "".join(conf.mathml(tex, True).split()))

    def test_figures_count_one_by_one(self):
        self.assertIn("<mfrac><mn>1</mn><mn>3</mn></mfrac>", self.mathml(r"\tfrac13\operatorname{tr}x"))
        self.assertIn("<msup><mi>x</mi><mn>1</mn></msup><mn>0</mn>", self.mathml("x^10"))
        self.assertIn("<msqrt><mn>2</mn></msqrt><mn>3</mn>", self.mathml(r"\sqrt23"))

    def test_an_accent_belongs_to_its_letter(self):
        self.assertRegex(self.mathml(r"\dot\gamma_0"),
                         r"<msub><mrow><mover><mi>γ</mi>.*</mover><mrow></mrow></mrow><mn>0</mn></msub>")

    def test_a_prime_stands_above_the_index(self):
        self.assertRegex(self.mathml("p'_0"), r"<msubsup><mi>p</mi><mn>0</mn><mo.*>′</mo></msubsup>")

    def test_what_cannot_be_drawn_is_refused(self):
        self.assertRaises(SyntaxError, self.mathml, r"\nonsense{x}")


if __name__ == "__main__":
    unittest.main()
