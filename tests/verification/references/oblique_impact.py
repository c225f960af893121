"""Oblique impact of a rigid ball on an elastic half-space with Coulomb friction: the equations of Cattaneo and Mindlin that N. Maw, J. R. Barber and
J. N. Fawcett solved on rings of the contact (Wear 38, 1976, 101-114), here on the bed of independent springs that is equivalent to them (V. L. Popov
and M. Hess, Method of Dimensionality Reduction in Contact Mechanics and Friction, Springer 2015, chapters 3 and 5; I. A. Lyashenko and V. L. Popov,
Scientific Reports 5, 8479, 2015): per length 2 G/(1 - nu) across the surface under the profile x^2/R, and 4 G/(2 - nu) along it, each
sliding where its force would exceed friction times its own normal one."""
import numpy as np


def rebound(incidence, poisson, gyration=0.4, springs=400, steps=4000):
    """Local angle psi_2 of rebound for psi_1 of incidence, psi = 2 (1 - nu)/(mu (2 - nu)) times the speed of what touches along the surface over
    that of the approach. gyration: moment of inertia over m R^2. Units: mass, radius, speed of approach and normal stiffness are 1."""
    friction = 1e-3  # small rotations: only psi counts
    factor = 2 * (1 - poisson) / (friction * (2 - poisson))
    ratio = 2 * (1 - poisson) / (2 - poisson)  # of the stiffnesses along and across the surface
    x = (np.arange(springs) + 0.5) / springs
    deepest = (15 / 16) ** 0.4  # 1/2 m v^2 = 8/15 E* R^(1/2) d^(5/2), E* = 1
    x = x * np.sqrt(deepest) * 1.001
    width = 2 * (x[1] - x[0])  # both sides of the middle
    stretch = np.zeros(springs)
    depth, speed, along, spin = 0.0, 1.0, incidence / factor, 0.0
    dt = 3.5 * deepest / steps
    while True:
        slip = along + spin  # of the ball's lowest point
        depth_end = depth + dt * speed
        normal = np.maximum(0.0, depth_end - x ** 2)
        trial = stretch + dt * slip
        limit = friction * normal / ratio
        stretch = np.where(normal > 0, np.clip(trial, -limit, limit), 0.0)
        across, sideways = normal.sum() * width, ratio * stretch.sum() * width
        speed -= dt * across
        along -= dt * sideways
        spin -= dt * sideways / gyration
        depth = depth_end
        if depth <= 0:
            return factor * (along + spin), -speed


def regimes(poisson, gyration=0.4):
    """psi_1 up to which all sticks at first, and from which all slides to the end; there psi_2 = psi_1 - 4 chi (momentum; Johnson 1985, 11.4)."""
    chi = (1 - poisson) * (1 + 1 / gyration) / (2 - poisson)
    return 1.0, 4 * chi - 1, chi
