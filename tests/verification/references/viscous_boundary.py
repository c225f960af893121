"""Plane waves that meet a boundary of dashpots, sigma_n = -a rho c_p v_n and tau = -b rho c_s v_t (Lysmer and Kuhlemeyer 1969).

The soil fills x < 0. What comes in is a P or S wave of displacement amplitude 1 at an angle from the normal; a P and an S
wave go back, beyond the critical angle of S a P wave that decays away from the boundary. The coefficients follow from the two
conditions at x = 0; they do not depend on the frequency, so pulses of any shape keep theirs (with its Hilbert transform
where they are complex). SI units.
"""
from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Elastic:
    """Isotropic elastic soil in plane strain."""
    density: float = 2000.0
    shear: float = 2e7
    poisson: float = 0.3

    @property
    def lame(self):
        return 2 * self.shear * self.poisson / (1 - 2 * self.poisson)

    @property
    def speed_s(self):
        return np.sqrt(self.shear / self.density)

    @property
    def speed_p(self):
        return np.sqrt((self.lame + 2 * self.shear) / self.density)


@dataclass(frozen=True)
class Wave:
    """u = displacement F(t - slowness . x), F analytic in the lower half plane; a complex slowness decays away from x = 0."""
    displacement: np.ndarray
    slowness: np.ndarray

    def conditions(self, soil, normal, tangential):
        """What its stress and the dashpots leave at x = 0, over -F'."""
        strain = 0.5 * (np.outer(self.displacement, self.slowness) + np.outer(self.slowness, self.displacement))
        stress = soil.lame * np.trace(strain) * np.eye(2) + 2 * soil.shear * strain
        return np.array([stress[0, 0] - normal * soil.density * soil.speed_p * self.displacement[0],
                         stress[1, 0] - tangential * soil.density * soil.speed_s * self.displacement[1]])


def plane_wave(soil, kind, along, direction):
    """A wave of unit amplitude: its slowness along the boundary, towards it (direction 1) or away from it (-1)."""
    speed = soil.speed_p if kind == "P" else soil.speed_s
    across = direction * np.sqrt(complex(1 / speed ** 2 - along ** 2))
    if abs(across.imag) > 0:  # F(t - s x) with x < 0 must tend to 0: a negative imaginary part of its argument
        across = 1j * -abs(across.imag)
    d = speed * np.array([across, along])
    return Wave(d if kind == "P" else np.array([-d[1], d[0]]), np.array([across, along]))


def reflection(soil, kind, angle, normal=1.0, tangential=1.0):
    """Incident wave, {kind: reflected wave, scaled}, {kind: coefficient}; the angle in radians."""
    speed = soil.speed_p if kind == "P" else soil.speed_s
    along = np.sin(angle) / speed
    incident = plane_wave(soil, kind, along, 1)
    back = {k: plane_wave(soil, k, along, -1) for k in "PS"}
    system = np.array([back[k].conditions(soil, normal, tangential) for k in "PS"]).T
    found = np.linalg.solve(system, -incident.conditions(soil, normal, tangential))
    coefficient = dict(zip("PS", found))
    return incident, {k: Wave(coefficient[k] * back[k].displacement, back[k].slowness) for k in "PS"}, coefficient


def reflected_energy(soil, kind, angle, normal=1.0, tangential=1.0):
    """Share of the incident flux of energy through the boundary that goes back."""
    incident, back, _ = reflection(soil, kind, angle, normal, tangential)
    speed = {"P": soil.speed_p, "S": soil.speed_s}

    def flux(k, wave):  # per density and frequency squared; none where the wave decays
        return speed[k] ** 2 * abs(wave.slowness[0].real) * speed[k] * np.vdot(wave.displacement, wave.displacement).real / speed[k]

    return sum(flux(k, wave) for k, wave in back.items()) / flux(kind, incident)


@dataclass(frozen=True)
class Saturated:
    """One-dimensional u-p equations without the fluid's acceleration: rho w^2 u = M q^2 u + i q p, p = -w q / (kappa q^2 - i w S) u
    for waves exp(i (q x - w t)); two of them, the fast one and one that diffuses."""
    modulus: float    # [Pa] M of the skeleton, confined
    density: float    # [kg/m3] of soil and water
    mobility: float   # [m2/(Pa s)] kappa
    storage: float    # [1/Pa] S

    def wave_numbers(self, w):
        """q of the fast wave and of the other, decaying towards +x."""
        squares = np.roots([self.modulus * self.mobility,
                            -1j * w * (self.storage * self.modulus + 1) - self.density * w ** 2 * self.mobility,
                            1j * w ** 3 * self.density * self.storage])
        q = np.sqrt(squares.astype(complex))
        return sorted(np.where(q.imag < 0, -q, q), key=lambda k: k.imag)

    def pressure(self, q, w):
        return -w * q / (self.mobility * q * q - 1j * w * self.storage)

    def reflection(self, w):
        """Displacement of the fast wave that goes back over that of the fast wave that meets an impermeable boundary of
        dashpots, total stress = -sqrt(rho (M + 1/S)) v: those of soil without flow."""
        dashpot = np.sqrt(self.density * (self.modulus + 1 / self.storage))

        def conditions(q):  # of u = exp(i q x): stress and dashpot, slope of the pressure
            return np.array([1j * q * self.modulus - self.pressure(q, w) - 1j * w * dashpot, 1j * q * self.pressure(q, w)])

        fast, other = self.wave_numbers(w)
        system = np.array([conditions(-fast), conditions(-other)]).T
        return np.linalg.solve(system, -conditions(fast))[0]
