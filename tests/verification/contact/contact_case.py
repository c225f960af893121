"""What the contact tests share."""
import os

import h5py
import numpy as np

from mudline_case import ROOT, MudlineCase

PRESSURE, SHEAR = "contact_pressure_face", "contact_shear_face"


class ContactCase(MudlineCase):
    def deck(self, name):
        return os.path.join(ROOT, "inputs", "contact", name + ".xml")

    def surface(self, stem, level, *names):
        """Present x and the named nodal fields of the nodes that started at y = level, by x, at the end."""
        with h5py.File(os.path.join(self.folder, "results", stem + ".h5"), "r") as file:
            step = file["steps"][sorted(file["steps"])[-1]]
            start = file["mesh/coordinates"][:]
            top = np.flatnonzero(np.abs(start[:, 1] - level) < 1e-9)
            top = top[np.argsort(start[top, 0])]
            return [step["coordinates"][:][top, 0]] + [np.asarray(step["nodal"][name])[top] for name in names]
