"""`cpack -G DEB` makes a package whose program runs where it is unpacked, with its documents, decks and manual page.

From the environment: MUDLINE_BUILD, the build folder to pack.
"""
import os
import pathlib
import shutil
import subprocess
import sys
import unittest

import mudline_case
from mudline_case import ROOT, MudlineCase, program

sys.path.insert(0, os.path.join(ROOT, "tests", "documents"))
import links  # noqa: E402

NEEDED = ("cpack", "dpkg-deb", "dpkg-shlibdeps", "file")
MISSING = [name for name in NEEDED if shutil.which(name) is None]


def call(*command, **more):
    return subprocess.run(command, check=True, capture_output=True, text=True, **more).stdout


@unittest.skipIf(MISSING, f"not installed: {', '.join(MISSING)}")
class Deb(MudlineCase):
    maxDiff = None

    def test_the_package(self):
        call("cpack", "-G", "DEB", "-B", self.folder, "-D", "CPACK_COMPONENTS_ALL=program",
             cwd=os.environ["MUDLINE_BUILD"])
        package, = pathlib.Path(self.folder).glob("mudline_*.deb")
        depends = call("dpkg-deb", "--field", package, "Depends")
        for name in ("python3-h5py", "libtrilinos-tpetra", "libmumps", "openmpi-bin"):
            self.assertIn(name, depends)

        tree = pathlib.Path(self.folder, "tree")
        call("dpkg-deb", "--extract", package, tree)
        share = tree / "usr" / "share"
        for name in ("man/man1/mudline.1", "doc/mudline/copyright", "bash-completion/completions/mudline",
                     "zsh/site-functions/_mudline", "doc/mudline/docs/tutorials/mudline.slurm"):
            self.assertTrue((share / name).is_file(), name)
        self.assertFalse((tree / "usr" / "include").exists())
        documents = links.documents(share / "doc" / "mudline")
        self.assertGreater(len(documents), 50)
        self.assertEqual(links.broken((share / "doc" / "mudline").resolve(), documents, source=False), [])

        mudline_case.PROGRAM = str(tree / "usr" / "bin" / "mudline")
        for command in (["new", "column"], ["run", "my_column.xml"], ["report", "results/my_column"],
                        ["check", share / "doc" / "mudline" / "inputs" / "cpt" / "clay.xml"]):
            done = program(command, folder=self.folder)
            self.assertEqual(done.returncode, 0, done.stderr)
        self.assertTrue(pathlib.Path(self.folder, "results", "my_column_report.html").is_file())


if __name__ == "__main__":
    unittest.main()
