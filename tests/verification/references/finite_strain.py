"""One-dimensional consolidation at finite strain, in material coordinates (Gibson, England & Hussey, Geotechnique 1967).

Y is the initial height of a grain, J = dy/dY. Incompressible grains and water, no gravity, sudden load q on the drained
top, impermeable base:
  equilibrium     p = q + M ln J             (effective stress M ln J, tension positive)
  water           dJ/dt = d/dY (mobility/J dp/dY)
With mobility proportional to J^2 the equation is linear (Xie & Leo, Comput. Geotech. 31, 2004), which checks the solver.
"""
import numpy as np
from scipy.integrate import solve_ivp


class Consolidation:
    """Finite volumes, finer towards the top, and an implicit integrator of high order. `mobility(J)`: m2/(Pa s)."""

    def __init__(self, modulus, load, mobility, times, height=1.0, cells=300):
        self.modulus, self.load, self.height = modulus, load, height
        faces = height * (1 - (1 - np.linspace(0, 1, cells + 1)) ** 2)  # from the base upwards
        self.faces, self.middles, self.sizes = faces, 0.5 * (faces[1:] + faces[:-1]), np.diff(faces)
        self.final_ratio = np.exp(-load / modulus)
        distances = np.append(np.diff(self.middles), faces[-1] - self.middles[-1])

        def rate(_, log):  # in ln J, so that p is linear in the unknown
            above = np.append(log[1:], -load / modulus)
            ratio = np.exp(0.5 * (log + above))
            upward = -mobility(ratio) / ratio * modulus * (above - log) / distances
            upward = np.concatenate([[0], upward])
            return -np.diff(upward) / self.sizes / np.exp(log)

        band = 1
        # the integrator knows the tridiagonal Jacobian through its band
        self.solution = solve_ivp(rate, (0, times[-1]), np.zeros(cells), method="LSODA", t_eval=times, rtol=1e-7,
                                  atol=1e-9, lband=band, uband=band)
        assert self.solution.success, self.solution.message
        self.times = np.asarray(times)

    def settlement(self):
        """Of the top, at the times."""
        return self.height - self.sizes @ np.exp(self.solution.y)

    def pressure(self, initial_height):
        return np.array([self.load + self.modulus * np.interp(initial_height, self.middles, log) for log in self.solution.y.T])

    def final_settlement(self):
        return self.height * (1 - self.final_ratio)
