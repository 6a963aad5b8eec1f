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


def read_columns(path):
    """The columns of a CSV file by name, and their units as in "force [kN]"; lines with # are left out."""
    try:
        with open(path, newline="", encoding="utf-8") as file:
            rows = list(csv.reader(line for line in file if line.strip() and not line.startswith("#")))
    except (OSError, UnicodeDecodeError) as error:
        raise Problem(f"{path} cannot be read ({error})") from error
    if len(rows) < 2:
        raise Problem(f"{path} has {len(rows)} lines (needed: a header and numbers)")
    units = {}
    for title in rows[0]:
        match = re.fullmatch(r"\s*(.*?)\s*(?:\[(.*)\])?\s*", title)
        units[match[1]] = match[2] or ""
    names = list(units)
    columns = {name: [] for name in names}
    for number, row in enumerate(rows[1:], 2):
        if len(row) != len(rows[0]):
            raise Problem(f"{path}, row {number}: {len(row)} numbers for {len(rows[0])} columns")
        for name, text in zip(names, row):
            try:
                columns[name].append(float(text))
            except ValueError as error:
                raise Problem(f"{path}, row {number}: {text!r} is not a number") from error
    return {name: np.array(values) for name, values in columns.items()}, units


class Expression:
    """A column, or a formula in columns, numbers and log, exp, sqrt, abs: "log(1 + end.displacement_x / 0.01)"."""

    def __init__(self, text):
        self.text = text
        try:
            self._tree = ast.parse(text, mode="eval").body
        except SyntaxError as error:
            raise Problem(f"{text!r} is not a formula ({error.msg})") from error

    def __call__(self, columns):
        return np.asarray(self._value(self._tree, columns), dtype=float)

    def _value(self, node, columns):
        if isinstance(node, ast.Constant) and isinstance(node.value, (int, float)):
            return node.value
        if isinstance(node, (ast.Name, ast.Attribute)):
            return self._column(ast.unparse(node), columns)
        if isinstance(node, ast.BinOp) and type(node.op) in OPERATORS:
            return OPERATORS[type(node.op)](self._value(node.left, columns), self._value(node.right, columns))
        if isinstance(node, ast.UnaryOp) and type(node.op) in OPERATORS:
            return OPERATORS[type(node.op)](self._value(node.operand, columns))
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.func.id in FUNCTIONS:
            return FUNCTIONS[node.func.id](*(self._value(argument, columns) for argument in node.args))
        raise Problem(f"{self.text!r} has {ast.unparse(node)!r} (allowed: columns, numbers, + - * / **, "
                      f"{', '.join(FUNCTIONS)})")

    def _column(self, name, columns):
        if name not in columns:
            raise Problem(f"{self.text!r} names {name!r}, which is no column (there are: {', '.join(columns)})")
        return columns[name]


def interpolate(x, y, at):
    """y over x at other places. x must rise."""
    if np.any(np.diff(x) <= 0):
        rising = np.concatenate(([True], np.diff(np.maximum.accumulate(x)) > 0))
        x, y = x[rising], y[rising]
    return np.interp(at, x, y)
