#!/usr/bin/env python3
"""Faults of every kind, done to decks, meshes, files, machines and plugins, and what becomes of the run.

    reliability.py [--full] [--only CATEGORY] [--seed N] [--write docs/reliability.md]

With --only, --write replaces the rows of these categories in the document and keeps the others, as the run before left them.

Without --full each category runs a sample that takes seconds. The environment variable MUDLINE names the program.
A category is a module of this folder with TITLE (what was tried), FULL and SAMPLE (how many faults), and
run(count, seed, folder), which yields Outcomes; it may have remarks(), lines that follow the table, and check(), which ends the
program where the category cannot be tried. Exit code 1 when one
verdict is bad.
"""
import argparse
import collections
import importlib
import pathlib
import sys
import tempfile

import fault

CATEGORIES = [
    "decks",
    "meshes",
    "kills",
    "bits",
    "disks_and_signals",
    "remeshing_signals",
    "plugins",
    "files_from_others",
    "practice",
    "unit_slips",
]


def kept_rows(path, modules):
    """{title: {verdict: count}} and {title: [remark]} of the rows that a document has of categories that are not run."""
    counts, remarks = {}, {}
    if path is None or not path.exists():
        return counts, remarks
    run = {module.TITLE for module in modules}
    titles = {importlib.import_module(name).TITLE for name in CATEGORIES} - run
    verdicts = []
    for line in path.read_text(encoding="utf-8").splitlines():
        cells = [cell.strip() for cell in line.strip("|").split("|")] if line.startswith("| ") else []
        if cells[:2] == ["tried", "faults"]:
            verdicts = cells[2:]
        elif verdicts and cells and cells[0] in titles:
            counts[cells[0]] = collections.Counter({verdict: int(number) for verdict, number in zip(verdicts, cells[2:])})
        for title in titles:
            if line.startswith(f"- {title}: "):
                remarks.setdefault(title, []).append(line[len(f"- {title}: "):].rstrip("."))
    return counts, remarks


def table(results, remarks, full, kept=None):
    """The document: a table over the categories, then every bad outcome. `kept`: {title: {verdict: count}} of rows that stay."""
    command = "tests/reliability/reliability.py --full --write docs/reliability.md"
    lines = ["# Reliability", "", "What was tried, and what became of it. Repeat it, with `MUDLINE` naming the program, by", "",
             f"    {command}", "", "Good ends:", ""]
    lines += [f"- **{name}**: {meaning}." for name, meaning in fault.GOOD.items()]
    lines += ["", "Neither:", ""]
    lines += [f"- **{name}**: {meaning}." for name, meaning in fault.OPEN.items()]
    lines += ["", "Bad ends:", ""]
    lines += [f"- **{name}**: {meaning}." for name, meaning in fault.BAD.items()]
    verdicts = [*fault.GOOD, *fault.OPEN, *fault.BAD]
    lines += ["", "| tried | faults | " + " | ".join(verdicts) + " |", "|---|---" + "|---" * len(verdicts) + "|"]
    counts = dict(kept or {})
    for title, outcomes in results.items():
        counts[title] = collections.Counter(outcome.verdict for outcome in outcomes)
    for title in sorted(counts, key=[importlib.import_module(name).TITLE for name in CATEGORIES].index):
        count = counts[title]
        lines.append(f"| {title} | {sum(count.values())} | " + " | ".join(str(count[verdict]) for verdict in verdicts) + " |")
    lines += [""] + [f"- {title}: {remark}." for title, own in remarks.items() for remark in own]
    bad = [(title, outcome) for title, outcomes in results.items() for outcome in outcomes if outcome.verdict in fault.BAD]
    lines += ["", "Bad ends in full:" if bad else "No bad end." + ("" if full else " (a sample)"), ""]
    lines += [f"- {title}: {outcome.fault}: {outcome.verdict}: {outcome.said}" for title, outcome in bad]
    return "\n".join(lines).rstrip() + "\n", bad


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--full", action="store_true")
    parser.add_argument("--only", action="append", choices=CATEGORIES)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--write", type=pathlib.Path)
    options = parser.parse_args()
    results, remarks = {}, {}
    modules = [importlib.import_module(name) for name in options.only or CATEGORIES]
    for module in modules:
        if hasattr(module, "check"):
            module.check()
    for module in modules:
        with tempfile.TemporaryDirectory() as folder:
            count = module.FULL if options.full else module.SAMPLE
            results[module.TITLE] = list(module.run(count, options.seed, pathlib.Path(folder)))
            remarks[module.TITLE] = module.remarks() if hasattr(module, "remarks") else []
    kept, old_remarks = kept_rows(options.write if options.only else None, modules)
    text, bad = table(results, {**old_remarks, **remarks}, options.full, kept)
    print(text)
    if options.write:
        options.write.write_text(text, encoding="utf-8")
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
