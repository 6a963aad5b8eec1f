# SPDX-License-Identifier: Apache-2.0
"""Columns of CSV files and expressions in them."""
import ast
import csv
import operator
import re

import numpy as np

from .problem import Problem

FUNCTIONS = {"log": np.log, "exp": np.exp, "sqrt": np.sqrt, "abs": np.abs}
OPERATORS = {ast.Add: operator.add, ast.Sub: operator.sub, ast.Mult: operator.mul, ast.Div: operator.truediv,
             ast.Pow: operator.pow, ast.USub: operator.neg, ast.UAdd: operator.pos}
BACKWARD = 0.02  # of the range of x: how far x of a run may go back, as in a vibration


def read_columns(path, si_of=None):
    """The columns of a CSV file by name; lines with # are left out.

    si_of: turns a unit, as in "force [kN]", into the factor and the offset of SI. Without it titles are plain names.
    """
    try:
        with open(path, newline="", encoding="utf-8-sig") as file:
            lines = [(number, line) for number, line in enumerate(file, 1) if line.strip() and not line.startswith("#")]
        rows = list(zip((number for number, _ in lines), csv.reader(line for _, line in lines)))
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        raise Problem(f"{path} cannot be read ({error})") from error
    if len(rows) < 2:
        raise Problem(f"{path} has {len(rows)} lines (needed: a header and numbers)")
    titles = [title.strip() for title in rows[0][1]]
    units = [""] * len(titles)
    if si_of is not None:
        matches = [re.fullmatch(r"(.*?)\s*(?:\[\s*(.*?)\s*\])?", title) for title in titles]
        titles, units = [match[1] for match in matches], [match[2] or "" for match in matches]
    for title in titles:
        if titles.count(title) > 1:
            raise Problem(f"{path} has two columns with the name {title!r}")
    values = np.array([_numbers(path, number, row, len(titles)) for number, row in rows[1:]])
    columns = {}
    for n, (title, unit) in enumerate(zip(titles, units)):
        try:
            factor, offset = si_of(unit) if unit else (1.0, 0.0)
        except Problem as error:
            raise Problem(f"{path}, column {title!r}: {error}") from error
        columns[title] = factor * values[:, n] + offset
    return columns


def _numbers(path, number, row, count):
    if len(row) != count:
        raise Problem(f"{path}, line {number}: {len(row)} numbers for {count} columns (separated by commas, with "
                      "decimal points)")
    try:
        return [float(text) if text.strip() else np.nan for text in row]
    except ValueError as error:
        raise Problem(f"{path}, line {number}: {str(error).rpartition(': ')[2]} is not a number") from error


class Expression:
    """A column, or a formula in columns, numbers and log, exp, sqrt, abs: "log(1 + end.displacement_x / 0.01)"."""

    def __init__(self, text):
        self.text = text
        try:
            self._tree, self._problem = ast.parse(text.strip(), mode="eval").body, ""
            self._check(self._tree)
        except (SyntaxError, ValueError, RecursionError, MemoryError):
            self._problem = f"{text!r} is neither a column nor a formula"
        except Problem as error:
            self._problem = str(error)

    def __call__(self, columns):
        """Values in all rows. Raises Problem for what is no formula in these columns."""
        if self.text in columns:
            return columns[self.text]
        if self._problem:
            raise Problem(f"{self._problem} (columns: {', '.join(columns)})")
        with np.errstate(all="ignore"):
            value = np.asarray(self._value(self._tree, columns), dtype=float)
        return np.broadcast_to(value, np.shape(next(iter(columns.values()))))

    def _check(self, node):
        number = isinstance(node, ast.Constant) and type(node.value) in (int, float)
        if number or isinstance(node, (ast.Name, ast.Attribute)):
            return
        if isinstance(node, ast.BinOp) and type(node.op) in OPERATORS:
            parts = [node.left, node.right]
        elif isinstance(node, ast.UnaryOp) and type(node.op) in OPERATORS:
            parts = [node.operand]
        elif (isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.func.id in FUNCTIONS
              and len(node.args) == 1 and not node.keywords):
            parts = node.args
        else:
            raise Problem(f"{self.text!r} has {ast.unparse(node)!r} (allowed: columns, numbers, + - * / **, "
                          f"{', '.join(FUNCTIONS)} of one value)")
        for part in parts:
            self._check(part)

    def _value(self, node, columns):
        if isinstance(node, ast.Constant):
            return np.float64(node.value)
        if isinstance(node, ast.BinOp):
            return OPERATORS[type(node.op)](self._value(node.left, columns), self._value(node.right, columns))
        if isinstance(node, ast.UnaryOp):
            return OPERATORS[type(node.op)](self._value(node.operand, columns))
        if isinstance(node, ast.Call):
            return FUNCTIONS[node.func.id](self._value(node.args[0], columns))
        name = ast.unparse(node)
        if name not in columns:
            raise Problem(f"{self.text!r} names {name!r}, which is no column (there are: {', '.join(columns)})")
        return columns[name]


def interpolate(x, y, at):
    """y over x at other places. x must rise or fall; raises ValueError if it turns back."""
    if x[-1] < x[0]:
        x, at = -x, -at
    front = np.maximum.accumulate(x)
    if np.max(front - x) > BACKWARD * (x.max() - x.min()):
        raise ValueError("its x turns back - compare over something that only rises, such as time")
    rising = np.concatenate(([True], np.diff(front) > 0))
    return np.interp(at, x[rising], y[rising])
