"""Draws histories and fields with matplotlib."""

import numpy as np
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
from matplotlib.collections import LineCollection  # noqa: E402
from matplotlib.patches import Polygon, Rectangle  # noqa: E402
from matplotlib.ticker import MaxNLocator  # noqa: E402
from matplotlib.tri import Triangulation  # noqa: E402

from report_result import scaled, time_unit  # noqa: E402

STYLE = {
    "font.family": "DejaVu Sans",
    "font.size": 9,
    "axes.titlesize": 10,
    "axes.titleweight": "bold",
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.edgecolor": "#555555",
    "axes.linewidth": 0.8,
    "axes.grid": True,
    "grid.color": "#e3e3e3",
    "grid.linewidth": 0.7,
    "axes.axisbelow": True,
    "xtick.color": "#333333",
    "ytick.color": "#333333",
    "legend.frameon": False,
    "lines.linewidth": 1.5,
    # six colours; further curves have them again, dashed and then dotted
    "axes.prop_cycle": matplotlib.cycler(linestyle=["-", "--", ":"])
    * matplotlib.cycler(color=["#0b5d8a", "#d1622b", "#3a8f5c", "#8a4f9e", "#b8902a", "#5c5c5c"]),
    "svg.fonttype": "path",
    "svg.hashsalt": "mudline",
    "figure.dpi": 100,
}
BODY = {"facecolor": "#9aa0a6", "edgecolor": "#3c4043", "linewidth": 1.2, "joinstyle": "round"}
COLOUR_MAP, DIVERGING = "viridis", "RdBu_r"
TWO_SIGNS = 0.05  # share of the largest magnitude that the smaller sign needs for colours around zero
MAX_POINTS = 1000


def ticks(count):
    return MaxNLocator(count, steps=[1, 2, 2.5, 5, 10])


def common_words(names):
    """What all curves of an axes are: "force" of "force y" and "tip force y"."""
    shared = set.intersection(*(set(name.split()) for name in names))
    return " ".join(word for word in names[0].split() if word in shared and len(word) > 1)


def thinned(x, y):
    """At most MAX_POINTS points that keep every peak: the extremes of equal pieces."""
    if len(x) <= MAX_POINTS:
        return x, y
    keep = {0, len(x) - 1}
    for piece in np.array_split(np.arange(len(x)), MAX_POINTS // 2):
        keep.update((piece[np.argmin(y[piece])], piece[np.argmax(y[piece])]))
    order = sorted(keep)
    return x[order], y[order]


def stage_rows(spans, time):
    """[(stage, start, rows)]: the rows of each stage of the run, the first row of all in the first stage."""
    parts = []
    for i, (stage, first, last, _) in enumerate(spans):
        start = spans[i - 1][2] if i else min(first, time[0])
        end = last if i + 1 < len(spans) else np.inf
        # The row at the start belongs to the stage before; it is drawn in both, so that curves join.
        rows = np.flatnonzero((time >= start) & (time <= end))
        if len(rows) > 1:
            parts.append((stage, start, rows))
    return parts


def need_panels(parts, time):
    """True when stages differ so much in length (milliseconds, years) that one time axis cannot show them all."""
    lengths = [np.ptp(time[rows]) for _, _, rows in parts]
    return len(lengths) > 1 and max(lengths) > 100 * min(lengths)


def spread_over_decades(since):
    steps = np.diff(since)
    steps = steps[steps > 0]
    return len(steps) > 3 and steps.max() > 1000 * steps.min()


def mark_stages(axes, parts, factor):
    """A dashed line where a stage begins and its name above its part of the time axis."""
    low, high = axes.get_xlim()
    for i, (stage, start, _) in enumerate(parts):
        end = parts[i + 1][1] * factor if i + 1 < len(parts) else high
        left = max(start * factor, low)
        if i:
            axes.axvline(left, color="#b0b0b0", linewidth=0.8, linestyle=(0, (4, 3)), zorder=0.5)
        if end - left > 0.08 * (high - low):
            middle = ((left + end) / 2 - low) / (high - low)
            axes.text(
                middle, 1.015, stage, transform=axes.transAxes, ha="center", va="bottom", fontsize=7.5, color="#777777"
            )


def split_errors(curves):
    """(curves, {name: error}): a curve "<name> error" beside "<name>" is the estimated error of that."""
    errors = {name: curves[f"{name} error"] for name in curves if f"{name} error" in curves}
    return {name: values for name, values in curves.items() if name.removesuffix(" error") not in errors or name in errors}, errors


def shade_error(axes, along, x, y, error):
    """The band of the estimated error about the curve drawn last; along: "x" or "y", whichever has the error."""
    fill, base, middle = (axes.fill_betweenx, y, x) if along == "x" else (axes.fill_between, x, y)
    fill(base, middle - error, middle + error, color=axes.lines[-1].get_color(), alpha=0.22, linewidth=0)


def draw_curves(axes, since, curves, rows, factor, decades=False):
    """The curves over a time that belongs to `rows`, with the bands of their errors; returns the factor of the time axis."""
    time_factor, unit = (1.0, "s") if decades or not len(since) else time_unit(since.max())
    curves, errors = split_errors(curves)
    for name, values in curves.items():
        axes.plot(*thinned(since * time_factor, values[rows] * factor), label=name, solid_joinstyle="round")
        if name in errors:
            shade_error(axes, "y", since * time_factor, values[rows] * factor, errors[name][rows] * factor)
    axes.margins(x=0.01)
    axes.xaxis.set_major_locator(ticks(6))
    axes.yaxis.set_major_locator(ticks(6))
    axes.set_xlabel(f"time [{unit}]")
    axes.ticklabel_format(axis="y", style="sci", scilimits=(-3, 4), useMathText=True)
    return time_factor


def label_curves(axes, curves, unit):
    curves, _ = split_errors(curves)
    if len(curves) == 1:
        axes.set_ylabel(f"{next(iter(curves))} [{unit}]")
    else:
        axes.set_ylabel(f"{common_words(list(curves))} [{unit}]".lstrip())
        axes.legend(fontsize=8, loc="best", handlelength=1.4)


def readable(unit, curves):
    finite = [np.abs(v[np.isfinite(v)]).max() for v in curves.values() if np.isfinite(v).any()]
    return scaled(unit, max(finite, default=0.0))


def history_figure(units, time, spans):
    """The curves of one group, by unit: one axes each, or one per stage where the stages' lengths differ too much."""
    parts = stage_rows(spans, time)
    with plt.rc_context(STYLE):
        return staged_figure(units, time, parts) if need_panels(parts, time) else plain_figure(units, time, parts)


def plain_figure(units, time, parts):
    columns = 1 if len(units) == 1 else 2
    rows = -(-len(units) // columns)
    size = (4.9 * columns, 2.75 * rows)
    figure, grid = plt.subplots(rows, columns, figsize=size, squeeze=False, layout="constrained")
    for axes, (unit, curves) in zip(grid.flat, units.items()):
        factor, shown_unit = readable(unit, curves)
        time_factor = draw_curves(axes, time, curves, slice(None), factor)
        label_curves(axes, curves, shown_unit)
        if len(parts) > 1:
            mark_stages(axes, parts, time_factor)
    for axes in list(grid.flat)[len(units) :]:
        axes.set_visible(False)
    return figure


def staged_figure(units, time, parts):
    size = (max(6.0, 2.9 * len(parts) + 0.6), 2.5 * len(units) + 0.3)
    figure, grid = plt.subplots(len(units), len(parts), figsize=size, squeeze=False, layout="constrained", sharey="row")
    for line, (unit, curves) in zip(grid, units.items()):
        factor, shown_unit = readable(unit, curves)
        for axes, (stage, start, rows) in zip(line, parts):
            since = time[rows] - start
            if spread_over_decades(since):
                later = since > 0
                rows, since = rows[later], since[later]
                draw_curves(axes, since, curves, rows, factor, decades=True)
                axes.set_xscale("log")
            else:
                draw_curves(axes, since, curves, rows, factor)
            if axes in grid[0]:
                axes.set_title(stage, fontsize=9)
            if axes not in grid[-1]:
                axes.set_xlabel("")
        label_curves(line[0], curves, shown_unit)
    for axes in grid[-1]:
        axes.set_xlabel(axes.get_xlabel().replace("time", "time in stage"))
    return figure


def colour_range(field, limits):
    """(factor, unit, lowest, highest) of the colour bar; limits: (lowest, highest) in the field's unit, or None. The
    bar is as long on both sides of zero where the values have both signs."""
    largest = np.abs(field.values).max() if limits is None else max(abs(limits[0]), abs(limits[1]))
    factor, unit = scaled(field.unit, largest)
    values = field.values * factor
    low, high = (values.min(), values.max()) if limits is None else (limits[0] * factor, limits[1] * factor)
    if high - low <= 1e-12 * max(abs(high), abs(low), 1e-300):
        return factor, unit, low - (0.01 * abs(low) or 1.0), high + (0.01 * abs(high) or 1.0)
    if low < 0 < high and min(-low, high) > TWO_SIGNS * max(-low, high):
        low, high = -max(-low, high), max(-low, high)
    return factor, unit, low, high


def common_limits(fields, samples):
    """(lowest, highest) for the colours of a field at several times: all values, or, where a few far ones would leave one
    colour for the rest, those of the middle 98 in 100 of the area at each time. samples: (values, areas) of what is seen."""
    low, high = min(field.values.min() for field in fields), max(field.values.max() for field in fields)
    middle = [middle_values(values, areas) for values, areas in samples]
    middle_low, middle_high = min(m[0] for m in middle), max(m[1] for m in middle)
    return (middle_low, middle_high) if 0 < middle_high - middle_low < 0.6 * (high - low) else (low, high)


def middle_values(values, areas):
    order = np.argsort(values)
    share = np.cumsum(areas[order]) / areas.sum()
    return values[order][np.searchsorted(share, (0.01, 0.99)).clip(max=len(values) - 1)]


def beyond(values, low, high):
    """Which ends of a colour bar have values beyond them, as matplotlib calls it."""
    tolerance = 1e-9 * (high - low)
    ends = (values.min() < low - tolerance, values.max() > high + tolerance)
    return {(False, False): "neither", (True, False): "min", (False, True): "max", (True, True): "both"}[ends]


def colour_map(low, high):
    """White at zero where the colour bar is as long on both sides of it."""
    return DIVERGING if low < 0 and low == -high else COLOUR_MAP


def paint(axes, mesh, values, by_triangle, low, high):
    """Colours triangles by their own values, or smoothly, with level lines, by those of the points."""
    if by_triangle:
        return axes.tripcolor(
            mesh,
            facecolors=values,
            cmap=colour_map(low, high),
            vmin=low,
            vmax=high,
            edgecolors="face",
            linewidth=0.4,
            antialiased=False,  # else the background shines through between the triangles
            rasterized=True,
        )
    drawn = axes.tripcolor(mesh, values, cmap=colour_map(low, high), vmin=low, vmax=high, shading="gouraud", rasterized=True)
    levels = np.linspace(low, high, 13)[1:-1]
    if np.any((levels > values.min()) & (levels < values.max())):
        colour = "white" if colour_map(low, high) == COLOUR_MAP else "black"
        axes.tricontour(mesh, values, levels=levels, colors=colour, linewidths=0.5, alpha=0.55, linestyles="solid")
    return drawn


def extent(contours):
    """Lowest and highest coordinates of all bodies."""
    points = np.vstack(list(contours.values()))
    return points.min(axis=0), points.max(axis=0)


def zoom_window(contours, bounds, half):
    """The neighbourhood of the bodies' lowest part, or None when it would show nearly everything."""
    if not contours:
        return None
    low, high = extent(contours)
    x_min, x_max, y_min, y_max = bounds
    # `half`: only one half of the body is drawn.
    size = 1.8 * max((high - low)[0] * (2 if half else 1), 1e-3 * (x_max - x_min))
    window = [max(x_min, low[0] - size), min(x_max, high[0] + size), max(y_min, low[1] - size), low[1] + size]
    # The surface and the body's lower part are what matters; the sky above is not.
    window[3] = min(window[3], max(y_max, low[1]) + 0.35 * size)
    # As wide as high, where the mesh reaches that far.
    window[1] = min(x_max, max(window[1], window[0] + window[3] - window[2]))
    if (window[1] - window[0]) * (window[3] - window[2]) > 0.5 * (x_max - x_min) * (y_max - y_min):
        return None
    return window


def body_window(contours, bounds, zoom):
    """What shows the bodies wholly, where they are much larger than the zoom and much smaller than the mesh; else None."""
    if not contours or not zoom:
        return None
    low, high = extent(contours)
    length = (high - low)[1]
    x_min, x_max, y_min, y_max = bounds
    if length < 1.5 * (zoom[3] - zoom[2]) or length > 0.3 * (y_max - y_min):
        return None
    return [max(x_min, low[0] - 0.3 * length), min(x_max, high[0] + 0.6 * length), max(y_min, low[1] - 0.3 * length),
            high[1] + 0.2 * length]


class FieldPicture:
    """Draws one field of one step: the whole mesh and, where a body acts, its neighbourhood."""

    def __init__(self, result, step, mirror, zoom=None):
        """zoom: window or None for an automatic one, [] for none."""
        self.result, self.step, self.zoom = result, step, zoom
        self.points = result.coordinates(step)
        cells = result.cells(step)
        self.triangles, self.cells, self.edges, self.boundary = (
            cells.triangles, cells.triangle_cells, cells.edges, cells.boundary)
        self.contours = dict(result.bodies(step))
        self.mirrored = mirror and result.axisymmetric
        self.count = len(self.points)
        if self.mirrored:
            self.points = np.vstack([self.points, self.points * [-1, 1]])
            self.triangles = np.vstack([self.triangles, self.triangles[:, ::-1] + self.count])
            self.cells = np.concatenate([self.cells, self.cells])
            self.edges = np.vstack([self.edges, self.edges + self.count])
            self.boundary = np.vstack([self.boundary, self.boundary + self.count])
            on_axis = np.abs(self.points[self.boundary][:, :, 0]).max(axis=1) < 1e-9 * np.ptp(self.points[:, 0])
            self.boundary = self.boundary[~on_axis]
            self.contours = {name: np.vstack([c, (c * [-1, 1])[::-1]]) for name, c in self.contours.items()}
        self.mesh = Triangulation(self.points[:, 0], self.points[:, 1], self.triangles)
        low, high = self.points.min(axis=0), self.points.max(axis=0)
        self.bounds = [low[0], high[0], low[1], high[1]]

    def window(self):
        """The second panel; None: there is none."""
        if self.zoom is None:
            return zoom_window(self.contours, self.bounds, self.result.axisymmetric and not self.mirrored)
        return self.zoom or None

    def sample(self, field):
        """(values, areas) of the triangles in the panel that shows most."""
        corners = self.points[self.triangles]
        sides = corners[:, 1:] - corners[:, :1]
        areas = np.abs(sides[:, 0, 0] * sides[:, 1, 1] - sides[:, 0, 1] * sides[:, 1, 0])
        values = field.values[self.cells] if field.by_cell else field.values[self.triangles % self.count].mean(axis=1)
        x_min, x_max, y_min, y_max = self.window() or self.bounds
        x, y = corners.mean(axis=1).T
        inside = (x >= x_min) & (x <= x_max) & (y >= y_min) & (y <= y_max)
        return (values[inside], areas[inside]) if inside.any() else (values, areas)

    def figure(self, field, limits=None):
        """limits: (lowest, highest) in the field's unit."""
        factor, unit, low, high = colour_range(field, limits)
        values = field.values * factor
        window = self.window()

        with plt.rc_context({**STYLE, "axes.grid": False}):
            whole = body_window(self.contours, self.bounds, window) or self.sky()
            panels = [whole] + ([window] if window else [])
            height = 4.3
            widths = [np.clip(height * (p[1] - p[0]) / (p[3] - p[2]), 1.4, 6.5) for p in panels]
            if window:
                widths[0] *= 0.7  # the overview shows where, the window shows what
            figure, grid = plt.subplots(
                1,
                len(panels),
                squeeze=False,
                layout="constrained",
                figsize=(sum(widths) + 1.5 + 0.6 * len(panels), height + 0.95),
                gridspec_kw={"width_ratios": widths},
            )
            for axes, panel in zip(grid[0], panels):
                drawn = self.draw(axes, field, values, low, high, panel, detailed=panel is window or not window)
            if window:
                grid[0][0].add_patch(
                    Rectangle(
                        (window[0], window[2]),
                        window[1] - window[0],
                        window[3] - window[2],
                        fill=False,
                        edgecolor="#d1622b",
                        linewidth=1.1,
                        zorder=6,
                    )
                )
                grid[0][0].set_anchor("NW")
                for side in grid[0][1].spines.values():
                    side.set(visible=True, color="#d1622b", linewidth=1.1)
            bar = figure.colorbar(drawn, ax=list(grid[0]), shrink=0.92, pad=0.02, aspect=28, extend=beyond(values, low, high))
            bar.set_label(f"{field.name} [{unit}]")
            bar.outline.set_visible(False)
            bar.ax.yaxis.set_major_locator(ticks(7))
            figure.suptitle(
                f"{field.name}   t = {nice_time(self.result.times[self.step])}   " f"{self.result.stages[self.step]}",
                fontsize=10.5,
                x=0.012,
                ha="left",
                fontweight="bold",
            )
            return figure

    def sky(self):
        """The whole mesh, and as much of the bodies above it as fits well."""
        x_min, x_max, y_min, y_max = self.bounds
        top = max([c[:, 1].max() for c in self.contours.values()], default=y_max)
        margin = 0.02 * max(x_max - x_min, y_max - y_min)
        return [
            x_min - margin,
            x_max + margin,
            y_min - margin,
            min(max(top, y_max), y_max + 0.25 * (y_max - y_min)) + margin,
        ]

    def draw(self, axes, field, values, low, high, panel, detailed):
        if field.by_cell:
            shown = values[self.cells]
        else:
            shown = np.concatenate([values, values]) if self.mirrored else values
        drawn = paint(axes, self.mesh, shown, field.by_cell, low, high)
        if detailed:
            axes.add_collection(LineCollection(self.points[self.edges], colors="black", linewidths=0.35, alpha=0.28))
        axes.add_collection(
            LineCollection(self.points[self.boundary], colors="#3c4043", linewidths=0.8, capstyle="round")
        )
        for contour in self.contours.values():
            axes.add_patch(Polygon(contour, closed=True, zorder=5, **BODY))
        axes.set_xlim(panel[0], panel[1])
        axes.set_ylim(panel[2], panel[3])
        axes.set_aspect("equal")
        axes.set_xlabel("r [m]" if self.result.axisymmetric else "x [m]")
        axes.set_ylabel("z [m]" if self.result.axisymmetric else "y [m]")
        axes.xaxis.set_major_locator(ticks(5))
        axes.yaxis.set_major_locator(ticks(6))
        return drawn


def nice_time(seconds):
    factor, unit = time_unit(seconds)
    return f"{seconds * factor:.4g} {unit}"
