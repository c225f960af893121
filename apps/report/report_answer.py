"""The first section of a report: the results of a run, <stem>.results.csv, as tables, and resistance over depth."""

import html

import numpy as np

import report_pictures as pictures

PLAIN = ("-", "")
ROUNDING = 1e-9  # [m]
ORDER = ["stage", "soil"]  # of tables: durations first, the soil last; bodies and conditions between


def whole(value, unit):
    """0 for a length that is rounding."""
    return 0.0 if unit == "m" and abs(value) < ROUNDING else value


def number(value, unit):
    """A number by itself, in a unit of its own."""
    value = whole(value, unit)
    if unit == "s":
        return pictures.nice_time(value)
    factor, shown = pictures.scaled(unit, abs(value))
    return f"{value * factor:.4g} {shown}".rstrip("- ")


def cells(name, unit, values):
    """(title with a unit for all values, their texts) of a quantity; "" where a value is None."""
    largest = max((abs(value) for value in values if value is not None), default=0.0)
    factor, shown = (1.0, "") if unit == "s" else pictures.scaled(unit, largest)
    title = html.escape(name) + (f" [{html.escape(shown)}]" if shown not in PLAIN else "")
    return title, ["" if value is None else number(value, "s") if unit == "s" else f"{whole(value, unit) * factor:.4g}" for value in values]


def stage_table(results, of, table):
    """A column for each stage, a row for each quantity; "" where nothing is of a stage."""
    quantities = {name: (unit, values) for name, (unit, values) in results.of[of].items() if any(values)}
    stages = [stage for stage in results.stages if any(stage in values for _, values in quantities.values())]
    if not stages:
        return ""
    rows = []
    duration = results.of.get("stage", {}).get("duration", ("s", {}))
    for name, (unit, values) in {"duration": duration, **quantities}.items():
        title, texts = cells(name, unit, [values.get(stage) for stage in stages])
        rows.append([title, *texts])
    return f"<h3>{html.escape(of)}</h3>" + table(rows, ["", *map(html.escape, stages)], range(1, len(stages) + 1))


def run_table(results, table):
    """What belongs to the whole run."""
    rows = [(html.escape(of), html.escape(name), html.escape(number(values[""], unit)))
            for of, quantities in results.of.items() for name, (unit, values) in quantities.items() if "" in values]
    return "<h3>whole run</h3>" + table(rows, ("of", "quantity", "value"), (2,)) if rows else ""


def results_tables(results, table):
    """table(rows, header, columns of numbers): HTML."""
    names = sorted(results.of, key=lambda of: ORDER.index(of) if of in ORDER else 0.5)
    return "".join(stage_table(results, of, table) for of in names if of != "stage") + run_table(results, table)


def tip_depth(results, body, moved, displaced):
    """Depth of the tip below the mudline over the run [m], from positions and displacements along the vertical; None
    where the results do not tell where it was at the start."""
    start = results.value(body, "depth of the tip at the start") if results else None
    return None if start is None else start + (moved[0] - displaced[0]) - moved


def contact_reactions(history, up):
    """Vertical reactions of all contacts by name: the resistance that a body meets."""
    reactions = {}
    for group, units in history.groups().items():
        if group.startswith("contact/") and np.any(units.get("N", {}).get(f"reaction {up}", 0)):
            contact, newtons = group.split("/", 1)[1], units["N"]
            reactions[contact] = newtons[f"reaction {up}"]
            if f"reaction {up} error" in newtons:
                reactions[f"{contact} error"] = newtons[f"reaction {up} error"]
    return reactions


def body_resistance(history, units, body="", results=None):
    """(vertical forces by name, the first one whole; what the depth is; the depth or None; speed or None) of a body's
    columns. Up is z in space, y in the plane."""
    newtons, metres = units.get("N", {}), units.get("m", {})
    up = "z" if "displacement z" in metres or "position z" in metres else "y"
    forces = {name: values for name, values in newtons.items() if name.endswith(f"force {up}") and np.any(values)}
    reactions = contact_reactions(history, up)
    if len(reactions) == 1:
        reactions.update(parts_of_reaction(history, up))
    forces = {**reactions, **forces}
    free = results is not None and "speed" in results.of.get(body, {})
    speed = units.get("m/s", {}).get(f"velocity {up}") if free else None
    moved, displaced = metres.get(f"position {up}"), metres.get(f"displacement {up}")
    if moved is not None and displaced is not None:
        depth = tip_depth(results, body, moved, displaced)
        if depth is not None:
            return forces, "depth of the tip below the mudline", depth, speed
    moved = displaced if displaced is not None else moved
    return forces, "penetration", None if moved is None else moved[0] - moved, speed


def parts_of_reaction(history, up):
    """The reactions of tip and shaft of the one contact that there is, where it has both."""
    parts = {part: values for (group, name, _), values in history.columns.items() for part in ("tip", "shaft")
             if group.startswith("contact/") and name == f"{part} reaction {up}" and np.any(values)}
    return parts if len(parts) == 2 else {}


def moving_stages(spans, time, depth):
    """[(stage, rows)] of the stages in which the depth changes."""
    parts = [(stage, rows) for stage, _, rows in pictures.stage_rows(spans, time)] or [("", np.arange(len(time)))]
    return [(stage, rows) for stage, rows in parts if np.ptp(depth[rows]) > 1e-4 * np.ptp(depth)]


def stage_ways(force, depth, stages):
    """[(stage, displacement since its begin in the direction in which it goes, force)]"""
    return [(stage, np.abs(depth[rows] - depth[rows[0]]), force[rows]) for stage, rows in stages]


def load_figure(body, forces, depth, name, stages, speed):
    """Resistance over depth, depth downwards, as a cone penetration test is drawn, with the bands of estimated errors;
    beside it, where there are several stages, the resistance over the displacement in each; and the speed over depth of
    a body that moves freely (None: of no interest). name: what `depth` is."""
    forces, errors = pictures.split_errors(forces)
    panels = ["depth"] + ["stages"] * (len(stages) > 1) + ["speed"] * (speed is not None)
    with pictures.plt.rc_context(pictures.STYLE):
        size = (4.5 * len(panels), 4.2)
        figure, grid = pictures.plt.subplots(1, len(panels), figsize=size, squeeze=False, layout="constrained")
        factor, unit = pictures.scaled("N", max(np.abs(values).max() for values in forces.values()))
        depth_factor, depth_unit = pictures.scaled("m", np.abs(depth).max())
        shown = depth * depth_factor
        for panel, axes in zip(panels, grid[0]):
            if panel == "stages":
                draw_stages(axes, next(iter(forces.values())) * factor, depth, stages)
                axes.set_ylabel(f"vertical force on {body} [{unit}]")
                continue
            if panel == "speed":
                axes.plot(np.abs(speed), shown)
                axes.set_xlabel("speed [m/s]")
            else:
                for title, values in forces.items():
                    axes.plot(values * factor, shown, label=title)
                    if title in errors:
                        pictures.shade_error(axes, "x", values * factor, shown, errors[title] * factor)
                axes.set_xlabel(f"vertical force on {body} [{unit}]")
                if len(forces) > 1:
                    axes.legend(fontsize=8)
            axes.invert_yaxis()
            axes.set_ylabel(f"{name} [{depth_unit}]")
        return figure


def draw_stages(axes, force, depth, stages):
    """Force over the displacement in each stage, in the direction in which that goes."""
    shown = stage_ways(force, depth, stages)
    # stages of millimetres beside one of metres: the long one is in the diagram over depth
    short = [part for part in shown if part[1].max() < 0.2 * max(way.max() for _, way, _ in shown)] or shown
    factor, unit = pictures.scaled("m", max(way.max() for _, way, _ in short))
    for stage, way, values in short:
        axes.plot(way * factor, values, label=stage)
    axes.set_xlabel(f"displacement in the stage [{unit}]")
    axes.legend(fontsize=8)


def cone_figure(name, columns, depth, title):
    """What a cone penetration test measures over depth, depth downwards, with the bands of estimated errors: a panel for
    each unit. columns: {name: (unit, values)}"""
    going = np.diff(depth, prepend=depth[0]) > 0  # while the cone rests, its depth tells nothing
    depth, panels = depth[going], {}
    for quantity, (unit, values) in sorted(columns.items(), key=lambda column: column[1][0] in PLAIN):
        panels.setdefault((unit, quantity if unit in PLAIN else ""), {})[quantity] = values[going]
    with pictures.plt.rc_context(pictures.STYLE):
        figure, grid = pictures.plt.subplots(1, len(panels), figsize=(3.6 * len(panels), 4.2), squeeze=False, layout="constrained", sharey=True)
        depth_factor, depth_unit = pictures.scaled("m", np.abs(depth).max())
        for ((unit, quantity), curves), axes in zip(panels.items(), grid[0]):
            factor, shown = pictures.scaled(unit, max(np.abs(values).max() for values in curves.values()))
            curves, errors = pictures.split_errors(curves)
            for label, values in curves.items():
                axes.plot(values * factor, depth * depth_factor, label=label)
                if label in errors:
                    pictures.shade_error(axes, "x", values * factor, depth * depth_factor, errors[label] * factor)
            axes.set_xlabel(f"{quantity or name} [{shown}]")
            if len(curves) > 1:
                axes.legend(fontsize=8)
        grid[0][0].invert_yaxis()
        grid[0][0].set_ylabel(f"{title} [{depth_unit}]")
        return figure
