"""The histories of a run: a CSV with a row for each step."""

import csv
from difflib import get_close_matches

import numpy as np

from mudline.errors import MudlineError
from mudline.units import scaled, time_unit


class History:
    """`time` [s] and `columns`, {(group, name, unit): values}: ("body/pile", "position y", "m")."""

    def __init__(self, path):
        with open(path, newline="", encoding="utf-8") as file:
            rows = list(csv.reader(file))
        if not rows or not rows[0] or rows[0][0] != "time [s]":
            raise MudlineError(f"{path}: not a history of mudline (the first column is not 'time [s]')")
        header = rows[0]
        # A last row cut short belongs to a step that is being written.
        complete = [row for row in rows[1:] if len(row) == len(header)]
        try:
            values = np.array(complete, dtype=float).reshape(len(complete), len(header))
        except ValueError:
            raise MudlineError(f"{path}: a row holds something that is not a number") from None
        self.path = path
        self.time = values[:, 0]
        self.columns = {}
        for title, column in zip(header[1:], values[:, 1:].T):
            path_text, _, unit = title.rpartition(" [")
            group, _, name = path_text.rpartition("/")
            self.columns[(group, name, unit.rstrip("]"))] = column

    def groups(self):
        """{group: {unit: {name: values}}} in the order of the file."""
        result = {}
        for (group, name, unit), values in self.columns.items():
            result.setdefault(group, {}).setdefault(unit, {})[name] = values
        return result

    def by_name(self):
        """{"body/pile/position y": values}, with "time"."""
        named = {f"{group}/{name}" if group else name: values for (group, name, _), values in self.columns.items()}
        return {"time": self.time, **named}

    def __getitem__(self, name):
        """The values of a column, by its name without unit. MudlineError where there is none."""
        known = self.by_name()
        if name not in known:
            near = get_close_matches(name, known, 1)
            raise MudlineError(f"{self.path}: there is no column '{name}'" + (f" (did you mean '{near[0]}'?)" if near else ""))
        return known[name]

    def unit(self, name):
        """The unit of a column."""
        self[name]
        return "s" if name == "time" else next(unit for group, last, unit in self.columns if name in (f"{group}/{last}", last))

    def readable(self, name):
        """(values, unit) of a column in a unit that suits its largest value: kPa, kN, mm; times in hours, days or
        years."""
        values, unit = self[name], self.unit(name)
        largest = np.abs(values[np.isfinite(values)]).max(initial=0.0)
        factor, unit = time_unit(largest) if name == "time" else scaled(unit, largest)
        return values * factor, unit

    def write(self, path):
        """Writes a CSV like that of the run with all columns in readable units, for a spreadsheet."""
        columns = {name: self.readable(name) for name in self.by_name()}
        with open(path, "w", newline="", encoding="utf-8") as file:
            rows = csv.writer(file)
            rows.writerow([f"{name} [{unit}]" for name, (_, unit) in columns.items()])
            rows.writerows(zip(*(values.tolist() for values, _ in columns.values())))

    def at(self, name, time):
        """A column at a time [s] within the run, linear between its rows."""
        if not self.time[0] <= time <= self.time[-1]:
            raise MudlineError(f"{self.path}: it goes from {self.time[0]:.6g} to {self.time[-1]:.6g} s; asked was {time:.6g} s")
        return float(np.interp(time, self.time, self[name]))

    def frame(self):
        """A pandas DataFrame with the time as index and the columns "body/pile/position y [m]"."""
        import pandas

        data = {f"{group}/{name} [{unit}]".lstrip("/"): values for (group, name, unit), values in self.columns.items()}
        return pandas.DataFrame(data, index=pandas.Index(self.time, name="time [s]"))
