"""Mean effective stress on a pile's wall against the critical states of the depth where the soil is and of the depth where it was:
python3 pile_drag.py results/pile_drag TIME [radius of the pile]. Needs h5py."""
import sys

import h5py
import numpy as np

LAMBDA, KAPPA = 0.2, 0.04  # compression and swelling slope of inputs/pile/clay.xml


def at_corners(places, mesh):
    starts, nodes = mesh["offset"][:], mesh["topology"][:]
    return np.array([places[nodes[k + 1:k + 4], :2].mean(axis=0) for k in starts])  # nodes[k]: type of the cell


def critical(preconsolidation, mean):
    """Mean effective stress at the critical state that soil reaches without drainage from this state."""
    return (preconsolidation / 2) ** (1 - KAPPA / LAMBDA) * mean ** (KAPPA / LAMBDA)


def main(stem, time, radius=0.2):
    with h5py.File(stem + ".h5") as file:
        names = sorted(file["steps"])
        first = file["steps"][names[0]]
        now = min((file["steps"][name] for name in names), key=lambda step: abs(step.attrs["time"] - time))
        depth = -at_corners(first["coordinates"][:], file["mesh"])[:, 1]
        start = critical(np.abs(first["cell/preconsolidation_pressure"][:]),
                         np.abs(first["cell/mean_effective_stress"][:]))
        line = np.polyfit(depth, start, 1)  # the stresses of the start are linear in depth
        place = at_corners(now["coordinates"][:], file["mesh"])
        was = now["cell/place_at_the_start"][:]
        mean = np.abs(now["cell/mean_effective_stress"][:])
        state = critical(np.abs(now["cell/preconsolidation_pressure"][:]), mean)
        ratio, deviator = now["cell/void_ratio"][:], now["cell/deviatoric_stress"][:]
        print(f"t = {now.attrs['time']:.3f} s; of the critical state: mean stress by its depth, by the depth of its "
              "start, critical state of its own state by the depth of its start")
        for k in np.argsort(-place[:, 1]):
            away = place[k, 0] - radius
            if 0 < away < 0.025 and -place[k, 1] > 0.1:
                own, begun = np.polyval(line, -place[k, 1]), np.polyval(line, -was[k, 1])
                print(f"depth {-place[k, 1]:.3f} m, {1e3 * away:4.1f} mm from the wall, "
                      f"from {-was[k, 1]:.3f} m and radius {was[k, 0]:.3f} m: "
                      f"{mean[k] / own:.2f} {mean[k] / begun:.2f} {state[k] / begun:.2f}, "
                      f"q/p' {deviator[k] / mean[k]:.2f}, e {ratio[k]:.3f}")


main(sys.argv[1], float(sys.argv[2]), *map(float, sys.argv[3:]))
