"""A rigid body in space, integrated in its own frame (Kirchhoff's equations, with Euler's as their rotational part)."""
import numpy as np
from scipy.integrate import solve_ivp
from scipy.spatial.transform import Rotation


def skew(w):
    return np.array([[0, -w[2], w[1]], [w[2], 0, -w[0]], [-w[1], w[0], 0]])


def move(times, mass, inertia, loads=None, added_mass=(0, 0, 0), added_inertia=(0, 0, 0), position=(0, 0, 0), velocity=(0, 0, 0),
         spin=(0, 0, 0)):
    """Centre of mass (time, 3), rotation matrices (time, 3, 3), velocity in space, spin about the body's axes.

    inertia: a matrix, or its diagonal. loads(t, x, turn, v, w): force and moment about the centre of mass, both along the body's
    axes, as are v and w; x is in space. position, velocity, spin: at time 0, when the axes are those of the model."""
    moving = mass * np.eye(3) + np.diag(added_mass)
    turning = (np.diag(inertia) if np.ndim(inertia) == 1 else np.array(inertia)) + np.diag(added_inertia)

    def rates(t, state):
        x, turn, v, w = state[:3], state[3:12].reshape(3, 3), state[12:15], state[15:]
        force, moment = loads(t, x, turn, v, w) if loads else (np.zeros(3), np.zeros(3))
        momentum = moving @ v
        dv = np.linalg.solve(moving, np.cross(momentum, w) + force)
        dw = np.linalg.solve(turning, np.cross(turning @ w, w) + np.cross(momentum, v) + moment)
        return np.concatenate([turn @ v, (turn @ skew(w)).ravel(), dv, dw])

    start = np.concatenate([position, np.eye(3).ravel(), velocity, spin]).astype(float)
    done = solve_ivp(rates, (0, times[-1]), start, method="DOP853", t_eval=times, rtol=1e-12, atol=1e-13)
    turns = done.y[3:12].T.reshape(-1, 3, 3)
    return done.y[:3].T, turns, np.einsum("tij,tj->ti", turns, done.y[12:15].T), done.y[15:].T


def turns_of(vectors):
    """Rotation matrices of rotation vectors."""
    return Rotation.from_rotvec(vectors).as_matrix()
