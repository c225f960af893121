#!/usr/bin/python3
"""One HTML file that shows a result of mudline: the answer, fields, histories, balances, deck.

mudline report results/cone                                  # writes results/cone_report.html
mudline report results/cone.h5 --times 0.05,0.2 --fields "pore pressure,void ratio" -o cone.html
mudline report results --mirror --png pictures
mudline report results/pile results/pile_after_a_year        # the first one, compared with the others
"""

import argparse
import base64
import html
import io
import re
import sys
import time
from pathlib import Path

import numpy as np
from PIL import Image

import report_answer
import report_compare
import report_pictures as pictures
import report_ground
import report_point
import report_space_pictures
from report_result import FieldResult, MudlineError, Result, text

sys.path.append(str(Path(__file__).resolve().parent.parent / "support"))
from standard_output import after_output  # noqa: E402

FAVOURITES = [
    "excess pore pressure",
    "pore pressure",
    "saturation",
    "displacement",
    "mean effective stress",
    "deviatoric stress",
    "void ratio",
    "preconsolidation pressure",
    "velocity",
]
MAX_DEFAULT_FIELDS = 5  # and, in space, the vertical displacement
ATTEMPTS = 3

CSS = """
:root { color-scheme: light; }
body { font: 15px/1.5 "Source Sans 3", "Segoe UI", "DejaVu Sans", Helvetica, Arial, sans-serif; color: #222;
       max-width: 1180px; margin: 2.2em auto 4em; padding: 0 1.5em; }
h1 { font-size: 1.75em; margin: 0 0 .1em; } h2 { font-size: 1.25em; margin: 2.2em 0 .6em; padding-bottom: .25em;
       border-bottom: 2px solid #0b5d8a; } h3 { font-size: 1.02em; margin: 1.5em 0 .3em; color: #0b5d8a; }
.subtitle { color: #666; margin: 0 0 1.4em; }
nav a { margin-right: 1.2em; color: #0b5d8a; text-decoration: none; } nav a:hover { text-decoration: underline; }
table { border-collapse: collapse; margin: .4em 0 1em; } th, td { padding: .28em .9em .28em 0; text-align: left;
       vertical-align: top; border-bottom: 1px solid #e6e6e6; } th { font-weight: 600; color: #555; }
td.number, th.number { text-align: right; font-variant-numeric: tabular-nums; padding-left: 1.2em; }
.row { display: flex; flex-wrap: wrap; gap: .8em 1.2em; } figure { margin: 0; } img { max-width: 100%; height: auto; }
pre { background: #f6f7f8; border: 1px solid #e2e4e6; padding: .9em 1.1em; overflow: auto; font-size: 12.5px;
      line-height: 1.4; max-height: 40em; }
summary { cursor: pointer; color: #0b5d8a; }
"""


class Gallery:
    """Turns figures into <img> tags and, on request, into PNG files of their own."""

    def __init__(self, folder):
        self.folder = Path(folder) if folder else None
        if self.folder:
            self.folder.mkdir(parents=True, exist_ok=True)
        self.written = []

    def add(self, figure, name, vector):
        options = {"facecolor": "white", "bbox_inches": "tight", "pad_inches": 0.08}
        if self.folder:
            path = self.folder / (re.sub(r"[^A-Za-z0-9.-]+", "_", name) + ".png")
            figure.savefig(path, dpi=200, **options)
            self.written.append(path)
        data = io.BytesIO()
        figure.savefig(data, format="svg" if vector else "png", dpi=115, **options)
        pictures.plt.close(figure)
        if not vector:  # 256 colours are enough for one field, and a third of the size
            picture = Image.open(data).convert("RGB")
            picture = picture.quantize(256, Image.Quantize.MAXCOVERAGE, dither=Image.Dither.NONE)
            data = io.BytesIO()
            picture.save(data, "png", optimize=True)
        width = figure.get_size_inches()[0] * 96
        kind = "svg+xml" if vector else "png"
        code = base64.b64encode(data.getvalue()).decode("ascii")
        return (
            f'<figure><img alt="{html.escape(name)}" width="{width:.0f}" '
            f'src="data:image/{kind};base64,{code}"></figure>'
        )


def table(rows, header=None, numbers=()):
    def line(cells, tag):
        return (
            "<tr>"
            + "".join(f'<{tag}{" class=number" if i in numbers else ""}>{cell}</{tag}>' for i, cell in enumerate(cells))
            + "</tr>"
        )

    return "<table>" + (line(header, "th") if header else "") + "".join(line(row, "td") for row in rows) + "</table>"


def summary(result, history, name):
    rows = [("result", html.escape(name))]
    if result:
        for key, value in result.metadata.items():
            if key != "title" and "\n" not in value and len(value) < 200:
                unit = " s" if key.replace("_", " ") == "wall time" and re.fullmatch(r"[0-9.eE+-]+", value) else ""
                rows.append((html.escape(key.replace("_", " ")), html.escape(value) + unit))
        rows += [
            ("geometry", result.geometry),
            (
                "mesh",
                f"{result.file.attrs['nodes']} nodes, {result.file.attrs['elements']} elements; "
                f"regions: {html.escape(', '.join(result.regions))}",
            ),
        ]
        bodies = [text(body.attrs["name"]) for body in result.file.get("bodies", {}).values()]
        if bodies:
            rows.append(("bodies", html.escape(", ".join(bodies))))
    if history is not None and len(history.time):
        rows.append(
            (
                "histories",
                f"{len(history.columns)} columns, {len(history.time)} rows, up to t = "
                f"{pictures.nice_time(history.time[-1])}",
            )
        )
    page = table([(f"<b>{key}</b>", value) for key, value in rows])
    if result and result.steps:
        page += "<h3>Stages</h3>" + table(
            [
                (html.escape(stage), f"{first:.6g}", f"{last:.6g}", str(count))
                for stage, first, last, count in result.stage_spans()
            ],
            ("stage", "first output [s]", "last output [s]", "outputs"),
            (1, 2, 3),
        )
    return page


def answer_section(results, history, spans, gallery):
    """The results as tables, and the resistance to each body over depth."""
    page = report_answer.results_tables(results, table) if results else ""
    if history is None or not len(history.time):
        return page
    figures, depths = [], []
    for group, units in history.groups().items():
        if not group.startswith("body/"):
            continue
        body = group.split("/", 1)[1]
        forces, name, depth, speed = report_answer.body_resistance(history, units, body, results)
        if forces and depth is not None and np.ptp(depth) > 0:
            depths.append((depth, name))
            stages = report_answer.moving_stages(spans, history.time, depth)
            figure = report_answer.load_figure(body, forces, depth, name, stages, speed)
            figures.append(gallery.add(figure, f"resistance {body}", True))
    for group, units in history.groups().items():
        if group.startswith("cone/") and len(depths) == 1:
            columns = {name: (unit, values) for unit, curves in units.items() for name, values in curves.items()}
            figure = report_answer.cone_figure(group.split("/", 1)[1], columns, *depths[0])
            figures.append(gallery.add(figure, group.replace("/", " "), True))
    return page + (f"<div class=row>{''.join(figures)}</div>" if figures else "")


def is_balance(group):
    """Whether a group of columns stands in the table of balances."""
    return group.split("/")[0] in ("balance", "mesh motion")


def history_section(history, spans, gallery):
    """The histories over time, but the balances; what does not change is told in a line."""
    parts, constant = [], []
    for group, units in history.groups().items():
        if is_balance(group):
            continue
        changing = {}
        for unit, curves in units.items():
            for name, values in curves.items():
                if np.ptp(values) > 0:
                    changing.setdefault(unit, {})[name] = values
                else:
                    constant.append(f"{group}/{name} {report_answer.number(values[0], unit)}")
        if changing:
            parts.append(f"<h3>{html.escape(group or 'run')}</h3><div class=row>")
            figure = pictures.history_figure(changing, history.time, spans)
            parts.append(gallery.add(figure, f"history {group or 'run'}", True) + "</div>")
    if constant:
        parts.append(f"<p>Constant: {html.escape('; '.join(constant))}.</p>")
    return "".join(parts)


def error_table(history):
    """What is estimated of the error that the mesh makes: shares, and the error of each quantity that has one."""
    rows = []
    for (group, name, unit), values in history.columns.items():
        base = history.columns.get((group, name.removesuffix(" error"), unit))
        if not name.endswith(" error") or not len(values) or (base is None and group != "mesh"):
            continue
        title = f"{group} {name.removesuffix(' error')}"
        share = np.abs(values[-1]) if base is None else np.abs(values[-1]) / max(np.abs(base[-1]), 1e-300)
        found = "" if base is None else f"{base[-1]:.6g}"
        error = "" if base is None else f"{values[-1]:.3g}"
        percent = f"{100 * share:.2g} %" if share <= 10 else "more than it"
        rows.append((html.escape(title), found, error, html.escape(unit) if base is not None else "", percent))
    if not rows:
        return ""
    return table(rows, ("quantity", "at the end", "estimated error", "unit", "share"), (1, 2, 4))


def balance_table(history):
    rows = []
    for (group, name, unit), values in history.columns.items():
        if is_balance(group) and len(values):
            rows.append(
                (
                    html.escape(f"{group.removeprefix('balance/')} {name}".strip()),
                    html.escape(unit),
                    f"{values[-1]:.6g}",
                    f"{np.abs(values).max():.6g}",
                )
            )
    return table(rows, ("balance", "unit", "at the end", "largest magnitude"), (2, 3)) if rows else ""


def choose_steps(result, times):
    if times:
        return sorted({result.nearest_step(moment) for moment in times})
    last_of_stage = [
        i for i in range(len(result.steps)) if i + 1 == len(result.steps) or result.stages[i + 1] != result.stages[i]
    ]
    return last_of_stage[-4:]


def choose_fields(result, step, wanted):
    available = result.fields(step)
    if wanted:
        for name in wanted:
            if name not in available:
                raise MudlineError(f"there is no field '{name}'; known: " + ", ".join(sorted(available)))
        return wanted
    # Components of vectors are there for who asks for them; their length says enough for an overview.
    whole = [name for name in available if not (name[-2:] in (" x", " y", " z") and name[:-2] in available)]
    ordered = [name for name in FAVOURITES if name in whole] + [name for name in whole if name not in FAVOURITES]
    # first of all the unknowns that not every model has: a temperature, what a plugin adds
    special = [name for name in ordered if not available[name].by_cell and name not in FAVOURITES and name + " x" not in available
               and not name.startswith("contact ")]
    ordered = special + [name for name in ordered if name not in special]
    if "excess pore pressure" in ordered and "pore pressure" in ordered:
        # where soil dries, the pressure itself tells how far the water reaches
        ordered.remove("excess pore pressure" if "saturation" in ordered else "pore pressure")
    ordered = ordered[:MAX_DEFAULT_FIELDS]
    if result.in_space and "displacement" in ordered:
        ordered.insert(ordered.index("displacement") + 1, "displacement z")
    return ordered


def field_drawings(result, steps, options):
    """[(step, what draws its fields)]"""
    if not result.in_space:
        return [(step, pictures.FieldPicture(result, step, options.mirror, options.zoom)) for step in steps]
    if options.zoom:
        raise MudlineError("--zoom: there is no second panel for a result in space")
    models = {}  # by mesh, as its last step asks for
    for step in reversed(steps):
        if result.mesh_name(step) not in models:
            models[result.mesh_name(step)] = report_space_pictures.SpaceModel(result, step)
    return [(step, report_space_pictures.SpacePicture(result, step, models[result.mesh_name(step)])) for step in steps]


def uniform_text(result, step, field):
    factor, unit, _, _ = pictures.colour_range(field, None)
    value = f"{field.values[0] * factor + 0.0:.6g} {unit}".removesuffix(" -")  # no "-0"
    return f"t = {pictures.nice_time(result.times[step])}, {result.stages[step]}: {value} everywhere."


def same_text(result, step, before):
    return f"t = {pictures.nice_time(result.times[step])}, {result.stages[step]}: as in the picture of '{result.stages[before]}'."


def is_same(before, field):
    """Whether a picture would be the one before: the same values on the same mesh."""
    if len(before.values) != len(field.values):
        return False
    return np.abs(field.values - before.values).max() <= 1e-4 * np.ptp(field.values)


def is_uniform(field):
    return np.ptp(field.values) <= 1e-9 * np.abs(field.values).max()


def moment_name(result, step):
    """Of a file: the stage, and the time where the stage has several outputs."""
    stage, time = result.stages[step], result.times[step]
    return f"{stage} t={time:.10g}" if result.stages.count(stage) > 1 else stage


def field_section(result, steps, wanted, options, gallery):
    names = choose_fields(result, steps[-1], wanted)
    drawings = [(step, drawing, result.fields(step)) for step, drawing in field_drawings(result, steps, options)]
    parts = []
    for name in names:
        parts.append(f"<h3>{html.escape(name)}</h3><div class=row>")
        shown = [(step, drawing, fields[name]) for step, drawing, fields in drawings if name in fields]
        limits = None
        if options.common_scale:
            samples = [drawing.sample(field) for _, drawing, field in shown]
            limits = pictures.common_limits([field for _, _, field in shown], samples)
        before = None
        for step, drawing, field in shown:
            if is_uniform(field) and (len(shown) > 1 or not result.in_space):  # a picture of it would tell nothing
                parts.append(f"<p>{html.escape(uniform_text(result, step, field))}</p>")
                continue
            if before and result.times[step] == result.times[before[0]] and is_same(before[1], field):
                parts.append(f"<p>{html.escape(same_text(result, step, before[0]))}</p>")
                continue
            before = step, field
            figure = drawing.figure(field, limits)
            parts.append(gallery.add(figure, f"{name} {moment_name(result, step)}", False))
        parts.append("</div>")
    return "".join(parts)


def build(options, gallery):
    files = Result(options.results[0])
    result = FieldResult(files.fields_path) if files.fields_path else None
    history, results, stem = files.history, files.results, files.stem
    metadata = result.metadata if result else {}
    deck_name = metadata.get("deck_name", stem.name)
    title = metadata.get("title") or deck_name
    spans = result.stage_spans() if result else []

    sections = [("Results", answer_section(results, history, spans, gallery))]
    if len(options.results) > 1:
        sections.append(("Comparison", report_compare.comparison(files, options.results[1:], table, gallery)))
    if result and result.steps:
        steps = choose_steps(result, options.times)
        sections.append(("Fields", field_section(result, steps, options.fields, options, gallery)))
    elif options.fields or options.times:
        raise MudlineError(f"{options.results[0]}: no step with fields was written")
    if options.csv:
        if history is None:
            raise MudlineError(f"--csv: {options.results[0]} has no history")
        history.write(options.csv)
    if history is not None and len(history.time):
        if report_point.is_point(history):
            figure = report_point.point_figure({stem.name: history})
            sections.append(("Test", f"<div class=row>{gallery.add(figure, 'material point', True)}</div>"))
        sections.append(("Histories", history_section(history, spans, gallery)))
        sections.append(("Discretisation", error_table(history)))
        sections.append(("Balances", balance_table(history)))
    sections.append(("Summary", summary(result, history, str(stem))))
    long_texts = {key: value for key, value in metadata.items() if "\n" in value or len(value) >= 200}
    sections.append(
        (
            "Deck",
            "".join(
                f"<details{' open' if key == 'deck' else ''}><summary>{html.escape(key.replace('_', ' '))}</summary>"
                f"<pre>{html.escape(value)}</pre></details>"
                for key, value in sorted(long_texts.items())
            ),
        )
    )

    sections = [(name, content) for name, content in sections if content]
    links = "".join(f'<a href="#{name.lower()}">{name}</a>' for name, _ in sections)
    body = "".join(f'<h2 id="{name.lower()}">{name}</h2>{content}' for name, content in sections)
    page = (
        f'<!DOCTYPE html><html lang="en"><head><meta charset="utf-8"><title>{html.escape(title)}</title>'
        f'<meta name="viewport" content="width=device-width, initial-scale=1"><style>{CSS}</style></head><body>'
        f"<h1>{html.escape(title)}</h1><p class=subtitle>{html.escape(deck_name)}</p>"
        f"<nav>{links}</nav>{body}</body></html>\n"
    )
    output = Path(options.output) if options.output else stem.with_name(stem.name + "_report.html")
    output.write_text(page, encoding="utf-8")
    return output


def numbers(text):
    try:
        return [float(part) for part in text.split(",") if part.strip()]
    except ValueError:
        raise argparse.ArgumentTypeError(f"'{text}' is not a list of numbers such as 0.1,2.5") from None


def window(text):
    if text == "none":
        return []
    values = numbers(text)
    if len(values) != 4 or values[1] <= values[0] or values[3] <= values[2]:
        raise argparse.ArgumentTypeError(f"'{text}' is not 'none' or xmin,xmax,ymin,ymax")
    return values


def names(text):
    return [part.strip() for part in text.split(",") if part.strip()]


def parse(arguments):
    parser = argparse.ArgumentParser(
        prog="mudline report",
        description=__doc__,
        allow_abbrev=False,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument(
        "results", nargs="+", metavar="result",
        help="result without suffix, its .h5, .vtkhdf, .xdmf or .csv, or a folder that holds one result; it is compared with further ones"
    )
    parser.add_argument("-o", "--output", help="HTML file (default: <result>_report.html)")
    parser.add_argument(
        "--times", type=numbers, help="draw the outputs nearest to these times [s] (default: the end of each stage)"
    )
    parser.add_argument("--fields", type=names, help="draw these fields, separated by commas (default: up to five)")
    parser.add_argument("--mirror", action="store_true", help="draw both halves of an axisymmetric mesh")
    parser.add_argument(
        "--zoom",
        type=window,
        help="second panel: xmin,xmax,ymin,ymax [m], or none (default: around the bodies)",
    )
    parser.add_argument(
        "--common-scale",
        action=argparse.BooleanOptionalAction,
        default=True,
        help="one colour scale per field for all times (default), or one for each picture",
    )
    parser.add_argument("--csv", metavar="FILE", help="write the history in kPa, kN, mm, days too, for a spreadsheet")
    parser.add_argument("--png", metavar="FOLDER", help="write every picture as a PNG file too")
    return parser.parse_args(arguments)


def build_patiently(options):
    """Builds the report; a step that is just being written leaves the file inconsistent for a moment: tries again."""
    for attempt in range(ATTEMPTS):
        gallery = Gallery(options.png)
        try:
            return build(options, gallery), gallery.written
        except (KeyError, RuntimeError, AttributeError) as error:  # what h5py raises for a half-written file
            if attempt + 1 == ATTEMPTS:
                reason = f"{type(error).__name__}: {error}".splitlines()[0]
                raise MudlineError(f"{', '.join(options.results)}: damaged, or a step is being written ({reason})") from error
            time.sleep(0.5)


def main(arguments=None):
    arguments = sys.argv[1:] if arguments is None else arguments
    drawings = {"--point": report_point.draw, "--ground": report_ground.draw}  # from `mudline point --png`
    if arguments[:1] and arguments[0] in drawings:
        try:
            print(drawings[arguments[0]](arguments[1:]))
        except (MudlineError, OSError) as error:
            print(f"mudline report: {error}", file=sys.stderr)
            return 2
        return 0
    options = parse(arguments)
    try:
        output, written = build_patiently(options)
    except (MudlineError, OSError) as error:
        print(f"mudline report: {error}", file=sys.stderr)
        return 2
    for path in written:
        print(path)
    print(output)
    return 0


if __name__ == "__main__":
    sys.exit(after_output(main))
