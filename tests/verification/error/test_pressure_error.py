"""The estimated error of the pore pressure, for every shape of cell, on problems whose pressures are known."""
import os
import unittest

import h5py
import numpy as np

from compared_case import problem
from mudline_case import ROOT, MudlineCase, deck_text
from references import biot

# XDMF's numbers of the cells in the fields file: (corners, nodes)
XDMF = {4: (3, 3), 5: (4, 4), 6: (4, 4), 9: (8, 8), 36: (3, 6), 35: (4, 9), 38: (4, 10), 50: (8, 27)}
GAUSS, WEIGHTS = np.polynomial.legendre.leggauss(5)
TERZAGHI = os.path.join(ROOT, "inputs", "consolidation", "terzaghi.xml")
LINEAR = ("tri3", "quad4", "tet4", "hex8")
PLANE = ("tri3", "quad4", "tri6", "quad9")
SPACE = ("tet4", "hex8", "tet10", "hex27")


def shapes(corners, place):
    """Linear shape functions of a cell and their derivatives at a place of the reference cell; simplices: of the unit simplex."""
    dimension = len(place)
    if corners == dimension + 1:
        return np.append(1 - sum(place), place), np.vstack((-np.ones(dimension), np.eye(dimension)))
    signs = np.array([(-1, -1, -1), (1, -1, -1), (1, 1, -1), (-1, 1, -1), (-1, -1, 1), (1, -1, 1), (1, 1, 1), (-1, 1, 1)])[:corners, :dimension]
    factors = (1 + signs * place) / 2
    slopes = [signs[:, i] / 2 * np.prod(np.delete(factors, i, axis=1), axis=1) for i in range(dimension)]
    return np.prod(factors, axis=1), np.column_stack(slopes)


def rule(corners, dimension):
    """Places and weights, five points in every direction; in simplices by Duffy's transformation."""
    grid = np.array(np.meshgrid(*[GAUSS] * dimension)).reshape(dimension, -1).T
    weights = np.prod(np.array(np.meshgrid(*[WEIGHTS] * dimension)).reshape(dimension, -1), axis=0)
    if corners > dimension + 1:
        return grid, weights
    t = (1 + grid) / 2
    places, left = np.empty_like(t), np.ones(len(t))
    weights = weights / 2 ** dimension
    for i in range(dimension):
        weights = weights * left
        places[:, i] = left * t[:, i]
        left = left * (1 - t[:, i])
    return places, weights


def errors(path, exact, axisymmetric):
    """(share of the volume, true, estimated) root mean squares of every cell of the last step of a fields file."""
    with h5py.File(path, "r") as file:
        last = file["steps"][sorted(file["steps"])[-1]]
        x, p, estimated = file["mesh/coordinates"][:], last["nodal/pore_pressure"][:], last["cell/error_pore_pressure"][:]
        numbers, cells = file["mesh/topology"][:], []
    while len(numbers) > 0:
        corners, nodes = XDMF[numbers[0]]
        cells.append(numbers[1:1 + corners])
        numbers = numbers[1 + nodes:]
    dimension = 3 if np.ptp(x[:, 2:]) > 0 else 2
    volumes, squares = [], []
    for cell in cells:
        volume = square = 0.0
        for place, weight in zip(*rule(len(cell), dimension)):
            N, slopes = shapes(len(cell), place)
            at = N @ x[cell, :dimension]
            dv = weight * np.linalg.det(x[cell, :dimension].T @ slopes) * (at[0] if axisymmetric else 1)
            volume += dv
            square += dv * (N @ p[cell] - exact(*at)) ** 2
        volumes.append(volume)
        squares.append(square / volume)
    return np.array(volumes) / sum(volumes), np.sqrt(squares), estimated


def seepage(cell, value, geometry, lower, upper, cells):
    """Steady flow through stiff sand with the pressure given on all sides."""
    space = geometry == "three-dimensional"
    sides = ["left", "right", "bottom", "top"] + (["front", "back"] if space else [])
    held = {"hold": {"type": "fixed", "set": "left" if geometry != "axisymmetric" else "bottom"}}
    return {
        "mesh": {"type": "box", "geometry": geometry, "cell": cell, "cells": [cells] * (3 if space else 2), "lower": lower, "upper": upper},
        "materials": {"sand": {"porosity": 0.4, "skeleton": {"type": "linear elastic", "Young's modulus": 1e12, "Poisson's ratio": 0.2},
                               "fluid": {"type": "water", "incompressible": True},
                               "permeability": {"type": "constant", "hydraulic conductivity": 1e-5}}},
        "physics": {"sand": {"type": "biot", **({"pressure": "equal order"} if cell in LINEAR else {})}},
        "boundary conditions": {**held, **{side: {"type": "pore pressure", "set": side, "value": value} for side in sides}},
        "stages": {"flow": {"type": "quasi-static", "duration": 1e6, "time step": {"initial": 2.5e5}}},
        "output": {"error estimate": True},
    }


@problem("exact", "the true error, from harmonic pressures and Terzaghi's series",
         "Estimated error of the pore pressure")
class Pressure(MudlineCase):
    """Effectivity (estimated over true error) of the whole field between a half and two, for every shape of cell."""

    def check(self, name, cell, decks, exact, axisymmetric=False, settings=()):
        self.run_deck(decks, [f"output/name={name}_{cell}", *settings], name=f"{name}_{cell}")
        share, true, estimated = errors(os.path.join(self.folder, "results", f"{name}_{cell}.h5"), exact, axisymmetric)
        effectivity = np.sqrt(share @ estimated ** 2 / (share @ true ** 2))
        if os.environ.get("MUDLINE_SHOW_ERRORS"):
            between = share[(estimated > 0.5 * true) & (estimated < 2 * true)].sum()
            print(f"{name}, {cell}: true {np.sqrt(share @ true ** 2):.4g} Pa, effectivity {effectivity:.3f}, {100 * between:.0f} % of the volume "
                  "between a half and two", flush=True)
        self.compare_range(f"{name}, {cell}: effectivity", effectivity, 0.5, 2.0, 1.0)

    def flow(self, name, cell, value, geometry, lower, upper, cells, exact):
        deck = self.write("seepage.xml", deck_text("deck", seepage(cell, value, geometry, list(lower), list(upper), cells)))
        self.check(name, cell, deck, exact, geometry == "axisymmetric")

    def in_plane(self, name, value, exact, geometry="plane strain", lower=(0.0, 0.0), upper=(1.0, 1.0)):
        for cell in PLANE:
            self.flow(name, cell, value, geometry, lower, upper, 8, exact)

    def test_exponential(self):
        """Curvatures of opposite sign: the errors of square cells vanish at their own quadrature points."""
        self.in_plane("exponential", "1000*exp(2*x)*cos(2*y)", lambda x, y: 1000 * np.exp(2 * x) * np.cos(2 * y))

    def test_saddle(self):
        """A mixed curvature beside the other ones, on cells that are not square."""
        self.in_plane("saddle", "1000*(x^3-3*x*y^2+2*(3*x^2*y-y^3))", lambda x, y: 1000 * (x ** 3 - 3 * x * y ** 2 + 2 * (3 * x ** 2 * y - y ** 3)),
                      upper=(2.0, 1.0))

    def test_well(self):
        """Flow to a well in axial symmetry."""
        self.in_plane("well", "1000*log(x)", lambda r, z: 1000 * np.log(r), "axisymmetric", (1.0, 0.0), (3.0, 1.0))

    def test_exponential_in_space(self):
        for cell in SPACE:
            self.flow("in_space", cell, "1000*exp(2*x)*cos(1.2*y)*cos(1.6*z)", "three-dimensional", (0.0,) * 3, (1.0,) * 3, 4,
                      lambda x, y, z: 1000 * np.exp(2 * x) * np.cos(1.2 * y) * np.cos(1.6 * z))

    def test_source_in_space(self):
        """Flow from a point outside."""
        for cell in SPACE:
            self.flow("source", cell, "1000/sqrt((x+1)^2+y^2+z^2)", "three-dimensional", (0.0,) * 3, (1.0,) * 3, 4,
                      lambda x, y, z: 1000 / np.sqrt((x + 1) ** 2 + y ** 2 + z ** 2))

    def test_consolidation(self):
        """Terzaghi's column at a time factor of a tenth."""
        exact = biot.Column(biot.INCOMPRESSIBLE, load=10.0)
        for cell in PLANE:
            over = self.write("over.xml", deck_text("over", {
                "mesh": {"cell": cell, "cells": [2, 10], "upper": [0.2, 1.0], "grading": [1.0, 1.0]}, "output": {"error estimate": True},
                "physics": {"ground": {"pressure": "equal order" if cell in LINEAR else "Taylor-Hood"}}}))
            self.check("column", cell, [TERZAGHI, over], lambda x, y: exact.pressure(1 - y, 0.1),
                       settings=[f"stages/consolidation/duration={exact.time(0.1)}"])


if __name__ == "__main__":
    unittest.main()
