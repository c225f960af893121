"""A rigid body that falls through water or is stopped by a given resistance (Newton's equation; closed forms, and one of any force)."""
import math

from scipy.integrate import solve_ivp


def fall_in_water(t, mass, volume, area, density, drag, g=9.81):
    """Depth and speed of a body let go at rest; drag 1/2 rho C_d A v^2."""
    net = g * (1 - density * volume / mass)
    terminal = math.sqrt(2 * mass * net / (density * drag * area))
    return terminal**2 / net * math.log(math.cosh(net * t / terminal)), terminal * math.tanh(net * t / terminal)


def linear_resistance(t, mass, stiffness, speed, weight=0.0):
    """Depth and speed before the turning point; resistance = stiffness * depth."""
    w = math.sqrt(stiffness / mass)
    still = weight / stiffness
    return (still - still * math.cos(w * t) + speed / w * math.sin(w * t), still * w * math.sin(w * t) + speed * math.cos(w * t))


def sphere_below(height, radius):
    """Volume of a sphere below a height above its lowest point."""
    h = min(max(height, 0.0), 2 * radius)
    return math.pi * h * h * (3 * radius - h) / 3


def ram_on_bar(t, mass, impedance, speed):
    """Speed of a mass that hits a long bar, before the wave returns (St Venant)."""
    return speed * math.exp(-impedance * t / mass)


def stopped(depth, speed, mass, force):
    """Times, depths and speeds from the given ones to the first rest. force(depth, speed): all that acts downwards [N], as in True (1976)."""

    def rests(_, state):
        return state[1]

    rests.terminal, rests.direction = True, -1
    solution = solve_ivp(lambda _, state: [state[1], force(*state) / mass], (0, 60), [depth, speed], events=rests, rtol=1e-8, atol=1e-8, max_step=0.02)
    return solution.t, *solution.y
