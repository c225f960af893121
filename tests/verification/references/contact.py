"""Contact of elastic half spaces with rigid bodies (Johnson, Contact Mechanics, 1985). Pressures positive, SI units."""
import numpy as np


def plane_modulus(young, poisson):
    return young / (1 - poisson**2)


def hertz_line(load, radius, modulus):
    """Half width of the contact and largest pressure under a rigid cylinder that bears `load` per metre."""
    half_width = np.sqrt(4 * load * radius / (np.pi * modulus))
    return half_width, 2 * load / (np.pi * half_width)


def hertz_pressure(x, half_width, largest):
    return largest * np.sqrt(np.maximum(0, 1 - (x / half_width)**2))


def circular_punch(settlement, radius, modulus):
    """Load on a rigid flat punch and pressure in its centre."""
    load = 2 * modulus * radius * settlement
    return load, load / (2 * np.pi * radius**2)


def stick_half_width(half_width, shear, limit):
    """Cattaneo and Mindlin: of the part that sticks under a shear force below `limit` = coefficient times normal force."""
    return half_width * np.sqrt(1 - shear / limit)


def partial_slip(x, half_width, stick, limit_stress):
    """Their shear stress; limit_stress = coefficient times the largest pressure."""
    return hertz_pressure(x, half_width, limit_stress) - hertz_pressure(x, stick, limit_stress * stick / half_width)
