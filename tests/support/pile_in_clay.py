"""The clay of inputs/pile/clay.xml in numbers (m, s, kPa), the cavity that a pile opens in it, and what a run finds on the pile's wall."""
import functools

import numpy as np

from references.cavity import CamClayRates, Undrained

RADIUS = 0.2
CLAY = dict(M=1.0, slope=0.2, swelling=0.04, nu=0.3, v0=2.3)
K0, OCR, SURCHARGE, GAMMA, GAMMA_WATER, CONDUCTIVITY = 0.6, 2.0, 10.0, 1700 * 9.81e-3 / 2.3, 9.81, 1e-9
START = (K0, K0, 1.0)  # rr, hoop, zz over the vertical one: all stresses of a solution grow in proportion to this


def vertical(depth):
    """Effective stress at the start."""
    return SURCHARGE + GAMMA * depth


@functools.cache
def cavity():
    """Undrained cylindrical cavity from nothing: total radial stress beyond hydrostatic and excess pore pressure at the wall, over the vertical
    effective stress."""
    solution = Undrained(CamClayRates(**CLAY, start=START, ocr=OCR), 1, 300.0)
    stress, total = solution.at(290.0)[:2]
    return total, total - stress[0]


def wall(file, step):
    """Depth, radius, total radial stress beyond hydrostatic, effective radial stress, excess pressure at the vertices that touch the pile, from the
    tip up. file: a run's fields (h5py), step: one of its steps."""
    x = step["coordinates"][:, :2]
    cells = file["mesh/topology"][()].reshape(-1, 7)[:, 1:4].astype(int)
    contact, excess = step["nodal/contact_pressure_pile"][()] * 1e-3, step["nodal/excess_pore_pressure"][()] * 1e-3
    radial = -step["cell/effective_stress"][:, 0] * 1e-3
    touching = sorted((i for i in np.unique(cells) if contact[i] > 0), key=lambda i: x[i, 1])
    # the surcharge presses on the soil beside and under the pile like a heavy fluid, apart from the contact; water at rest acts nowhere
    rows = [(-x[i, 1], x[i, 0], contact[i] + SURCHARGE, radial[(cells == i).any(axis=1)].mean(), excess[i]) for i in touching]
    return np.array(rows).reshape(-1, 5).T


def shares_of_cavity(depth, total, effective, excess):
    """The stresses on a wall over those of the cavity at their depths."""
    total_cavity, excess_cavity = cavity()
    scale = vertical(depth)
    return {
        "total radial stress, from the contact": total / scale / total_cavity,
        "effective radial stress": effective / scale / (total_cavity - excess_cavity),
        "excess pore pressure": excess / scale / excess_cavity,
    }


def at_half_height(radius, share):
    """Of a pile that tapers to its tip: a share where the wall has half the shaft's radius."""
    taper = radius < 0.99 * RADIUS
    return np.interp(0.5 * RADIUS, radius[taper], share[taper])
