"""Rigid blocks on rough ground (Coulomb friction), closed forms; a cylinder that rolls down a slope."""
import math


def spring_block(t, frequency, strength_over_stiffness, start):
    """Block on a spring, released at `start` > 0 at rest: position. The amplitude drops by twice the friction's share each
    half period, until the spring cannot move it."""
    e, half = strength_over_stiffness, math.pi / frequency
    amplitude, sign = start, 1.0
    while True:
        if amplitude <= e:
            return sign * amplitude
        if t < half:
            return sign * (e + (amplitude - e) * math.cos(frequency * t))
        t -= half
        amplitude, sign = amplitude - 2 * e, -sign
        if amplitude < 0:
            amplitude, sign = -amplitude, -sign


def rolling_acceleration(along, mass, inertia, radius):
    """Without sliding; `along`: gravity down the slope."""
    return along / (1 + inertia / (mass * radius**2))
