"""L2 norms of nodal fields of quad9 and tri6 meshes."""
import numpy as np

GAUSS = np.array([-np.sqrt(0.6), 0.0, np.sqrt(0.6)]), np.array([5, 8, 5]) / 9


def _line(x):
    """Quadratic shapes at -1, 0, 1 and their slopes."""
    return np.array([0.5 * x * (x - 1), 1 - x * x, 0.5 * x * (x + 1)]), np.array([x - 0.5, -2 * x, x + 0.5])


def _quad9():
    place = [(0, 0), (2, 0), (2, 2), (0, 2), (1, 0), (2, 1), (1, 2), (0, 1), (1, 1)]  # of each node in the tensor grid
    for i, xi in enumerate(GAUSS[0]):
        for j, eta in enumerate(GAUSS[0]):
            (nx, dx), (ny, dy) = _line(xi), _line(eta)
            shape = np.array([nx[a] * ny[b] for a, b in place])
            slope = np.array([(dx[a] * ny[b], nx[a] * dy[b]) for a, b in place])
            corner = np.zeros(9)
            corner[:4] = [0.25 * (1 + sx * xi) * (1 + sy * eta) for sx, sy in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
            yield shape, slope, corner, GAUSS[1][i] * GAUSS[1][j]


def _tri6():
    a, b = (6 - np.sqrt(15)) / 21, (6 + np.sqrt(15)) / 21  # seven points, degree 5 (Radon 1948)
    points = [((1 / 3, 1 / 3), 0.225)]
    for c, w in ((a, (155 - np.sqrt(15)) / 1200), (b, (155 + np.sqrt(15)) / 1200)):
        points += [((c, c), w), ((1 - 2 * c, c), w), ((c, 1 - 2 * c), w)]
    for (x, y), w in points:
        z = 1 - x - y
        shape = np.array([z * (2 * z - 1), x * (2 * x - 1), y * (2 * y - 1), 4 * z * x, 4 * x * y, 4 * y * z])
        slope = np.array([(1 - 4 * z, 1 - 4 * z), (4 * x - 1, 0), (0, 4 * y - 1), (4 * (z - x), -4 * x), (4 * y, 4 * x),
                          (-4 * y, 4 * (z - y))])
        yield shape, slope, np.array([z, x, y, 0, 0, 0]), 0.5 * w


def l2_error(coordinates, topology, values, exact, linear=False):
    """L2 norm over the plane of (nodal values interpolated - exact(x, y)); `topology` as in XDMF's mixed format. `linear`:
    the field lives on the corners only, as the pore pressure does."""
    width, rule = {35: (10, _quad9), 36: (7, _tri6)}[topology[0]]
    cells = topology.reshape(-1, width)[:, 1:]
    square = 0.0
    for shape, slope, corner, weight in rule():
        x = coordinates[cells]
        jacobian = np.einsum("eai,aj->eij", x, slope)
        point = np.einsum("a,eai->ei", shape, x)
        difference = (corner if linear else shape) @ values[cells].T - exact(point[:, 0], point[:, 1])
        square += np.sum(weight * np.linalg.det(jacobian) * difference ** 2)
    return np.sqrt(square)
