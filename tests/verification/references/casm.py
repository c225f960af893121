"""Triaxial tests on Modified Cam Clay with the yield surface of CASM (Yu 1998), by quadrature over the stress ratio.

Compression positive, logarithmic strain, dv = -v deps_v, K = v p'/kappa, G = g K, eta = q/p'. On the surface
pc = p' r^((eta/M)^n); d ln pc = deps_v^p v/(lambda - kappa); flow of the ellipse, deps_q^p = deps_v^p 2 eta/(M^2 -
eta^2). Undrained, v stays and with it p'^kappa pc^(lambda - kappa). Drained, q = 3 (p' - p'0). In both eta alone gives
p' and v, so strains are integrals over eta. Stresses in the unit of p0."""
import numpy as np
from scipy.integrate import quad
from scipy.optimize import brentq


class Casm:
    def __init__(self, M, slope, swelling, r, n, nu=0.3, v0=2.0, p0=100.0, ocr=1.0):
        self.M, self.slope, self.swelling, self.r, self.n, self.v0, self.p0 = M, slope, swelling, r, n, v0, p0
        self.pc0, self.g = ocr * p0, 1.5 * (1 - 2 * nu) / (1 + nu)

    def log_shape(self, eta):
        """ln(pc/p') on the surface."""
        return np.log(self.r) * (eta / self.M) ** self.n

    def flow(self, eta):
        """Plastic shear strain over plastic volume strain."""
        return 2 * eta / (self.M ** 2 - eta ** 2)

    def along(self, rate, start, eta):
        return quad(rate, start, eta, epsabs=1e-11, epsrel=1e-9, limit=400)[0]

    def ratio_at(self, strain, start, axial):
        """The stress ratio between that of first yield and M at an axial strain."""
        return brentq(lambda eta: strain(eta) - axial, start, start + (1 - 1e-9) * (self.M - start), xtol=1e-14)

    def critical_undrained(self):
        """q at the critical state of undrained shear."""
        return self.M * self.p0 * (self.pc0 / self.p0 / self.r) ** (1 - self.swelling / self.slope)

    def undrained(self, axial):
        """(p', q) at an axial strain."""
        first = self.M * (np.log(self.pc0 / self.p0) / np.log(self.r)) ** (1 / self.n)
        elastic = self.swelling / (3 * self.g * self.v0)  # strain per stress ratio at constant p'
        if axial <= elastic * first:
            return self.p0, axial / elastic * self.p0
        big = 1 - self.swelling / self.slope

        def mean(eta):
            return self.p0 * (self.pc0 / self.p0 * np.exp(-self.log_shape(eta))) ** big

        def rate(eta):
            fall = big * self.n * np.log(self.r) * eta ** (self.n - 1) / self.M ** self.n  # -dln p'/deta
            return elastic * (1 - eta * fall) + self.swelling / self.v0 * fall * self.flow(eta)

        eta = self.ratio_at(lambda x: elastic * first + self.along(rate, first, x), first, axial)
        return mean(eta), eta * mean(eta)

    def drained(self, axial):
        """(p', q, volume strain) at an axial strain."""
        p0, pc0 = self.p0, self.pc0
        mean = lambda eta: p0 / (1 - eta / 3)
        first = brentq(lambda x: np.log(mean(x) / pc0) + self.log_shape(x), 0, 2.999) if pc0 > p0 else 0.0

        def swollen(eta):
            return self.v0 - self.swelling * np.log(mean(eta) / p0)

        def volume(eta):
            return swollen(eta) - (self.slope - self.swelling) * (np.log(mean(eta) / pc0) + self.log_shape(eta))

        def elastic(eta, v):  # dq = p0/(1 - eta/3)^2 deta
            return self.swelling / (3 * self.g) * mean(eta) / p0 / v

        def rate(eta):
            growth = 1 / (3 - eta) + np.log(self.r) * self.n * eta ** (self.n - 1) / self.M ** self.n  # dln pc/deta
            return elastic(eta, volume(eta)) + (self.slope - self.swelling) / volume(eta) * growth * self.flow(eta)

        def before(eta):
            return self.along(lambda x: elastic(x, swollen(x)), 0, eta) + np.log(self.v0 / swollen(eta)) / 3

        if axial <= before(first):
            eta = brentq(lambda x: before(x) - axial, 0, first, xtol=1e-14)
            return mean(eta), eta * mean(eta), np.log(self.v0 / swollen(eta))
        shear = before(first) - np.log(self.v0 / swollen(first)) / 3
        strain = lambda x: shear + self.along(rate, first, x) + np.log(self.v0 / volume(x)) / 3
        eta = self.ratio_at(strain, first, axial)
        return mean(eta), eta * mean(eta), np.log(self.v0 / volume(eta))
