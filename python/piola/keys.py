# SPDX-License-Identifier: Apache-2.0
"""Values of a case by key, with advice from the schema of case files."""
from __future__ import annotations

import copy
import functools
import json
import os
from typing import Any, Dict, List

from . import _piola
from .errors import UnknownName
from .strict import advice


def value_at(values: Dict[str, Any], key: str) -> Any:
    """A copy of the value that a key of --set names ("body.column.material.density").

    Raises KeyError with the nearest valid name, TypeError for what is no text.
    """
    if not isinstance(key, str):
        raise TypeError(f"{key!r} is no key of a case - write a text such as case['run.end']")
    at, known, where, absent = values, [_schema()], [], ""
    for step in (part.strip() for part in key.split(".")):
        keys = {name: entry for each in known for name, entry in each.get("properties", {}).items()}
        if isinstance(at, list):
            at = _item(at, step, key, ".".join(where))
        elif isinstance(at, dict) and step in at:
            at, known = at[step], _below(known, step)
        elif isinstance(at, dict) and step in keys:  # may stand here; the rest of the key is checked, too
            absent = absent or _not_given(keys[step], step, key)
            at, known = {}, _below(known, step)
        elif absent and known[0].get("type") == "array":
            break
        else:
            raise UnknownName(_no_key(at, keys, step, key, ".".join(where)))
        where.append(step)
    if absent:
        raise UnknownName(absent)
    return copy.deepcopy(at)


def _item(items: list, step: str, key: str, where: str) -> Any:
    """An item of a list by its number or its name."""
    if step.isdecimal():
        if int(step) < len(items):
            return items[int(step)]
        raise UnknownName(f"{key}: {where!r} has {len(items)} item(s), which count from 0 - use a smaller number")
    names = [item["name"] for item in items if isinstance(item, dict) and "name" in item]
    for item in items:
        if isinstance(item, dict) and item.get("name") == step:
            return item
    what = advice(step, names) if names else "use a number from 0 on"
    raise UnknownName(f"{key}: no {where} has the name {step!r} - {what}")


def _not_given(described: dict, step: str, key: str) -> str:
    _, default, text = described.get("description", "").partition("Default: ")
    then = f"; its default is {text}" if default else ""
    return f"{key}: the case does not give {step!r}{then} - case[{key!r}] = ... sets it"


def _no_key(at: Any, keys: Dict[str, dict], step: str, key: str, where: str) -> str:
    if not isinstance(at, dict):
        return f"{key}: {where!r} is the single value {at!r} - shorten the key"
    if not at and not keys:
        return f"{key}: {where!r} is a single value - shorten the key"
    place = repr(where) if where else "a case"
    return f"{key}: {step!r} is no key of {place} - {advice(step, dict.fromkeys([*at, *keys]))}"


def _below(known: List[dict], step: str) -> List[dict]:
    """What the schema says of an entry, or of the items if this is a list: all alternatives that it allows."""
    found = []
    for each in known:
        if step in each.get("properties", {}):
            found += _alternatives(each["properties"][step])
    return found


def _alternatives(entry: dict) -> List[dict]:
    """An entry of the schema with references, combinations and lists resolved."""
    if "$ref" in entry:
        return _alternatives(_schema()["definitions"][entry["$ref"].rpartition("/")[2]])
    parts = [part for how in ("allOf", "anyOf", "oneOf") for part in entry.get(how, [])]
    if isinstance(entry.get("items"), dict):
        parts.append(entry["items"])
    return [entry] + [found for part in parts for found in _alternatives(part)]


@functools.lru_cache(maxsize=None)
def _schema() -> dict:
    return json.loads(_piola.case_schema())


def with_absolute_files(value: Any, folder: str) -> Any:
    """Values of a case in which the files that it names have absolute paths; relative ones start from `folder`."""
    def absolute(name):
        return os.path.join(folder, name) if isinstance(name, str) else name

    if isinstance(value, list):
        return [with_absolute_files(item, folder) for item in value]
    if not isinstance(value, dict):
        return value
    changed = {key: with_absolute_files(entry, folder) for key, entry in value.items()}
    for key in ("file", "library"):
        if isinstance(changed.get(key), list):
            changed[key] = [absolute(name) for name in changed[key]]
        elif key in changed:
            changed[key] = absolute(changed[key])
    return changed
