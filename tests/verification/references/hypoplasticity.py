"""Hypoplastic sand of von Wolffersdorff (1996) with the intergranular strain of Niemunis and Herle (1997), in principal
axes that do not turn. All tensors are diagonal: three numbers (radial, axial, radial), tension positive; L is a 3 x 3
matrix. The rate equations are solved by an integrator with order and step control of its own, so nothing is shared with
the program but the equations.

Stresses in Pa. The void ratio follows de = (1 + e) tr D dt. There is no lower bound of the stress here."""
import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

HOCHSTETTEN = {"phi": 33.0, "hs": 1e9, "n": 0.25, "ed0": 0.55, "ec0": 0.95, "ei0": 1.05, "alpha": 0.25, "beta": 1.5}
INTERGRANULAR = {"R": 1e-4, "mR": 5.0, "mT": 2.0, "betar": 0.5, "chi": 6.0}


class Sand:
    def __init__(self, phi, hs, n, ed0, ec0, ei0, alpha, beta, R=None, mR=None, mT=None, betar=None, chi=None):
        self.hs, self.n, self.alpha, self.beta = hs, n, alpha, beta
        self.limits = np.array([ed0, ec0, ei0])
        self.R, self.mR, self.mT, self.betar, self.chi = R, mR, mT, betar, chi
        sine = np.sin(np.radians(phi))
        self.a = np.sqrt(3) * (3 - sine) / (2 * np.sqrt(2) * sine)

    def linear_and_other(self, T, e):
        """L and N of dT = L D + N |D|."""
        ed0, ec0, ei0 = self.limits
        trace = T.sum()
        that = T / trace
        dev = that - 1 / 3
        tan_psi = np.sqrt(3) * np.linalg.norm(dev)
        if tan_psi > 1e-9:
            cos3 = -np.sqrt(6) * (dev ** 3).sum() / ((dev ** 2).sum()) ** 1.5
            cos3 = min(1.0, max(-1.0, cos3))
            lode = (2 - tan_psi ** 2) / (2 + np.sqrt(2) * tan_psi * cos3)
            F = np.sqrt(tan_psi ** 2 / 8 + lode) - tan_psi / (2 * np.sqrt(2))
        else:
            F = 1.0
        ed, ec, ei = self.limits * np.exp(-(-trace / self.hs) ** self.n)
        fd = ((e - ed) / (ec - ed)) ** self.alpha
        fe = (ec / e) ** self.beta
        fb = (self.hs / self.n * (ei0 / ec0) ** self.beta * (1 + ei) / ei * (-trace / self.hs) ** (1 - self.n)
              / (3 + self.a ** 2 - np.sqrt(3) * self.a * ((ei0 - ed0) / (ec0 - ed0)) ** self.alpha))
        front = fb * fe / (that @ that)
        return front * (F ** 2 * np.eye(3) + self.a ** 2 * np.outer(that, that)), front * fd * F * self.a * (that + dev)

    def rates(self, T, e, h, D):
        L, N = self.linear_and_other(T, e)
        if self.R is None:
            return L @ D + N * np.linalg.norm(D), (1 + e) * D.sum(), 0 * h
        size = np.linalg.norm(h)
        rho = size / self.R
        u = h / size if size > 1e-14 else 0 * h
        along = u @ D
        M = (rho ** self.chi * self.mT + (1 - rho ** self.chi) * self.mR) * L
        if along > 0:
            M = M + rho ** self.chi * (1 - self.mT) * np.outer(L @ u, u) + rho ** self.chi * np.outer(N, u)
            dh = D - np.outer(u, u) @ D * rho ** self.betar
        else:
            M = M + rho ** self.chi * (self.mR - self.mT) * np.outer(L @ u, u)
            dh = D
        return M @ D, (1 + e) * D.sum(), dh


def undrained(sand, T, e, h, sign):
    return sign * np.array([-0.5, 1.0, -0.5])


def oedometric(sand, T, e, h, sign):
    return sign * np.array([0.0, 1.0, 0.0])


def drained(sand, T, e, h, sign):
    """The radial stretching that leaves the radial stress as it is."""
    radial = lambda x: sand.rates(T, e, h, np.array([x, sign, x]))[0][0]
    low, high = (-1.5, 0.5) if sign > 0 else (-0.5, 1.5)
    return (lambda x: np.array([x, sign, x]))(brentq(radial, low, high, xtol=1e-12))


def leg(sand, motion, y, sign, length, rows=2, event=None):
    """Axial strain goes on by sign * length, or until the event; y: T, e, h, axial strain. Returns y at `rows` places,
    the start included."""
    def f(_, y):
        dT, de, dh = sand.rates(y[:3], y[3], y[4:7], motion(sand, y[:3], y[3], y[4:7], -sign))
        return np.concatenate((dT, [de], dh, [sign]))
    size = np.abs(y[:3]).max()
    scale = np.concatenate((np.full(3, 1e-7 * size), np.full(4, 1e-10), [1e-12]))
    solution = solve_ivp(f, (0, length), y, method="LSODA", rtol=1e-8, atol=scale, events=event, max_step=length / 50,
                         t_eval=None if event else np.linspace(0, length, rows))
    assert solution.success, solution.message
    return solution.y.T


def start(p0, e0):
    return np.concatenate((np.full(3, -p0), [e0], np.zeros(4)))


def path(sand, motion, p0, e0, strains, rows):
    """From an isotropic stress the axial strain (compression positive) goes to each of `strains`. Returns a table: axial
    strain, T radial, T axial, e; `rows` of each leg, the last one of a leg being the first one of the next."""
    y, table = start(p0, e0), []
    for target in strains:
        part = leg(sand, motion, y, np.sign(target - y[7]), abs(target - y[7]), rows)
        table.extend(part[1 if table else 0:])
        y = part[-1].copy()
        y[7] = target
    return np.array(table)[:, [7, 0, 1, 3]]


def turns(sand, motion, p0, e0, amplitude, count):
    """The stress difference goes to and fro between +-`amplitude`: T radial, T axial at each of `count` turns."""
    y, table = start(p0, e0), []
    for k in range(count):
        sign = 1.0 if k % 2 == 0 else -1.0
        reached = lambda _, y, sign=sign: sign * (y[0] - y[1]) - amplitude
        reached.terminal, reached.direction = True, 1
        y = leg(sand, motion, y, sign, 0.1, event=reached)[-1]
        table.append(y[:2])
    return np.array(table)
