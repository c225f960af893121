"""Closed solutions of linear consolidation for tests: SI units, pore pressure positive in compression.

Column: Terzaghi, Theoretical Soil Mechanics (1943), with Biot's storage as in Detournay & Cheng (1993), sec. 5.2.
Slab, cylinder and sphere: Mandel (Geotechnique 1953), de Leeuw (1965) and Cryer (Q. J. Mech. Appl. Math. 1963). They
share one solution in Laplace space, since displacement is a gradient: M div u - alpha p = g(t) in the whole body
(Cheng, Poroelasticity 2016, ch. 7). It is inverted with the fixed Talbot rule (Abate & Valko, Int. J. Numer. Meth.
Engng 60, 2004).
"""
from dataclasses import dataclass

import numpy as np
from scipy.optimize import brentq, minimize_scalar
from scipy.special import ive


@dataclass(frozen=True)
class Soil:
    """Linear poroelastic soil; storage is that at constant strain, mobility is conductivity over unit weight."""
    young: float = 10e6
    poisson: float = 0.25
    alpha: float = 1.0
    storage: float = 0.0
    mobility: float = 1e-10

    @property
    def shear(self):
        return self.young / (2 * (1 + self.poisson))

    @property
    def oedometric(self):
        return 2 * self.shear * (1 - self.poisson) / (1 - 2 * self.poisson)

    @property
    def capacity(self):
        """Storage at constant uniaxial stress."""
        return self.storage + self.alpha ** 2 / self.oedometric

    @property
    def diffusivity(self):
        return self.mobility / self.capacity


INCOMPRESSIBLE = Soil()
COMPRESSIBLE = Soil(alpha=0.9, storage=2.75e-8)


class Column:
    """Height, load; drained on top, where it is loaded; base fixed and impermeable. T = c t / height^2."""

    def __init__(self, soil, height=1.0, load=10e3):
        self.soil, self.height, self.load = soil, height, load
        self.initial_pressure = soil.alpha * load / (soil.oedometric * soil.capacity)
        self.initial_settlement = height * (load - soil.alpha * self.initial_pressure) / soil.oedometric
        self.final_settlement = height * load / soil.oedometric
        self._wave = (np.arange(300) + 0.5) * np.pi

    def time(self, T):
        return T * self.height ** 2 / self.soil.diffusivity

    def pressure(self, depth, T):
        modes = np.sin(np.multiply.outer(np.asarray(depth) / self.height, self._wave))
        return self.initial_pressure * modes @ (2 / self._wave * np.exp(-self._wave ** 2 * T))

    def settlement(self, T, depth=0.0):
        """Downward displacement of the soil at a depth below the surface."""
        left = np.asarray(depth) / self.height
        modes = np.cos(np.multiply.outer(left, self._wave)) @ (2 / self._wave ** 2 * np.exp(-self._wave ** 2 * T))
        excess = self.soil.alpha * self.initial_pressure * self.height / self.soil.oedometric
        return self.final_settlement * (1 - left) - excess * modes


class Symmetric:
    """Body of half width or radius 1 m in 1 (Mandel's slab), 2 (cylinder) or 3 (sphere) dimensions, load [Pa] = mean
    pressure of the plates or the pressure on the drained surface. T = c t / m^2."""

    def __init__(self, dimensions, soil, load=10e3):
        self.dimensions, self.soil, self.load = dimensions, soil, load
        ratio = 2 * soil.shear / soil.oedometric
        # -load = direct g - mixed alpha <p>: vertical equilibrium of the plate, radial equilibrium of the surface
        if dimensions == 1:
            self._direct, self._mixed = 2 - ratio, ratio
        else:
            self._mixed = ratio * (dimensions - 1) / dimensions
            self._direct = 1 - self._mixed
        self._coupling = soil.alpha / (soil.oedometric * soil.capacity)  # p = -coupling g where nothing flows yet

    def _shape(self, root, r):
        """Solution of the Laplacian times s that is 1 on the surface, and its mean over the body."""
        if self.dimensions == 2:
            near, surface = ive(0, root), np.exp(np.abs(root.real) * (r - 1))
            return ive(0, root * r) / near * surface, 2 * ive(1, root) / (root * near)
        decay = np.exp(-2 * root)
        tanh = (1 - decay) / (1 + decay)
        if self.dimensions == 1:
            return (np.exp(root * (r - 1)) + np.exp(-root * (r + 1))) / (1 + decay), tanh / root
        value = (2 * root * np.exp(-root) if r == 0 else (np.exp(root * (r - 1)) - np.exp(-root * (r + 1))) / r) / (1 - decay)
        return value, 3 * (root / tanh - 1) / root ** 2

    def _transforms(self, s, r):
        shape, mean = self._shape(np.sqrt(s), r)
        g = -self.load / (s * (self._direct + self._mixed * self.soil.alpha * self._coupling * (1 - mean)))
        p, p_mean = -self._coupling * g * (1 - shape), -self._coupling * g * (1 - mean)
        return np.array([g, p, p_mean])

    def _at(self, T, r=0.0, terms=18):
        """g, p(r), mean p."""
        angle = np.arange(1, terms) * np.pi / terms
        cot = 1 / np.tan(angle)
        radius = 2 * terms / (5 * T)
        s = radius * np.concatenate([[1], angle * (cot + 1j)])
        weight = np.concatenate([[0.5], 1 + 1j * (angle + (angle * cot - 1) * cot)])
        return radius / terms * (self._transforms(s.astype(complex), r) * weight * np.exp(s * T)).real.sum(axis=1)

    def pressure(self, T, r=0.0):
        return self._at(T, r)[1]

    def radial_displacement(self, T):
        """Of the cylinder's or the sphere's surface, or of the slab's free side."""
        g, _, mean = self._at(T)
        volume = (g + self.soil.alpha * mean) / self.soil.oedometric
        return volume - self.plate_strain(T) if self.dimensions == 1 else volume / self.dimensions

    def plate_strain(self, T):
        """Vertical strain of the slab."""
        return self._at(T)[0] / (2 * self.soil.shear)

    def peak(self):
        """Time and value of the largest pressure at the centre."""
        found = minimize_scalar(lambda log: -self.pressure(np.exp(log)), bounds=(-5, -1), method="bounded",
                                options={"xatol": 1e-8})
        return np.exp(found.x), -found.fun


def leaky_column(height, time_factor, number, terms=60):
    """p / p0 at height z / L of a column with an impermeable base whose top lets water through, after a sudden load:
    kappa dp/dz + C p = 0 at z = L, number = C L / kappa, time_factor = c t / L^2. Carslaw and Jaeger (1959), section 3.11."""
    roots = [brentq(lambda m: m * np.sin(m) - number * np.cos(m), i * np.pi, i * np.pi + np.pi / 2) for i in range(terms)]
    return sum(4 * np.sin(m) / (2 * m + np.sin(2 * m)) * np.cos(m * height) * np.exp(-m * m * time_factor) for m in roots)
