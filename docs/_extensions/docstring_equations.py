"""Sets the indented equations of docstrings as they stand, in a fixed-width block, and keeps the
first sentence of an attribute whole."""

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


def join_sentence(lines: list[str]) -> list[str]:
    """The lines of an attribute with what stands before its first colon back in its sentence.

    Napoleon takes "Density [kg/m^3]: at T_0." for a type and a text; types are annotations here.
    """
    taken = next((line for line in lines if line.startswith(":type: ")), None)
    if taken is None:
        return lines
    first, *rest = [line for line in lines if line is not taken]
    return [f"{taken.removeprefix(':type: ')}: {first}", *rest]


def process_attribute(_app, what, _name, _object, _options, lines: list[str]) -> None:
    """Handler of `autodoc-process-docstring`, for what has no sections."""
    if what in ("attribute", "data", "property"):
        lines[:] = join_sentence(lines)


def setup(app: Any) -> dict[str, bool]:
    """Called by Sphinx; before napoleon reads the sections, and after."""
    app.connect("autodoc-process-docstring", process, priority=400)
    app.connect("autodoc-process-docstring", process_attribute, priority=600)
    return {"parallel_read_safe": True}
