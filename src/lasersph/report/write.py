"""`write_report`: one HTML file that tells a run from question to result."""

from __future__ import annotations

import json
import shlex
from html import escape
from pathlib import Path
from typing import Any

from lasersph.observers import Crater, EnergyBudget, Observer, Steps, Vaporization
from lasersph.observers.observer_list import OBSERVERS
from lasersph.output import OutputError, Run, open_run
from lasersph.output.atomic import replace_text
from lasersph.output.errors import clear_errors
from lasersph.plots.ablation_fields import has_ablation
from lasersph.plots.animation import LEAST_FRAMES, animate_run
from lasersph.plots.flow_fields import has_flow
from lasersph.plots.run_figures import DRAWINGS, draw_run
from lasersph.report import tables, uncertainty_tables
from lasersph.report.headline import STILLS, large_numbers, what_was_computed
from lasersph.report.page import contents, details, figure, heading, listing, page, paragraph, table
from lasersph.report.scene import scene
from lasersph.report.summary_text import note_texts, verdict, warning_texts

ANIMATION = "Temperature, and speed with arrows or the ejecta, in time."
SET = "# --set "
"""Begins the lines above the text of case.toml that tell its overrides."""
GIVEN = "given: "
"""Begins the source of an uncertainty that the command gave."""


def write_report(folder: str | Path, *, with_scene: bool = True) -> Path:
    """Draw the figures of a complete run and write its report.html.

    The page holds its images and needs no other file.

    Args:
        with_scene: whether it holds the viewer too, with the particles of at most 24 snapshots and
            5 MB; a browser without WebGL shows the figures alone.

    Returns:
        Path of the report.

    Raises:
        OutputError: no run there, the run is not complete, or nothing can be written.
    """
    run = open_run(folder)
    if not run.is_complete:
        raise OutputError(
            f"{run.path}: the run is not complete, so there is nothing to report yet;"
            " go on with --resume"
        )
    images = draw_run(folder)
    if is_moving(run):
        images.append(animate_run(folder))
    path = run.path / "report.html"
    with clear_errors("read", run.path):
        text = report_page(run, images, scene(run) if with_scene else "")
    replace_text(path, text)
    return path


def is_moving(run: Run) -> bool:
    """Whether a run has something to animate: a flow in the plane, or a crater."""
    if len(run.snapshots) < LEAST_FRAMES:
        return False
    return has_flow(run) or (has_ablation(run) and run.snapshots.dimension > 1)


def report_page(run: Run, images: list[Path], viewer: str = "") -> str:
    """The whole page; `viewer` is HTML. Raises OSError where an image cannot be read."""
    summary = run.summary
    name = str(summary.get("title") or summary["case"])
    versions = run.resolved.get("versions", {})
    still = min(
        (image for image in images if image.stem in STILLS),
        key=lambda image: STILLS.index(image.stem),
        default=None,
    )
    images = sorted(images, key=lambda image: image != still)
    captions = {drawing.name: drawing.caption for drawing in DRAWINGS} | {"animation": ANIMATION}
    drawn = [figure(image, captions[image.stem], k) for k, image in enumerate(images, start=1)]
    parts = {
        "Figures": drawn[1:],
        "Results": results(summary),
        "How sure": uncertainty_tables.how_sure(summary, run.uncertainty),
        "Case": case_as_read(run),
        "Reproduce": reproduce(run, versions),
    }
    parts = {title: part for title, part in parts.items() if part}
    body = [
        f"<h1>{escape(name)}</h1>",
        paragraph(what_was_computed(run), "lead"),
        f'<div class="top">{viewer}{"".join(drawn[:1])}<div>{large_numbers(run)}</div></div>',
        paragraph(verdict(summary), "result"),
    ]
    body += [paragraph(text, "warning") for text in warning_texts(summary, run.events)]
    body += [paragraph(text, "note") for text in note_texts(summary)]
    body.append(contents(parts))
    for title, part in parts.items():
        body += [heading(title), *part]
    return page(f"{name} – lasersph", body)


def results(summary: dict[str, Any]) -> list[str]:
    """A folded table for each observer that found something, then energy, estimates, computation
    and all numbers."""
    body = []
    for kind in OBSERVERS:
        body += measured(summary, kind)
    energy = table(tables.energy(summary), tables.ENERGY_HEAD) + paragraph(EnergyBudget.note)
    body.append(details("Energy", energy, prints=True))
    for title, rows, head in (
        ("Estimates", tables.estimates(summary), tables.ESTIMATE_HEAD),
        ("What the model leaves out", tables.left_out(summary), tables.LEFT_OUT_HEAD),
        ("Dimensionless numbers", tables.dimensionless(summary), ()),
        ("Computation", tables.computation(summary), ()),
    ):
        if rows:
            body.append(details(title, table(rows, head), prints=True))
    body.append(details("All numbers of summary.json", table(tables.flat(summary))))
    return body


def measured(summary: dict[str, Any], kind: type[Observer]) -> list[str]:
    """What an observer found, folded: a table, or one for each of its probes or traces, and its
    note."""
    if kind in (Steps, EnergyBudget) or (kind is Vaporization and "crater" in summary):
        return []  # steps and energy have parts of their own; ejecta say what vaporized
    section = kind.all_results()[0].key.split(".")[0]
    names = summary.get(section, {}) if "<name>" in kind.all_results()[0].key else [""]
    body = []
    for name in names:
        rows = tables.measured(summary, kind, name)
        if kind is Crater:
            rows += tables.removal_efficiency(summary)
        if rows:
            body.append(table(rows, (name, "", "at")))
    if body and kind.note:
        body.append(paragraph(kind.note))
    title = f"{kind.title[0].upper()}{kind.title[1:]}"
    return [details(title, "".join(body), prints=True)] if body else []


def case_as_read(run: Run) -> list[str]:
    """The case as given and as the program read it."""
    resolved = json.dumps(run.case, indent=2, ensure_ascii=False)
    return [
        paragraph("The case file as given:"),
        listing(run.case_text),
        details("The case with every default filled in, SI units", listing(resolved)),
    ]


def reproduce(run: Run, versions: dict[str, str]) -> list[str]:
    """How to get the same numbers again."""
    return [
        paragraph(
            "The run folder holds case.toml as given. The same program computes the same numbers,"
            " bit for bit, with any number of threads:"
        ),
        listing(command_of(run)),
        paragraph(f"Case {run.resolved.get('case_hash', '')}, computed with:"),
        table([(name, number) for name, number in versions.items()]),
        paragraph(
            "Data: history.csv (one row per step), particles.vtkhdf (open it in ParaView 5.12 or"
            " later), summary.json (SI units). In Python: lasersph.open_run(folder)."
        ),
    ]


def command_of(run: Run) -> str:
    """The command that repeats the run, with what was set beside the case file."""
    words = ["lasersph", "run", "case.toml", "--out", "again"]
    for line in run.case_text.splitlines():
        if not line.startswith(SET):
            break
        words += ["--set", line.removeprefix(SET)]
    if run.uncertainty is not None:
        words.append("--uncertainty")
        for key, one in run.uncertainty["inputs"].items():
            if one["source"].startswith(GIVEN):
                words += ["--uncertain", f"{key}={one['source'].removeprefix(GIVEN)}"]
    precision = run.summary.get("precision", "float64")
    if precision != "float64":
        words += ["--precision", precision]
    return shlex.join(words)
