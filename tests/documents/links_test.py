"""Every link of the documents leads somewhere, and the first page to all of them."""
import pathlib
import tempfile
import unittest

import links

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent

# What a newcomer asks, and words of the line of docs/where.md that answers
QUESTIONS = ["depends on depth", "rough a wall", "water table", "start a run from another", "as CSV",
             "without ParaView", "how long", "step was rejected", "warning means", "N_kt", "units", "signs",
             "another number of ranks", "remeshing on or off", "Abaqus", "material of my own",
             "output of my own", "in cycles", "heat", "layers", "after a day", "pull-out capacity", "how exact", "symmetric model", "cite"]


class Links(unittest.TestCase):
    def test_no_link_is_broken(self):
        files = links.documents(ROOT)
        self.assertGreater(len(files), 50)
        self.assertEqual(links.broken(ROOT, files), [])

    def test_what_is_broken_is_found(self):
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder).resolve()
            (root / "docs").mkdir()
            (root / "docs" / "a.md").write_text(
                "# A title: one\n\n# A title: one\n\n[b](b.md) `[c](c.md)`\n\n    [d](d.md)\n")
            (root / "docs" / "b.md").write_text(
                "[a](a.md#a-title-one) [a](a.md#a-title-one-1) [x](a.md#x) ![p](p.png) [u](https://a.b)\n"
                "`inputs/none.xml` [self](#none)\n")
            self.assertEqual(links.broken(root, links.documents(root)),
                             ["docs/b.md: no heading for a.md#x", "docs/b.md: there is no file p.png",
                              "docs/b.md: no heading for #none", "docs/b.md: there is no file inputs/none.xml"])

    def test_newcomers_find_the_page(self):
        text = (ROOT / "docs" / "where.md").read_text(encoding="utf-8")
        rows = [line for line in text.splitlines() if line.startswith("| ")]
        for question in QUESTIONS:
            found = [row for row in rows if question in row.split("|")[1]]
            self.assertEqual(len(found), 1, question)
            self.assertRegex(found[0], r"\]\(|CITATION")


if __name__ == "__main__":
    unittest.main()
