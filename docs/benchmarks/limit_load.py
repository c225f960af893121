"""Collapse load of rigid, perfectly plastic Tresca soil in plane strain on the meshes that a run left behind: an independent check of a
footing's resistance at any depth, without elasticity, stress history, contact law or time.

    python3 docs/benchmarks/limit_load.py RESULT.h5 [BODY] [rough]

At the output times: the velocity field (six-node triangles, no change of volume at three points each) that dissipates least while the body
goes down by one unit and the soil that it presses keeps to its contour (what would pull is released, one node after the other). Prints
dissipation / (half width x strength), the factor N_c. Needs scipy. Elements are the run's, so their error is seen at the surface, where
2 + pi is exact.
"""
import sys

import h5py
import numpy as np
import scipy.sparse as sp
import scipy.sparse.linalg as sla

POINTS = [(1 / 6, 1 / 6), (2 / 3, 1 / 6), (1 / 6, 2 / 3)]
STIFF = 1e6   # of volume and contact against the viscosity 1 / rate of what yields
RIGID = 1e-5  # rate below which soil counts as rigid


def slopes(r, s):
    t = 1 - r - s
    return np.array([[1 - 4 * t, 4 * r - 1, 0, 4 * (t - r), 4 * s, -4 * s], [1 - 4 * t, 0, 4 * s - 1, -4 * r, 4 * r, 4 * (t - s)]])


def strain_matrices(x, cells):
    """Matrices of exx - eyy, 2 exy and volume at the points, and the points' areas."""
    parts, areas = [[], [], []], []
    dofs = np.stack([2 * cells, 2 * cells + 1], axis=2).reshape(len(cells), 12)
    rows = np.arange(len(cells) * len(POINTS)).reshape(len(POINTS), len(cells))
    for k, (r, s) in enumerate(POINTS):
        d = slopes(r, s)
        jacobian = np.einsum("ia,eaj->eij", d, x[cells])
        g = np.linalg.solve(jacobian, np.broadcast_to(d, (len(cells), 2, 6)))
        areas.append(np.linalg.det(jacobian) / 6)
        for part, (cx, cy) in zip(parts, ((g[:, 0], -g[:, 1]), (g[:, 1], g[:, 0]), (g[:, 0], g[:, 1]))):
            part.append((np.stack([cx, cy], axis=2).reshape(-1), np.repeat(rows[k], 12), dofs.reshape(-1)))
    shape = (rows.size, 2 * len(x))
    return [sp.csr_matrix((np.concatenate([p[0] for p in part]), (np.concatenate([p[1] for p in part]), np.concatenate([p[2] for p in part]))), shape)
            for part in parts], np.concatenate(areas)


def boundary_nodes(cells):
    sides = {}
    for nodes in cells:
        for a, b, m in ((0, 1, 3), (1, 2, 4), (2, 0, 5)):
            sides.setdefault(frozenset((nodes[a], nodes[b])), []).append((nodes[a], nodes[b], nodes[m]))
    return np.array(sorted({n for one in sides.values() if len(one) == 1 for n in one[0]}))


def least_dissipation(matrices, areas, held, pressed, normals, rough, iterations=40):
    """Iteratively reweighted least squares; returns the dissipation and the contact pressures (positive: presses)."""
    free = np.setdiff1d(np.arange(matrices[0].shape[1]), held)
    exx, exy, volume = [m[:, free] for m in matrices]
    shear = sp.vstack([exx, exy]).tocsr()
    along = np.stack([-normals[:, 1], normals[:, 0]], axis=1)
    directions = [normals, along] if rough else [normals]
    count = len(pressed)
    contact = sp.vstack([sp.csr_matrix((np.concatenate([n[pressed, 0], n[pressed, 1]]),
                                        (np.tile(np.arange(count), 2), np.concatenate([2 * pressed, 2 * pressed + 1]))),
                                       shape=(count, matrices[0].shape[1])) for n in directions]).tocsr()[:, free]
    given = np.concatenate([-n[pressed, 1] for n in directions])
    fixed = STIFF * (volume.T @ sp.diags(areas) @ volume + contact.T @ contact)
    rate, right = np.ones(len(areas)), STIFF * (contact.T @ given)
    for _ in range(iterations):
        weight = areas / np.maximum(rate, RIGID)
        solution = sla.spsolve((fixed + shear.T @ sp.diags(np.tile(weight, 2)) @ shear).tocsc(), right, permc_spec="COLAMD")
        rate = np.hypot(exx @ solution, exy @ solution)
    return np.sum(areas * rate), STIFF * (contact @ solution - given)[:count] * -1


def limit_loads(path, body="footing", rough=False):
    """Yields (depth, N_c, nodes pressed) at the output times."""
    file = h5py.File(path)
    topology, offset = file["mesh/topology"][:], file["mesh/offset"][:]
    cells = np.array([topology[o + 1:o + 7] for o in offset])
    x0 = file["mesh/coordinates"][:, :2]
    contour = file["bodies/%s/contour" % body][:, :2]
    half_width = contour[:, 0].max()
    contour = contour[:np.flatnonzero(contour[:, 0] == half_width)[-1] + 1]  # without the top
    dense = np.vstack([np.linspace(a, b, 400)[:-1] for a, b in zip(contour[:-1], contour[1:])])
    tangent = np.vstack([np.tile(b - a, (399, 1)) / np.linalg.norm(b - a) for a, b in zip(contour[:-1], contour[1:])])
    edge = boundary_nodes(cells)
    low, far = x0[:, 1].min(), x0[:, 0].max()
    bottom, side, axis = edge[x0[edge, 1] < low + 1e-9], edge[x0[edge, 0] > far - 1e-9], edge[x0[edge, 0] < 1e-9]
    held = np.concatenate([2 * bottom, 2 * bottom + 1, 2 * side, 2 * axis])
    top = axis[x0[axis, 1].argmax()]
    surface = np.setdiff1d(edge, np.concatenate([bottom, side, np.setdiff1d(axis, [top])]))
    for name in sorted(file["steps"]):
        x = file["steps/%s/coordinates" % name][:, :2]
        place = dense + [0, x[top, 1] - contour[0, 1]]
        distance = np.hypot(*(place[None] - x[surface][:, None]).transpose(2, 0, 1))
        nearest = distance.argmin(axis=1)
        normals = np.zeros((len(x), 2))
        normals[surface] = np.stack([tangent[nearest, 1], -tangent[nearest, 0]], axis=1)
        pressed = surface[distance.min(axis=1) < 0.01 * half_width]
        matrices, areas = strain_matrices(x, cells)
        for _ in range(12):
            load, pressure = least_dissipation(matrices, areas, held, pressed, normals, rough)
            pulls = pressure < -1e-3 * pressure.max()
            if not pulls.any():
                break
            pressed = pressed[~pulls]
        yield -x[top, 1], load / half_width, len(pressed)


def main():
    for depth, factor, nodes in limit_loads(sys.argv[1], (sys.argv[2:3] or ["footing"])[0], "rough" in sys.argv[3:]):
        print(f"depth {depth:.3f} m: N_c {factor:.3f} ({nodes} nodes pressed)", flush=True)


if __name__ == "__main__":
    main()
