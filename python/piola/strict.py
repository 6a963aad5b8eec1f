# SPDX-License-Identifier: Apache-2.0
"""Objects that refuse attributes they do not know, so that a typo does not pass in silence."""
from __future__ import annotations

import difflib
from typing import Any, Iterable


def advice(name: str, known: Iterable[str]) -> str:
    """What to do about an unknown name: the nearest known one, capitals aside, or all of them. Columns such as
    "top.twist_angle" are also near to the name of their probe."""
    known = list(known)
    lower = {each.lower().partition(".")[0]: each for each in reversed(known)}
    lower.update({each.lower(): each for each in reversed(known)})
    near = difflib.get_close_matches(name.lower(), lower, n=1)
    return f"did you mean {lower[near[0]]!r}?" if near else f"choose one of {', '.join(known) or 'none'}"


class Strict:
    """Base of the classes of this package. `_settable` names the attributes that a user may set; those that begin with
    an underscore are the class's own. Setting any other one raises AttributeError with the nearest name."""
    _settable: tuple = ()

    def __setattr__(self, name: str, value: Any) -> None:
        if name.startswith("_") or name in self._settable:
            object.__setattr__(self, name, value)
            return
        kind = type(self).__name__
        can = f"(allowed: {', '.join(self._settable) or 'none'})"
        if hasattr(type(self), name):
            raise AttributeError(f"{name!r} of {kind} cannot be set {can} - only read it")
        public = [each for each in dir(type(self)) if not each.startswith("_")]
        raise AttributeError(f"{kind} has no attribute {name!r} to set {can} - "
                             f"{advice(name, self._settable or public)}")
