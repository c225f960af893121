"""Undrained penetration of a simple pile by the strain path method (Baligh 1985, J. Geotech. Eng. 111:1108): the soil is assumed to
flow past the pile like an ideal fluid past a point source in a uniform stream, so the strains are known before the stresses. Here with
Modified Cam Clay, and the stresses far behind the tip from radial equilibrium.

Compression positive. Coordinates of the pile: r, and z upwards from the source; the soil comes from below with unit velocity, the pile's
radius far behind its (round) tip is 1:

    v = e_z + x / (4 |x|^3),    strain rate = (I - 3 n n) / (4 |x|^3),    no spin

Components of tensors: rr, hoop, zz, rz. Stress unit: any.
"""
import numpy as np

ONE = np.array([1.0, 1.0, 1.0, 0.0])
TWICE = np.array([1.0, 1.0, 1.0, 2.0])  # the shear component counts twice in products


class SimplePile:
    """Particles that pass the pile, from start (effective stress far below, rr, hoop, zz) to far behind the tip.

    radii: present radii, in those of the pile, ascending; stress: effective, (n, 4); size: preconsolidation pressures, (n,).
    largest_strain bounds the strain of one step."""

    def __init__(self, M, slope, swelling, nu, v0, start, ocr, particles=160, nearest=0.02, farthest=60.0, largest_strain=2e-3):
        self.M, self.slope, self.swelling, self.v0 = M, slope, swelling, v0
        self.g = 1.5 * (1 - 2 * nu) / (1 + nu)
        first = np.append(np.asarray(start, dtype=float), 0.0)
        p, q2, _ = self.invariants(first[None])
        self.first = first
        self.stress = np.tile(first, (particles, 1))
        self.size = np.full(particles, ocr * (p + q2 / (M * M * p)))
        self.radii = np.geomspace(nearest, farthest, particles)
        self.flow(largest_strain)

    @staticmethod
    def invariants(stress):
        p = stress[:, :3].mean(axis=1)
        s = stress - p[:, None] * ONE
        return p, 1.5 * (s * s * TWICE).sum(axis=1), s

    def flow(self, largest_strain, reach=400.0):
        r, z = self.radii.copy(), np.full(len(self.radii), -reach)
        while (z < reach).any():
            distance = np.hypot(r, z)
            step = np.minimum(4 * largest_strain * distance ** 3, 0.05 * distance)
            step[z >= reach] = 0
            velocity = lambda r, z: (r / (4 * np.hypot(r, z) ** 3), 1 + z / (4 * np.hypot(r, z) ** 3))
            vr, vz = velocity(r, z)
            rm, zm = r + 0.5 * step * vr, z + 0.5 * step * vz  # midpoint rule
            vr, vz = velocity(rm, zm)
            distance = np.hypot(rm, zm)
            nr, nz = rm / distance, zm / distance
            rate = np.stack([1 - 3 * nr * nr, np.ones_like(nr), 1 - 3 * nz * nz, -3 * nr * nz], axis=1) / (4 * distance ** 3)[:, None]
            r, z = r + step * vr, z + step * vz
            self.load(-rate * step[:, None])
        self.radii = r

    def load(self, strain):
        """Volume-keeping strain increments: elastic trial, then back to the yield surface along its normals."""
        bulk = self.v0 * self.stress[:, :3].mean(axis=1) / self.swelling
        shear = self.g * bulk
        p, q2, s = self.invariants(self.stress + 2 * shear[:, None] * strain)
        for _ in range(20):
            f = q2 / self.M ** 2 + p * (p - self.size)
            outside = f > 1e-10 * self.size ** 2
            if not outside.any():
                break
            normal, growth = 2 * p - self.size, self.v0 / (self.slope - self.swelling)
            modulus = bulk * normal ** 2 + 2 * shear * 6 * q2 / self.M ** 4 + p * self.size * growth * normal
            factor = np.where(outside, f / modulus, 0.0)
            p = p - factor * bulk * normal
            s = s * (1 - 6 * shear * factor / self.M ** 2)[:, None]
            self.size = self.size * np.exp(growth * factor * normal)
            q2 = 1.5 * (s * s * TWICE).sum(axis=1)
        self.stress = s + p[:, None] * ONE

    def wall(self):
        """Total radial stress beyond the pore pressure far away, effective radial stress, excess pore pressure; all at the pile's wall."""
        difference = self.stress[:, 0] - self.stress[:, 1]
        x = np.append(0.0, np.log(self.radii))  # d sigma_r / d ln r = -(sigma_r - sigma_hoop)
        total = self.first[0] + np.trapz(np.append(difference[0], difference), x)
        return total, self.stress[0, 0], total - self.stress[0, 0]
