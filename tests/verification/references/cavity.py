"""Expansion of a cavity from a0 to a in an infinite soil at rest: exact solutions at finite strain, by one ordinary differential
equation. Drained after Yu and Houlsby (1991, Geotechnique 41:173) and Chen and Abousleiman (2013, Geotechnique 63:1061), undrained
after Collins and Yu (1996, Int. J. Numer. Anal. Meth. Geomech. 20:489) and Chen and Abousleiman (2012, Geotechnique 62:447), here
with the soil elastic in the logarithmic strain at every distance (those papers take small strain outside the plastic zone).

Compression positive, principal components (radial, hoop, third): the third is along a cylindrical cavity, a second hoop
direction of a spherical one. k = 1 for the cylinder, 2 for the sphere. Stretch = r/r0 of a particle. The axes of stretch
do not turn, so the increments of the logarithmic strain are exact: hoop -ln(stretch), radial -ln(dr/dr0).

Undrained, the volume is kept: dr/dr0 = stretch^-k, and the strain path of every particle is known. Equilibrium of total stress,
d sigma_r/dr = -k (sigma_r - sigma_hoop)/r with dr/r = -d(stretch)/(stretch (stretch^(k+1) - 1)), gives the rest.

Drained, nothing but the particle's start r0 over a length L that grows with the cavity can matter (rate-independent soil, infinite
and uniform): r = L rho(eta), eta = r0/L. A cavity of finite radius a0 is the part r0 >= a0 of one that grows from nothing; so the
stress of a particle depends on its stretch only, and the cavity pressure on a/a0 only. With t = -ln(eta), which grows along the
history of every particle, equilibrium and the law give

    hoop strain   d e_h = (eta rho'/rho - 1) dt
    equilibrium   d sigma_r = k (sigma_r - sigma_h) (eta rho'/rho) dt
    law           d sigma_r = D_rr d e_r + D_rh d e_h   ->  d e_r,    rho' = exp(-e_r)

started where the strain is 1e-6, with the elastic field u = B/r^k. In hypoplastic sand d sigma = D d e - N |d e|, so
that d e_r is the root of a quadratic equation.
"""
import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

from references.hypoplasticity import Sand

TIGHT = dict(method="DOP853", rtol=1e-10, atol=1e-13)


class LinearRates:
    """Laws whose stress rate is linear in the strain rate."""

    def other(self, stress, state):
        """N, the part of the stress rate per size of the strain rate."""
        return np.zeros(3)


class CamClayRates(LinearRates):
    """Modified Cam Clay: f = q^2/M^2 + p'(p' - pc), K = v p'/kappa, G = g K, v = v0 exp(-volumetric strain). Stress unit: any.
    State: (pc, volumetric strain)."""

    def __init__(self, M, slope, swelling, nu, v0, start, ocr):
        """start: initial effective stress (radial, hoop, third); ocr scales the yield surface through it."""
        self.M, self.slope, self.swelling, self.v0 = M, slope, swelling, v0
        self.g = 1.5 * (1 - 2 * nu) / (1 + nu)
        self.start = np.array(start, dtype=float)
        p, q2 = self.invariants(self.start)[:2]
        self.begin = np.array([ocr * (p + q2 / (M * M * p)), 0.0])

    @staticmethod
    def invariants(stress):
        p = stress.sum() / 3
        s = stress - p
        return p, 1.5 * (s @ s), s

    def yield_function(self, stress, state):
        p, q2, _ = self.invariants(stress)
        return (q2 / self.M ** 2 + p * (p - state[0])) / state[0] ** 2

    def elastic(self, stress, state):
        bulk = self.v0 * np.exp(-state[1]) * stress.sum() / 3 / self.swelling
        shear = self.g * bulk
        return (bulk - 2 * shear / 3) * np.ones((3, 3)) + 2 * shear * np.eye(3)

    def stiffness(self, stress, state, plastic):
        """D of d sigma = D d eps, and a function of d eps for the rates of the state."""
        D = self.elastic(stress, state)
        if not plastic:
            return D, lambda e: np.array([0.0, e.sum()])
        p, _, s = self.invariants(stress)
        normal = (2 * p - state[0]) / 3 + 3 * s / self.M ** 2
        growth = self.v0 * np.exp(-state[1]) * state[0] / (self.slope - self.swelling) * (2 * p - state[0])
        direction = D @ normal
        modulus = normal @ direction + p * growth
        return D - np.outer(direction, direction) / modulus, lambda e: np.array([direction @ e / modulus * growth, e.sum()])


class CasmRates(CamClayRates):
    """The same with the yield surface of CASM, ln(p'/pc) + ln(r) (q/(M p'))^n = 0; the flow is that of the ellipse."""

    def __init__(self, r, n, ocr, **clay):
        super().__init__(ocr=1.0, **clay)
        self.r, self.n = r, n
        p, q2 = self.invariants(self.start)[:2]
        self.begin[0] = ocr * p * np.exp(self.log_shape(q2 / p ** 2))

    def log_shape(self, eta2):
        return np.log(self.r) * (eta2 / self.M ** 2) ** (self.n / 2)

    def yield_function(self, stress, state):
        p, q2, _ = self.invariants(stress)
        return np.log(p / state[0]) + self.log_shape(q2 / p ** 2)

    def stiffness(self, stress, state, plastic):
        D = self.elastic(stress, state)
        if not plastic:
            return D, lambda e: np.array([0.0, e.sum()])
        p, q2, s = self.invariants(stress)
        shape = self.n * self.log_shape(q2 / p ** 2)  # q df/dq = -(p df/dp - 1)
        normal = (1 - shape) / (3 * p) + (1.5 * shape / q2 * s if q2 > 0 else 0)
        flow = (p - q2 / (self.M ** 2 * p)) / 3 + 3 * s / self.M ** 2
        growth = self.v0 * np.exp(-state[1]) / (self.slope - self.swelling) * flow.sum()  # of ln pc
        modulus = normal @ D @ flow + growth
        multiplier = normal @ D / modulus
        return (D - np.outer(D @ flow, multiplier),
                lambda e: np.array([multiplier @ e * growth * state[0], e.sum()]))


class MohrCoulombRates(LinearRates):
    """Linear elastic in the logarithmic strain, radial stress largest. Cylinder: the third stress stays between the other two.
    Sphere: both hoop stresses are equal, the flow is shared between the two faces. State: none (one idle number)."""

    def __init__(self, E, nu, c, phi, psi, start, k):
        """phi, psi in degrees."""
        s = np.sin(np.radians([phi, psi]))
        self.N, self.flow = (1 + s) / (1 - s)
        self.Y = 2 * c * np.cos(np.radians(phi)) / (1 - s[0])
        self.lame, self.shear, self.k = E * nu / ((1 + nu) * (1 - 2 * nu)), E / (2 * (1 + nu)), k
        self.start, self.begin = np.array(start, dtype=float), np.zeros(1)

    def yield_function(self, stress, state):
        return (stress[0] - self.N * stress[1] - self.Y) / (2 * self.shear)

    def stiffness(self, stress, state, plastic):
        D = self.lame * np.ones((3, 3)) + 2 * self.shear * np.eye(3)
        if plastic:
            hoop = np.array([0.0, 1.0, 0.0]) if self.k == 1 else np.array([0.0, 0.5, 0.5])
            normal, flow = np.array([1.0, 0, 0]) - self.N * hoop, np.array([1.0, 0, 0]) - self.flow * hoop
            D = D - np.outer(D @ flow, normal @ D) / (normal @ D @ flow)
        return D, lambda e: np.zeros(1)


class HypoplasticRates:
    """Sand of von Wolffersdorff without intergranular strain: d sigma = D d e - N |d e|. State: (void ratio)."""

    def __init__(self, sand, void_ratio, start):
        """sand: parameters of references/hypoplasticity.py."""
        self.sand = Sand(**sand)
        self.start, self.begin = np.array(start, dtype=float), np.array([void_ratio])

    def yield_function(self, stress, state):
        return 1.0  # never elastic

    def stiffness(self, stress, state, plastic):
        D = self.sand.linear_and_other(-stress, state[0])[0]
        return D, lambda e: np.array([-(1 + state[0]) * e.sum()])

    def other(self, stress, state):
        """N."""
        return self.sand.linear_and_other(-stress, state[0])[1]


class Undrained:
    """Cavity of stretch up to `largest`. `far`: pore pressure far away."""

    def __init__(self, law, k, largest, far=0.0):
        self.k, self.far = k, far
        n = len(law.begin)

        def rate(x, y, plastic):
            stretch = np.exp(x)  # x: minus the hoop strain
            strain = np.array([k, -1.0, -1.0 if k == 2 else 0.0])
            D, state_rate = law.stiffness(y[:3], y[3:3 + n], plastic)
            total = k * (y[0] - y[1]) / np.expm1((k + 1) * x) if x > 0 else k * (D[0] - D[1]) @ strain / (k + 1)
            return np.concatenate((D @ strain, state_rate(strain), [total]))

        start = np.concatenate((law.start, law.begin, [law.start[0] + far]))
        self.path = _Path(law, rate, start, 0.0, np.log(largest), n)

    def at(self, stretch):
        """Effective stresses (radial, hoop, third), total radial stress, excess pore pressure."""
        y = self.path(np.log(stretch))
        return y[:3], y[-1], y[-1] - y[0] - self.far

    def stretch(self, r, a, a0):
        """Of the particle now at r."""
        m = self.k + 1
        return r / (r ** m - a ** m + a0 ** m) ** (1 / m)


class Drained:
    """Cavity of stretch up to `largest`."""

    def __init__(self, law, k, largest, smallest=1e-6):
        self.k, self.law = k, law
        n = self.n = len(law.begin)
        elastic = law.stiffness(law.start, law.begin, False)[0]
        shear = elastic[0, 0] - elastic[0, 1]  # 2G
        e = smallest * np.array([k, -1.0, -1.0 if k == 2 else 0.0])  # of u = B/r^k, volume kept

        def rate(t, y, plastic):
            stress, state, radial, hoop = y[:3], y[3:3 + n], y[3 + n], y[4 + n]
            ratio = np.exp(hoop - radial)  # eta rho'/rho
            D, state_rate = law.stiffness(stress, state, plastic)
            d_hoop = ratio - 1
            other = D[0, 1] + (D[0, 2] if k == 2 else 0.0)
            wanted = k * (stress[0] - stress[1]) * ratio - other * d_hoop
            N = law.other(stress, state)
            # D_rr x - N_r |(x, hoop)| = wanted, with D_rr > N_r
            square, hoops = D[0, 0] ** 2 - N[0] ** 2, k * d_hoop ** 2
            root = N[0] * np.sqrt(wanted ** 2 + square * hoops)
            d_radial = (D[0, 0] * wanted + root) / square
            strain = np.array([d_radial, d_hoop, d_hoop if k == 2 else 0.0])
            change = D @ strain - N * np.linalg.norm(strain)
            return np.concatenate((change, state_rate(strain), [d_radial, d_hoop]))

        start = np.concatenate((law.start + shear * e, law.begin, e[:2]))
        enough = lambda t, y, plastic: -y[4 + n] - np.log(largest) - 1e-6
        self.path = _Path(law, rate, start, 0.0, 200.0, n, enough)

    def time(self, stretch):
        """t where a particle has this stretch."""
        return brentq(lambda t: self.path(t)[4 + self.n] + np.log(stretch), *self.path.ends, xtol=1e-13)

    def at(self, stretch):
        """Effective stresses (radial, hoop, third), volumetric strain -ln J."""
        y = self.path(self.time(stretch))
        return y[:3], y[3 + self.n] + self.k * y[4 + self.n]

    def stretch(self, r, a, a0):
        """Of the particle now at r: r/a = rho(t)/rho(t of the wall), rho = stretch exp(-t)."""
        log_rho = lambda t: -self.path(t)[4 + self.n] - t
        wall = self.time(a / a0)
        t = brentq(lambda t: log_rho(t) - log_rho(wall) - np.log(r / a), self.path.ends[0], wall, xtol=1e-13)
        return np.exp(-self.path(t)[4 + self.n])


class _Path:
    """Elastic until the yield function passes zero, plastic from there."""

    def __init__(self, law, rate, start, first, last, n, enough=None):
        grows = lambda t, y, plastic: law.yield_function(y[:3], y[3:3 + n])
        grows.terminal, grows.direction = True, 1
        events = [grows]
        if enough:
            enough.terminal = True
            events = [grows, enough]
        self.parts, self.yields_at = [], None
        y, t = start, first
        if law.yield_function(start[:3], start[3:3 + n]) < -1e-9:
            part = solve_ivp(rate, (t, last), y, args=(False,), events=events, dense_output=True, **TIGHT)
            self.parts.append(part)
            t, y = part.t[-1], part.y[:, -1]
            done = len(part.t_events[0]) == 0
        else:
            done = False
        if not done:
            self.yields_at = t
            part = solve_ivp(rate, (t, last), y, args=(True,), events=events[1:], dense_output=True, **TIGHT)
            self.parts.append(part)
        if not all(part.success for part in self.parts):
            raise RuntimeError("the solution stops")
        self.ends = first, self.parts[-1].t[-1]

    def __call__(self, t):
        part = next((p for p in self.parts if t <= p.t[-1]), self.parts[-1])
        return part.sol(t)


def yu_houlsby(ratio, k, E, nu, c, phi, psi, p0):
    """Cavity pressure at a/a0 = ratio in Mohr-Coulomb soil; Yu and Houlsby 1991, eqs 37 to 43: small strain outside the plastic
    zone, logarithmic within. Angles in degrees."""
    s, t = np.sin(np.radians([phi, psi]))
    alpha, beta = (1 + s) / (1 - s), (1 + t) / (1 - t)
    G, m = E / (2 * (1 + nu)), 2 - k
    Y = 2 * c * np.cos(np.radians(phi)) / (1 - s)
    strength = Y + (alpha - 1) * p0
    delta = strength / (2 * (k + alpha) * G)
    gamma = alpha * (beta + k) / (k * (alpha - 1) * beta)
    eta = np.exp((beta + k) * (1 - 2 * nu) * (1 + m * nu) * strength / (E * (alpha - 1) * beta))
    xi = (1 - nu ** 2 * m) * (1 + k) * delta / ((1 + nu) * (alpha - 1) * beta) * (
        alpha * beta + k * (1 - 2 * nu) + 2 * nu - k * nu * (alpha + beta) / (1 - nu * m))

    def series(x):
        total, factor = 0.0, 1.0  # factor: xi^n/n!
        for n in range(200):
            total += factor * (np.log(x) if abs(n - gamma) < 1e-12 else (x ** (n - gamma) - 1) / (n - gamma))
            factor *= xi / (n + 1)
        return total

    def excess(R):
        return (R ** -gamma / ((1 - delta) ** ((beta + k) / beta) - gamma / eta * series(R))) ** (beta / (beta + k)) - ratio

    high = 1.0
    while True:  # the denominator reaches zero at the limit pressure
        step = high * 1.01
        value = (1 - delta) ** ((beta + k) / beta) - gamma / eta * series(step)
        if value <= 0 or excess(step) > 0:
            break
        high = step
    low = high
    high *= 1.01
    for _ in range(200):
        middle = 0.5 * (low + high)
        beyond = (1 - delta) ** ((beta + k) / beta) - gamma / eta * series(middle) <= 0 or excess(middle) > 0
        low, high = (low, middle) if beyond else (middle, high)
    R = 0.5 * (low + high)
    return (R * alpha * (1 + k) / (k + alpha) * strength - Y) / (alpha - 1)
