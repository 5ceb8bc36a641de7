"""Markdown of docs/papers.md: what both papers print beside what the validations recorded."""

import tomllib
from collections import Counter
from collections.abc import Mapping
from decimal import Decimal
from pathlib import Path
from typing import Any

from validation_table import State, label, number, plain, table

TITLES = {
    "ablation": "Alshaer, Rogers & Li 2017: pulsed heating and ablation of aluminum",
    "texturing": "Demuth & Lasagni 2020: interference patterning of steel and aluminum",
}
HEAD = ("number", "paper", "ours", "verdict")
REPRODUCED, DIFFERS, NOT_MET, NOT_GIVEN, OWN, MISSING = (
    "reproduced",
    "differs",
    "**not met**",
    "not given",
    "own",
    "missing",
)
Part = dict[str, Any]
"""One `[[ablation]]` or `[[texturing]]` of docs/papers.toml."""
Entry = Mapping[str, Any]
"""One row of a part. `by` names one row or several, of the validation `of` where it is another."""
Row = dict[str, Any]
"""One row of a record."""


def read_papers(file: Path) -> dict[str, list[Part]]:
    """Parts of both papers."""
    return tomllib.loads(file.read_text(encoding="utf-8"))


def row_named(state: State | None, beginning: str) -> Row | None:
    """The recorded row of that quantity, else the only one that begins so; None where none does.

    Raises:
        ValueError: several rows begin so.
    """
    rows = state.record["rows"] if state and state.record else []
    found = [row for row in rows if row["quantity"].startswith(beginning)]
    found = [row for row in found if row["quantity"] == beginning] or found
    if len(found) > 1:
        raise ValueError(f"{len(found)} rows begin with {beginning!r}")
    return found[0] if found else None


def papers_page(papers: Mapping[str, list[Part]], states: Mapping[str, State]) -> str:
    """One section a paper: how often which verdict, then a head for each figure or table.

    states: of all validations by name.
    """
    texts = []
    for paper, title in TITLES.items():
        parts = papers[paper]
        counts = Counter(
            verdict(entry, states[part["validation"]], states)[0]
            for part in parts
            for entry in entries(part, states)
        )
        counts[NOT_GIVEN] += sum("missing" in part for part in parts)
        said = ", ".join(f"{count} {word}" for word, count in counts.items())
        texts += [f"## {title}", f"Numbers: {said}."]
        texts += [text for part in parts for text in section(part, states)]
    return "\n\n".join(texts) + "\n"


def entries(part: Part, states: Mapping[str, State]) -> list[dict[str, Any]]:
    """Entries of a part; one with `all` stands for every row whose name has these words.

    Rows that an entry names by itself, and rows that judge nothing for themselves, are left out.
    """
    given = part.get("rows", ())
    state = states[part["validation"]] if given else None
    rows = state.record["rows"] if state and state.record else []
    named = [row_named(state, entry["row"]) for entry in given if "row" in entry]
    found = []
    for entry in given:
        if "row" in entry:
            found.append(entry)
            continue
        more = [row for row in rows if entry["all"] in row["quantity"] and not row["own"]]
        found += [entry | {"row": row["quantity"]} for row in more if row not in named]
    return found


def section(part: Part, states: Mapping[str, State]) -> list[str]:
    """Head, command, figure, numbers, and what the paper does not give."""
    texts = [f"### {plain(part['where'])}", plain(part["what"]) + "."]
    state = states[part["validation"]] if "validation" in part else None
    if state is not None:
        texts[-1] += f" Command: `lasersph validate {state.name}`, record {label(state)}."
        files = [f"{name}.png" for name in part.get("figures", ())]
        drawn = state.record["figures"] if state.record else []
        alt = plain(part["where"])
        texts += [f"![{alt}](validation/{state.name}/{file})" for file in files if file in drawn]
    if part.get("rows"):
        found = [cells(entry, state, states) for entry in entries(part, states)]
        texts.append(table(HEAD, found))
    if part.get("missing"):
        texts.append(f"*Not given by the paper*: {prose(part['missing'])}.")
    return texts


def prose(text: str) -> str:
    """Plain text, but for code between backticks."""
    return plain(text).replace("\\`", "`")


def cells(entry: Entry, state: State | None, states: Mapping[str, State]) -> tuple[str, ...]:
    """What it is, the paper's number, ours, the verdict with its reason."""
    row = row_named(state, entry["row"])
    words = ": ".join(filter(None, verdict(entry, state, states)))
    if row is None:
        return plain(entry["row"]), "", "", words
    unit = f" [{row['unit']}]" if row["unit"] not in ("", "1", "SI") else ""
    paper = plain(entry["paper"]) if "paper" in entry else number(row["published"])
    return plain(row["quantity"] + unit), paper, number(row["computed"]), words


def reason(entry: Entry, state: State | None, states: Mapping[str, State]) -> str:
    """`because`, and the recorded numbers that show it."""
    names = entry.get("by", [])
    shown = states.get(entry.get("of", ""), state)
    rows = [row_named(shown, name) for name in ([names] if isinstance(names, str) else names)]
    numbers = [f"{row['quantity']}: {number(row['computed'])}" for row in rows if row]
    return entry.get("because", "") + (f" ({'; '.join(numbers)})" if numbers else "")


def verdict(
    entry: Entry, state: State | None, states: Mapping[str, State] | None = None
) -> tuple[str, str]:
    """The verdict on a row, and its reason: its band, or `because` and `by` of docs/papers.toml.

    A number for which the paper prints nothing is not reproduced, however near another reference.

    Raises:
        ValueError: a row that is not judged and does not agree, without `because`.
    """
    row = row_named(state, entry["row"])
    if row is None:
        return MISSING, "not recorded"
    changed = f"; changed: {row['changed']}" if row["changed"] else ""
    if row["own"]:
        return OWN, plain(f"our other result, or fitted{changed}")
    because = reason(entry, state, states or {})
    if because and row["verdict"] is not False:
        return REPRODUCED if agrees(row) else DIFFERS, prose(because)
    if row["verdict"] is None and agrees(row):
        return REPRODUCED, "a statement"
    if row["verdict"] is None:
        raise ValueError(f"{row['quantity']!r} is not judged: say why it differs")
    unit = "" if row["unit"] in ("", "1", "SI") else f" {row['unit']}"
    band = "" if row["tolerance"] is None else f"within {row['tolerance']:.3g}{unit}"
    reasons = "; ".join(filter(None, (band, row["reason"], because)))
    if row["verdict"] and row["published"] is None and "paper" not in entry:
        reasons = f"reference {number(row['reference'])} ({row['source']}); {reasons}"
        return NOT_GIVEN, prose(reasons + changed)
    return REPRODUCED if row["verdict"] else NOT_MET, prose(reasons + changed)


def agrees(row: Row) -> bool:
    """Whether a statement holds, or a number is the printed one in the digits that are printed."""
    found, printed = row["computed"], row["published"]
    if found == "holds" or not isinstance(printed, float):
        return found == "holds"
    exponent = Decimal(repr(printed)).as_tuple().exponent
    return isinstance(exponent, int) and round(found, -exponent) == printed
