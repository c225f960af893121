"""Oblique impact of a rigid sphere on an elastic half space (N. Maw, J. R. Barber, J. N. Fawcett, Wear 38, 1976, 101-114): Hertz's theory
along the normal, Coulomb friction on rings along the surface, neither of which changes the other (exact for Poisson's ratio 0.5).
Speeds along the surface are those of the sphere's lowest point, as psi = kappa v_t / (mu v_n), kappa = 2 (1 - nu) / (2 - nu)."""
import numpy as np

SLOWNESS = 3.5  # of the lowest point, 1 + m R^2 / I of a homogeneous sphere: its speed per impulse along the surface, times m
DURATION = 2.9432  # of an elastic impact, times the largest approach over the speed


def kappa(poisson):
    """Compliance along the normal over that along the surface."""
    return 2 * (1 - poisson) / (2 - poisson)


def gross_slip(psi, poisson):
    """psi behind an impact that slides throughout: friction is mu times the normal force."""
    return psi - 2 * SLOWNESS * kappa(poisson)


def hertz_load(approach, radius, shear, poisson):
    return 8 * shear * np.sqrt(radius) * np.maximum(approach, 0)**1.5 / (3 * (1 - poisson))


def mass_for(approach, speed, radius, shear, poisson):
    """Of the sphere that comes so far: half m v^2 is the work of Hertz's load."""
    return 2 * 0.4 * hertz_load(approach, radius, shear, poisson) * approach / speed**2


class Rings:
    """Shear tractions sqrt(1 - r^2/a^2) of several radii a, and the displacements of the surface along them (Johnson, 3.7; the part that
    depends on the direction has the mean 0 and is left out)."""

    def __init__(self, largest, count, shear, poisson):
        outer = largest * np.arange(1, count + 1) / count
        self.radii = outer - 0.5 * largest / count
        r, a = np.meshgrid(self.radii, outer, indexing="ij")
        inside = r <= a
        share = np.where(inside, 1.0, a / r)
        shape = np.where(inside, np.pi / 2 * (2 * a**2 - r**2),
                         (2 * a**2 - r**2) * np.arcsin(share) + a * np.sqrt(np.maximum(r**2 - a**2, 0)))
        to_amplitudes = np.linalg.inv(np.sqrt(np.maximum(1 - (r / a)**2, 0)))
        self.compliance = (2 - poisson) / (8 * shear) * (shape / a) @ to_amplitudes
        self.areas = 2 * np.pi / 3 * outer**2 @ to_amplitudes

    def tractions(self, displacement, way, limit):
        """Those after a displacement of the sphere, where |q| <= limit: rings stick, or slip in the direction of their traction."""
        touching = limit > 0
        stick, direction = touching.copy(), np.zeros(len(limit))
        for _ in range(200):
            q = np.where(touching & ~stick, limit * direction, 0.0)
            q[stick] = np.linalg.solve(self.compliance[np.ix_(stick, stick)], (displacement + way - self.compliance @ q)[stick])
            over = stick & (np.abs(q) > limit * (1 + 1e-9))
            slip = displacement + way - self.compliance @ q
            back = touching & ~stick & (slip * direction < -1e-12 * np.abs(displacement + way).max())
            if not over.any() and not back.any():
                return q
            direction = np.where(over, np.sign(q), direction)
            stick = (stick & ~over) | back
        raise RuntimeError("stick and slip do not settle")


def impact(psi, poisson, count=40, steps=600):
    """Times in largest approaches over the speed, and psi at them, of an impact that begins with `psi`. Explicit in time."""
    radius, shear, speed, friction, approach = 1.0, 1.0, 1.0, 0.3, 0.01  # psi depends on none of them
    mass = mass_for(approach, speed, radius, shear, poisson)
    rings = Rings(1.02 * np.sqrt(approach * radius), count, shear, poisson)
    step = 1.1 * DURATION * approach / speed / steps
    depth, down, along = 0.0, speed, psi * friction * speed / kappa(poisson)
    q, displacement = np.zeros(count), np.zeros(count)
    history = [(0.0, psi)]
    while depth > 0 or down > 0:
        down -= 0.5 * step * hertz_load(depth, radius, shear, poisson) / mass
        along -= 0.5 * step * SLOWNESS / mass * rings.areas @ q
        depth += step * down
        touching = np.sqrt(max(depth, 0) * radius)
        pressure = 4 * shear / (np.pi * radius * (1 - poisson)) * np.sqrt(np.maximum(touching**2 - rings.radii**2, 0))
        q = rings.tractions(displacement, step * along, friction * pressure)
        displacement = rings.compliance @ q
        down -= 0.5 * step * hertz_load(depth, radius, shear, poisson) / mass
        along -= 0.5 * step * SLOWNESS / mass * rings.areas @ q
        history.append((history[-1][0] + step * speed / approach, kappa(poisson) * along / (friction * speed)))
    return np.array(history).T
