"""Records of validations: what was computed, when, where and from which sources; what is current.

A folder of records holds NAME.json of every validation and its figures in NAME/. A record is out of
date once a case that it ran, its material, its own tables or a module that it runs through differs
from then. Where the shortened form still gives its stored numbers, the record is confirmed.
"""

from __future__ import annotations

import json
import os
import platform
import shutil
import subprocess
from collections import Counter
from collections.abc import Mapping
from dataclasses import asdict, dataclass
from datetime import UTC, datetime
from functools import partial
from pathlib import Path
from typing import Any

from lasersph import __version__
from lasersph.case import load_case
from lasersph.input import CaseError
from lasersph.output import OutputError, hash_of_case
from lasersph.output.atomic import replace_json
from lasersph.validation import sources
from lasersph.validation.registry import validate
from lasersph.validation.report import Report
from lasersph.validation.study import Study, module_of, tables_of

SCHEMA_VERSION = 2
ROUND_OFF = 1e-8
"""Relative difference of numbers that are the same. Sums in another order differ by 1e-16 and let
solves end elsewhere below their residual, 1e-8 of the energy of a step: 1.2e-9 was found in a
temperature after 2000 steps. A formula or a constant that changed is seen far above."""
ZERO_TOLERANCE = 1e-12
"""In the unit of its row: what should vanish, and is round-off."""
WORDS = ("reason", "changed", "source")
"""Keys of `rows.toml` that change no number."""
Entry = dict[str, Any]


@dataclass(frozen=True)
class State:
    """How far a validation can be relied on.

    Attributes:
        name: of the validation. word: "current", "confirmed", "stale", "failed" or "missing".
        record: content of its file, with the reasons that `rows.toml` gives now. changes: names of
            sources and tables that differ from when it was computed, or confirmed.
    """

    name: str
    word: str
    record: Entry | None = None
    changes: tuple[str, ...] = ()

    @property
    def is_out_of_date(self) -> bool:
        """Whether it has to be computed, or confirmed."""
        return self.record is None or bool(self.changes)

    @property
    def text(self) -> str:
        """Dates, what failed and what changed, as one line."""
        parts = list(self.outcome)
        if self.changes:
            more = f" and {len(self.changes) - 4} more" if len(self.changes) > 4 else ""
            parts.append("changed since: " + ", ".join(self.changes[:4]) + more)
        return "; ".join(parts)

    @property
    def outcome(self) -> tuple[str, ...]:
        """When it was computed and confirmed, and what failed; nothing where it never was."""
        if self.record is None:
            return ()
        parts = [f"computed {self.record['computed']['date']}"]
        if self.record["confirmed"] and not self.changes:
            parts.append(f"confirmed {self.record['confirmed']['date']}")
        if not self.record["passed"]:
            verdicts = Counter(row["verdict"] for row in self.record["rows"])
            judged = verdicts[True] + verdicts[False]
            parts.append(self.record["error"] or f"{verdicts[False]} of {judged} judged not met")
        return tuple(parts)


def state_of(name: str, folder: Path) -> State:
    """State of the record of a validation in a folder of records.

    Raises:
        ValueError: a record of another version of this file.
    """
    # No record, or one of another format.
    file = folder / f"{name}.json"
    if not file.is_file():
        return State(name, "missing")
    record = json.loads(file.read_text(encoding="utf-8"))
    if record["schema_version"] != SCHEMA_VERSION:
        raise ValueError(f"{file}: schema_version {record['schema_version']}, not {SCHEMA_VERSION}")
    # Reasons are those of today: they change no number.
    kinds = Study(name, Path()).comparisons
    for row in record["rows"]:
        if (kind := kinds.get(row["kind"])) is not None:
            is_judged = row["tolerance"] is not None or row["verdict"] is not None
            row |= {"reason": kind.reason if is_judged else "", "changed": kind.changed}
    # Changes since it was computed, or since it was confirmed.
    changes, word = changes_since(record["computed"], name), "current"
    if changes and record["confirmed"]:
        changes, word = changes_since(record["confirmed"], name), "confirmed"
    if changes:
        word = "stale"
    return State(name, word if record["passed"] else "failed", record, changes)


def recorded_seconds(name: str, folder: Path, *, quick: bool = False) -> float | None:
    """Wall time that a validation took when it was recorded [s]; None where that is not known.

    Args:
        folder: of the records. quick: that of its shortened form.
    """
    file = folder / f"{name}.json"
    if not file.is_file():
        return None
    record = json.loads(file.read_text(encoding="utf-8"))
    return (record.get("short") or {}).get("seconds") if quick else record.get("seconds")


def make_record(
    name: str, folder: Path, out: Path, *, threads: int | None = None, backend: str = "cpu"
) -> Entry:
    """Compute a validation, shortened and in full, and store it with its figures.

    Runs are kept below `out` and taken from there. A validation that breaks off is stored as well.

    Raises:
        OutputError, OSError: the folder cannot be written, or a run in it not be read.
    """
    # The shortened form first: it shows soon what is broken.
    run = partial(validate, name, threads=threads, backend=backend)
    short = None
    report = Report(name, "", ())
    error = ""
    sources.hashes([module_of(name), sources.TIME_LOOP])  # of the files as they are loaded now
    try:
        short = run(out / "short" / name, quick=True)
        report = run(out / name)
    except (OutputError, OSError, MemoryError):  # of the machine, not of the validation
        raise
    except Exception as failure:
        error = f"broke off: {type(failure).__name__}: {' '.join(str(failure).split())}"

    # Figures of the record replace those of an earlier one.
    content = report.as_dict()
    shutil.rmtree(folder / name, ignore_errors=True)
    for figure in report.figures:
        (folder / name).mkdir(parents=True, exist_ok=True)
        shutil.copyfile(figure, folder / name / figure.name)

    # Rows, figures and origin of both forms.
    record = {
        "schema_version": SCHEMA_VERSION,
        **{key: content[key] for key in ("name", "passed", "rows", "remarks")},
        "error": error,
        "figures": [figure.name for figure in report.figures],
        "seconds": report.seconds,
        "short": {"seconds": short.seconds, "rows": short.as_dict()["rows"]} if short else None,
        "computed": _origin(name, report, short) | {"backend": backend, "threads": threads},
        "confirmed": None,
    }
    folder.mkdir(parents=True, exist_ok=True)
    replace_json(folder / f"{name}.json", record)
    return record


def confirm(state: State, folder: Path, out: Path, *, threads: int | None = None) -> list[str]:
    """Confirm a stale record by its shortened form; what stands against it, nothing if confirmed.

    The form has to give every stored number of its own to `ROUND_OFF`. It cannot speak for
    tables of the validation itself, nor for a key of a case that it overrides.
    """
    record, name = state.record, state.name
    assert record is not None
    # Nothing to compare with, own tables changed, or a case that the form overrides.
    if record["short"] is None:
        return ["it has no shortened form"]
    if own := [text for text in state.changes if text.startswith("own ")]:
        return [f"changed: {text}" for text in own]
    before = record["computed"]
    if _changed(before["cases"]) and not _changed(before["short_cases"]):
        return ["a case differs in what the shortened form overrides"]
    # Compute the form; it has to give its stored numbers.
    short = validate(name, out / "short" / name, quick=True, threads=threads)
    found = differences(record["short"]["rows"], short.as_dict()["rows"])
    if not found:
        # Confirmed: today's sources give the same numbers.
        origin = _origin(name, Report(name, "", ()), short)
        origin["cases"] = {label: _case(label)[0] for label in before["cases"]}
        origin["roots"] = sorted({*origin["roots"], *before["roots"]})
        origin["sources"] = sources.hashes(origin["roots"])
        replace_json(folder / f"{name}.json", record | {"confirmed": origin})
    return found


def differences(before: list[Entry], after: list[Entry], round_off: float = ROUND_OFF) -> list[str]:
    """Rows whose numbers or verdicts are not those of before, or that only one of both has."""
    # By quantity, so that rows may change their places.
    first, second = keyed_rows(before), keyed_rows(after)
    return [
        key[0]
        for key in first | second
        if key not in first
        or key not in second
        or first[key]["verdict"] != second[key]["verdict"]
        or any(
            relative(first[key], second[key], what) > round_off
            for what in ("computed", "reference", "tolerance")
        )
    ]


def relative(first: Entry, second: Entry, what: str = "computed") -> float:
    """Difference of two rows over their size; infinite where only one has a number."""
    a, b = first[what], second[what]
    # Equal, without a number, or round-off of what should vanish.
    if a == b:
        return 0.0
    if not (isinstance(a, int | float) and isinstance(b, int | float)):
        return float("inf")
    if abs(a - b) < ZERO_TOLERANCE:
        return 0.0
    # Over the largest of the numbers that the row is about.
    sizes = (a, b, first["reference"] or 0.0, first["tolerance"] or 0.0)
    return abs(a - b) / max(abs(size) for size in sizes)


def keyed_rows(rows: list[Entry]) -> dict[tuple[str, int], Entry]:
    """Rows by quantity, and by how many of that name came before."""
    seen: Counter[str] = Counter()
    keyed = {}
    for row in rows:
        keyed[row["quantity"], seen[row["quantity"]]] = row
        seen[row["quantity"]] += 1
    return keyed


def changes_since(origin: Entry, name: str) -> tuple[str, ...]:
    """Tables, cases, materials and modules that differ from those of a computation."""
    # Tables and cases first, then the modules, by their hashes.
    cases = origin["cases"] | origin["short_cases"]
    found = [*_differ(origin["own"], _own_tables(name)), *_changed(cases)]
    return (*found, *_differ(origin["sources"], sources.hashes(origin["roots"])))


def _differ(before: Mapping[str, Any], now: Mapping[str, Any]) -> list[str]:
    return [key for key in sorted({*before, *now}) if before.get(key) != now.get(key)]


def _changed(cases: Mapping[str, list[str]]) -> list[str]:
    """Names of the cases and the materials that differ from what was run."""
    found = []
    # Hashes of today against those of before.
    for label, before in cases.items():
        now, names = _case(label)
        found += [
            f"{word} {of}"
            for word, of, a, b in zip(("case", "material"), names, before, now, strict=True)
            if a != b
        ]
    return list(dict.fromkeys(found))


def _case(label: str) -> tuple[list[str], tuple[str, str]]:
    """Hashes, and names, of a case but for its material, and of its material."""
    name, *settings = json.loads(label)
    try:
        case = load_case(name, settings)
    except CaseError as error:
        return [str(error), ""], (name, f"of {name}")
    # The material apart, so that its change is told as such.
    content = case.resolved()
    material = content.pop("material")
    return [hash_of_case(content), hash_of_case(material)], (name, case.material.name)


def _own_tables(name: str) -> dict[str, str]:
    """Hashes of what a validation states itself: what it runs, what it compares, and with what."""
    # What is run and compared, without words that change no number; tables as they lie.
    studies = [Study(name, Path(), quick=quick) for quick in (False, True)]
    plans = [vars(study.plan) | {"remarks": (), "order": 0} for study in studies]
    kinds = {key: asdict(kind) for key, kind in studies[0].comparisons.items()}
    rows = {key: {k: v for k, v in kind.items() if k not in WORDS} for key, kind in kinds.items()}
    stated = {"case.toml": {"plans": plans}, "rows.toml": rows}
    tables = {file.name: {"text": file.read_text("utf-8")} for file in tables_of(name)}
    return {f"own {key}": hash_of_case(value) for key, value in (stated | tables).items()}


def _origin(name: str, report: Report, short: Report | None) -> Entry:
    """Origin of a record: what it was computed from, when and where."""
    # Modules from which the computation starts.
    kinds = {*report.solvers, *(short.solvers if short else ())}
    recipes = [sources.recipe_module(kind) for kind in sorted(kinds)]
    roots = [module_of(name), sources.JUDGE, *recipes, *([sources.TIME_LOOP] if kinds else [])]
    return {
        "date": datetime.now(UTC).strftime("%Y-%m-%d"),
        "lasersph": __version__,
        "commit": _commit(),
        "machine": _machine(),
        "own": _own_tables(name),
        "cases": {label: _case(label)[0] for label in report.cases},
        "short_cases": {label: _case(label)[0] for label in (short.cases if short else ())},
        "roots": roots,
        "sources": sources.hashes(roots),
    }


def _machine() -> str:
    """Processor, number of processors and system."""
    # The system may not have a list of its processors.
    info = Path("/proc/cpuinfo")
    lines = info.read_text().splitlines() if info.is_file() else []
    models = [line.partition(":")[2].strip() for line in lines if line.startswith("model name")]
    return (
        f"{(models or [platform.machine()])[0]}, {os.cpu_count()} processors, {platform.system()}"
    )


def _commit() -> str | None:
    """Latest commit that changed the package, if it lies in a work tree of git."""

    def git(*words: str) -> str:
        command = ["git", "-C", str(sources.ROOT), *words, "--", "."]
        return subprocess.run(command, capture_output=True, text=True, check=True).stdout.strip()

    # Without git there is no commit.
    try:
        found = git("log", "-1", "--format=%h")
        return f"{found} with changes" if found and git("status", "--porcelain") else found or None
    except (OSError, subprocess.CalledProcessError):
        return None
