"""Rigid bodies in space, closed surfaces of triangles, cut by planes across the axes. No drawing here.

A plane is (axis, at, inwards): the coordinate along `axis` is `at`, and what lies on the side of `inwards` (1: above,
-1: below) is kept. Faces of the surface that lie in the plane count as cut by it where the body is on that side.
"""

import numpy as np

from report_space import sharp_sides

ROUNDING = 1e-9  # of the size of the body's surroundings: nearer to a plane than this is in it


def levels(coordinate, plane, size):
    """Signed distance from the plane, positive inwards, exactly 0 where only rounding differs."""
    _, at, inwards = plane
    level = inwards * (coordinate - at)
    level[np.abs(level) < ROUNDING * size] = 0.0
    return level


def section(points, triangles, plane, size):
    """(places, pairs): the line along which the surface is cut, and which two places each piece of it joins. All pieces
    run on in one direction around the body."""
    level = levels(points[:, plane[0]], plane, size)
    above = level[triangles] > 0
    chosen = (above.sum(axis=1) > 0) & ~above.all(axis=1)
    triangles, above = triangles[chosen], above[chosen]
    after = np.roll(above, -1, axis=1)
    rows = np.arange(len(triangles))
    ends = []  # of each piece: where the way around the triangle goes down through the plane, and where it comes up
    for side, upper, lower in ((np.argmax(above & ~after, axis=1), 0, 1), (np.argmax(~above & after, axis=1), 1, 0)):
        ends.append(np.column_stack([triangles[rows, (side + upper) % 3], triangles[rows, (side + lower) % 3]]))
    ends = np.stack(ends, axis=1)  # (piece, end, upper and lower point)
    ends[..., 0] = np.where(level[ends[..., 1]] == 0, ends[..., 1], ends[..., 0])  # a point in the plane is one place
    ends, number = np.unique(ends.reshape(-1, 2), axis=0, return_inverse=True)
    upper, lower = level[ends[:, 0]], level[ends[:, 1]]
    share = np.divide(upper, upper - lower, out=np.zeros(len(ends)), where=upper > 0)[:, None]
    places = (1 - share) * points[ends[:, 0]] + share * points[ends[:, 1]]
    pairs = number.reshape(-1, 2)
    return places, pairs[pairs[:, 0] != pairs[:, 1]]


def section_loops(points, triangles, plane, size):
    """The closed lines of the section: [(place, 3)]. Those around holes run the other way."""
    places, pairs = section(points, triangles, plane, size)
    following = {}
    for first, second in pairs.tolist():
        following.setdefault(first, []).append(second)
    loops = []
    while following:
        loop = [next(iter(following))]
        while loop[-1] in following:
            onwards = following[loop[-1]]
            loop.append(onwards.pop())
            if not onwards:
                del following[loop[-2]]
            if loop[-1] == loop[0]:
                break
        loops.append(places[loop])
    return loops


def filled(places, pairs):
    """(corners, sides) of triangles that fill what the pieces enclose in the plane: strips across the first axis, in
    which no piece ends, so that trapezia lie between the pieces. places: (place, 2)."""
    ends = places[pairs]
    forwards = np.where(ends[:, 1, 0] > ends[:, 0, 0], 1, -1)
    ends = np.where(forwards[:, None, None] > 0, ends, ends[:, ::-1])
    lines = np.unique(ends[..., 0])
    first, last = np.searchsorted(lines, ends[:, 0, 0]), np.searchsorted(lines, ends[:, 1, 0])
    piece = np.repeat(np.arange(len(ends)), last - first)
    strip = np.arange(len(piece)) - np.repeat(np.cumsum(last - first) - last, last - first)
    left, right = lines[strip], lines[strip + 1]
    start, way = ends[piece, 0], ends[piece, 1] - ends[piece, 0]
    at_left, at_right = (start[:, 1] + way[:, 1] * (u - start[:, 0]) / way[:, 0] for u in (left, right))
    order = np.lexsort([at_left + at_right, strip])
    strip, left, right, at_left, at_right = (values[order] for values in (strip, left, right, at_left, at_right))
    turns = np.cumsum(forwards[piece[order]])  # 0 outside the body, as many pieces lead into it as out of it
    low = np.flatnonzero((turns[:-1] != 0) & (strip[1:] == strip[:-1]))
    high = low + 1
    a, b = np.column_stack([left, at_left])[low], np.column_stack([right, at_right])[low]
    c, d = np.column_stack([right, at_right])[high], np.column_stack([left, at_left])[high]
    corners = np.concatenate([np.stack([a, b, c], axis=1), np.stack([a, c, d], axis=1)])
    sides = np.zeros((len(corners), 3), int)
    sides[: len(low), 0] = np.where(np.concatenate([[0], turns])[low] == 0, 2, 0)
    sides[len(low) :, 1] = np.where(turns[high] == 0, 2, 0)
    return corners, sides


def cut_face(points, triangles, plane, size):
    """(corners, sides) of the face that the plane makes, turned outwards."""
    axis, at, inwards = plane
    places, pairs = section(points, triangles, plane, size)
    others = [other for other in range(3) if other != axis]  # upright faces in upright strips, the fastest to draw
    flat, sides = filled(places[:, others], pairs)
    corners = np.full((len(flat), 3, 3), float(at))
    corners[..., others] = flat
    outwards = -inwards if axis != 1 else inwards  # x, z and y are no right-handed system
    return (corners, sides) if outwards > 0 else (corners[:, ::-1], sides[:, [1, 0, 2]])


def cut_off(corners, sides, plane, size):
    """(corners, sides) of what is left of triangles inside of the plane."""
    level = levels(corners[..., plane[0]], plane, size)
    above = level > 0
    number = above.sum(axis=1)
    whole = (number > 0) & (level.min(axis=1) >= 0)
    parts, lines = [corners[whole]], [sides[whole]]
    for how_many in (1, 2):
        chosen = (number == how_many) & ~whole
        lonely = np.argmax(above[chosen] == (how_many == 1), axis=1)  # the corner that is alone on its side comes first
        turned = (lonely[:, None] + np.arange(3)) % 3
        x, s = np.take_along_axis(corners[chosen], turned[..., None], 1), np.take_along_axis(sides[chosen], turned, 1)
        h = np.take_along_axis(level[chosen], turned, 1)
        share = h[:, :1] / (h[:, :1] - h[:, 1:])
        p, q = ((1 - share[:, [k]]) * x[:, 0] + share[:, [k]] * x[:, k + 1] for k in (0, 1))
        none, cut = np.zeros(len(x), int), np.full(len(x), 2)
        if how_many == 1:
            parts.append(np.stack([x[:, 0], p, q], axis=1))
            lines.append(np.column_stack([s[:, 0], cut, s[:, 2]]))
        else:
            parts += [np.stack([p, x[:, 1], x[:, 2]], axis=1), np.stack([p, x[:, 2], q], axis=1)]
            lines += [np.column_stack([s[:, 0], s[:, 1], none]), np.column_stack([none, s[:, 2], cut])]
    return np.concatenate(parts), np.concatenate(lines)


def clipped(points, triangles, low, high):
    """(corners, sides) of the body cut off at the box, with the faces that this makes: (triangle, corner, 3) and, as
    those of outer_surface, (triangle, 3)."""
    size = np.linalg.norm(high - low)
    planes = [(axis, at, inwards) for axis in range(3) for at, inwards in ((low[axis], 1), (high[axis], -1))]
    planes = [plane for plane in planes if levels(points[:, plane[0]], plane, size).min() <= 0]
    surfaces = [(None, points[triangles], 2 * sharp_sides(points, triangles))]
    surfaces += [(plane, *cut_face(points, triangles, plane, size)) for plane in planes]
    for plane in planes:
        surfaces = [
            (own, *((corners, sides) if own == plane else cut_off(corners, sides, plane, size)))
            for own, corners, sides in surfaces
        ]
    return np.concatenate([corners for _, corners, _ in surfaces]), np.concatenate([sides for _, _, sides in surfaces])
