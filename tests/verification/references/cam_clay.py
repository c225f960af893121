"""Element tests of Modified Cam Clay by closed forms and quadrature (Wood 1990; Peric and Ayari 2002).

Compression positive, logarithmic strain, dv = -v deps_v, K = v p'/kappa, G = g K. Triaxial variables: dq = 3 G deps_q^e,
f = q^2/M^2 + p'(p' - pc), deps_q^p = deps_v^p 2 eta/(M^2 - eta^2), deps_v^p = (lambda - kappa)/v dpc/pc.
"""
import numpy as np
from scipy.integrate import quad, solve_ivp
from scipy.optimize import brentq

END = 1 - 1e-13  # of the distance to the critical state, which is reached at infinite strain


class CamClay:
    def __init__(self, M=1.2, slope=0.15, swelling=0.03, nu=0.3, v0=2.0, p0=100.0, ocr=1.0):
        self.M, self.slope, self.swelling, self.v0, self.p0, self.pc0 = M, slope, swelling, v0, p0, ocr * p0
        self.g = 1.5 * (1 - 2 * nu) / (1 + nu)

    # undrained: v and p'^kappa pc^(lambda - kappa) stay

    def undrained(self, axial):
        """(p', q) at an axial strain."""
        M, kappa, big = self.M, self.swelling, 1 - self.swelling / self.slope
        at_yield = M * np.sqrt(self.pc0 / self.p0 - 1)
        elastic = kappa / (3 * self.g * self.v0)  # strain per stress ratio
        if axial <= elastic * at_yield:
            return self.p0, axial / elastic * self.p0

        def strain(eta):
            plastic = kappa * big / (self.v0 * M) * (np.log(abs((M + eta) / (M - eta))) - 2 * np.arctan(eta / M))
            return plastic + elastic * (eta - 2 * big * (eta - M * np.arctan(eta / M)))

        if abs(at_yield - M) < 1e-12:  # yields where it is critical: perfectly plastic from there
            return self.p0, M * self.p0
        start = strain(at_yield)
        target = axial - elastic * at_yield
        eta = brentq(lambda x: strain(x) - start - target, at_yield, at_yield + END * (M - at_yield), xtol=1e-15, rtol=1e-14)
        return self.p0 * (self.pc0 / self.p0 / (1 + (eta / M) ** 2)) ** big, eta * self.undrained_mean(eta)

    def undrained_mean(self, eta):
        return self.p0 * (self.pc0 / self.p0 / (1 + (eta / self.M) ** 2)) ** (1 - self.swelling / self.slope)

    # drained: dq = 3 dp'

    def first_yield_drained(self):
        """q where p'(p' - pc0) + q^2/M^2 = 0 on p' = p0 + q/3."""
        if self.pc0 == self.p0:
            return 0.0
        return brentq(lambda q: (q / self.M) ** 2 + (self.p0 + q / 3) * (self.p0 + q / 3 - self.pc0), 1e-9, 3 * self.pc0, xtol=1e-13)

    def drained_volume(self, q, q_yield):
        p = self.p0 + q / 3
        plastic = 0.0
        if q != q_yield or self.pc0 == self.p0:
            plastic = (self.slope - self.swelling) * np.log((p + (q / self.M) ** 2 / p) / self.pc0)
        return self.v0 - self.swelling * np.log(p / self.p0) - plastic

    def drained(self, axial):
        """(p', q, volumetric strain) at an axial strain."""
        q_yield = self.first_yield_drained()
        elastic_volume = lambda q: self.v0 - self.swelling * np.log(1 + q / 3 / self.p0)
        elastic_shear = lambda q, v: self.swelling / (3 * self.g * v * (self.p0 + q / 3))

        def elastic(q):
            return np.log(self.v0 / elastic_volume(q)) / 3 + quad(lambda s: elastic_shear(s, elastic_volume(s)), 0, q, epsabs=0, epsrel=1e-13)[0]

        if q_yield > 0 and axial <= elastic(q_yield):
            q = brentq(lambda s: elastic(s) - axial, 0, q_yield, xtol=1e-13)
            return self.p0 + q / 3, q, np.log(self.v0 / elastic_volume(q))
        M = self.M
        q_end = 3 * M * self.p0 / (3 - M)
        shear_yield = quad(lambda s: elastic_shear(s, elastic_volume(s)), 0, q_yield, epsabs=0, epsrel=1e-13)[0] if q_yield else 0.0

        def rate(q):
            p = self.p0 + q / 3
            v, eta = self.drained_volume(q, np.nan), q / p
            pc = p + q * q / (M * M * p)
            dpc = 1 / 3 + 2 * q / (M * M * p) - q * q / (3 * M * M * p * p)
            return elastic_shear(q, v) + (self.slope - self.swelling) / v * dpc / pc * 2 * eta / (M * M - eta * eta)

        def strain(q):
            shear = shear_yield + quad(rate, q_yield, q, epsabs=1e-14, epsrel=1e-12, limit=200)[0]
            return np.log(self.v0 / self.drained_volume(q, np.nan)) / 3 + shear

        q = brentq(lambda s: strain(s) - axial, q_yield, q_yield + (1 - 1e-9) * (q_end - q_yield), xtol=1e-12, rtol=1e-14)
        return self.p0 + q / 3, q, np.log(self.v0 / self.drained_volume(q, np.nan))

    # one-dimensional and isotropic compression

    def oedometer(self, axial):
        """(axial, radial) stress after virgin compression from an isotropic stress."""
        M, kappa, part = self.M, self.swelling, self.slope - self.swelling

        def rate(strain, y):
            p, q = y
            v, eta = self.v0 * np.exp(-strain), q / p
            # dpc/pc = c dp + d dq with pc = p + q^2/(M^2 p)
            c = (1 - (eta / M) ** 2) / (p * (1 + (eta / M) ** 2))
            d = 2 * eta / (M * M * p * (1 + (eta / M) ** 2))
            flow = 2 * eta / (M * M - eta * eta)
            matrix = np.array([[kappa / p + part * c, part * d], [part * c * flow, kappa / (3 * self.g * p) + part * d * flow]]) / v
            return np.linalg.solve(matrix, [1, 2 / 3])

        p, q = solve_ivp(rate, (0, axial), (self.p0, 0.0), rtol=1e-11, atol=1e-9, method="DOP853").y[:, -1]
        return p + 2 * q / 3, p - q / 3

    def isotropic(self, volume):
        """(p', v) at a volumetric strain."""
        v = self.v0 * np.exp(-volume)
        p = self.p0 * np.exp((self.v0 - v) / self.swelling)
        if p > self.pc0:
            at_yield = self.v0 - self.swelling * np.log(self.pc0 / self.p0)
            p = self.pc0 * np.exp((at_yield - v) / self.slope)
        return p, v
