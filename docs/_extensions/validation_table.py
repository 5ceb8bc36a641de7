"""The page of validations, from their records: every one with its state, none left out."""

import re
from collections.abc import Mapping, Sequence
from typing import Any

from validation_charts import judged

from lasersph.validation.records import State

CHARTS = """![Every judged number](generated/validation-overview.svg)

*A point is one judged number, by how far it lies from its reference in units of its tolerance: left
of the line it is met. Statements that hold or not have no distance; they stand in the tables only.
Points at the left border agree to 1e-4 of the tolerance or better.*"""
NOT_MET = "## Not met"
HEAD = ("quantity", "published", "reference", "computed", "tolerance", "verdict")
VERDICTS = {True: "ok", False: "**FAILED**", None: "shown"}


def validation_table(states: Sequence[State], readmes: Mapping[str, str]) -> str:
    """An overview, then one section a validation: state, README, remarks, numbers, figures.

    readmes: by name of the validation.
    """
    rows = [
        (
            f"[](#{_anchor(state)})",
            _title(readmes[state.name]),
            _count(state.record),
            state.record["computed"]["date"] if state.record else "",
            label(state),
        )
        for state in states
    ]
    parts = [table(("validation", "question", "numbers", "computed", "state"), rows), CHARTS]
    for state in states:
        parts += _section(state, readmes[state.name])
    return "\n\n".join(part for part in parts if part) + "\n"


def readme_text(readme: str) -> str:
    """A README as text of a section: its title as the first line, its heads as first words."""
    title, _, text = readme.partition("\n")
    return title.removeprefix("# ") + "\n" + re.sub(r"^## (.+)\n", r"**\1.** ", text, flags=re.M)


def _section(state: State, readme: str) -> list[str]:
    record = state.record
    head = f"({_anchor(state)})=\n## {state.name}"
    said = ": ".join(text for text in (label(state), plain(state.text)) if text)
    parts = [head, said + ".", readme_text(readme)]
    if state.word == "failed" and NOT_MET not in readme:
        parts.append("Why it fails is not explained yet.")
    if record is None:
        return parts
    made, notes = record["computed"], _notes(record["rows"])
    version = f"lasersph {made['lasersph']}" + (f", {made['commit']}" if made["commit"] else "")
    threads = f"threads: {made['threads'] or 'all'}"
    parts.append(
        f"*{_duration(record['seconds'])} on {made['machine']}, {threads}; {version}, "
        f"{made['date']}.*"
    )
    parts.append("\n".join(f"- {plain(remark)}" for remark in record["remarks"]))
    if judged(record):
        chart = f"generated/validation-{state.name}.svg"
        parts.append(f"![{state.name}: difference over tolerance]({chart})")
    if record["rows"]:
        parts.append(table(HEAD, [_cells(row, notes) for row in record["rows"]]))
    parts.append("\n".join(f"- ({k}) {plain(text)}" for text, k in notes.items()))
    parts += [f"![{state.name}](validation/{state.name}/{file})" for file in record["figures"]]
    return parts


def _anchor(state: State) -> str:
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
    judged = len(verdicts) - verdicts.count(None)
    return f"{verdicts.count(True)} of {judged} met, {verdicts.count(None)} shown"


def _duration(seconds: float | None) -> str:
    if seconds is None:
        return "In a time that was not noted"
    if seconds < 90.0:
        return f"{seconds:.0f} s"
    return f"{seconds / 60.0:.0f} min" if seconds < 5400.0 else f"{seconds / 3600.0:.1f} h"


def _note(row: dict[str, Any]) -> str:
    """Why the band of a row is so wide, and what it was before."""
    changed = f"Changed: {row['changed']}" if row["changed"] else ""
    return " ".join(text for text in (row["reason"], changed) if text)


def _notes(rows: list[dict[str, Any]]) -> dict[str, int]:
    """Numbers of the notes to the rows."""
    texts = dict.fromkeys(note for row in rows if (note := _note(row)))
    return {text: k for k, text in enumerate(texts, start=1)}


def _cells(row: dict[str, Any], notes: dict[str, int]) -> tuple[str, ...]:
    unit = f" [{row['unit']}]" if row["unit"] not in ("", "1") else ""
    tolerance = "" if row["tolerance"] is None else f"{row['tolerance']:.3g}"
    note = f"({notes[_note(row)]})" if _note(row) else ""
    numbers = (number(row[key]) for key in ("published", "reference", "computed"))
    verdict = "own" if row["own"] else VERDICTS[row["verdict"]]
    return plain(row["quantity"] + unit), *numbers, f"{tolerance} {note}".strip(), verdict


def number(value: float | str | None) -> str:
    """A number to six digits, a text without meaning to Markdown, nothing for None."""
    if value is None:
        return ""
    return plain(value) if isinstance(value, str) else f"{value:.6g}"


def plain(text: str) -> str:
    """Text whose characters mean nothing to Markdown."""
    return re.sub(r"([|*<>$\[\]`\\])", r"\\\1", text)


def table(head: tuple[str, ...], rows: list[tuple[str, ...]]) -> str:
    """A table of cells that are Markdown."""
    lines = [head, ("---",) * len(head), *rows]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines)
