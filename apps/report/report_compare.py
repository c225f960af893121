"""The section of a report that compares several runs: their results side by side, and forces over displacement by stage."""

import html

import numpy as np

import report_answer
import report_pictures as pictures
from report_result import MudlineError, Result

SAME = 1e-9  # of the larger value
MOST = 6  # runs in one report


class Run:
    """What is compared of a run: its name, results, history, and the rows of its stages."""

    def __init__(self, argument):
        files = Result(argument)
        self.stem, self.name, self.results, self.history = files.stem, files.name, files.results, files.history
        self.spans = files.fields.stage_spans() if files.fields else []

    def forces(self, body):
        """[(stage, displacement in it, vertical force on the body)]"""
        if self.history is None or not len(self.history.time):
            return []
        units = self.history.groups().get(f"body/{body}")
        if units is None:
            return []
        forces, _, depth, _ = report_answer.body_resistance(self.history, units, body, self.results)
        if not forces or depth is None or not np.ptp(depth) > 0:
            return []
        force = next(iter(forces.values()))
        return [(stage, np.abs(depth[rows] - depth[rows[0]]), force[rows])
                for stage, rows in report_answer.moving_stages(self.spans, self.history.time, depth)]


def differing_rows(runs, of, stages):
    """[[stage, quantity, a value for each run]] of what is not the same in all runs."""
    rows = []
    quantities = {name: unit for run in runs for name, (unit, _) in run.results.of.get(of, {}).items()}
    for stage in ["", *stages]:
        for name, unit in quantities.items():
            values = [run.results.value(of, name, stage) for run in runs]
            known = [value for value in values if value is not None]
            if not known or (len(known) == len(runs) and np.ptp(known) <= SAME * np.abs(known).max()):
                continue
            largest = max(abs(value) for value in known)
            factor, shown = (1.0, "") if unit == "s" else pictures.scaled(unit, largest)
            title = html.escape(name) + (f" [{html.escape(shown)}]" if shown not in report_answer.PLAIN else "")
            rows.append([html.escape(stage), title] + [
                "" if value is None else report_answer.number(value, "s") if unit == "s" else
                f"{report_answer.whole(value, unit) * factor:.4g}" for value in values])
    return rows


def tables(runs, table):
    with_results = [run for run in runs if run.results]
    if len(with_results) < 2:
        return ""
    stages = list(dict.fromkeys(stage for run in with_results for stage in run.results.stages))
    page = ""
    for of in dict.fromkeys(of for run in with_results for of in run.results.of):
        rows = differing_rows(with_results, of, stages)
        if rows:
            header = ["stage", "", *(html.escape(run.name) for run in with_results)]
            page += f"<h3>{html.escape(of)}</h3>" + table(rows, header, range(2, len(header)))
    return page or "<p>All results are the same.</p>"


def force_figure(body, curves):
    """curves: {stage: [(run, displacement, force)]}"""
    with pictures.plt.rc_context(pictures.STYLE):
        figure, grid = pictures.plt.subplots(1, len(curves), figsize=(4.5 * len(curves), 4.2), squeeze=False, layout="constrained")
        largest = max(np.abs(force).max() for parts in curves.values() for _, _, force in parts)
        factor, unit = pictures.scaled("N", largest)
        for (stage, parts), axes in zip(curves.items(), grid[0]):
            length, metre = pictures.scaled("m", max(way.max() for _, way, _ in parts))
            for name, way, force in parts:
                axes.plot(way * length, force * factor, label=name)
            axes.set_title(stage)
            axes.set_xlabel(f"displacement in the stage [{metre}]")
            axes.set_ylabel(f"vertical force on {body} [{unit}]")
            axes.legend(fontsize=8)
        return figure


def comparison(arguments, table, gallery):
    """HTML that compares these results."""
    if len(arguments) > MOST:
        raise MudlineError(f"{len(arguments)} results are too many for one report; allowed are {MOST}")
    runs = [Run(argument) for argument in arguments]
    stems = [run.stem.resolve() for run in runs]
    for stem in stems:
        if stems.count(stem) > 1:
            raise MudlineError(f"{stem.name}: given twice")
    page = tables(runs, table)
    bodies = dict.fromkeys(group.split("/", 1)[1] for run in runs if run.history is not None
                           for group in run.history.groups() if group.startswith("body/"))
    for body in bodies:
        curves = {}
        for run in runs:
            for stage, way, force in run.forces(body):
                curves.setdefault(stage, []).append((run.name, way, force))
        curves = {stage: parts for stage, parts in curves.items() if len(parts) > 1}
        if curves:
            page += "<div class=row>" + gallery.add(force_figure(body, curves), f"comparison {body}", True) + "</div>"
    return page
