#!/usr/bin/env python3
"""Faults of every kind, done to decks, meshes, files, machines and plugins, and what becomes of the run.

    reliability.py [--full] [--only CATEGORY] [--seed N] [--write docs/reliability.md]

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
    "plugins",
]


def table(results, remarks, full):
    """The document: a table over the categories, then every bad outcome."""
    command = "tests/reliability/reliability.py --full --write docs/reliability.md"
    lines = ["# Reliability", "", "What was tried, and what became of it. Repeat it, with `MUDLINE` naming the program, by", "",
             f"    {command}", "", "Good ends:", ""]
    lines += [f"- **{name}**: {meaning}." for name, meaning in fault.GOOD.items()]
    lines += ["", "Bad ends:", ""]
    lines += [f"- **{name}**: {meaning}." for name, meaning in fault.BAD.items()]
    verdicts = [*fault.GOOD, *fault.BAD]
    lines += ["", "| tried | faults | " + " | ".join(verdicts) + " |", "|---|---" + "|---" * len(verdicts) + "|"]
    for title, outcomes in results.items():
        count = collections.Counter(outcome.verdict for outcome in outcomes)
        lines.append(f"| {title} | {len(outcomes)} | " + " | ".join(str(count[verdict]) for verdict in verdicts) + " |")
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
    text, bad = table(results, remarks, options.full)
    print(text)
    if options.write:
        options.write.write_text(text, encoding="utf-8")
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
