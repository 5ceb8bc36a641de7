"""The overview of validations, from their records: what failed and why, then all with state."""

import re
from collections.abc import Mapping, Sequence
from typing import Any

from lasersph.validation.records import State

CHARTS = """<div class="chart">

![Every judged number](generated/validation-overview.svg)

</div>

*A point is one judged number, by how far it lies from its reference in units of its tolerance: left
of the line it is met. Statements that hold or not have no distance; they stand in the tables only.
Points at the left border agree to 1e-4 of the tolerance or better.*"""
NOT_MET = "## Not met"
UNEXPLAINED = "Why it fails is not explained yet."


def validation_table(states: Sequence[State], readmes: Mapping[str, str]) -> str:
    """Rows that are not met and why, then a table of all validations, each with a link to its page.

    readmes: by name of the validation.
    """
    rows = [
        (
            f"[{state.name}](#{anchor(state)})",
            _title(readmes[state.name]),
            _count(state.record),
            state.record["computed"]["date"] if state.record else "",
            label(state),
        )
        for state in states
    ]
    failed = [state for state in states if state.word == "failed" or _missed(state)]
    parts = ["## What is not met"]
    parts += [_not_met(state, readmes[state.name]) for state in failed]
    parts += [] if failed else ["Every judged number lies within its band."]
    parts += ["## All validations"]
    parts += [table(("validation", "question", "numbers", "computed", "state"), rows), CHARTS]
    pages = "\n".join(f"generated/validation/{state.name}" for state in states)
    parts += [f"```{{toctree}}\n:hidden:\n\n{pages}\n```"]
    return "\n\n".join(parts) + "\n"


def _not_met(state: State, readme: str) -> str:
    """A failed validation: its numbers outside their bands, and the first word on the reason."""
    missed = _missed(state)
    count = f"{len(missed)} of {_judged_count(state.record)} numbers" if missed else state.text
    head = f"**[{state.name}](#{anchor(state)})**, {plain(count)}:"
    listed = "".join(f"- {_missed_words(row)}\n" for row in missed)
    return f"{head}\n\n{listed}\nWhy: {_reason(readme)}"


def _missed(state: State) -> list[dict[str, Any]]:
    """The judged rows outside their bands, as recorded, also where the record is stale."""
    rows = state.record["rows"] if state.record else ()
    return [row for row in rows if row["verdict"] is False and not row["own"]]


def _missed_words(row: dict[str, Any]) -> str:
    """A number that is not met, with what it is judged by."""
    wanted = row["reference"] if row["reference"] is not None else row["published"]
    unit = f" {plain(row['unit'])}" if row["unit"] not in ("", "1") else ""
    if isinstance(wanted, str) or isinstance(row["computed"], str) or wanted is None:
        return f"{plain(row['quantity'])}: does not hold"
    return (
        f"{plain(row['quantity'])} is {number(row['computed'])}{unit}, not {number(wanted)}{unit}"
    )


def _reason(readme: str) -> str:
    """The first sentence of what a README says under *Not met*, lists and tables left out."""
    told = readme.partition(NOT_MET)[2].partition("\n## ")[0]
    for paragraph in told.split("\n\n"):
        text = " ".join(paragraph.split())
        if text and not text.startswith("|") and not text.endswith(":"):
            return text.partition(". ")[0].removesuffix(".") + "."
    return UNEXPLAINED


def anchor(state: State) -> str:
    """Label of the page of a validation."""
    return f"validation-{state.name}"


def _title(readme: str) -> str:
    return plain(readme.partition("\n")[0].removeprefix("# "))


def label(state: State) -> str:
    """The state; what is not as it should be stands out."""
    if state.word == "confirmed" and state.record is not None:
        return f"confirmed on {state.record['confirmed']['date']}"
    return state.word if state.word == "current" else f"**{state.word}**"


def _count(record: dict[str, Any] | None) -> str:
    """How many numbers are judged and met, and how many are not judged."""
    if record is None:
        return ""
    verdicts = [row["verdict"] for row in record["rows"]]
    judged = _judged_count(record)
    return f"{verdicts.count(True)} of {judged} met, {verdicts.count(None)} shown"


def _judged_count(record: dict[str, Any] | None) -> int:
    """How many numbers are judged."""
    return sum(row["verdict"] is not None for row in record["rows"]) if record else 0


def number(value: float | str | None) -> str:
    """A number to six digits, a text without meaning to Markdown, nothing for None."""
    if value is None:
        return ""
    return plain(value) if isinstance(value, str) else f"{value:.6g}"


def plain(text: str) -> str:
    """Text whose characters mean nothing to Markdown."""
    return re.sub(r"([|*<>$\[\]`\\])", r"\\\1", text)


def prose(text: str) -> str:
    """Text as above, whose names between backticks stay code."""
    parts = text.split("`")
    if len(parts) % 2 == 0:
        return plain(text)
    return "".join(f"`{part}`" if k % 2 else plain(part) for k, part in enumerate(parts))


def table(head: tuple[str, ...], rows: list[tuple[str, ...]]) -> str:
    """A table of cells that are Markdown."""
    lines = [head, ("---",) * len(head), *rows]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines)
