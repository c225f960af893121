"""What the consolidation tests share: decks, the compressible soil, values of a history between its rows."""
import os

import h5py
import numpy as np
from scipy.interpolate import CubicSpline

from mudline_case import ROOT, MudlineCase

# alpha = 0.9 and storage n/K_f + (alpha - n)/K_s = 2.75e-8 1/Pa at the decks' porosity of 0.4
COMPRESSIBLE = ("materials/soil/Biot coefficient=0.9", "materials/soil/grain bulk modulus=66666666.666666667",
                "materials/soil/fluid/incompressible=false", "materials/soil/fluid/bulk modulus=2e7")


class ConsolidationCase(MudlineCase):
    def deck(self, name):
        return os.path.join(ROOT, "inputs", "consolidation", name + ".xml")

    def fields(self, stem):
        return h5py.File(os.path.join(self.folder, "results", stem + ".h5"), "r")

    def corner_near(self, stem, x, y):
        """Initial position of the cell corner nearest to (x, y): a probe there shows that corner's pore pressure."""
        with self.fields(stem) as file:
            nodes, topology = file["mesh/coordinates"][:, :2], file["mesh/topology"][:]
        width, corners = {35: (10, 4), 36: (7, 3)}[topology[0]]  # XDMF's codes of quad9 and tri6
        nodes = nodes[np.unique(topology.reshape(-1, width)[:, 1:1 + corners])]
        return nodes[np.argmin(np.hypot(nodes[:, 0] - x, nodes[:, 1] - y))]



def between(history, name, times):
    """A column at any times; cubic, since straight lines between the rows would cost more than the time steps do."""
    return CubicSpline(history.time, history[name])(times)
