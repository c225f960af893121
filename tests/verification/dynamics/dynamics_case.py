"""What the dynamic tests share: the columns of inputs/dynamic_column as references see them, comparison with peaks."""
import os

import numpy as np
from scipy.interpolate import CubicSpline

from mudline_case import ROOT, MudlineCase
from references import porous_column as reference

SCALE = 1e-3  # of the loads in the decks, for small strains

DE_BOER = reference.Column(10.0, 8.3750e6 + 2 * 5.5833e6, 0.33, 2000.0, 1e-6)
SAND = reference.Column(10.0, 40e6, 0.4, 2650.0, 1e-8, storage=0.4 / 2.2e9)
SINE_RAMP = reference.Column(30.0, 30e6 * 0.8 / 0.72, 0.3, 2000.0, 1e-6, storage=0.3 / 100e6)
LAYER = reference.Column(30.0, 749.2e6 * 0.8 / 0.72, 0.333, 2000.0, 1e-11, storage=0.333 / 3.33e9)
HAN = reference.Column(10.0, 10e6 * 0.8 / 0.72, 0.35, 1650 / 0.65, 1e-2 / 9810)


def stiff_layer(conductivity, fluid_acceleration=False):
    return reference.Column(4.0, 5e9, 0.4, 2650.0, conductivity / 9810, storage=0.4 / 2e9, water_load=True,
                            fluid_acceleration=fluid_acceleration)


def fluid_acceleration(on):
    return (f"physics/ground/fluid acceleration={'true' if on else 'false'}",)


def corner(height, cells, ratio, depth):
    """Depth of the cell corner nearest to `depth`, where the pore pressure lives; ratio: of last to first cell, upwards."""
    sizes = ratio ** (np.arange(cells) / (cells - 1))
    depths = height - height * np.concatenate([[0], np.cumsum(sizes)]) / sizes.sum()
    return depths[np.argmin(np.abs(depths - depth))]


class DynamicsCase(MudlineCase):
    def deck(self, name, topic="dynamic_column"):
        return os.path.join(ROOT, "inputs", topic, name + ".xml")

    def settlement(self, history, probe, times):
        return -between(history, f"probe/{probe}/displacement y", times)

    def pressure(self, history, probe, times):
        return between(history, f"probe/{probe}/pore pressure", times)



def between(history, name, times):
    """A column at any times; cubic, since straight lines would cost more than the time steps do."""
    return CubicSpline(history.time, history[name])(times)
