"""A rigid plate that is pulled off a saturated elastic layer at a constant velocity (plane, small strains, incompressible water).

The layer is drained at its base and touched by the plate at its top. The total stress is uniform over the height, so the
effective stress s (compression positive) diffuses, s_t = c s_zz, with z from the top down. What moves up at the base is
water alone, and as much as the plate moves: s_z(H) = -V / mobility. While the plate touches, no water passes the top: s_z(0) = 0.
When s(0) = 0 the surfaces part, and water fills the gap: s(0) = 0 from then on. When the water's pressure has fallen to that of
cavitation the total stress stays there: s(H) = p_c."""
import numpy as np
from scipy.integrate import trapezoid
from scipy.optimize import brentq

TERMS = np.arange(1, 400)
Z = np.linspace(0, 1, 8001)


def coefficients(values, modes):
    """Of values(Z) in an expansion in sin(modes Z)."""
    return np.array([2 * trapezoid(values * np.sin(m * Z), Z) for m in modes])


class PulledPlate:
    def __init__(self, height, modulus, mobility, velocity, stress=0.0, cavitation=-np.inf):
        self.height, self.modulus, self.velocity, self.stress, self.cavitation = height, modulus, velocity, stress, cavitation
        self.time = height**2 / (mobility * modulus)
        self.mobility = mobility
        self.pull = velocity * height / mobility  # [Pa] in the end
        self.parts = brentq(lambda T: self.touching(T)[0], 1e-12, 1e3) if stress > 0 else 0.0
        start = self.touching(self.parts) if stress > 0 else np.zeros_like(Z)
        self.odd = (TERMS - 0.5) * np.pi
        self.open = coefficients(start + self.pull * Z, self.odd)
        self.vapour_from = np.inf
        if self.pull > -cavitation:
            self.vapour_from = self.parts + brentq(lambda T: self.parted(T)[-1] - cavitation, 1e-6, 1e3)
            self.even = TERMS * np.pi
            self.boiling = coefficients(self.parted(self.vapour_from - self.parts) - cavitation * Z, self.even)

    def touching(self, T):
        series = sum((-1.0)**n / n**2 * np.exp(-(n * np.pi)**2 * T) * np.cos(n * np.pi * Z) for n in TERMS)
        return self.stress - self.pull * (T + (3 * Z**2 - 1) / 6 - 2 / np.pi**2 * series)

    def parted(self, T):
        return -self.pull * Z + np.sin(np.outer(Z, self.odd)) @ (self.open * np.exp(-self.odd**2 * T))

    def boils(self, T):
        return self.cavitation * Z + np.sin(np.outer(Z, self.even)) @ (self.boiling * np.exp(-self.even**2 * T))

    def profile(self, t):
        T = t / self.time
        if T < self.parts:
            return self.touching(T)
        return self.parted(T - self.parts) if T < self.vapour_from else self.boils(T - self.vapour_from)

    def total(self, t):
        """Pressure of the plate on the layer [Pa]."""
        return self.profile(t)[-1]

    def gap(self, t):
        lifted = -self.height / self.modulus * trapezoid(self.profile(t) - self.stress, Z)
        return self.velocity * t - lifted

    def vapour(self, t):
        """Thickness of the gap that is not water [m]: what the plate has gone less what has come up at the base."""
        T = t / self.time - self.vapour_from
        if T <= 0:
            return 0.0
        slope = self.cavitation * T + np.sum(self.boiling * np.cos(self.even) * (1 - np.exp(-self.even**2 * T)) / self.even)
        return self.velocity * T * self.time + self.mobility / self.height * slope * self.time
