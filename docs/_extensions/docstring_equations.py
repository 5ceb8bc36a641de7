"""Sets the indented equations of docstrings as they stand, in a fixed-width block."""

import re
from typing import Any

SECTION = re.compile(r"(Args|Attributes|Returns|Raises|Yields|Example|Examples):$")


def set_equations(lines: list[str]) -> list[str]:
    """The lines with `::` before every indented block outside Args, Returns and the like.

    Elsewhere the bars of |x| are escaped, which reStructuredText takes for substitutions.
    """
    found: list[str] = []
    in_section = in_block = False
    for line in lines:
        if line and not line.startswith(" "):
            in_section, in_block = bool(SECTION.match(line)), False
        starts = line.startswith("    ") and bool(found) and not found[-1]
        if starts and not in_section and not in_block:
            found += ["::", ""]
            in_block = True
        found.append(line if in_block else line.replace("|", r"\|"))
    return found


def process(_app, _what, _name, _object, _options, lines: list[str]) -> None:
    """Handler of `autodoc-process-docstring`."""
    lines[:] = set_equations(lines)


def setup(app: Any) -> dict[str, bool]:
    """Called by Sphinx; before napoleon reads the sections."""
    app.connect("autodoc-process-docstring", process, priority=400)
    return {"parallel_read_safe": True}
