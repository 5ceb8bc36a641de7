"""Pages of both papers: what they print beside what the validations recorded.

docs/papers.md has the overview, docs/papers/PAPER.md every figure, table and number of one.
"""

import tomllib
from collections import Counter
from collections.abc import Mapping
from decimal import Decimal
from pathlib import Path
from typing import Any

from validation_table import State, label, number, plain, table

from lasersph.plots import style

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
IN_PART = "in part"
WHOLES = (REPRODUCED, IN_PART, DIFFERS, NOT_MET, NOT_GIVEN)
"""Verdicts on a figure, table or section: all of its numbers, some, none, one is not met, no number
is printed."""
LOOKS = dict(zip(WHOLES, ("#009E73", "#56B4E9", "#E69F00", "#D55E00", "0.8"), strict=True))
"""Color of each, of those that color-blind readers tell apart."""
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


def part_verdicts(part: Part, states: Mapping[str, State]) -> Counter[str]:
    """How often which verdict was given on the numbers of a figure, table or section."""
    counts: Counter[str] = Counter()
    if part.get("rows"):
        state = states[part["validation"]]
        counts.update(verdict(entry, state, states)[0] for entry in entries(part, states))
    return counts


def whole_verdict(counts: Counter[str]) -> str:
    """The verdict on a figure, table or section from those on its numbers."""
    judged = {word for word in counts if word not in (OWN, NOT_GIVEN)}
    if not judged:
        return NOT_GIVEN
    if NOT_MET in judged or MISSING in judged:
        return NOT_MET
    if judged == {REPRODUCED}:
        return REPRODUCED
    return IN_PART if REPRODUCED in judged else DIFFERS


def overview(papers: Mapping[str, list[Part]], states: Mapping[str, State]) -> str:
    """How many figures, tables and sections agree, by paper, and the list of them with links."""
    texts, rows = [], []
    for paper, title in TITLES.items():
        counts = [part_verdicts(part, states) for part in papers[paper]]
        wholes = Counter(whole_verdict(one) for one in counts)
        rows.append((f"[{title}](papers/{paper}.md)", *(str(wholes[word]) for word in WHOLES)))
        texts.append(f"## {title}")
        lines = [
            (
                f"[{plain(part['where'])}](#{anchor(paper, k)})",
                plain(part["what"]),
                whole_verdict(one),
                ", ".join(f"{count} {word}" for word, count in one.items()),
            )
            for k, (part, one) in enumerate(zip(papers[paper], counts, strict=True))
        ]
        texts.append(table(("place", "what", "verdict", "its numbers"), lines))
    return "\n\n".join([table(("paper", *WHOLES), rows), *texts]) + "\n"


def paper_page(paper: str, parts: list[Part], states: Mapping[str, State]) -> str:
    """How often which verdict on a number; then a head for each figure, table or section."""
    counts: Counter[str] = sum((part_verdicts(part, states) for part in parts), Counter())
    counts[NOT_GIVEN] += sum("missing" in part for part in parts)
    said = ", ".join(f"{count} {word}" for word, count in counts.items())
    texts = [f"Numbers: {said}."]
    for k, part in enumerate(parts):
        texts += section(part, states, anchor(paper, k))
    return "\n\n".join(texts) + "\n"


def anchor(paper: str, k: int) -> str:
    """Name of the place of a part."""
    return f"paper-{paper}-{k + 1}"


def draw_overview(
    papers: Mapping[str, list[Part]], states: Mapping[str, State], file: Path
) -> None:
    """A bar a paper: its figures, tables and sections by verdict."""
    figure, (axes,) = style.new_figure(height=2.2)
    names = [title.partition(":")[0] for title in TITLES.values()]
    left = [0] * len(names)
    for word in WHOLES:
        wholes = [
            sum(whole_verdict(part_verdicts(part, states)) == word for part in papers[paper])
            for paper in TITLES
        ]
        bars = axes.barh(names, wholes, left=left, color=LOOKS[word], label=word.strip("*"))
        axes.bar_label(bars, [str(n) if n else "" for n in wholes], label_type="center", fontsize=9)
        left = [a + b for a, b in zip(left, wholes, strict=True)]
    axes.invert_yaxis()
    axes.grid(False, axis="y")
    style.label(axes, "figures, tables and sections", "")
    style.legend_above(figure, axes, columns=len(WHOLES))
    figure.savefig(file)


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


def section(part: Part, states: Mapping[str, State], name: str) -> list[str]:
    """Head, command, figure, the numbers folded, and what the paper does not give."""
    texts = [f"({name})=\n## {plain(part['where'])}", plain(part["what"]) + "."]
    state = states[part["validation"]] if "validation" in part else None
    if state is not None:
        texts[-1] += f" Command: `lasersph validate {state.name}`, record {label(state)}."
        files = [f"{name}.png" for name in part.get("figures", ())]
        drawn = state.record["figures"] if state.record else []
        alt = plain(part["where"])
        texts += [f"![{alt}](../validation/{state.name}/{file})" for file in files if file in drawn]
    if part.get("rows"):
        found = [cells(entry, state, states) for entry in entries(part, states)]
        counts = part_verdicts(part, states)
        said = ", ".join(f"{count} {word.strip('*')}" for word, count in counts.items())
        texts += [f"<details><summary>Numbers: {said}</summary>", table(HEAD, found), "</details>"]
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
