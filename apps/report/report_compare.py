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

    def __init__(self, files):
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
        stages = report_answer.moving_stages(self.spans, self.history.time, depth)
        return report_answer.stage_ways(next(iter(forces.values())), depth, stages)


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
            title, texts = report_answer.cells(name, unit, values)
            rows.append([html.escape(stage), title, *texts])
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


def comparison(first, others, table, gallery):
    """HTML that compares a Result, which is read already, with those that these arguments mean."""
    if 1 + len(others) > MOST:
        raise MudlineError(f"{1 + len(others)} results are too many for one report; allowed are {MOST}")
    runs = [Run(files) for files in (first, *map(Result, others))]
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
