"""Reads the deck of a sweep and evaluates its formulas."""

import ast
import math
import operator
import xml.etree.ElementTree as ElementTree
from difflib import get_close_matches
from pathlib import Path

import numpy as np

SECTIONS = ("variables", "settings", "results")
PARAMETERS = {"deck": "string", "overlays": "Array(string)", "abscissa": "string", "logarithmic": "bool"}


class SweepError(Exception):
    """The user's input is wrong; printed as one line."""


def did_you_mean(name, known):
    close = get_close_matches(name, known, 1)
    return f" (did you mean '{close[0]}'?)" if close else f"; known: {', '.join(known)}"


def items(text):
    return [part.strip() for part in text.strip().strip("{}").split(",") if part.strip()]


class SweepDeck:
    """deck: the XML file that is run; variables: name -> values, all equally many; settings: path -> formula of the variables;
    results: "name [unit]" -> formula of the variables and of the columns of a run's history."""

    def __init__(self, path):
        self.path = Path(path)
        try:
            root = ElementTree.parse(self.path).getroot()
        except OSError as error:
            raise SweepError(f"{path}: cannot be read: {error.strerror}") from None
        except ElementTree.ParseError as error:
            raise SweepError(f"{path}: no XML: {error}") from None
        self.name = root.get("name") or self.path.stem
        given = {}
        for entry in root:
            name = entry.get("name")
            known = SECTIONS if entry.tag == "ParameterList" else tuple(PARAMETERS)
            if name not in known:
                kind = "section" if entry.tag == "ParameterList" else "parameter"
                raise SweepError(f"{path}: {name}: unknown {kind}{did_you_mean(str(name), known)}")
            if entry.tag == "Parameter" and entry.get("type") != PARAMETERS[name]:
                raise SweepError(f"{path}: {name}: has type '{entry.get('type')}', must have '{PARAMETERS[name]}'")
            given[name] = entry
        for name in ("deck", "abscissa") + SECTIONS:
            if name not in given:
                raise SweepError(f"{path}: required entry '{name}' is missing")
        folder = self.path.parent
        self.files = [str(folder / given["deck"].get("value"))]
        if "overlays" in given:
            self.files += [str(folder / item) for item in items(given["overlays"].get("value"))]
        for file in self.files:
            if not Path(file).is_file():
                raise SweepError(f"{path}: deck: there is no file '{file}'")
        self.variables = {e.get("name"): self._numbers(e) for e in given["variables"]}
        counts = {len(values) for values in self.variables.values()}
        if len(counts) != 1 or 0 in counts:
            raise SweepError(f"{path}: variables: all need the same number of values, at least one")
        self.cases = counts.pop()
        self.settings = {e.get("name"): e.get("value") for e in given["settings"]}
        self.results = {e.get("name"): e.get("value") for e in given["results"]}
        self.abscissa = given["abscissa"].get("value")
        if self.abscissa not in self.results:
            raise SweepError(f"{path}: abscissa: '{self.abscissa}' is none of the results{did_you_mean(self.abscissa, list(self.results))}")
        self.logarithmic = "logarithmic" in given and given["logarithmic"].get("value").lower() == "true"

    def _numbers(self, entry):
        try:
            return [float(item) for item in items(entry.get("value"))]
        except ValueError:
            raise SweepError(f"{self.path}: variables/{entry.get('name')}: '{entry.get('value')}' are no numbers") from None

    def case(self, index):
        return {name: values[index] for name, values in self.variables.items()}

    def check(self):
        """Finds wrong formulas and variables that none names before the first run."""
        named = set()
        for section, formulas in (("settings", self.settings), ("results", self.results)):
            for name, text in formulas.items():
                named |= Formula(text, f"{self.path}: {section}/{name}").check(list(self.variables))
        for name in self.variables:
            if name not in named:
                raise SweepError(f"{self.path}: variables/{name}: no setting and no result names this variable")
        for index in range(self.cases):
            self.settings_of(index)

    def settings_of(self, index):
        """["path=value", ...] of one case."""
        values = self.case(index)
        return [f"{path}={Formula(formula, f'{self.path}: settings/{path}').setting(values)}" for path, formula in self.settings.items()]


OPERATORS = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: operator.mul,
    ast.Div: operator.truediv,
    ast.Pow: operator.pow,
    ast.USub: operator.neg,
    ast.UAdd: operator.pos,
}
FUNCTIONS = {"abs": abs, "sqrt": math.sqrt, "exp": math.exp, "log": math.log, "log10": math.log10, "min": min, "max": max}
OF_COLUMN = {
    "first": lambda column: float(column[0]),
    "last": lambda column: float(column[-1]),
    "smallest": lambda column: float(np.min(column)),
    "largest": lambda column: float(np.max(column)),
    "mean": lambda column: float(np.mean(column)),
}
KNOWN_FUNCTIONS = [*FUNCTIONS, *OF_COLUMN, "at", "result"]


class Formula:
    """Arithmetic with variables, pi, the functions above, and first/last/smallest/largest/mean('column of the history');
    at('column', time) interpolates linearly, within the run; result('stage', 'of', 'quantity') is one of the run's results."""

    def __init__(self, text, where):
        self.where = where
        try:
            self.tree = ast.parse(text, mode="eval").body
        except SyntaxError:
            raise SweepError(f"{where}: '{text}' is no formula") from None

    def check(self, variables):
        """The names in it; refuses those that are unknown."""
        names = set()
        called = [node.func for node in ast.walk(self.tree) if isinstance(node, ast.Call)]
        for node in ast.walk(self.tree):
            if not isinstance(node, ast.Name):
                continue
            known = KNOWN_FUNCTIONS if node in called else [*variables, "pi"]
            if node.id not in known:
                kind = "function" if node in called else "variable"
                raise SweepError(f"{self.where}: unknown {kind} '{node.id}'{did_you_mean(node.id, known)}")
            names.add(node.id)
        return names

    def value(self, variables, columns=None):
        return self._checked(self.tree, variables, columns)

    def setting(self, variables):
        """As a deck has it: a number, or an array where the formula is {a, b}."""
        if isinstance(self.tree, ast.Set):
            return "{" + ", ".join(f"{self._checked(entry, variables):.12g}" for entry in self.tree.elts) + "}"
        return f"{self.value(variables):.12g}"

    def _checked(self, tree, variables, columns=None):
        self.check(list(variables))
        try:
            return self._value(tree, {**variables, "pi": math.pi}, columns)
        except (ZeroDivisionError, ValueError, OverflowError) as error:
            raise SweepError(f"{self.where}: {error}") from None

    def _value(self, node, variables, columns):
        if isinstance(node, ast.Constant) and isinstance(node.value, (int, float)):
            return node.value
        if isinstance(node, ast.Name):
            return variables[node.id]
        if isinstance(node, ast.BinOp) and type(node.op) in OPERATORS:
            return OPERATORS[type(node.op)](self._value(node.left, variables, columns), self._value(node.right, variables, columns))
        if isinstance(node, ast.UnaryOp) and type(node.op) in OPERATORS:
            return OPERATORS[type(node.op)](self._value(node.operand, variables, columns))
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and not node.keywords:
            return self._call(node, variables, columns)
        raise SweepError(f"{self.where}: '{ast.unparse(node)}' is not allowed in a formula")

    def _call(self, node, variables, columns):
        name = node.func.id
        if name in FUNCTIONS:
            return FUNCTIONS[name](*(self._value(argument, variables, columns) for argument in node.args))
        if columns is None:
            raise SweepError(f"{self.where}: '{name}' needs a run's history; here are only variables")
        if name == "result":
            return self._result([part.value for part in node.args if isinstance(part, ast.Constant)], columns)
        if len(node.args) != (2 if name == "at" else 1) or not isinstance(node.args[0], ast.Constant) or not isinstance(node.args[0].value, str):
            raise SweepError(f"{self.where}: '{name}' takes one column in quotes{' and a time' if name == 'at' else ''}")
        column = node.args[0].value
        if column not in columns:
            raise SweepError(f"{self.where}: the history has no column '{column}'{did_you_mean(column, [name for name in columns if isinstance(name, str)])}")
        if name != "at":
            return OF_COLUMN[name](columns[column])
        time, times = self._value(node.args[1], variables, columns), columns["time"]
        if not times[0] <= time <= times[-1]:
            raise SweepError(f"{self.where}: the history goes from {times[0]:.6g} to {times[-1]:.6g} s; asked was {time:.6g} s")
        return float(np.interp(time, times, columns[column]))

    def _result(self, words, columns):
        """columns: results are in it by (stage, of, quantity)."""
        if len(words) != 3 or not all(isinstance(word, str) for word in words):
            raise SweepError(f"{self.where}: 'result' takes stage, what it is of, and quantity, in quotes; the stage of the whole run is ''")
        known = [key for key in columns if isinstance(key, tuple)]
        if tuple(words) not in known:
            names = [" / ".join(key) for key in known]
            raise SweepError(f"{self.where}: the run has no result '{' / '.join(words)}'{did_you_mean(' / '.join(words), names)}")
        return columns[tuple(words)]
