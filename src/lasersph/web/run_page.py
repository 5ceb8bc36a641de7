"""Content of one run: a card in the list, and its page. Reads files, writes none."""

from __future__ import annotations

import csv
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from lasersph.input import format_duration
from lasersph.input.key_units import amount_dimension, unit_in
from lasersph.output import OutputError, Run, open_run
from lasersph.output.folder_lock import is_computing
from lasersph.output.growing_table import last_row, some_values
from lasersph.output.pulse_starts import starts_of_pulses
from lasersph.report import tables
from lasersph.report.headline import LARGE, MOST_NUMBERS, telling_results
from lasersph.report.summary_text import note_texts, verdict, warning_texts
from lasersph.web.changes import changes, unit_of_key
from lasersph.web.folder_list import Entry, refuse_links

PICTURES = ("crater", "flow", "particles", "surface-profiles", "crater-3d", "temperature")
"""Figures that a card shows, the first that there is."""
SPARKS = 48
"""Values of the small curve of a card."""
LOG_TAIL = 1 << 16
"""Bytes of run.log that a page shows."""
TEMPERATURE = "temperature_max_K"
RELIEF = "surface.csv"


class Cards:
    """The cards of runs; those whose files did not change are not read again."""

    def __init__(self) -> None:
        self._known: dict[Path, tuple[tuple, dict[str, Any]]] = {}

    def card(self, entry: Entry) -> dict[str, Any]:
        """Card of a run in the list; where it cannot be read, why, in its own card alone."""
        head = {"id": entry.id, "name": entry.name, "sweep": entry.sweep}
        try:
            # Stamps of the files tell whether the card is still right.
            with telling_damage(entry):
                refuse_links(entry.path)
                signature = tuple(_stamp(entry.path / name) for name in WATCHED)
                known = self._known.get(entry.path)
                if known is None or known[0] != signature:
                    known = signature, _card(open_run(entry.path))
                    self._known[entry.path] = known
                return head | known[1] | {"state": state_of(entry.path)}
        except OutputError as error:
            return head | {"state": "damaged", "error": str(error)}


@contextmanager
def telling_damage(entry: Entry) -> Iterator[None]:
    """Say in one line what is wrong in a folder that was not written as runs write it.

    Raises OutputError for whatever is raised inside the block.
    """
    try:
        yield
    except OutputError:
        raise
    except Exception as error:  # files of others hold anything
        raise OutputError(f"{entry.name} cannot be read: it is damaged ({error!r})") from error


WATCHED = ("resolved.json", "summary.json", "history.csv", "events.jsonl", "figures", "case.toml")


def _stamp(path: Path) -> tuple[int, int]:
    try:
        found = path.stat()
    except OSError:
        return 0, 0
    return found.st_mtime_ns, found.st_size


def state_of(folder: Path) -> str:
    """complete, running or stopped."""
    if (folder / "summary.json").exists():
        return "complete"
    return "running" if is_computing(folder) else "stopped"


def _card(run: Run) -> dict[str, Any]:
    # From the case and the last row of the history, which every run has.
    case = run.case
    history = run.path / "history.csv"
    row = last_row(history) if history.exists() else {}
    end = float(case["time"]["end"])
    found: dict[str, Any] = {
        "title": str(case.get("title") or ""),
        "material": str((case.get("material") or {}).get("name", "")),
        "solver": str((case.get("solver") or {}).get("kind", "")),
        "time_s": row.get("time_s", 0.0),
        "end_s": end,
        "pulses": starts_of_pulses(case),
        "step": int(row.get("step", 0)),
        "modified": (run.path / "resolved.json").stat().st_mtime,
        "changes": changes(run.case_text),
        "picture": next((name for name in PICTURES if name in _figure_files(run.path)), None),
        "warnings": warning_texts(run.summary if run.is_complete else None, run.events),
        "numbers": [],
        "values": {TEMPERATURE: row.get(TEMPERATURE)},
    }

    # A complete run has its numbers.
    if run.is_complete:
        summary = run.summary
        found["case"] = str(summary["case"])
        found["title"] = found["title"] or found["case"]
        found["dimensions"] = summary.get("dimensions")
        found["particles"] = summary["particles"]
        found["took"] = format_duration(summary["wall_time_s"])
        found["values"] = {
            one.key: value
            for one, value in tables.main_results(summary)
            if isinstance(value, int | float)
        }
        found["numbers"] = main_numbers(run)
        found["time_s"] = summary["time_s"]
    elif TEMPERATURE in row:
        # One that is computed has those of its last row.
        found["numbers"] = [
            {
                "words": "highest temperature now",
                "text": tables.in_words(row[TEMPERATURE], "K"),
            }
        ]
        if row.get("melt_depth_any_m"):
            found["numbers"].append(
                {"words": "melt depth now", "text": tables.in_words(row["melt_depth_any_m"], "m")}
            )

    # Without a picture a small curve.
    if found["picture"] is None and history.exists():
        found["curve"] = some_values(history, TEMPERATURE, SPARKS)
    return found


def main_numbers(run: Run) -> list[dict[str, str]]:
    """The most telling results of a complete run, with their errors where these are known."""
    errors = (run.uncertainty or {}).get("numbers", {})
    # In the order of the headline, as many as it has.
    known = telling_results(run.summary)
    found = []
    for key, words in LARGE.items():
        if key not in known:
            continue
        one, value = known[key]
        error = errors.get(key, {}).get("error")
        found.append(
            {
                "words": words,
                "text": tables.text_of(one, value, run.summary),
                "error": "" if error is None else tables.text_of(one, error, run.summary),
                "at": tables.place_text(run.summary, one.at[0]) if one.at else "",
            }
        )
    return found[:MOST_NUMBERS]


def results(summary: dict[str, Any]) -> list[dict[str, Any]]:
    """The main results with their words, for a table: `value` and `unit` of those that are numbers
    that can be taken from one another, `text` of all."""
    # Numbers with units can be subtracted on the page, texts cannot.
    dimensions = amount_dimension(summary)
    return [
        {
            "key": one.key,
            "words": one.words,
            "text": tables.text_of(one, value, summary),
            "value": value if isinstance(value, int | float) else None,
            "unit": unit_in(one.unit, dimensions),
        }
        for one, value in tables.main_results(summary)
    ]


def relief(entry: Entry) -> dict[str, list[float]]:
    """Places and heights of the surface at the end [m], also of the mirror image of half a period;
    of a run in 3-D along x at y = 0.

    Raises:
        KeyError: the surface did not move, or the run is not at its end. OutputError: the file is
            damaged.
    """
    path = entry.path / RELIEF
    if not path.is_file():
        raise KeyError(path.name)
    with telling_damage(entry), path.open(newline="", encoding="utf-8") as stream:
        # Of a surface over x and y, which is whole, the row next to y = 0.
        found = list(csv.DictReader(stream))
        is_area = bool(found) and "y_m" in found[0]
        if is_area:
            middle = min((float(row["y_m"]) for row in found), key=lambda y: (abs(y), y))
            found = [row for row in found if float(row["y_m"]) == middle]
        # Half a period of a line is mirrored.
        rows = [(float(row["x_m"]), float(row["height_m"])) for row in found]
        if not is_area and open_run(entry.path).symmetry_factor == 2:
            rows = [*((-x, height) for x, height in reversed(rows) if x > 0.0), *rows]
    return {"x": [x for x, _ in rows], "height": [height for _, height in rows]}


def _figure_files(folder: Path) -> dict[str, Path]:
    try:
        files = sorted((folder / "figures").iterdir())
    except OSError:
        return {}
    return {file.stem: file for file in files if file.suffix in (".png", ".gif")}


def figure_file(folder: Path, name: str) -> Path:
    """The file of a figure. Raises KeyError where the folder has none of that name."""
    return _figure_files(folder)[name]


def details(entry: Entry) -> dict[str, Any]:
    """All that the page of a run shows but for what grows: history, particles, log.

    Raises OutputError where the folder cannot be read.
    """
    with telling_damage(entry):
        return _details(entry, open_run(entry.path))


def _details(entry: Entry, run: Run) -> dict[str, Any]:
    # The card, the case and what lies in the folder.
    resolved, files = run.resolved, _figure_files(entry.path)
    found = {
        "id": entry.id,
        "name": entry.name,
        "sweep": entry.sweep,
        **_card(run),
        "state": state_of(entry.path),
        "started": str(_stamp(entry.path / "resolved.json")[0]),
        "case_hash": resolved.get("case_hash", ""),
        "case_text": run.case_text,
        "resolved": (flat := _flat(run.case)),
        "units": {key: unit for key in flat if (unit := unit_of_key(key))},
        "versions": resolved.get("versions", {}),
        "has_report": (entry.path / "report.html").is_file(),
        "has_relief": (entry.path / RELIEF).is_file(),
        "has_particles": (entry.path / "particles.vtkhdf").exists(),
        "figures": _captions(files) if files else [],
        "tables": [],
        "results": [],
    }

    # Results and tables of a complete run.
    if run.is_complete:
        summary = run.summary
        found["results"] = results(summary)
        found["verdict"] = verdict(summary)
        found["notes"] = note_texts(summary)
        found["tables"] = [
            {"title": "Energy", "head": tables.ENERGY_HEAD, "rows": tables.energy(summary)},
            {"title": "Computation", "head": (), "rows": tables.computation(summary)},
            {"title": "All numbers", "head": (), "rows": tables.flat(summary)},
        ]
    return found


def _captions(files: dict[str, Path]) -> list[dict[str, str]]:
    """Figures with their captions, in the order of the report."""
    from lasersph.plots.run_figures import DRAWINGS
    from lasersph.report.write import ANIMATION

    # The order of the report.
    known = {drawing.name: drawing.caption for drawing in DRAWINGS} | {"animation": ANIMATION}
    names = [name for name in known if name in files]
    return [{"name": name, "caption": known[name]} for name in names]


def _flat(value: Any, name: str = "") -> dict[str, Any]:
    """Plain values of a case by dotted key."""
    if isinstance(value, dict):
        parts = [_flat(item, f"{name}.{key}" if name else key) for key, item in value.items()]
        return {key: item for part in parts for key, item in part.items()}
    return {name: value}


def log_text(folder: Path) -> str:
    """The end of run.log. Raises OutputError."""
    path = folder / "run.log"
    if not path.exists():
        return ""
    # The end of the log, without its first line, which may be cut.
    with open(path, "rb") as stream:
        size = stream.seek(0, 2)
        stream.seek(max(0, size - LOG_TAIL))
        text = stream.read().decode(errors="replace")
    return text if size <= LOG_TAIL else text.partition("\n")[2]
