"""The results of a run, <stem>.results.csv: the answer by stage."""

import csv

from mudline.errors import MudlineError

ENDING = ".results.csv"
HEADER = ["stage", "of", "quantity", "value", "unit"]


class Results:
    """`of`: {what it is of: {quantity: (unit, {stage: value})}}; the stage of the whole run is "". `stages` in order."""

    def __init__(self, path):
        self.stages, self.of = [], {}
        with open(path, newline="", encoding="utf-8") as file:
            reader = csv.DictReader(file)
            if reader.fieldnames != HEADER:
                raise MudlineError(f"{path}: not the results of mudline (its first line is not '{','.join(HEADER)}')")
            for row in reader:
                try:
                    value = float(row["value"])
                except (TypeError, ValueError):
                    raise MudlineError(f"{path}:{reader.line_num}: '{row['value']}' is not a number") from None
                if row["stage"] and row["stage"] not in self.stages:
                    self.stages.append(row["stage"])
                quantities = self.of.setdefault(row["of"], {})
                quantities.setdefault(row["quantity"], (row["unit"], {}))[1][row["stage"]] = value

    def value(self, of, quantity, stage=""):
        """In SI units; None where there is none."""
        return self.of.get(of, {}).get(quantity, ("", {}))[1].get(stage)

    def all(self):
        """{(stage, of, quantity): value}"""
        return {(stage, of, quantity): value for of, quantities in self.of.items()
                for quantity, (_, values) in quantities.items() for stage, value in values.items()}

    def frame(self):
        """A pandas DataFrame with the columns of the file."""
        import pandas

        rows = [(stage, of, quantity, value, self.of[of][quantity][0]) for (stage, of, quantity), value in self.all().items()]
        return pandas.DataFrame(rows, columns=HEADER)
