"""Consolidation of a layer under a load on a rectangle of its surface, after Booker (1974, Q. J. Mech. Appl. Math. 27:1): cosine series
over the surface, closed form through the depth in Laplace space, fixed Talbot inversion (Abate and Valko 2004). SI units, pore pressure
positive in compression, settlement positive downwards.

The layer is quadratic in plan, of width `width` and thickness `depth`, between smooth impermeable walls: one quarter of a period of
the series, so that a mesh with rollers there solves the same problem. Base rigid, rough and impermeable; surface drained. The
constituents are incompressible. With z downwards, one term cos(a x) cos(b y), k^2 = a^2 + b^2, of volume strain e, pore pressure p
and settlement w, and horizontal displacement along (a, b)/k of amplitude U:

    volume strain   c (e'' - k^2 e) = s e                        e = A exp(+-g z),   g^2 = k^2 + s/c
    pressure        p'' - k^2 p = M (e'' - k^2 e)                p = M e + B exp(+-k z)
    vertical        G (w'' - k^2 w) = p' - (lambda + G) e'       w = A (+-g) c/s exp(+-g z) + B z exp(+-k z)/(2 G) + C exp(+-k z)
    continuity      k U + w' = e
"""
import numpy as np

TERMS = 14


class Layer:
    """Square load on |x|, |y| < half of the corner of a layer at x, y = 0 (the quarter); `modes` along each axis."""

    def __init__(self, soil, width, depth, half, load, modes):
        self.soil, self.depth = soil, depth
        wave = np.arange(modes) * np.pi / width
        # of the load along one axis: 1 for |x| < half
        share = np.where(wave > 0, 2 * np.sinc(wave * half / np.pi), 1.0) * half / width
        self._a, self._b = (w.ravel() for w in np.meshgrid(wave, wave, indexing="ij"))
        self._load = load * np.outer(share, share).ravel()
        # one column of depth for every k^2 that occurs
        number = np.arange(modes)
        squares = (number[:, None] ** 2 + number[None, :] ** 2).ravel()
        found, self._which = np.unique(squares, return_inverse=True)
        self._k = np.sqrt(found) * np.pi / width

    def _at_unit_load(self, s, z):
        """(settlement at the surface, pressure at the depth z) of every k at one s of the Laplace space, for the load 1/s."""
        soil, h = self.soil, self.depth
        G, M = soil.shear, soil.oedometric
        c = soil.diffusivity
        k = self._k[1:].astype(complex)
        g = np.sqrt(k * k + s / c)
        zero = np.zeros_like(k)

        def functions(z):
            """e, e', p, p', w, w' at the depth z, of the six constants: exp(-g z), exp(g (z - h)), then of p and of w each
            exp(-k z), exp(k (z - h))."""
            eg, fg = np.exp(-g * z), np.exp(g * (z - h))
            ek, fk = np.exp(-k * z), np.exp(k * (z - h))
            e = [eg, fg, zero, zero, zero, zero]
            de = [-g * eg, g * fg, zero, zero, zero, zero]
            p = [M * eg, M * fg, ek, fk, zero, zero]
            dp = [-g * M * eg, g * M * fg, -k * ek, k * fk, zero, zero]
            w = [-g * c / s * eg, g * c / s * fg, z * ek / (2 * G), z * fk / (2 * G), ek, fk]
            dw = [g * g * c / s * eg, g * g * c / s * fg, (1 - k * z) * ek / (2 * G), (1 + k * z) * fk / (2 * G), -k * ek, k * fk]
            return (np.array(rows) for rows in (e, de, p, dp, w, dw))

        e_0, de_0, p_0, dp_0, w_0, dw_0 = functions(0.0)
        second = k * k * w_0 + (dp_0 - (M - G) * de_0) / G  # w''; lambda + G = M - G
        stress = (M - 2 * G) * e_0 + 2 * G * dw_0 - p_0  # vertical, tension positive
        shear = (de_0 - second) / k - k * w_0  # U' - k w
        e_h, _, _, dp_h, w_h, dw_h = functions(h)
        matrix = np.array([p_0, stress, shear, w_h, (e_h - dw_h) / k, dp_h])  # (condition, constant, k)
        right = np.zeros((len(k), 6, 1), dtype=complex)
        right[:, 1, 0] = -1 / s
        system = np.moveaxis(matrix, -1, 0)
        scale = np.abs(system).max(axis=1, keepdims=True)  # of the constants, which differ by many orders
        constants = np.moveaxis(np.linalg.solve(system / scale, right)[:, :, 0] / scale[:, 0, :], -1, 0)
        settlement, pressure = np.empty(len(k) + 1, dtype=complex), np.empty(len(k) + 1, dtype=complex)
        settlement[1:] = (w_0 * constants).sum(axis=0)
        _, _, p_z, _, _, _ = functions(z)
        pressure[1:] = (p_z * constants).sum(axis=0)
        # the even load: a column
        root = np.sqrt(s / c)
        decay = np.exp(-2 * root * h)
        pressure[0] = 1 / s * (1 - (np.exp(-root * z) + np.exp(-root * (2 * h - z))) / (1 + decay))
        settlement[0] = 1 / (M * s) * (1 - decay) / (1 + decay) / root
        return settlement, pressure

    def at(self, time, diagonal, z=0.0):
        """Settlement of the surface and pore pressure at the depth z, at a time, in places x = y of the list `diagonal`."""
        radius = 2 * TERMS / 5
        angle = np.arange(1, TERMS) * np.pi / TERMS
        cot = 1 / np.tan(angle)
        points = np.concatenate([[radius], radius * angle * (cot + 1j)]) / time
        weights = np.concatenate([[0.5], 1 + 1j * (angle + (angle * cot - 1) * cot)]) * np.exp(points * time) * radius / TERMS / time
        settlement = pressure = 0.0
        for s, weight in zip(points, weights):
            w, p = self._at_unit_load(s, z)
            settlement, pressure = settlement + (weight * w).real, pressure + (weight * p).real
        modes = [self._load * np.cos(self._a * x) * np.cos(self._b * x) for x in diagonal]
        return np.array(modes) @ settlement[self._which], np.array(modes) @ pressure[self._which]


def giroud_corner(width, length, load, young, poisson):
    """Settlement of the corner of a flexible rectangle on an elastic half space (Steinbrenner 1934, Giroud 1968)."""
    m = length / width
    shape = (np.log(m + np.sqrt(1 + m * m)) + m * np.log((1 + np.sqrt(1 + m * m)) / m)) / np.pi
    return load * width * (1 - poisson ** 2) / young * shape
