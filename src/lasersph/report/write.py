"""`write_report`: one HTML file that tells a run from question to result."""

from __future__ import annotations

import json
import shlex
from html import escape
from pathlib import Path
from typing import Any

from lasersph.output import OutputError, Run, open_run
from lasersph.output.atomic import replace_text
from lasersph.output.errors import clear_errors
from lasersph.plots.ablation_fields import has_ablation
from lasersph.plots.animation import LEAST_FRAMES, animate_run
from lasersph.plots.flow_fields import has_flow
from lasersph.plots.run_figures import DRAWINGS, draw_run
from lasersph.report import ablation_tables, flow_tables, tables
from lasersph.report.page import (
    contents,
    figure,
    folded,
    heading,
    listing,
    page,
    paragraph,
    table,
)
from lasersph.report.summary_text import notes_of, verdict, warnings_of

ANIMATION = "Temperature, and speed with arrows or the ejecta, in time."
SET = "# --set "
"""What the lines above the text of case.toml begin with that tell its overrides."""
SECTIONS = ("Results", "Figures", "Energy", "What was asked", "Computation", "Reproduce")


def write_report(folder: str | Path) -> Path:
    """Draw the figures of a complete run and write its report.html.

    The page holds its images and needs no other file.

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
        text = report_page(run, images)
    replace_text(path, text)
    return path


def is_moving(run: Run) -> bool:
    """Whether a run has something to animate: a flow in the plane, or a crater."""
    if len(run.snapshots) < LEAST_FRAMES:
        return False
    return has_flow(run) or (has_ablation(run) and run.snapshots.dimension > 1)


def report_page(run: Run, images: list[Path]) -> str:
    """The whole page. Raises OSError where an image cannot be read."""
    summary = run.summary
    name = str(summary.get("title") or summary["case"])
    versions = run.resolved.get("versions", {})
    about = f"lasersph {versions.get('lasersph', '')}, case {summary['case']}, run {run.path.name}"
    body = [f"<h1>{escape(name)}</h1>", paragraph(about, "about")]
    body += [contents(SECTIONS), paragraph(verdict(summary), "result")]
    body += [paragraph(text, "warning") for text in warnings_of(summary, run.events)]
    body += [paragraph(text, "note") for text in notes_of(summary)]
    parts = (
        results(summary),
        figures(images),
        [table(tables.energy(summary), tables.ENERGY_HEAD)],
        asked(run),
        computation(summary),
        reproduce(run, versions),
    )
    for title, part in zip(SECTIONS, parts, strict=True):
        body += [heading(title), *part]
    return page(f"{name} – lasersph", body)


def results(summary: dict[str, Any]) -> list[str]:
    """Tables of the results."""
    body = [table(tables.temperatures(summary))]
    if rows := tables.melt_pool(summary):
        body.append(table(rows, tables.MELT_HEAD))
        body.append(
            paragraph(
                "Depth: lower face of the deepest such cell below the original surface. Width:"
                " full width of one pool at the surface. Sizes are whole cells, but for the"
                " width at f_m = 0.5, which is interpolated."
            )
        )
    if (rows := tables.vaporization(summary)) and "crater" not in summary:
        body.append(table(rows))
    for rows, head in (
        (ablation_tables.crater(summary), ("crater", "")),
        (ablation_tables.ejecta(summary), ("ejecta", "")),
        (ablation_tables.traces(summary), ablation_tables.TRACE_HEAD),
        (ablation_tables.estimates(summary), ablation_tables.ESTIMATE_HEAD),
        (ablation_tables.left_out(summary), ablation_tables.LEFT_OUT_HEAD),
        (flow_tables.speeds(summary), flow_tables.SPEED_HEAD),
        (flow_tables.layer(summary), ()),
        (flow_tables.extrema(summary), flow_tables.EXTREMA_HEAD),
        (flow_tables.lid(summary), flow_tables.LID_HEAD),
        (flow_tables.box(summary), flow_tables.BOX_HEAD),
        (flow_tables.walls(summary), flow_tables.WALLS_HEAD),
        (tables.probes(summary), tables.PROBE_HEAD),
    ):
        if rows:
            body.append(table(rows, head))
    body.append(folded("All numbers of summary.json", table(tables.flat(summary))))
    return body


def figures(images: list[Path]) -> list[str]:
    """All figures that were drawn, numbered."""
    captions = {drawing.name: drawing.caption for drawing in DRAWINGS} | {"animation": ANIMATION}
    return [figure(image, captions[image.stem], k) for k, image in enumerate(images, start=1)]


def computation(summary: dict[str, Any]) -> list[str]:
    """How the run was computed, its steps and, with flow, how sound that is."""
    parts = (tables.computation(summary), tables.time_steps(summary))
    parts += (flow_tables.soundness(summary), flow_tables.dimensionless(summary))
    return [table(rows) for rows in parts if rows]


def asked(run: Run) -> list[str]:
    """The case as given and as the program read it."""
    resolved = json.dumps(run.case, indent=2, ensure_ascii=False)
    return [
        paragraph("The case file as given:"),
        listing(run.case_text),
        folded("The case with every default filled in, SI units", listing(resolved)),
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
    precision = run.summary.get("precision", "float64")
    if precision != "float64":
        words += ["--precision", precision]
    return shlex.join(words)
