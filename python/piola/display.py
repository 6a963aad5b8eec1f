# SPDX-License-Identifier: Apache-2.0
"""Tables that notebooks show."""
import html
from typing import Any, Mapping


def html_table(title: str, rows: Mapping[str, Any]) -> str:
    """A heading and a table with a row for each entry; empty entries are left out."""
    lines = "".join(f"<tr><th style='text-align:left'>{html.escape(str(name))}</th>"
                    f"<td style='text-align:left'>{html.escape(str(value))}</td></tr>"
                    for name, value in rows.items() if value not in ("", None))
    return f"<b>{html.escape(title)}</b><table>{lines}</table>"
