"""Two elastic bars that meet: force plateau, duration, impulse, energy; E = 200 GPa, 7800 kg/m3, 1 m, 1e-4 m2, 5 m/s each."""
import os
import unittest

import h5py
import numpy as np
from compared_case import problem
from mudline_case import ROOT, MudlineCase

DECK = os.path.join(ROOT, "inputs", "impact", "two_bars.xml")
FORCE, DURATION, IMPULSE = 19748.4177, 3.949684e-4, 7.8
ENERGY = 2 * 0.5 * 0.78 * 5.0**2
THROWN = 6e-4  # s, end of the first stage
# the bars meet 5e-5 s after they are thrown, and have parted well before the end
CLOSE = ("mesh/parameters/gap=0.006", "stages/fly and meet/duration=5e-4")


@problem("exact", "one-dimensional wave theory", "Two elastic bars that meet")
class Bars(MudlineCase):
    def meet(self, radius, *settings):
        history = self.run_deck(DECK, (f"stages/fly and meet/integrator/spectral radius={radius}", *CLOSE, *settings))
        force = -history["contact/faces/force on slave x"]
        touching = np.flatnonzero(force > 0)
        self.begin, self.end = history.time[touching[0] - 1], history.time[touching[-1]]
        self.early = (history.time > self.begin + 0.1 * DURATION) & (history.time < self.begin + 0.9 * DURATION)
        self.assertEqual(force[-1], 0)  # they have parted
        return history, force

    def velocities(self):
        """Mean velocity of each bar (masses of equal linear elements in a row) at the end."""
        with h5py.File(os.path.join(self.folder, "results", "two_bars.h5"), "r") as file:
            x = file["mesh/coordinates"][:, 0]
            v = file["steps"][sorted(file["steps"])[-1]]["nodal/velocity"][:][:, 0]
        means = []
        for bar in (x < 0, x > 0):
            ends = (x[bar] == x[bar].min()) | (x[bar] == x[bar].max())
            means.append(np.average(v[bar], weights=np.where(ends, 0.5, 1.0)))
        return means

    def close(self, what, value, exact, tolerance):
        self.compare(what, np.max(np.abs(value / exact - 1)), tolerance)

    def lost(self, history):
        """Energy that integrator and contact have taken since the bars flew, over that of the start."""
        taken = history["balance/energy/numerical dissipation"] + history["balance/energy/contact/faces"]
        return (taken - taken[np.searchsorted(history.time, THROWN)])[history.time >= THROWN] / ENERGY

    def test_force_duration_impulse(self):
        history, force = self.meet(0.5)
        self.close("plateau", force[self.early], FORCE, 0.02)
        self.close("mean force", force[self.early].mean(), FORCE, 0.002)
        self.close("duration", self.end - self.begin, DURATION, 0.01)
        left, right = self.velocities()
        # the bars keep a per cent of the energy as vibration, so they part a little slower than they met
        self.close("impulse", 0.78 * (5 - left), IMPULSE, 0.01)
        self.compare("difference of the speeds", abs(left + right) / 5, 1e-6)
        lost = self.lost(history)
        self.assertGreater(lost[-1], 0)
        self.assertLess(lost[-1], 0.02)

    def of_cells(self, cells, *settings):
        """The bars with so many cells each, half a cell's travel time per step: contact's impulse and the loss of momentum of each bar [N s]."""
        with open(os.path.join(os.path.dirname(DECK), "two_bars.geo")) as file:
            mesh = self.write("bars.geo", file.read().replace("cells = {100,", f"cells = {{{cells},"))
        stage = "stages/fly and meet/"
        history, force = self.meet(0.5, f"mesh/file={mesh}", stage + f"time step/initial={1e-4 / cells}", stage + f"time step/maximum={1e-4 / cells}", *settings)
        left, right = self.velocities()
        return np.sum(force * history["step/dt"]), 0.78 * (5 - left), 0.78 * (5 + right)

    def test_impulse_is_the_change_of_momentum(self):
        # what the integrator takes of the two ends adds up to the force at the ends of all steps
        impulse, left, right = self.of_cells(40, "contacts/faces/impact=interpolated")
        self.close("impulse against the left bar's momentum", impulse, left, 1e-6)
        self.close("impulse against the right bar's momentum", impulse, right, 1e-6)

    def test_impulse_converges(self):
        """Towards that of waves without dispersion, with the root of the cells' size: what is missing stays as vibration behind the steep front."""
        errors = [1 - self.of_cells(cells)[1] / IMPULSE for cells in (20, 40, 80)]
        self.assertGreater(min(errors[1:]), 0)
        self.compare_orders("order of the impulse", errors, -np.log2(0.85), all_orders=True)
        self.compare("impulse, 80 cells", errors[-1], 4e-3)

    def test_no_growth_at_radius_one(self):
        history, force = self.meet(1.0)
        self.close("mean force", force[self.early].mean(), FORCE, 0.02)
        self.compare("numerical dissipation",
                     np.abs(history["balance/energy/numerical dissipation"][history.time >= THROWN]
                            - history.at("balance/energy/numerical dissipation", THROWN)).max() / ENERGY, 1e-10)
        # the contact has opened: what its springs took has been given back
        self.compare("energy in the contact", abs(history["balance/energy/contact/faces"][-1]) / ENERGY, 1e-10)
        left, right = self.velocities()
        self.compare("difference of the speeds", abs(left + right) / 5, 1e-6)

    def test_damping_takes_what_it_reports(self):
        history, force = self.meet(1.0, "contacts/faces/damping=0.01")
        heat = history["contact/faces/damping heat"][-1]
        if os.environ.get("MUDLINE_SHOW_ERRORS"):
            print(f"damping heat {heat / ENERGY:.3e} of the energy, mean force {force[self.early].mean() / FORCE:.5f}")
        self.assertGreater(heat, 1e-4 * ENERGY)
        self.compare("energy in the contact against damping heat",
                     abs(history["balance/energy/contact/faces"][-1] - heat) / ENERGY, 1e-9)
        self.close("mean force", force[self.early].mean(), FORCE, 0.02)  # bars that move together are not damped
        left, right = self.velocities()
        self.compare("difference of the speeds", abs(left + right) / 5, 1e-6)

    def test_damping_of_mortar(self):
        """Its springs are not conserving: what they give or take themselves is left of the contact's work."""
        with open(DECK) as file:
            text = "".join(line for line in file if "master surface" not in line).replace("node to segment", "mortar")
        deck = self.write("two_bars.xml", text.replace("two_bars.geo", os.path.join(os.path.dirname(DECK), "two_bars.geo")))
        lost = []
        for damping in (0.0, 0.01):
            history = self.run_deck(deck, ("stages/fly and meet/integrator/spectral radius=1", *CLOSE,
                                           "contacts/faces/enforcement=penalty", f"contacts/faces/damping={damping}"))
            lost.append(history["balance/energy/contact/faces"][-1])
        heat = history["contact/faces/damping heat"]
        self.assertGreater(heat[-1], 1e-3 * ENERGY)
        self.assertGreater(np.diff(heat).min(), -1e-12 * ENERGY)
        self.close("damping heat", lost[1] - lost[0], heat[-1], 0.02)
        left, right = self.velocities()
        self.compare("difference of the speeds", abs(left + right) / 5, 1e-6)

    @problem("behaviour")
    def test_no_growth_with_a_stiff_spring(self):
        """Steps that do not resolve the penalty's spring, radii at which such steps used to add energy."""
        stage = "stages/fly and meet/"
        for radius in (0.8, 0.9):
            history, _ = self.meet(radius, "contacts/faces/penalty factor=10", stage + "time step/initial=2e-6", stage + "time step/maximum=2e-6")
            lost = self.lost(history)
            self.assertGreater(lost.min(), -1e-6)
            self.assertLess(lost[-1], 0.01)

    @problem("behaviour")
    def test_step_is_bounded_by_the_closing_speed(self):
        """Far apart the bars may come half their distance nearer, close by a quarter of the shortest side, 1e-4 m."""
        stage = "stages/fly and meet/"
        history = self.run_deck(DECK, (stage + "duration=4e-4", stage + "time step/initial=4e-4", stage + "time step/maximum=4e-4"))
        start, end = history.time[:-1], history.time[1:]
        flight = (start >= THROWN * (1 - 1e-9)) & (end < THROWN + 4e-4)
        gap = 0.01 - 10 * (start - 5e-5)  # the throw takes 1e-4 s to its speed
        allowed = np.maximum(0.5 * gap, 0.25e-4) / 10
        self.assertGreater(flight.sum(), 2)
        self.assertLess(((end - start) / allowed)[flight].max(), 1.001)
        self.assertGreater(((end - start) / allowed)[flight].max(), 0.85)


if __name__ == "__main__":
    unittest.main()
