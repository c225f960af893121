"""A body whose contour is drawn in a Gmsh geometry: the same forces as the library's shape of the same sizes."""
import unittest

from compared_case import problem
from contact_case import ContactCase
from mudline_case import program

LIBRARY = """<ParameterList name="library"><ParameterList name="bodies"><ParameterList name="cone"><ParameterList name="contour">
  <Parameter name="type" type="string" value="cone"/>
  <Parameter name="diameter" type="double" value="0.2"/>
  <Parameter name="apex angle [deg]" type="double" value="120"/>
  <Parameter name="tip radius" type="double" value="0.05"/>
  <Parameter name="shoulder radius" type="double" value="0.03"/>
</ParameterList></ParameterList></ParameterList></ParameterList>
"""


@problem("consistency", title="Drawn contour against the library's cone")
class Drawn(ContactCase):
    def library_deck(self):
        """The same deck with the library's cone."""
        with open(self.deck("drawn_cone")) as file:
            text = file.read()
        start = text.index('<ParameterList name="contour">')
        end = text.index("</ParameterList>", start)
        contour = LIBRARY[LIBRARY.index('<ParameterList name="contour">'):LIBRARY.index("</ParameterList>")]
        return self.write("library_cone.xml", text[:start] + contour + text[end:])

    def test_forces_are_those_of_the_librarys_cone(self):
        drawn = self.run_deck(self.deck("drawn_cone"))
        library = self.run_deck(self.library_deck(), name="library_cone")
        self.assertGreater(library["contact/face/reaction y"][-1], 100)
        self.assertEqual(len(drawn.time), len(library.time))
        for column in ("reaction y", "friction heat"):
            exact = library["contact/face/" + column]
            self.compare_values(column, drawn["contact/face/" + column], exact, 1e-8, exact.max())

    @problem("consistency")
    def test_ranks(self):
        one, two = (self.run_deck(self.deck("drawn_cone"), ranks=ranks) for ranks in (1, 2))
        self.assert_same_run(one, two, ["contact/face/reaction y"], "2 ranks")

    @problem("behaviour")
    def test_errors(self):
        def message(*settings):
            done = program(["check", self.deck("drawn_cone")] + [x for s in settings for x in ("--set", s)], 1, self.folder)
            self.assertEqual(done.returncode, 2, done.stdout + done.stderr)
            return done.stderr

        self.assertIn("bodies/cone/contour/physical curve: unknown physical curve 'outlin' (did you mean 'outline'?)",
                      message("bodies/cone/contour/physical curve=outlin"))
        self.assertIn("a half contour starts on its axis", message("bodies/cone/contour/origin={50, 100}"))


if __name__ == "__main__":
    unittest.main()
