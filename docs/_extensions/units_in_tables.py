"""Numbers in tables stay on one line: narrow columns would part 186 and nm, or 1e- and 06."""

import re
from typing import Any

from docutils import nodes

BREAK = re.compile(r"(?<=[0-9)]) (?=(?:%|°|[munkMG]?(?:m|s|g|J|K|N|W|B|Pa|iB)\b|µ[ms]|J/|W/|ms\b))")
"""The blank between a number and what looks like a unit."""
NO_BREAK = "\u00a0"
MAY_BREAK = "\u200b"
"""Blank without a width: a narrow column parts a number before its power, not within it."""
POWER = re.compile(r"(?<![\w.])(\d+(?:\.\d+)?)e([+-]?)0*(\d+)\b")
"""A number as programs print it, 1.7e-06: its factor, the sign and the digits of its power."""
RAISED = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


def with_power(found: re.Match[str]) -> str:
    """1.7·10⁻⁶ for 1.7e-06, 10³ for 1e+03."""
    factor, sign, digits = found.groups()
    power = f"10{(sign.removeprefix('+') + digits).translate(RAISED)}"
    return power if factor == "1" else f"{factor}{MAY_BREAK}·{power}"


def keep_units(_app: Any, doctree: nodes.document) -> None:
    """Replace these blanks and powers in the cells of all tables, but for what is to be typed."""
    for entry in doctree.findall(nodes.entry):
        for text in list(entry.findall(nodes.Text)):
            if not isinstance(text.parent, nodes.literal | nodes.math):
                whole = POWER.sub(with_power, BREAK.sub(NO_BREAK, text))
                text.parent.replace(text, nodes.Text(whole))


def setup(app: Any) -> dict[str, bool]:
    """Called by Sphinx."""
    app.connect("doctree-read", keep_units)
    return {"parallel_read_safe": True}
