"""A smooth rigid cylinder or ball of radius a in an elastic ring or shell whose outer face, of radius b, is held. Lamé (1852) for the pressure;
for the pull the equations of equilibrium (Timoshenko and Goodier, Theory of Elasticity, 1970, sections 28 and 132) of the displacements
u_r = f(r) cos(theta), u_theta = g(r) sin(theta), solved as a boundary-value problem."""
import numpy as np
from scipy.integrate import solve_bvp


class Ring:
    """k: 1 for a cylinder in plane strain, 2 for a ball."""

    def __init__(self, k, a, b, young, poisson):
        self.k, self.a, self.b = k, a, b
        self.shear = young / (2 * (1 + poisson))
        self.lame = young * poisson / ((1 + poisson) * (1 - 2 * poisson))

    def unloaded(self, pressure):
        """Displacement of the inner face, outwards, when its pressure goes: u = A r + B/r^k."""
        k, a, b = self.k, self.a, self.b
        volume = (k + 1) * self.lame + 2 * self.shear  # sigma_r = volume A - 2 k G B/r^(k+1)
        amplitude = -pressure / (volume / b ** (k + 1) + 2 * k * self.shear / a ** (k + 1))
        return amplitude * (1 / a ** k - a / b ** (k + 1))

    def pulled(self, way):
        """Force on the whole body, per metre for a cylinder, that is moved by `way` and does not part from the soil."""
        k, lame, shear = self.k, self.lame, self.shear

        def stresses(r, y):
            f, g, slope, shear_stress = y
            hoop = (f + g) / r
            trace = lame * (slope + k * hoop)
            return trace + 2 * shear * slope, trace + 2 * shear * hoop, shear_stress

        def equations(r, y):
            f, g, slope, shear_stress = y
            radial, hoop_stress, _ = stresses(r, y)
            slope_g = shear_stress / shear + (g + f) / r
            hoop_change = (slope + slope_g) / r - (f + g) / r ** 2
            radial_change = -k * (radial - hoop_stress) / r - k * shear_stress / r
            curvature = (radial_change - lame * k * hoop_change) / (lame + 2 * shear)
            return np.vstack([slope, slope_g, curvature, hoop_stress / r - (k + 1) * shear_stress / r])

        def ends(inner, outer):
            return np.array([inner[0] - way, inner[3] / shear, outer[0], outer[1]])

        r = np.linspace(self.a, self.b, 60)
        start = np.zeros((4, 60))
        start[0] = way * (self.b - r) / (self.b - self.a)
        found = solve_bvp(equations, ends, r, start, tol=1e-8, max_nodes=20000)
        assert found.success, found.message
        radial = stresses(self.a, found.sol(self.a))[0]
        return radial * (np.pi * self.a if k == 1 else 4 * np.pi / 3 * self.a ** 2)
