"""Draws a field in space, with the bodies: a perspective picture of the outer surface, and two upright sections."""

import numpy as np
from matplotlib.cm import ScalarMappable
from matplotlib.collections import LineCollection
from matplotlib.colors import Normalize, to_rgb
from matplotlib.patches import PathPatch
from matplotlib.path import Path
from matplotlib.tri import Triangulation

import report_pictures as pictures
from report_space import Section, normals, outer_surface
from report_space_bodies import clipped, section_loops
from report_view import Buffer, View, shaded

plt = pictures.plt
STYLE = {**pictures.STYLE, "axes.grid": False, "contour.negative_linestyle": "solid"}
RESOLUTION = 160  # pixels of the perspective picture per inch
NARROW = 1 / 12  # a section narrower than this part of the other one is left out
BODY_SHADE = 0.65  # brightness of a body where the lamp does not reach
IN_FRONT = 1 + 1e-4  # times the nearness of bodies: they are seen where soil is at the same place
LEVELS = 12  # bands between level lines, as in the sections
HEIGHT, WIDTH = 4.3, 5.0  # [inch] that the perspective picture may take, and the sections together
SKY, HIGH_SKY = 0.25, 0.75  # of the model's longest side: bodies end there above the soil, if they are higher than that
LABELS = 0.58  # [inch] around the perspective picture for the numbers on its axes


class SpaceModel:
    """What stays the same in all pictures of a mesh: surface, sections, direction of view.

    Each section goes through the middle of the first body (without bodies: of the model), or is a flat side of the
    model, where the soil moves more there (at least a quarter more than in the middle): a plane of symmetry cuts
    through what happens. A flat side at x = 0 or y = 0 that the body reaches is preferred when it is as good. The
    viewer stands on the side of the section, else at small x and y, and sees a flat side that is a section from nearer
    its front.
    """

    def __init__(self, result, step):
        mesh = result.mesh_in_space(step)
        self.surface = outer_surface(mesh)
        moved = np.linalg.norm(result.coordinates(step) - mesh.points, axis=1)
        self.sections, weight = [], [-1.0, -1.0]
        extent = np.ptp(mesh.points, axis=0)
        spans = spans_of_body(mesh, result.bodies_in_space(step))
        for axis in (1, 0):
            section, side = choose_section(mesh, self.surface, moved, axis, spans[axis])
            if section is not None and extent[1 - axis] > NARROW * extent[axis]:
                self.sections.append(section)
            longer = (extent[1 - axis], axis) > (extent[axis], 1 - axis)
            across = 1.2 if longer else 1.0  # the longer side, rather from its front
            weight[axis] = (side or -1.0) * (1.6 if side else 1.0) * across
        self.towards = weight


def spans_of_body(mesh, bodies):
    """(axis, 2): from where to where the first body goes; along axes where its middle is not in the model, the model."""
    spans = np.column_stack([mesh.points.min(axis=0), mesh.points.max(axis=0)])
    for points, _ in list(bodies.values())[:1]:
        body = np.column_stack([points.min(axis=0), points.max(axis=0)])
        middle, tolerance = body.mean(axis=1), 1e-6 * np.ptp(spans)
        inside = (middle > spans[:, 0] + tolerance) & (middle < spans[:, 1] - tolerance)
        spans = np.where(inside[:, None], body, spans)
    return spans


def choose_section(mesh, surface, moved, axis, span):
    """(section, -1 or 1 where it is the lower or upper flat side, 0 in the middle) across x (axis 0) or y (axis 1).
    span: of the body or the model, see spans_of_body."""
    coordinate = mesh.points[:, axis]
    low, high = coordinate.min(), coordinate.max()
    size = max(abs(low), abs(high), high - low)
    places = [(at, side) for at, side in ((low, -1), (high, 1)) if is_flat(mesh, surface, axis, at)]
    at_zero = [place for place in places if abs(place[0]) < 1e-9 * size and span[0] <= place[0] <= span[1]]
    places = at_zero + [((span[0] + span[1]) / 2, 0)] + [place for place in places if place not in at_zero]
    sections = [(Section(mesh, axis, at), side) for at, side in places]
    sections = [(section, side) for section, side in sections if len(section.triangles)]
    peaks = [section.at_places(moved).max() for section, _ in sections]
    for section, peak in zip(sections, peaks):
        if peak >= 0.8 * max(peaks):
            return section
    return None, 0


def is_flat(mesh, surface, axis, at):
    """Whether outer faces lie in the plane."""
    coordinate = mesh.points[:, axis]
    on_plane = np.abs(surface.at_places(coordinate) - at) < 1e-9 * max(np.ptp(coordinate), 1e-300)
    return bool(on_plane[surface.triangles].all(axis=1).any())


class SpacePicture:
    """Draws fields of one step. The mesh is the deformed one, to scale."""

    def __init__(self, result, step, model):
        self.result, self.step, self.model = result, step, model
        points = result.coordinates(step)
        self.points = model.surface.at_places(points)
        self.view = View(self.points.min(axis=0), self.points.max(axis=0), model.towards)
        self.bodies = list(result.bodies_in_space(step).values())
        self.low, self.high = self.body_box()
        self.panels = [Panel(section, points, self.bodies, self.low, self.high) for section in model.sections]
        self._look()

    def body_box(self):
        """(low, high) of the box in which bodies are drawn: that of the soil, and some air."""
        low, high = self.view.low.copy(), self.view.high.copy()
        size = (high - low).max()
        above = max([points[:, 2].max() - high[2] for points, _ in self.bodies], default=0.0)
        high[2] += SKY * size if above > HIGH_SKY * size else max(above, 0.0) + 0.02 * size
        return low, high

    def _look(self):
        """The pixels of the perspective picture and what is drawn over the colours of every field."""
        points, triangles, sides, part = self.with_bodies()
        projected = self.view.project(points)
        projected[len(self.points) :, 2] *= IN_FRONT
        drawn = np.vstack([projected[:, :2], self.view.project(axis_lines(self.view).reshape(-1, 3))[:, :2]])
        low, high = drawn.min(axis=0), drawn.max(axis=0)
        margin = 0.01 * (high - low).max()
        self.window = [low[0] - margin, high[0] + margin, low[1] - margin, high[1] + margin]
        size = high - low + 2 * margin
        self.size = size * min(WIDTH / size[0], HEIGHT / size[1])
        width, height = np.ceil(self.size * RESOLUTION).astype(int)
        self.buffer = Buffer(projected, triangles, self.window, width, height)
        turned = normals(points, triangles)
        light = np.where(part == 1, self.view.light(turned), self.view.light(turned, BODY_SHADE)).astype(np.float32)
        self.light, self.dark = light[self.buffer.triangle], self.buffer.lines(sides, part)
        self.count = len(triangles)

    def with_bodies(self):
        """(points, triangles, sides, part): the outer surface, part 1, and after it what is drawn of the bodies."""
        surface = self.model.surface
        points, sides = [self.points], [surface.sides]
        part = [np.full(len(surface.triangles), 1)]
        for number, (places, triangles) in enumerate(self.bodies, 2):
            corners, lines = clipped(places, triangles, self.low, self.high)
            points.append(corners.reshape(-1, 3))
            sides.append(lines)
            part.append(np.full(len(lines), number))
        points, part = np.concatenate(points), np.concatenate(part)
        of_bodies = np.arange(len(self.points), len(points)).reshape(-1, 3)
        return points, np.vstack([surface.triangles, of_bodies]), np.concatenate(sides), part

    @staticmethod
    def sample(field):
        """(values, weights) of what is shown."""
        return field.values, np.ones(len(field.values))

    def figure(self, field, limits=None):
        """limits: (lowest, highest) in the field's unit."""
        factor, unit, low, high = pictures.colour_range(field, limits)
        values = field.values * factor
        with plt.rc_context(STYLE):
            boxes = self.section_boxes()
            left = self.size[0] + 2 * LABELS + 0.35
            right = max([x + w for x, _, w, _ in boxes], default=0.0) + (left if boxes else left - 0.9)
            # the two columns stand side by side, their middles at one height
            tallest = max([self.size[1] + LABELS] + [y + h + 0.3 for _, y, _, h in boxes])
            total = np.array([right + 1.15, tallest + 0.5])
            figure = plt.figure(figsize=total)

            def axes_at(x, y, w, h):
                return figure.add_axes([x / total[0], y / total[1], w / total[0], h / total[1]])

            shift = (tallest - self.size[1] - LABELS) / 2
            self.draw_surface(axes_at(LABELS, LABELS + shift, *self.size), field, values, low, high)
            up = (tallest - max([y + h for _, y, _, h in boxes], default=0.0) - 0.25) / 2
            for panel, (x, y, w, h) in zip(self.panels, boxes):
                panel.draw(axes_at(left + x, y + up, w, h), field, values, low, high)
            bar_height = min(tallest - 0.5, 3.8)
            bar_axes = axes_at(right + 0.25, (tallest - bar_height) / 2, 0.15, bar_height)
            colours = ScalarMappable(Normalize(low, high), pictures.colour_map(low, high))
            bar = figure.colorbar(colours, cax=bar_axes, extend=pictures.beyond(values, low, high))
            bar.set_label(f"{field.name} [{unit}]")
            bar.outline.set_visible(False)
            bar.ax.yaxis.set_major_locator(pictures.ticks(7))
            bar.formatter.set_useMathText(True)
            title = f"{field.name} [{unit}]   t = {pictures.nice_time(self.result.times[self.step])}   "
            title += self.result.stages[self.step]
            figure.text(0.012, 1 - 0.1 / total[1], title, ha="left", va="top", fontsize=10.5, fontweight="bold")
            return figure

    def section_boxes(self):
        """[(x, y, width, height)] of the sections in inches: one over the other or side by side, whichever is larger."""
        sizes = [np.maximum(panel.high - panel.low, 1e-300) for panel in self.panels]
        if not sizes:
            return []
        gap = np.array([0.75, 0.85])  # for numbers and titles
        wide, tall = (np.array([s[i] for s in sizes]) for i in (0, 1))
        stacked = min(WIDTH / wide.max(), (HEIGHT - gap[1] * (len(sizes) - 1)) / tall.sum())
        beside = min((WIDTH - gap[0] * (len(sizes) - 1)) / wide.sum(), HEIGHT / tall.max())
        scale = max(stacked, beside)
        boxes, x, y = [], 0.0, 0.45
        for w, h in zip(wide * scale, tall * scale):
            boxes.append([x, y, w, h])
            if beside > stacked:
                x += w + gap[0]
            else:
                y += h + gap[1]
        if beside <= stacked:  # the first one on top
            for box, height in zip(boxes, [y - gap[1] - boxes[0][3], 0.45]):
                box[1] = height
        return boxes

    def draw_surface(self, axes, field, values, low, high):
        surface, buffer = self.model.surface, self.buffer
        of_corners = np.full((self.count, 3), np.nan)  # bodies have no values
        if field.by_cell:
            of_corners[: len(surface.cells)] = values[surface.cells][:, None]
            of_pixels, white = of_corners[buffer.triangle, 0], np.zeros(len(buffer.pixel), np.float32)
        else:
            of_corners[: len(surface.cells)] = surface.at_places(values)[surface.triangles]
            of_pixels = buffer.values(of_corners)
            white = 0.5 * buffer.level_lines(of_pixels, low, high, LEVELS).astype(np.float32)
        table = plt.get_cmap(pictures.colour_map(low, high))(np.linspace(0, 1, 256))[:, :3]
        table = np.vstack([table, to_rgb(pictures.BODY["facecolor"])]).astype(np.float32)
        number = ((of_pixels - low) / (high - low) * 255).round().clip(0, 255)
        number = np.nan_to_num(number, nan=256).astype(int)
        image = buffer.image(shaded(table[number], self.light, white, self.dark))
        axes.imshow(image, extent=self.window, zorder=2)
        axes.set_xlim(self.window[:2])
        axes.set_ylim(self.window[2:])
        axes.axis("off")
        draw_axes(axes, self.view, self.window, self.size[0])


def axis_lines(view):
    """(axis, end, 3): three edges of the box around the model, on the outline of the box."""
    low, high = view.low, view.high
    near = np.where(view.eye > 0, high, low)
    far = low + high - near
    upright = min([(near[0], far[1]), (far[0], near[1])], key=lambda xy: view.project([*xy, low[2]])[0])
    starts = np.array([[low[0], near[1], low[2]], [near[0], low[1], low[2]], [*upright, low[2]]])
    ends = starts.copy()
    np.fill_diagonal(ends, high)
    return np.stack([starts, ends], axis=1)


def draw_axes(axes, view, window, inches):
    """Axes in metres beside the model."""
    metre = (window[1] - window[0]) / inches / 72  # of the picture in a point
    middle = view.project(view.middle)[:2]
    style = {"color": "#555555", "linewidth": 0.8, "clip_on": False, "zorder": 1, "solid_capstyle": "round"}
    for axis, line in enumerate(axis_lines(view)):
        a, b = view.project(line)[:, :2]
        along = (b - a) / max(np.hypot(*(b - a)), 1e-300)
        out = np.array([-along[1], along[0]])
        out *= np.sign(out @ ((a + b) / 2 - middle)) or 1.0
        axes.plot(*np.array([a, b]).T, **style)
        longest = 0
        for value in marks(view.low[axis], view.high[axis], np.hypot(*(b - a)) / metre):
            place = line[0].copy()
            place[axis] = value
            place = view.project(place)[:2]
            axes.plot(*np.array([place, place + 4 * metre * out]).T, **style)
            label = f"{value:.8g}".replace("-", "\N{MINUS SIGN}")
            longest = max(longest, len(label))
            write(axes, label, place, out * (12 + 2.4 * max(len(label) - 3, 0) * abs(out[0])))
        write(axes, f"{'xyz'[axis]} [m]", (a + b) / 2, out * (31 + 5 * max(longest - 3, 0) * abs(out[0])))


def marks(low, high, points):
    """Round numbers for an axis that is so many points long."""
    values = pictures.ticks(max(1, int(points / 42))).tick_values(low, high)
    tolerance = 1e-6 * (high - low)
    values = [value for value in values if low - tolerance <= value <= high + tolerance]
    return values if points > 14 * len(values) else values[-1:]


def write(axes, text, place, offset):
    """offset in points"""
    axes.annotate(
        text, place, offset, textcoords="offset points", ha="center", va="center", fontsize=9, annotation_clip=False
    )


class Panel:
    """A section in the soil's current position, with those of the bodies in the plane of the section at the start."""

    def __init__(self, section, points, bodies, low, high):
        """low, high: of the box in which bodies are drawn."""
        self.section = section
        shown = [1 - section.axis, 2]
        self.places = section.at_places(points)[:, shown]
        self.low, self.high = self.places.min(axis=0), self.places.max(axis=0)
        at, axis = section.at, section.axis
        plane = (axis, at, 1 if at - low[axis] < high[axis] - at else -1)
        self.loops = []
        for body in bodies:
            for loop in section_loops(*body, plane, np.linalg.norm(high - low)):
                loop = loop[:, shown]
                inside = loop.clip(low[shown], high[shown])
                if (np.ptp(inside, axis=0) > 0).all():
                    self.loops.append(loop)
                    self.low = np.minimum(self.low, inside.min(axis=0))
                    self.high = np.maximum(self.high, inside.max(axis=0))
                    if self.high[1] > self.places[:, 1].max():
                        self.high[1] = high[2]

    def draw(self, axes, field, values, low, high):
        section, places = self.section, self.places
        mesh = Triangulation(places[:, 0], places[:, 1], section.triangles)
        shown = values[section.cells] if field.by_cell else section.at_places(values)
        pictures.paint(axes, mesh, shown, field.by_cell, low, high)
        inches = axes.figure.get_size_inches() * axes.get_position().size
        cells = max(len(np.unique(section.cells)), 1)
        if np.sqrt(inches.prod() / cells) > 0.07:  # finer mesh lines would only darken the picture
            axes.add_collection(LineCollection(places[section.edges], colors="black", linewidths=0.35, alpha=0.28))
        axes.add_collection(
            LineCollection(places[section.outline], colors="#3c4043", linewidths=0.8, capstyle="round", clip_on=False)
        )
        self.draw_bodies(axes)
        axes.set_aspect("equal")
        axes.set_xlim(self.low[0], self.high[0])
        axes.set_ylim(self.low[1], self.high[1])
        axes.ticklabel_format(style="plain", useOffset=False)
        axes.set_xlabel(f"{'yx'[section.axis]} [m]")
        axes.set_ylabel("z [m]")
        axes.xaxis.set_major_locator(pictures.ticks(max(1, min(5, int(inches[0] / 0.45)))))
        axes.yaxis.set_major_locator(pictures.ticks(max(1, min(6, int(inches[1] / 0.35)))))
        at = 0.0 if abs(section.at) < 1e-9 * np.abs(places).max() else section.at
        axes.apply_aspect()
        width = axes.figure.get_size_inches()[0] * axes.get_position().width
        title = f"{'section at ' if width > 1.4 else ''}{'xy'[section.axis]} = {at:.5g} m"
        axes.set_title(title, fontsize=9, fontweight="normal", loc="left")

    def draw_bodies(self, axes):
        if not self.loops:
            return
        path = Path.make_compound_path(*(Path(loop, closed=True) for loop in self.loops))
        style = pictures.BODY
        # outlines first, so that those inside a body of several pieces are covered
        axes.add_patch(PathPatch(path, zorder=5, **{**style, "linewidth": 2 * style["linewidth"]}))
        axes.add_patch(PathPatch(path, zorder=5, facecolor=style["facecolor"], edgecolor="none"))
