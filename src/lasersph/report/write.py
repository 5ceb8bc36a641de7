"""`write_report`: one HTML file that tells a run from question to result."""

from __future__ import annotations

import json
import shlex
from html import escape
from pathlib import Path
from typing import Any

from lasersph.input.document import split_settings
from lasersph.observers import Crater, EnergyBudget, Probes, Steps, Vaporization
from lasersph.observers.declared import AnyObserver, kinds_of
from lasersph.output import OutputError, Run, RunOrFolder, open_run
from lasersph.output.atomic import replace_text
from lasersph.output.errors import clear_errors
from lasersph.output.last_pulse import last_pulse, starts_after_pauses
from lasersph.plots.ablation_fields import has_ablation
from lasersph.plots.animation import LEAST_FRAMES
from lasersph.plots.drawing_processes import DrawingProcesses
from lasersph.plots.flow_fields import has_flow
from lasersph.plots.pictures import ANIMATION, draw_pictures
from lasersph.plots.run_figures import DRAWINGS, Begun, captions, pulse_note
from lasersph.report import tables, uncertainty_tables
from lasersph.report.headline import TELLING_FIGURES, large_numbers, what_was_computed
from lasersph.report.page import (
    contents,
    details,
    figure,
    heading,
    listing,
    page,
    paragraph,
    table,
    warnings_box,
)
from lasersph.report.scene import scene
from lasersph.report.summary_text import note_texts, verdict, warning_texts

ANIMATION_CAPTION = "Temperature, and speed with arrows or the ejecta, in time."
GIVEN = "given: "
"""Begins the source of an uncertainty that the command gave."""


def write_report(
    folder: RunOrFolder,
    *,
    with_scene: bool = True,
    begun: Begun | None = None,
    others: DrawingProcesses | None = None,
) -> Path:
    """Draw the figures of a complete run and write its report.html.

        lasersph.write_report("runs/dlip-steel")

    The page holds its images and needs no other file.

    Args:
        folder: a run, or its folder.
        with_scene: whether it holds the viewer too, with the particles of at most 24 snapshots and
            5 MB; a browser without WebGL shows the figures alone.
        begun: called before each drawing: name, how many are drawn, of how many.
        others: processes that draw as well; if not given, this one draws all figures.

    Returns:
        Path of the report.

    Raises:
        OutputError: no run there, the run is not complete, or nothing can be written.
    """
    run = open_run(folder)
    # Without a summary there are no results.
    if not run.is_complete:
        raise OutputError(
            f"{run.path}: the run is not complete, so there is nothing to report yet;"
            " go on with --resume"
        )
    # Figures, the animation where anything moves, then the page.
    names = [*captions(), *([ANIMATION] if is_moving(run) else [])]
    images = draw_pictures(run, names, begun=begun, others=others)
    if begun is not None:
        begun("report", len(names), len(names))
    path = run.path / "report.html"
    with clear_errors("read", run.path):
        text = report_page(run, images, scene(run) if with_scene else "")
    replace_text(path, text)
    return path


def is_moving(run: Run) -> bool:
    """Whether a run has something to animate: a flow in the plane, or a crater."""
    if len(last_pulse(run).snapshots) < LEAST_FRAMES:
        return False
    return has_flow(run) or (has_ablation(run) and run.snapshots.dimension > 1)


def report_page(run: Run, images: list[Path], viewer: str = "") -> str:
    """The whole page; `viewer` is HTML. Raises OSError where an image cannot be read."""
    summary = run.summary
    name = str(summary.get("title") or summary["case"])

    # The most telling still stands beside the large numbers at the top.
    versions = run.resolved.get("versions", {})
    still = min(
        (image for image in images if image.stem in TELLING_FIGURES),
        key=lambda image: TELLING_FIGURES.index(image.stem),
        default=None,
    )
    images = sorted(images, key=lambda image: image != still)
    figures = figures_by_part(run, images)
    top, *drawn = figures["results"] or [""]

    # Parts of the page; empty ones are left out.
    parts = {
        "Results": results(run),
        "Figures": [*drawn, *folded("More figures", figures["more"])],
        "How sure": uncertainty_tables.how_sure(summary, run.uncertainty),
        "How it was computed": computation(summary, figures["computation"]),
        "Case": case_as_read(run),
        "Reproduce": reproduce(run, versions),
    }
    parts = {title: part for title, part in parts.items() if part}

    # Top: title, sentence, warnings, numbers, verdict; then contents and parts.
    body = [
        f"<h1>{escape(name)}</h1>",
        paragraph(what_was_computed(run), "lead"),
        warnings_box(warning_texts(summary, run.events)),
        f'<div class="top">{viewer}{top}<div>{large_numbers(run)}</div></div>',
        paragraph(verdict(summary), "result"),
    ]
    body += [paragraph(text, "note") for text in note_texts(summary)]
    body.append(contents(parts))
    for title, part in parts.items():
        body += [heading(title), *part]
    return page(f"{name} – lasersph", body)


def figures_by_part(run: Run, images: list[Path]) -> dict[str, list[str]]:
    """The figures of each part of the report as HTML, with their captions, numbered through."""
    drawings = {drawing.name: drawing for drawing in DRAWINGS}
    pulses = 1 + len(starts_after_pauses(run))
    found: dict[str, list[str]] = {"results": [], "more": [], "computation": []}
    wanted: dict[str, list[tuple[Path, str]]] = {part: [] for part in found}
    # Each image goes to its part, with a note where it shows only the last pulse.
    for image in images:
        drawing = drawings.get(image.stem)
        caption = ANIMATION_CAPTION if drawing is None else drawing.caption
        if pulses > 1 and not (drawing and drawing.has_all_pulses):
            caption += f" Here {pulse_note(pulses)}."
        wanted["results" if drawing is None else drawing.part].append((image, caption))
    # Figures are numbered through all parts.
    number = 0
    for part, pairs in wanted.items():
        for image, caption in pairs:
            number += 1
            found[part].append(figure(image, caption, number))
    return found


def folded(title: str, body: list[str]) -> list[str]:
    """A part that opens on a click; nothing without anything in it."""
    return [details(title, "".join(body), prints=True)] if body else []


def results(run: Run) -> list[str]:
    """The main results in a table, then a folded one for each observer that found something."""
    summary = run.summary
    body = [table(tables.main_rows(summary, run.uncertainty), ("result", "value", "at"))]
    if "probes" in summary:
        body.append(paragraph(Probes.note))
    # A folded table for each observer, then energy, estimates, limits of the model.
    for kind in kinds_of(summary):
        body += measured(summary, kind)
    energy = table(tables.energy(summary), tables.ENERGY_HEAD) + paragraph(EnergyBudget.note)
    body.append(details("Energy", energy, prints=True))
    for title, rows, head in (
        ("Estimates", tables.estimates(summary), tables.ESTIMATE_HEAD),
        ("What the model leaves out", tables.left_out(summary), tables.LEFT_OUT_HEAD),
    ):
        if rows:
            body.append(details(title, table(rows, head), prints=True))
    return body


def computation(summary: dict[str, Any], figures: list[str]) -> list[str]:
    """How the run was computed: numbers and figures for who judges the computation, folded."""
    numbers = tables.dimensionless(summary)
    return [
        details("Computation", table(tables.computation(summary)), prints=True),
        *([details("Dimensionless numbers", table(numbers), prints=True)] if numbers else []),
        *folded("Steps, iterations, particles", figures),
        details("All numbers of summary.json", table(tables.flat(summary))),
    ]


def measured(summary: dict[str, Any], kind: AnyObserver) -> list[str]:
    """Results of an observer, folded: a table, or one for each of its probes or traces, and its
    note."""
    if kind in (Steps, EnergyBudget) or (kind is Vaporization and "crater" in summary):
        return []  # steps and energy have parts of their own; ejecta say what vaporized
    section = kind.all_results()[0].key.split(".")[0]
    names = summary.get(section, {}) if "<name>" in kind.all_results()[0].key else [""]
    body = []
    # A table for each name, of the crater with the removed volume over the energy.
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
    # Settings beside the file, errors of inputs, precision.
    words += [word for one in split_settings(run.case_text)[0] for word in ("--set", one)]
    if run.uncertainty is not None:
        words.append("--uncertainty")
        for key, one in run.uncertainty["inputs"].items():
            if one["source"].startswith(GIVEN):
                words += ["--uncertain", f"{key}={one['source'].removeprefix(GIVEN)}"]
    precision = run.summary.get("precision", "float64")
    if precision != "float64":
        words += ["--precision", precision]
    return shlex.join(words)
