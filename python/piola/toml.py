# SPDX-License-Identifier: Apache-2.0
"""Python values as TOML, the language of case files."""
import json
import math


def value_text(value) -> str:
    """One value in one line: numbers, texts, truth values, lists and dicts of them, numpy's numbers and arrays.

    Raises ValueError for numbers that are not finite, TypeError for what TOML has no word for.
    """
    if hasattr(value, "tolist"):  # numpy
        value = value.tolist()
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, int):
        return str(value)
    if isinstance(value, float):
        if not math.isfinite(value):
            raise ValueError(f"{value} cannot stand in a case: a finite number is needed")
        return repr(value)
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(value_text(item) for item in value) + "]"
    if isinstance(value, dict):
        return "{" + ", ".join(f"{key_text(key)} = {value_text(item)}" for key, item in value.items()) + "}"
    raise TypeError(f"a {type(value).__name__} cannot stand in a case (numbers, texts, truth values, lists, dicts can)")


def key_text(key: str) -> str:
    """A key, in quotes if it needs them."""
    plain = key and all(c.isascii() and (c.isalnum() or c in "_-") for c in key)
    return key if plain else json.dumps(key)


def document_text(case: dict) -> str:
    """A whole case: dicts become sections, lists of dicts sections that repeat, one line each for the rest."""
    lines, sections = [], []
    for key, value in case.items():
        if isinstance(value, dict):
            sections += ["", f"[{key_text(key)}]"] + _entries(value)
        elif isinstance(value, (list, tuple)) and value and all(isinstance(item, dict) for item in value):
            for item in value:
                sections += ["", f"[[{key_text(key)}]]"] + _entries(item)
        else:
            lines.append(f"{key_text(key)} = {value_text(value)}")
    return "\n".join(lines + sections) + "\n"


def _entries(table: dict) -> list:
    return [f"{key_text(key)} = {value_text(value)}" for key, value in table.items()]
