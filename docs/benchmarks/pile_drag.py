"""Where the soil beside a pile came from: pathlines back in time through the velocities of the fields, which know nothing of the remap
of stresses, against what the soil's state says. pile_wall.md has the figures.

python3 pile_drag.py RESULTS/deep [TIME] : results without ending, after a push from the surface in the clay of inputs/pile/clay.xml; the
end of the push by default. Needs h5py, matplotlib, scipy."""
import sys

import h5py
import numpy as np
from matplotlib.tri import LinearTriInterpolator, Triangulation
from scipy.spatial import cKDTree

LAMBDA, KAPPA, VOLUME = 0.2, 0.04, 2.3  # compression and swelling slope, specific volume at the start
RADIUS = 0.2
STEP = 0.005  # [s]
SPAN = (0.6, 3.05)  # depths of the shaft [m]
DISTANCES = 1e-3 * np.array([1, 2, 4, 7, 10, 14, 20, 28, 40, 57, 80])  # from the wall [m]
DEPTHS = (1.2, 1.6, 2.0, 2.4)  # [m]
POINTS = np.array([[4, 1, 1], [1, 4, 1], [1, 1, 4]]) / 6  # of a triangle


class Field:
    """Velocities of one written step; depths are those below the pile's tip, so that fields of different instants are alike."""

    def __init__(self, file, name):
        step = file["steps"][name]
        mesh = step["mesh"] if "mesh" in step else file["mesh"]
        nodes = mesh["topology"][:]
        self.cells = np.array([nodes[k + 1:k + 7] for k in mesh["offset"][:]])  # nodes[k]: type of the cell
        self.time, self.tip = step.attrs["time"], step["bodies/pile"].attrs["displacement"][1]
        self.x, self.velocity = step["coordinates"][:, :2], step["nodal/velocity"][:, :2]
        parts = np.vstack([self.cells[:, corners] for corners in ([0, 3, 5], [3, 1, 4], [5, 4, 2], [3, 4, 5])])
        triangles = Triangulation(*self.x.T, parts)
        finder = triangles.get_trifinder()
        self.inside = [LinearTriInterpolator(triangles, v, trifinder=finder) for v in self.velocity.T]
        self.nearest = cKDTree(self.x)

    def at(self, places, tip):
        """(place, component) beside a pile whose tip is at that height."""
        places = places + [0, self.tip - tip]
        result = np.column_stack([np.ma.filled(part(*places.T), np.nan) for part in self.inside])
        outside = np.isnan(result[:, 0])
        result[outside] = self.velocity[self.nearest.query(places[outside])[1]]
        return result


def origin(fields, places):
    """Where the soil at these places, at the time of the last field, was at the start."""
    times, tips = np.array([(field.time, field.tip) for field in fields]).T

    def rate(places, time):
        k = np.clip(np.searchsorted(times, time) - 1, 0, len(times) - 2)
        share, tip = (time - times[k]) / (times[k + 1] - times[k]), np.interp(time, times, tips)
        return (1 - share) * fields[k].at(places, tip) + share * fields[k + 1].at(places, tip)

    for time in np.arange(times[-1], 0, -STEP):
        middle = places - 0.5 * STEP * rate(places, time)
        places = places - STEP * rate(np.abs(middle) * [1, -1], time - 0.5 * STEP)
        places[:, 0] = np.abs(places[:, 0])
    return places


def critical(mean, preconsolidation, volume=VOLUME):
    """Mean effective stress at the critical state that soil in this state reaches with the specific volume of the start."""
    return (preconsolidation / 2) ** (1 - KAPPA / LAMBDA) * mean ** (KAPPA / LAMBDA) * np.exp((volume - VOLUME) / LAMBDA)


def main(stem, time=3.21):
    with h5py.File(stem + ".h5") as file:
        names = [name for name in sorted(file["steps"]) if file["steps"][name].attrs["time"] <= time * (1 + 1e-9)]
        fields = [Field(file, name) for name in names]
        first, now = (file["steps"][names[i]]["cell"] for i in (0, -1))
        start = critical(*(np.abs(first[name][:]) for name in ("mean_effective_stress", "preconsolidation_pressure")))
        depth = -fields[0].x[fields[0].cells[:, :3]].mean(axis=1)[:, 1]
        line = np.polyfit(depth, start, 1)  # the stresses of the start are linear in depth
        mean = np.abs(now["mean_effective_stress"][:])
        state = critical(mean, np.abs(now["preconsolidation_pressure"][:]), 1 + now["void_ratio"][:])
    cells, x = fields[-1].cells[:, :3], fields[-1].x
    print("drag [m] by pathlines, at distances from the wall [mm]:", *np.round(1e3 * DISTANCES).astype(int))
    for depth in DEPTHS:
        if depth < -fields[-1].tip - 2 * RADIUS:
            was = origin(fields, np.column_stack([RADIUS + DISTANCES, np.full(len(DISTANCES), -depth)]))
            print(f"  from a depth of {depth} m:", *(f"{value:.2f}" for value in depth + was[:, 1]))

    wall = np.abs(x[:, 0] - RADIUS) < 0.0025
    touching, middles = wall[cells].sum(axis=1), x[cells].mean(axis=1)
    span = (-middles[:, 1] > SPAN[0]) & (-middles[:, 1] < min(SPAN[1], -fields[-1].tip - 0.15)) & (middles[:, 0] < 4 * RADIUS)
    touched = np.isin(cells, cells[span & (touching == 2)]).any(axis=1)
    rows = ("first row", span & (touching == 2)), ("second", span & (touching == 1)), ("third", span & (touching == 0) & touched)
    for name, row in rows:
        corners = x[cells[row]]
        was = origin(fields, np.vstack([np.einsum("c,ecd->ed", point, corners) for point in POINTS]))
        came = np.polyval(line, np.maximum(-was[:, 1], 0)).reshape(3, -1).mean(axis=0)
        drag = -middles[row, 1] + was[:, 1].reshape(3, -1).mean(axis=0)
        by_state = -middles[row, 1] - (state[row] - line[1]) / line[0]
        length = np.ptp(corners[:, :, 1], axis=1)
        average = lambda values: np.average(values, weights=length)  # noqa: E731
        print(f"{name}, {1e3 * average(middles[row, 0] - RADIUS):.0f} mm from the wall: p' {average(mean[row]) / 1e3:.2f} kPa; "
              f"critical state by its own state {average(state[row]) / 1e3:.2f}, of where it came from {average(came) / 1e3:.2f}, "
              f"of its depth {average(np.polyval(line, -middles[row, 1])) / 1e3:.2f}; drag by its state {average(by_state):.2f} m, "
              f"by pathlines {average(drag):.2f}")


main(sys.argv[1], *map(float, sys.argv[2:]))
