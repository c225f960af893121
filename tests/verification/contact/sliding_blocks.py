"""Two blocks of inputs/contact/blocks.xml, the upper one pressed and then dragged over the lower one, for every contact of two surfaces."""
import os

import numpy as np

from contact_case import ContactCase
from mudline_case import History, program

SLIDE = """<ParameterList name="slide">
  <ParameterList name="contacts"><ParameterList name="face">
    <Parameter name="gap tolerance" type="double" value="1e-9"/>
    <ParameterList name="friction">
      <Parameter name="type" type="string" value="coulomb"/>
      <Parameter name="coefficient" type="double" value="0.3"/>
    </ParameterList>
  </ParameterList></ParameterList>
  <ParameterList name="boundary conditions"><ParameterList name="pull">
    <Parameter name="type" type="string" value="displacement"/>
    <Parameter name="set" type="string" value="top"/>
    <Parameter name="x" type="string" value="2e-4*(t&gt;1)*(t-1)"/>
  </ParameterList>
  <ParameterList name="base right">
    <Parameter name="type" type="string" value="fixed"/>
    <Parameter name="set" type="string" value="base"/>
  </ParameterList></ParameterList>
  <ParameterList name="solver"><Parameter name="residual tolerance" type="double" value="1e-8"/></ParameterList>
  <ParameterList name="stages">
    <ParameterList name="press"><Parameter name="conditions" type="Array(string)" value="{base right, load, pull}"/></ParameterList>
    <ParameterList name="slide">
      <Parameter name="type" type="string" value="quasi-static"/>
      <Parameter name="duration" type="double" value="1.0"/>
      <Parameter name="conditions" type="Array(string)" value="{base right, load, pull}"/>
      <ParameterList name="time step"><Parameter name="initial" type="double" value="0.125"/></ParameterList>
    </ParameterList>
  </ParameterList>
</ParameterList>
"""


FORCES = [f"contact/face/{name}" for name in ("force on slave x", "force on slave y", "friction heat")]
HEAT_OF_STEPS = 2e-3  # of the heat; the forces follow from the position alone


class SlidingBlocks(ContactCase):
    def table(self, overlays, *extra, ranks=1):
        done = program(["run", "-q", self.deck("blocks")] + overlays + list(extra), ranks, self.folder)
        self.assertEqual(done.returncode, 0, done.stdout[-2000:] + done.stderr[-2000:])
        with open(os.path.join(self.folder, "results", "blocks.csv")) as file:
            return file.read(), History(os.path.join(self.folder, "results", "blocks.csv"))

    def check_sliding_blocks(self, *overlays):
        """Forces and heat once all slides, a restart halfway and more ranks. The history of the run on one rank."""
        decks = list(overlays) + [self.write("slide.xml", SLIDE)]
        text, history = self.table(decks)
        drag, force = history["contact/face/force on slave x"], history["contact/face/force on slave y"]
        # the ground tilts under the drag, by a strain of 1e-5
        self.compare_values("sliding force", -drag[-1], 0.3 * force[-1], 1e-3)
        self.compare_values("load", force[-1], 100.0, 1e-3)
        heat = history["contact/face/friction heat"]
        late = np.searchsorted(history.time, 1.7)  # from here on all slides
        self.compare_values("heat", heat[-1] - heat[late], 2e-4 * (2 - history.time[late]) * 30, 2e-3)
        self.table(decks, "--steps", "3")
        restarted, _ = self.table(decks, "--restart")
        self.assertEqual(restarted, text)
        self.assert_same_run(history, self.table(decks, ranks=3)[1], FORCES, "3 ranks", steps=HEAT_OF_STEPS)
        return history
