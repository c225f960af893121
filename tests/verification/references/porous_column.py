"""One-dimensional waves in a saturated column of finite depth, linear u-p theory, by exact modal sums. SI units.

Depth z and displacement u downwards, p > 0 in compression, at rest at t = 0. Base fixed and impermeable; the surface
carries the total stress -q(t) and the pore pressure 0, or q(t) where the load is water. Balances as in Zienkiewicz,
Chang and Bettess, Geotechnique 30 (1980) 385; d is the derivative in time, ' that in depth:

  rho d2u - M u'' + alpha p' = 0        S dp + alpha du' - kappa (p'' + rho_a d2u') = 0

rho_a is the fluid's density where Darcy's law keeps the acceleration of the soil, else 0. With u = sum a cos(bz) and
p = sum P sin(bz), b = (2n+1) pi/(2L), each mode is a rational function in Laplace space; its residues give a and P.
"""
from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Load:
    """Parts (start, [(pole, residue), ...], slope): after its start each adds sum residue e^(pole t) + slope t."""
    parts: tuple

    def __call__(self, t):
        return sum(slope * (t - start) + sum((r * np.exp(s * (t - start))).real for s, r in poles)
                   for start, poles, slope in self.parts if t >= start)


def step(q):
    return Load(((0.0, ((0, q),), 0.0),))


def one_minus_cosine(q, w):
    return Load(((0.0, ((0, q), (1j * w, -q / 2), (-1j * w, -q / 2)), 0.0),))


def sine(q, w, start=0.0):
    return Load(((start, ((1j * w, -0.5j * q), (-1j * w, 0.5j * q)), 0.0),))


def ramp(q, duration):
    return Load(((0.0, (), q / duration), (duration, (), -q / duration)))


def sine_ramp(q, duration):
    """q sin(pi t/(2 duration)), then q: from there on 1 - cos is added to the sine."""
    w = np.pi / (2 * duration)
    return Load(sine(q, w).parts + tuple((duration, poles, slope) for _, poles, slope in one_minus_cosine(q, w).parts))


def together(*loads):
    return Load(tuple(part for load in loads for part in load.parts))


@dataclass(frozen=True)
class Column:
    height: float
    modulus: float            # oedometric, M
    porosity: float
    grain_density: float
    mobility: float           # kappa = k/gamma_w
    storage: float = 0.0      # S
    alpha: float = 1.0
    water_density: float = 1000.0
    fluid_acceleration: bool = False
    water_load: bool = False

    def _matrix(self, b):
        """Entries of the modal system as polynomials in s, highest power first; with the determinant."""
        rho = (1 - self.porosity) * self.grain_density + self.porosity * self.water_density
        rho_a = self.water_density if self.fluid_acceleration else 0.0
        uu, up = np.array([rho, 0, self.modulus * b ** 2]), np.array([self.alpha * b])
        pu, pp = np.array([self.mobility * rho_a * b, -self.alpha * b, 0]), np.array([self.storage, self.mobility * b ** 2])
        return uu, up, pu, pp, np.polysub(np.polymul(uu, pp), np.polymul(up, pu))

    def _mode(self, b, load, times):
        """a(t) and P(t) of one mode."""
        uu, up, pu, pp, det = self._matrix(b)
        det = np.trim_zeros(det, "f")
        force, source = np.array([2 / self.height]), np.array([0.0])
        if self.water_load:  # p = q + what vanishes on the surface: no traction is left, but a source
            force, source = np.array([0.0]), np.array([-2 * self.storage / (self.height * b), 0])
        numerators = (np.polysub(np.polymul(force, pp), np.polymul(up, source)),
                      np.polysub(np.polymul(uu, source), np.polymul(pu, force)))
        roots = np.roots(det)
        slope_det, result = np.polyder(det), np.zeros((2, len(times)))
        for start, poles, slope in load.parts:
            after = times >= start
            t = times[after] - start
            for row, numerator in enumerate(numerators):
                value = np.zeros(len(t), complex)
                for root in roots:
                    q = sum(r / (root - s) for s, r in poles) + slope / root ** 2
                    value += np.polyval(numerator, root) / np.polyval(slope_det, root) * q * np.exp(root * t)
                for s, r in poles:
                    value += r * np.polyval(numerator, s) / np.polyval(det, s) * np.exp(s * t)
                if slope:  # the double pole 1/s^2
                    n0, d0 = np.polyval(numerator, 0), np.polyval(det, 0)
                    n1, d1 = np.polyval(np.polyder(numerator), 0), np.polyval(slope_det, 0)
                    value += slope * (n0 / d0 * t + (n1 * d0 - n0 * d1) / d0 ** 2)
                result[row, after] += value.real
        return result

    def response(self, depths, times, load, modes=800):
        """u and p, each (time, depth); the static part of u is summed in closed form."""
        z, times = np.atleast_1d(depths).astype(float), np.atleast_1d(times).astype(float)
        q = np.array([load(t) for t in times])
        static = 0.0 if self.water_load else 1.0
        u = static * np.outer(q, self.height - z) / self.modulus
        p = np.tile(q[:, None], len(z)) if self.water_load else np.zeros((len(times), len(z)))
        for n in range(modes):
            b = (n + 0.5) * np.pi / self.height
            a, P = self._mode(b, load, times)
            u += np.outer(a - static * 2 * q / (self.height * self.modulus * b ** 2), np.cos(b * z))
            p += np.outer(P, np.sin(b * z))
        return u, p

    def steady(self, depths, w, q=1.0, modes=20000):
        """Complex amplitudes u and p under q e^(iwt)."""
        z = np.atleast_1d(depths).astype(float)
        u, p = q * (self.height - z) / self.modulus + 0j, np.zeros(len(z), complex)
        for n in range(modes):
            b = (n + 0.5) * np.pi / self.height
            uu, up, pu, pp, det = (np.polyval(c, 1j * w) for c in self._matrix(b))
            u += (2 * q / self.height) * (pp / det - 1 / (self.modulus * b ** 2)) * np.cos(b * z)
            p -= (2 * q / self.height) * pu / det * np.sin(b * z)
        return u, p

    def free_vibration(self, n=0):
        """Undamped circular frequency |s| and damping ratio of mode n with drained surface."""
        roots = np.roots(self._matrix((n + 0.5) * np.pi / self.height)[-1])
        s = roots[np.argmax(roots.imag)]
        return abs(s), -s.real / abs(s)
