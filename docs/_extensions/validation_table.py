"""Markdown tables of published beside computed numbers, from the JSON of `lasersph validate`."""

import re
from typing import Any

WORDS = {True: "ok", False: "**FAILED**", None: "shown"}
HEAD = ("quantity", "published", "reference", "computed", "tolerance", "verdict")


def validation_table(results: dict[str, Any], readmes: dict[str, str]) -> str:
    """An overview, then one section a validation: README, remarks, every number with its verdict.

    readmes: by name of the validation.
    """
    reports = results["validations"].values()
    overview = [
        (f"[](#{_anchor(report)})", report["title"], _count(report), WORDS[report["passed"]])
        for report in reports
    ]
    parts = [
        f"Computed with lasersph {results['lasersph']}.",
        _table(("validation", "question", "numbers", "verdict"), overview),
    ]
    for report in reports:
        short = " (shortened)" if report["quick"] else ""
        parts += [
            f"({_anchor(report)})=\n## {report['name']}{short}",
            readme_text(readmes[report["name"]]),
        ]
        parts.append("\n".join(f"- {_plain(remark)}" for remark in report["remarks"]))
        parts.append(_table(HEAD, [_cells(row) for row in report["rows"]]))
    return "\n\n".join(part for part in parts if part) + "\n"


def readme_text(readme: str) -> str:
    """A README as text of a section: its title as the first line, its heads as first words."""
    title, _, text = readme.partition("\n")
    return title.removeprefix("# ") + "\n" + re.sub(r"^## (.+)\n", r"**\1.** ", text, flags=re.M)


def _anchor(report: dict[str, Any]) -> str:
    return f"validation-{report['name']}"


def _count(report: dict[str, Any]) -> str:
    judged = sum(row["verdict"] is not None for row in report["rows"])
    return f"{judged} judged, {len(report['rows']) - judged} shown"


def _cells(row: dict[str, Any]) -> tuple[str, ...]:
    unit = f" [{row['unit']}]" if row["unit"] not in ("", "1") else ""
    tolerance = "" if row["tolerance"] is None else f"{row['tolerance']:.3g}"
    numbers = (_number(row[key]) for key in ("published", "reference", "computed"))
    return _plain(row["quantity"] + unit), *numbers, tolerance, WORDS[row["verdict"]]


def _number(value: float | str | None) -> str:
    if value is None:
        return ""
    return _plain(value) if isinstance(value, str) else f"{value:.6g}"


def _plain(text: str) -> str:
    """Text whose characters mean nothing to Markdown."""
    return re.sub(r"([|*<>$\[\]`\\])", r"\\\1", text)


def _table(head: tuple[str, ...], rows: list[tuple[str, ...]]) -> str:
    lines = [head, ("---",) * len(head), *rows]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines)
