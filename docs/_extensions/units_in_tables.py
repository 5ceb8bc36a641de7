"""Numbers in tables stay on one line with their units: narrow columns would part 186 and nm."""

import re
from typing import Any

from docutils import nodes

BREAK = re.compile(r"(?<=[0-9)]) (?=(?:%|°|[munkMG]?(?:m|s|g|J|K|N|W|B|Pa|iB)\b|µ[ms]|J/|W/|ms\b))")
"""The blank between a number and what looks like a unit."""
NO_BREAK = "\u00a0"


def keep_units(_app: Any, doctree: nodes.document) -> None:
    """Replace these blanks in the cells of all tables, but for what is to be typed."""
    for entry in doctree.findall(nodes.entry):
        for text in list(entry.findall(nodes.Text)):
            if not isinstance(text.parent, nodes.literal | nodes.math):
                text.parent.replace(text, nodes.Text(BREAK.sub(NO_BREAK, text)))


def setup(app: Any) -> dict[str, bool]:
    """Called by Sphinx."""
    app.connect("doctree-read", keep_units)
    return {"parallel_read_safe": True}
