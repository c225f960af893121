"""Heat in saturated soil: linear, small strain, incompressible constituents, skeleton that expands like its grains.

Pore pressure and rise of temperature positive up, displacement away from the source. Balances: (lambda + 2G) eps_v = p + K a_s T
(irrotational); div v + div q = (n a_w + (1-n) a_s) dT/dt; q = -mobility grad p; dT/dt = kappa lap T. Both fields diffuse, so the
pressure is a difference of two solutions of the equation of heat. Booker and Savvidou (1985), McTigue (1986); the front in a uniform
flow: Ogata and Banks (1961).
"""
from dataclasses import dataclass

import numpy as np
from scipy.special import erf, erfc, erfcx


@dataclass
class Clay:
    """That of inputs/heat; SI units."""
    young: float = 1e7
    poisson: float = 0.3
    porosity: float = 0.4
    mobility: float = 2e-14       # k/gamma_w [m2/(Pa s)]
    conductivity: float = 1.5     # [W/(m K)]
    heat_capacity: float = 2.8e6  # [J/(m3 K)] of the whole
    expansion_of_water: float = 4e-4
    expansion_of_grains: float = 3e-5

    def __post_init__(self):
        self.constrained = self.young * (1 - self.poisson) / ((1 + self.poisson) * (1 - 2 * self.poisson))
        self.thermal_stress = self.young / (3 * (1 - 2 * self.poisson)) * self.expansion_of_grains
        whole = self.porosity * self.expansion_of_water + (1 - self.porosity) * self.expansion_of_grains
        self.heat_diffusivity = self.conductivity / self.heat_capacity
        self.water_diffusivity = self.mobility * self.constrained
        # pressure per degree, once the two diffusivities are told apart
        self.pressing = (self.constrained * whole - self.thermal_stress) / (1 - self.water_diffusivity / self.heat_diffusivity)


def _spread(diffusivity, r, t):
    """Of a point source, over its steady state; and the integral that its displacement needs."""
    z = r / (2 * np.sqrt(diffusivity * t))
    return erfc(z), 0.5 * erfc(z) + erf(z) / (4 * z * z) - np.exp(-z * z) / (2 * z * np.sqrt(np.pi))


def point_source(clay, power, r, t):
    """Rise of temperature [K], pore pressure [Pa], displacement [m] at the distance r [m], the time t [s] of a power [W] since 0."""
    steady = power / (4 * np.pi * clay.conductivity)
    (f_heat, g_heat), (f_water, g_water) = _spread(clay.heat_diffusivity, r, t), _spread(clay.water_diffusivity, r, t)
    displacement = steady / clay.constrained * (clay.pressing * (g_heat - g_water) + clay.thermal_stress * g_heat)
    return steady / r * f_heat, clay.pressing * steady / r * (f_heat - f_water), displacement


def heated_surface(clay, rise, depth, t):
    """Half space, its surface warmed at 0 and drained: temperature [K] and pressure [Pa] at a depth [m], heave of the surface [m]."""
    length_heat, length_water = np.sqrt(clay.heat_diffusivity * t), np.sqrt(clay.water_diffusivity * t)
    heat, water = erfc(depth / (2 * length_heat)), erfc(depth / (2 * length_water))
    heave = 2 * rise / np.sqrt(np.pi) / clay.constrained * (
        (clay.pressing + clay.thermal_stress) * length_heat - clay.pressing * length_water)
    return rise * heat, clay.pressing * rise * (heat - water), heave


def front(rise, speed, diffusivity, x, t):
    """Temperature [K] at x [m] in a half space through which it is convected with `speed` [m/s], warmed at x = 0 since 0."""
    width = 2 * np.sqrt(diffusivity * t)
    early, late = (x - speed * t) / width, (x + speed * t) / width
    return 0.5 * rise * (erfc(early) + np.exp(-early * early) * erfcx(late))  # exp(v x / D) erfc(late)
