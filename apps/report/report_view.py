"""Perspective view of a surface of triangles as an image, by a depth buffer: hidden faces behind, light, and mesh lines."""

import numpy as np

ELEVATION = np.radians(25.0)
DISTANCE = 5.0  # of the eye, over half the diagonal of the model
FINER = 2  # the buffer has so many pixels along one of the image, for smooth outlines
CHUNK = 1_000_000  # fragments at a time
LINE = np.array([0.12, 0.13, 0.15], np.float32)


class View:
    """Looks at the middle of a box from the direction `towards` (x, y), from above; x right, y up on the picture [m]."""

    def __init__(self, low, high, towards):
        self.low, self.high = np.asarray(low, float), np.asarray(high, float)
        self.middle = (self.low + self.high) / 2
        across = np.asarray(towards, float) / np.hypot(*towards)
        self.eye = np.array([*np.cos(ELEVATION) * across, np.sin(ELEVATION)])
        self.right = np.array([-across[1], across[0], 0.0])
        self.up = np.cross(self.eye, self.right)
        self.distance = DISTANCE * max(np.linalg.norm(self.high - self.low) / 2, 1e-300)

    def project(self, points):
        """(point, 3): place on the picture, and nearness (one over the distance along the view, 1 at the middle)."""
        points = np.asarray(points) - self.middle
        nearness = self.distance / (self.distance - points @ self.eye)
        return np.stack([points @ self.right * nearness, points @ self.up * nearness, nearness], axis=-1)

    def light(self, normals, shade=0.8):
        """Brightness of faces: from above and left of the eye; weak, so that colours stay those of the colour bar.
        shade: where the lamp does not reach."""
        lamp = 0.75 * self.eye + 0.6 * self.up - 0.45 * self.right
        length = np.maximum(np.linalg.norm(normals, axis=1), 1e-300) * np.linalg.norm(lamp)
        return (shade + (1.02 - shade) * np.clip(normals @ lamp / length, 0, 1)).clip(max=1.0)


def cross(a, b):
    return a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]


class Buffer:
    """What the pixels of an image see: of the covered ones `pixel`, `triangle` and `weights` of its three corners."""

    def __init__(self, projected, triangles, window, width, height):
        """window: left, right, bottom, top of the picture; width, height in pixels of the image."""
        self.width, self.height = FINER * width, FINER * height
        left, right, bottom, top = window
        self.corners = projected[triangles]  # (triangle, corner, 3); places in pixels, y downwards
        self.corners[..., 0] = (self.corners[..., 0] - left) / (right - left) * self.width
        self.corners[..., 1] = (top - self.corners[..., 1]) / (top - bottom) * self.height
        a, b, c = (self.corners[:, i, :2] for i in range(3))
        self.area = -cross(b - a, c - a)  # of the parallelogram; positive where the outer side is seen
        # How the weights of the second and the third corner grow along x and y.
        opposite = np.stack([c - a, a - b], axis=1)[..., ::-1] * [-1, 1]
        with np.errstate(all="ignore"):  # faces seen from their edge are left out
            self.slopes = (opposite / self.area[:, None, None]).astype(np.float32)
        self.corners = self.corners.astype(np.float32)
        self._fill()

    def _fill(self):
        nearest = np.zeros(self.width * self.height, np.float32)
        owner = np.full(self.width * self.height, -1, np.int32)
        seen = np.flatnonzero(self.area > 1e-9)
        # Pixels (i, j) of the box around each triangle whose middles (i + 1/2, j + 1/2) may lie in it.
        limit = np.array([self.width, self.height])
        first = np.clip(np.ceil(self.corners[seen, :, :2].min(axis=1) - 0.5), 0, limit).astype(int)
        last = np.clip(np.floor(self.corners[seen, :, :2].max(axis=1) - 0.5), -1, limit - 1).astype(int)
        size = np.maximum(last - first + 1, 0)
        counts = size.prod(axis=1)
        for part in np.split(np.arange(len(seen)), np.flatnonzero(np.diff(np.cumsum(counts) // CHUNK)) + 1):
            total = counts[part].sum()
            which = np.repeat(part, counts[part])
            within = np.arange(total) - np.repeat(np.cumsum(counts[part]) - counts[part], counts[part])
            i = first[which, 0] + within % size[which, 0]
            j = first[which, 1] + within // size[which, 0]
            triangle, pixel = seen[which], j * self.width + i
            weights = self.flat_weights(triangle, i, j)
            inside = np.minimum(np.minimum(weights[0], weights[1]), weights[2]) >= -1e-4
            triangle, pixel = triangle[inside], pixel[inside]
            near = sum(weights[k][inside] * self.corners[triangle, k, 2] for k in range(3))
            order = np.argsort(near, kind="stable")  # the nearest is written last
            order = order[near[order] > nearest[pixel[order]]]
            nearest[pixel[order]], owner[pixel[order]] = near[order], triangle[order]
        self.pixel = np.flatnonzero(owner >= 0)
        self.triangle = owner[self.pixel]
        flat = self.flat_weights(self.triangle, self.pixel % self.width, self.pixel // self.width)
        self.to_sides = self._distances(flat)
        weights = [flat[k] * self.corners[self.triangle, k, 2] for k in range(3)]  # along the face, not along the picture
        total = sum(weights)
        self.weights = [weight / total for weight in weights]

    def flat_weights(self, triangle, i, j):
        """Barycentric coordinates of the pixels' middles on the picture: three arrays."""
        start, slopes = self.corners[:, 0, :2], self.slopes
        x, y = (i + np.float32(0.5)) - start[triangle, 0], (j + np.float32(0.5)) - start[triangle, 1]
        second, third = (slopes[triangle, k, 0] * x + slopes[triangle, k, 1] * y for k in range(2))
        return 1 - second - third, second, third

    def _distances(self, weights):
        """[pixels] from each covered pixel to the sides 01, 12, 20 of its triangle."""
        xy = self.corners[:, :, :2]
        lengths = np.linalg.norm(np.roll(xy, -1, axis=1) - xy, axis=2)
        heights = (self.area[:, None] / np.maximum(lengths, 1e-9)).astype(np.float32)
        return [weights[(side + 2) % 3] * heights[self.triangle, side] for side in range(3)]

    def lines(self, sides, part):
        """Darkness of the covered pixels: edges of the model, outlines of its parts, and edges of cells where the mesh
        is coarse enough. sides: see outer_surface; part (triangle): 1, 2, ..."""
        dark = np.zeros(len(self.pixel), np.float32)
        size = np.sqrt(np.maximum(self.area, 0))[self.triangle] / FINER  # of a triangle, in pixels of the image
        strength = 0.32 * np.clip((size - 5) / 12, 0, 1)
        for kind, half, strong in ((1, 0.45 * FINER, strength), (2, 0.8 * FINER, 0.75)):
            for side, distance in enumerate(self.to_sides):
                here = (sides[:, side] == kind)[self.triangle]
                np.maximum(dark, here * strong * np.clip(half + 0.5 - distance, 0, 1), out=dark)
        parts = np.zeros((self.height + 2, self.width + 2), int)
        rows, columns = self.pixel // self.width + 1, self.pixel % self.width + 1
        parts[rows, columns] = here = part[self.triangle]
        neighbours = [parts[rows + i, columns + j] for i, j in ((1, 0), (-1, 0), (0, 1), (0, -1))]
        dark[np.min(neighbours, axis=0) < here] = 0.75
        return dark

    def values(self, corner_values):
        """(triangle, 3) values at the corners, interpolated in the covered pixels."""
        corner_values = corner_values.astype(np.float32)
        return sum(weight * corner_values[self.triangle, k] for k, weight in enumerate(self.weights))

    def level_lines(self, values, low, high, count):
        """Covered pixels at which one of `count` bands of equal width between low and high begins; pixels whose value is
        not a number have none."""
        band = np.full((self.height, self.width), -1, np.int16)
        of_pixel = np.floor((values - low) / (high - low) * count).clip(0, count - 1)
        band.reshape(-1)[self.pixel] = np.where(np.isnan(values), -1, of_pixel)
        line = np.zeros_like(band, bool)
        for here, there in ((np.s_[:, :-1], np.s_[:, 1:]), (np.s_[:-1], np.s_[1:])):
            changes = (band[here] != band[there]) & (band[here] >= 0) & (band[there] >= 0)
            line[here] |= changes
            line[there] |= changes
        return line.reshape(-1)[self.pixel]

    def image(self, colours):
        """(height, width, 4) image, 0 to 255, of the colours (pixel, 3) of the covered pixels, clear elsewhere."""
        full = np.zeros((self.height, self.width, 4), np.float32)
        flat = full.reshape(-1, 4)
        flat[self.pixel, :3], flat[self.pixel, 3] = colours, 1.0
        small = sum(full[i::FINER, j::FINER] for i in range(FINER) for j in range(FINER))
        small[..., :3] *= 255 / np.maximum(small[..., 3:], 1)
        small[..., 3] *= 255 / FINER**2
        return small.round().astype(np.uint8)


def shaded(colours, light, white, dark):
    """Colours (pixel, 3) in the light, with white level lines and dark mesh lines of given strength over them."""
    colours = colours * light[:, None]
    for ink, strength in ((1, white), (LINE, dark)):
        drawn = np.flatnonzero(strength)
        colours[drawn] += (ink - colours[drawn]) * strength[drawn, None]
    return colours
