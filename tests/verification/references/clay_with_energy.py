"""Modified Cam Clay with elasticity that stores energy (Houlsby, Amorosi and Rojas 2005 with n = 1, and the same with a
specific volume that follows the strain). Compression positive, g = G/p', v the specific volume.

The potential psi(w) of w = eps_v + g e:e, with e the deviator of the elastic strain: psi' is the swelling line,
p_ref exp(v w/kappa) with a constant v, else p_ref exp((v - v exp(-w))/kappa). Stresses are its derivatives here, by a
complex step; its rates are those of the stiffness, in principal axes.
"""
import numpy as np
from scipy.integrate import solve_ivp
from scipy.special import exp1

from references.cavity import CamClayRates

STEP = 1e-30  # imaginary: the derivative is exact to rounding


class Potential:
    """The elastic law from p_ref at no strain. Strains: xx yy zz yz xz xy, engineering shear."""

    def __init__(self, g, swelling, v0, reference, current=True):
        self.g, self.swelling, self.v0, self.reference, self.current = g, swelling, v0, reference, current

    def energy(self, strain):
        volume = strain[0] + strain[1] + strain[2]
        deviator = [c - volume / 3 for c in strain[:3]]
        w = volume + self.g * (sum(c * c for c in deviator) + 0.5 * sum(c * c for c in strain[3:]))
        x = self.v0 / self.swelling
        if self.current:  # the integral of p_ref exp(x - x exp(-w))
            return self.reference * np.exp(x) * exp1(x * np.exp(-w))
        return self.reference / x * np.exp(x * w)

    def stress(self, strain):
        gradient = []
        for i in range(6):
            moved = np.array(strain, dtype=complex)
            moved[i] += 1j * STEP
            gradient.append(self.energy(moved).imag / STEP)
        return np.array(gradient)


class EnergyRates(CamClayRates):
    """The law in principal axes: D = 2 g p' on the deviator + K/p'^2 sigma sigma, K = v p'/kappa exp(-q^2/(6 g p'^2))."""

    def __init__(self, ratio, **clay):
        super().__init__(nu=0.0, **clay)
        self.ratio = ratio

    def elastic(self, stress, state):
        p, q2, _ = self.invariants(stress)
        bulk = self.v0 * np.exp(-state[1] - q2 / (6 * self.ratio * p * p)) * p / self.swelling
        return 2 * self.ratio * p * (np.eye(3) - 1 / 3) + bulk / p ** 2 * np.outer(stress, stress)


def triaxial(law, kind, axial):
    """p', q, volumetric strain and pc at axial strains, which are all positive and grow: undrained, drained or oedometer."""

    def direction(D):
        if kind == "drained":  # the radial stress stays
            return np.array([1.0, 1.0, 1.0]) - np.array([0.0, 1.0, 1.0]) * (1 + D[1, 0] / (D[1, 1] + D[1, 2]))
        return np.array([1.0, -0.5, -0.5] if kind == "undrained" else [1.0, 0.0, 0.0])

    def rate(plastic):
        def of(x, y):
            D, state_rate = law.stiffness(y[:3], y[3:], plastic)
            e = direction(D)
            return np.concatenate((D @ e, state_rate(e)))
        return of

    def yields(x, y):
        return law.yield_function(y[:3], y[3:])

    yields.terminal, yields.direction = True, 1
    options = {"method": "DOP853", "rtol": 1e-11, "atol": 1e-10, "dense_output": True}
    y, x, parts = np.concatenate((law.start, law.begin)), 0.0, []
    if law.yield_function(law.start, law.begin) < -1e-9:
        part = solve_ivp(rate(False), (0.0, axial[-1]), y, events=yields, **options)
        parts.append((part.t[-1], part.sol))
        x, y = part.t[-1], part.y[:, -1]
    if x < axial[-1]:
        parts.append((axial[-1], solve_ivp(rate(True), (x, axial[-1]), y, **options).sol))
    rows = []
    for a in axial:
        y = next(solution for end, solution in parts if a <= end)(a)
        rows.append((y[:3].mean(), y[0] - y[1], y[4], y[3]))
    return np.array(rows).T
