"""A page for each validation, from its record: figure, question, numbers, what made it."""

import re
from typing import Any

from validation_charts import judged, share_of
from validation_table import NOT_MET, UNEXPLAINED, anchor, label, number, plain, prose, table

from lasersph.validation.records import State

HEAD = ("quantity", "published", "reference", "computed", "tolerance", "verdict")
VERDICTS = {True: "ok", False: "**FAILED**", None: "shown"}
ROUND_OFF = 1e-9
"""Below it a number whose reference is 0 is 0, in its unit: sums of a few thousand terms of order 1
end at 1e-13."""
FEW = 8
"""Rows that are not folded, whatever they say: a table this short hides nothing."""
MOST_OPEN = 16
"""Rows that are open: a screen of them. Of more the ones stay that use most of their tolerance."""


def validation_page(state: State, readme: str) -> str:
    """State and figure first, then the README, the judged numbers, the folded ones and figures."""
    record = state.record
    title, text = readme_text(readme)
    said = ": ".join(words for words in (label(state), plain(_said(state))) if words)
    parts = [f"({anchor(state)})=\n# {state.name}", f"{title} ({said}.)"]
    figures = [_figure(state, file) for file in record["figures"]] if record else []
    parts += figures[:1]
    parts.append(f'<div class="readme">\n\n{text}\n\n</div>')
    if state.word == "failed" and NOT_MET not in readme:
        parts.append(UNEXPLAINED)
    if record is None:
        return _joined(parts)
    parts.append("\n".join(f"- {prose(remark)}" for remark in record["remarks"]))
    parts += _numbers(state, record)
    parts += figures[1:]
    parts.append(_origin(record))
    return _joined(parts)


def _said(state: State) -> str:
    """When it was computed, what failed, and which cases and how many modules changed since."""
    cases = [change for change in state.changes if not change.startswith("lasersph")]
    modules = len(state.changes) - len(cases)
    counted = [f"{modules} module{'s' * (modules > 1)} of the program"] if modules else []
    changed = ["changed since: " + ", ".join(cases + counted)] if state.changes else []
    return "; ".join([*state.outcome, *changed])


def _joined(parts: list[str]) -> str:
    return "\n\n".join(part for part in parts if part) + "\n"


def readme_text(readme: str) -> tuple[str, str]:
    """Title of a README, and its text with its heads as first words."""
    title, _, text = readme.partition("\n")
    text = re.sub(r"^## (.+)\n(?=[|-])", r"**\1.**\n\n", text, flags=re.M)  # tables and lists
    return title.removeprefix("# "), re.sub(r"^## (.+)\n", r"**\1.** ", text, flags=re.M).strip()


def _figure(state: State, file: str) -> str:
    return f"![{state.name}](../../validation/{state.name}/{file})"


def _origin(record: dict[str, Any]) -> str:
    """How long it took, where and with what."""
    made = record["computed"]
    threads = f"threads: {made['threads'] or 'all'}"
    return (
        f"*{_duration(record['seconds'])} on {made['machine']}, {threads}; "
        f"lasersph {made['lasersph']}, {made['date']}.*"
    )


def _numbers(state: State, record: dict[str, Any]) -> list[str]:
    """The judged numbers; folded are those far inside their tolerance, equal and shown ones."""
    rows, notes = record["rows"], _notes(record["rows"])
    judged_rows = [row for row in rows if row["verdict"] is not None and not row["own"]]
    shown = [row for row in rows if row["verdict"] is None or row["own"]]
    equal = [row for row in judged_rows if row["verdict"] and _is_equal(row)]
    if len(judged_rows) <= FEW:
        equal = []
    parts = ["## Numbers"]
    if judged(record):
        chart = f"![{state.name}: difference over tolerance](../validation-{state.name}.svg)"
        parts.append(f'<div class="chart">\n\n{chart}\n\n</div>')
    unequal = [row for row in judged_rows if row not in equal]
    open_rows, near = _worst(unequal)
    if open_rows:
        parts.append(_table(open_rows, notes))
    groups = {
        "judged, which use less of their tolerance": near,
        "judged and equal in every digit shown": equal,
        "not judged": shown,
    }
    for words, group in groups.items():
        if group:
            parts.append(_folded(f"{len(group)} more numbers, {words}", _table(group, notes)))
    parts.append("\n".join(f"- ({k}) {prose(text)}" for text, k in notes.items()))
    return parts


def _worst(rows: list[dict[str, Any]]) -> tuple[list[dict[str, Any]], list[dict[str, Any]]]:
    """The rows that stay open, in their order, and the others.

    Open are what failed and what is judged otherwise than by a difference, then those with the
    largest difference over tolerance.
    """
    if len(rows) <= MOST_OPEN + FEW:
        return rows, []
    shares = [share_of(row) for row in rows]
    ranks = [2.0 if not row["verdict"] else 1.5 if share is None else share
             for row, share in zip(rows, shares, strict=True)]  # fmt: skip
    least = sorted(ranks, reverse=True)[MOST_OPEN - 1]
    pairs = list(zip(rows, ranks, strict=True))
    far = [row for row, rank in pairs if rank < least]
    return [row for row, rank in pairs if rank >= least], far


def _table(rows: list[dict[str, Any]], notes: dict[str, int]) -> str:
    """The numbers without empty columns, in a box whose rows a telephone stacks."""
    columns = list(zip(HEAD, *(_cells(row, notes) for row in rows), strict=True))
    head, *cells = zip(*(column for column in columns if any(column[1:])), strict=True)
    return f'<div class="numbers">\n\n{table(head, cells)}\n\n</div>'


def _is_equal(row: dict[str, Any]) -> bool:
    """Whether a number and what it is judged by are printed alike, or are 0 to round-off."""
    wanted = row["reference"] if row["reference"] is not None else row["published"]
    if wanted == 0.0 and isinstance(row["computed"], int | float):
        return abs(row["computed"]) < ROUND_OFF
    return number(row["computed"]) == number(wanted)


def _folded(words: str, inner: str) -> str:
    return f"<details><summary>{words}</summary>\n\n{inner}\n\n</details>"


def _duration(seconds: float | None) -> str:
    if seconds is None:
        return "In a time that was not noted"
    if seconds < 90.0:
        return f"{seconds:.0f} s"
    return f"{seconds / 60.0:.0f} min" if seconds < 5400.0 else f"{seconds / 3600.0:.1f} h"


def _note(row: dict[str, Any]) -> str:
    """Why the band of a row is so wide, and what it was before."""
    changed = f"changed: {row['changed']}" if row["changed"] else ""
    return "; ".join(text for text in (row["reason"].removesuffix("."), changed) if text)


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
