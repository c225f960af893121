"""Natural clay in triaxial states: S-CLAY1 (Wheeler and others 2003), S-CLAY1S (Karstunen and others 2005) and
Creep-SCLAY1S (Sivasithamparam, Karstunen and Bonnier 2015), in p', q and the scalar inclination of the papers. An
integrator with order and step control of its own solves the rate equations, so nothing is shared with the program but
the equations.

Compression positive, logarithmic strain, v = 1 + e falls by v times the volume strain, stresses in Pa, time in s.
    size F     = p + (q - alpha p)^2/((M^2 - alpha^2) p)
    dalpha     = omega [(3/4 eta - alpha) <dev> + omega_d (eta/3 - alpha) |deq|]
    dchi       = -xi chi (|dev| + xi_d |deq|)
    dpi        = pi v/(lambda - kappa) dev
with plastic strains that keep F = (1 + chi) pi, or with the creep rates
    mu/(v tau) (F/((1 + chi) pi))^((lambda - kappa)/mu) (M^2 - alpha0^2)/(M^2 - eta0^2) (dF/dp, dF/dq).
M is that of extension where q < alpha p, if Me is given."""
import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

P, Q, SIZE, ALPHA, CHI, V, AXIAL, VOLUME = range(8)


class Clay:
    def __init__(self, M, slope, swelling, nu, omega=0.0, omega_d=None, chi=0.0, xi=0.0, xi_d=0.0, mu=0.0,
                 tau=86400.0, Me=None):
        self.M, self.Me, self.slope, self.swelling = M, Me or M, slope, swelling
        self.g = 1.5 * (1 - 2 * nu) / (1 + nu)
        self.omega, self.chi, self.xi, self.xi_d, self.mu, self.tau = omega, chi, xi, xi_d, mu, tau
        self.k0 = 1 - 3 * M / (6 + M)
        self.eta0 = 3 * (1 - self.k0) / (1 + 2 * self.k0)
        self.alpha0 = (self.eta0 ** 2 + 3 * self.eta0 - M ** 2) / 3
        self.omega_d = omega_d or 3 * (4 * M ** 2 - 4 * self.eta0 ** 2 - 3 * self.eta0) / (
            8 * (self.eta0 ** 2 - M ** 2 + 2 * self.eta0))

    def size(self, p, q, alpha):
        """F and its derivatives by p, q and alpha."""
        M2, over = (self.M if q >= alpha * p else self.Me) ** 2, q - alpha * p
        room = M2 - alpha ** 2
        F = p + over ** 2 / (room * p)
        return (F, 1 - 2 * alpha * over / (room * p) - over ** 2 / (room * p ** 2), 2 * over / (room * p),
                -2 * over / room + 2 * alpha * over ** 2 / (room ** 2 * p))

    def start(self, p, q, ocr, e, alpha):
        F = self.size(p, q, alpha)[0]
        return np.array([p, q, ocr * F / (1 + self.chi), alpha, self.chi, 1 + e, 0.0, 0.0])

    def moduli(self, y):
        K = y[V] * y[P] / self.swelling
        return K, self.g * K

    def hardening(self, y, ev, eq):
        """Rates of pi, alpha and chi."""
        eta = y[Q] / y[P]
        turn = (0.75 * eta - y[ALPHA]) * max(ev, 0.0) + self.omega_d * (eta / 3 - y[ALPHA]) * abs(eq)
        return np.array([y[SIZE] * y[V] / (self.slope - self.swelling) * ev, self.omega * turn,
                         -self.xi * y[CHI] * (abs(ev) + self.xi_d * abs(eq))])

    def rates(self, y, axial, volume, plastic=True):
        """dy/dt for the rates of axial and volume strain."""
        K, G = self.moduli(y)
        shear = axial - volume / 3
        F, fp, fq, fa = self.size(y[P], y[Q], y[ALPHA])
        pm = (1 + y[CHI]) * y[SIZE]
        if self.mu:
            rest = (self.M ** 2 - self.alpha0 ** 2) / (self.M ** 2 - self.eta0 ** 2)
            rate = rest * self.mu / (y[V] * self.tau) * (F / pm) ** ((self.slope - self.swelling) / self.mu)
        elif plastic:
            per = self.hardening(y, fp, fq)
            hardening = (1 + y[CHI]) * per[0] + y[SIZE] * per[2] - fa * per[1]
            rate = max(0.0, (fp * K * volume + fq * 3 * G * shear) / (K * fp ** 2 + 3 * G * fq ** 2 + hardening))
        else:
            rate = 0.0
        dp, dq = K * (volume - rate * fp), 3 * G * (shear - rate * fq)
        return np.concatenate(([dp, dq], self.hardening(y, rate * fp, rate * fq), [-y[V] * volume, axial, volume]))

    def axial_rate(self, y, stress_rate):
        """Rate of oedometric strain that gives a rate of the axial stress."""
        change = lambda axial: (lambda d: d[P] + 2 / 3 * d[Q] - stress_rate)(self.rates(y, axial, axial))
        K, G = self.moduli(y)
        if self.mu:
            return -change(0.0) / (K + 4 / 3 * G)
        return brentq(change, -1.0, 1.0, xtol=1e-18, rtol=1e-14)

    def follow(self, y, motion, times):
        """`motion` (t, y) gives axial and volume strain rates. Returns y at the times [s], the first one included."""
        scale = np.array([1e-8 * y[P], 1e-8 * y[P], 1e-8 * y[SIZE], 1e-10, 1e-10, 1e-11, 1e-12, 1e-12])
        pm = lambda _, y: (self.size(y[P], y[Q], y[ALPHA])[0] / ((1 + y[CHI]) * y[SIZE])) - 1 + 1e-12
        pm.terminal, pm.direction = True, 1

        def solve(plastic, y, times, first):
            run = lambda t, y: self.rates(y, *motion(t, y), plastic=plastic)
            s = solve_ivp(run, (first, times[-1]), y, method="LSODA", rtol=1e-9, atol=scale, dense_output=True,
                          events=None if plastic or self.mu else pm, max_step=(times[-1] - times[0]) / 200)
            assert s.success, s.message
            return s
        plastic = bool(self.mu) or pm(0, y) >= -1e-9
        s = solve(plastic, y, times, times[0])
        if s.t[-1] >= times[-1]:
            return s.sol(times).T
        rest = solve(True, s.y[:, -1], times, s.t[-1])
        return np.array([s.sol(t) if t <= s.t[-1] else rest.sol(t) for t in times])

    def undrained(self, y, rate, strain, rows):
        return self.follow(y, lambda t, y: (np.sign(strain) * rate, 0.0), np.linspace(0, abs(strain) / rate, rows))

    def oedometer(self, y, rate, strain, rows):
        return self.follow(y, lambda t, y: (rate, rate), np.linspace(0, strain / rate, rows))


class UndrainedCylinder:
    """Creep around a cylindrical cavity of radius a(t) from a0 = 1 in infinite clay, undrained: every particle keeps its
    volume, r^2 = r0^2 + a^2 - 1, so its strain path is known, and equilibrium of total stress gives the pressure. Principal
    stresses (radial, hoop, axial), tensors diagonal; the fabric starts along the axis."""

    def __init__(self, clay, start, ocr, e, radius, far, particles=120):
        """`start`: effective stress; `radius`: a and its rate of t; `far`: initial radius of the last particle."""
        self.clay, self.radius, self.r0 = clay, radius, np.geomspace(1.0, far, particles)
        n, stress = particles, np.array(start, float)
        fabric = clay.alpha0 * np.array([-1.0, -1.0, 2.0]) / 3
        p, r = stress.mean(), stress - stress.mean() * (1 + fabric)
        F = p + 1.5 * r @ r / ((clay.M ** 2 - clay.alpha0 ** 2) * p)
        self.volume, self.radial = 1 + e, stress[0]
        self.begin = np.concatenate((np.repeat(stress / p, n), np.repeat(fabric, n), np.full(n, ocr * F / (1 + clay.chi) / p),
                                     np.full(n, clay.chi)))
        self.unit = p

    def rates(self, t, y):
        c, n = self.clay, len(self.r0)
        stress, fabric = y[:3 * n].reshape(3, n), y[3 * n:6 * n].reshape(3, n)
        size, chi = y[6 * n:7 * n], y[7 * n:]
        a, speed = self.radius(t)
        spread = a * speed / (self.r0 ** 2 + a ** 2 - 1)
        strain = np.array([spread, -spread, 0 * spread])  # compression positive
        p = stress.mean(axis=0)
        s = stress - p
        r = s - p * fabric
        room = c.M ** 2 - 1.5 * (fabric ** 2).sum(axis=0)
        over = 1.5 * (r ** 2).sum(axis=0)
        F = p + over / (room * p)
        along = 3 * r / (room * p)  # dF/ds
        volume = 1 - over / (room * p ** 2) - (along * fabric).sum(axis=0)  # dF/dp
        rest = (c.M ** 2 - c.alpha0 ** 2) / (c.M ** 2 - c.eta0 ** 2)
        rate = rest * c.mu / (self.volume * c.tau) * (F / ((1 + chi) * size)) ** ((c.slope - c.swelling) / c.mu)
        ev, shear = rate * volume, rate * np.sqrt(2 / 3 * (along ** 2).sum(axis=0))
        K = self.volume * p / c.swelling
        change = -K * ev + 2 * c.g * K * (strain - rate * along)
        turn = (0.75 * s / p - fabric) * np.maximum(ev, 0) + c.omega_d * (s / p / 3 - fabric) * shear
        return np.concatenate((change.ravel(), (c.omega * turn).ravel(),
                               size * self.volume / (c.slope - c.swelling) * ev,
                               -c.xi * chi * (abs(ev) + c.xi_d * shear)))

    def wall(self, times):
        """Total pressure and excess pore pressure at the wall at the times."""
        n = len(self.r0)
        with np.errstate(over="ignore", invalid="ignore"):  # of trial steps that are too long
            s = solve_ivp(self.rates, (0, times[-1]), self.begin, method="RK45", rtol=1e-7, atol=1e-9, t_eval=times)
        assert s.success, s.message
        table = []
        for t, y in zip(times, s.y.T):
            a = self.radius(t)[0]
            r = np.sqrt(self.r0 ** 2 + a ** 2 - 1)
            difference = y[:n] - y[n:2 * n]
            total = self.radial + self.unit * np.trapz(difference, np.log(r))
            table.append((total, total - self.unit * y[0]))
        return np.array(table)
