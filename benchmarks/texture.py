"""Textures: what a spot of 24 cells costs, and whether a hidden fluence is found in a profile.

python benchmarks/texture.py spot DIR       a spot of 50 um, 5 um period, 24 cells at 16 nm, two
                                            workers; the same command again goes on
python benchmarks/texture.py direct DIR     a spot of 60 um at 1/e^2, 12 periods, in one run and
                                            from 24 cells, both at 16 nm: how depths differ, what
                                            each costs; --share DIR/cells takes those of a spot;
                                            DIR 8 24: of 8 periods, with particles of 24 nm
python benchmarks/texture.py recover [DIR]  20 profiles with hidden factors on the fluence, tilts,
                                            5 nm of noise, 1 % in lateral scale, from the cells of
                                            a texture or of a formula: of a spot for compare, of
                                            lines of one fluence for calibrate
"""

from __future__ import annotations

import os
import sys
import time
from collections.abc import Sequence
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np

from lasersph.cli import main
from lasersph.output import open_run
from lasersph.output.height_map import HeightMap
from lasersph.plots import style
from lasersph.studies.calibration import MakeReliefs, Settings, calibrate_with
from lasersph.studies.calibration_reading import read_calibration_plan
from lasersph.studies.texture.cells import Cell, read_cell
from lasersph.studies.texture.compare import compare
from lasersph.studies.texture.make import read_table
from lasersph.studies.texture.relief import Relief, read_relief, repeating_relief
from lasersph.studies.texture.table import CellTable

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "tests"))
from texture_cells import spot, table

STEEL = (
    "solver.flow.surface=moving",
    "material.base=steel-304-demuth",
    "material.surface_tension=1.6 N/m",
)
PERIOD_UM = 5
SPOT = 'laser.spot={diameter="%g um", definition="1/e^2", extent="%s"}'
SEEDS, NOISE, PLACES = 20, 5e-9, 256
CASE_SHARE = 0.75
"""Fluence of the lines over that of the highest cell: 1.3 times it is inside."""
PLAN = """case = "dlip-steel"
[set]
"solver.flow.surface" = "moving"
"material.base" = "steel-304-demuth"
"material.surface_tension" = "1.6 N/m"
"laser.beam.period" = "{period} um"
"domain.width" = "{period} um"
[unknown]
factor = {{ scales = "laser.fluence", between = [0.7, 1.3] }}
[[measured]]
set = {{ "laser.fluence" = "{fluence} J/m^2" }}
profile = {{ file = "line.csv", error = "5 nm", scale_error = "3 %" }}
[runs]
first = 6
most = 12
"""


def words(*settings: str) -> list[str]:
    """Words of a command that set these keys of a case of steel."""
    return ["dlip-steel", *(word for one in (*STEEL, *settings) for word in ("--set", one))]


def timed(command: list[str]) -> tuple[int, float, float]:
    """Exit code of a command, minutes by the clock and minutes of the processors it kept busy."""

    def busy() -> float:
        return sum(os.times()[:4]) / 60.0

    start, before = time.monotonic(), busy()
    code = main(command)
    return code, (time.monotonic() - start) / 60.0, busy() - before


def spot_texture(folder: Path, diameter: float, more: Sequence[str], spacing: str = "16") -> int:
    """Compute the texture of a spot [um] from particles [nm] and say what it cost."""
    settings = words(SPOT % (diameter, "cell"), f"particles.spacing={spacing} nm")
    command = ["texture", *settings, "--cells", "24", "--workers", "2"]
    code, clock, busy = timed([*command, "--threads", "1", "--out", str(folder), *more])
    print(f"{clock:.1f} minutes, {busy:.1f} minutes of processors")
    return code


def direct(folder: Path, more: Sequence[str]) -> int:
    """Compare a spot that is assembled from cells with one run that holds all of it."""
    is_given = bool(more) and more[0].isdigit()
    (periods, spacing), more = (more[:2], more[2:]) if is_given else (("12", "16"), more)
    wide = int(periods) * PERIOD_UM
    if code := spot_texture(folder / "assembled", wide, more, spacing):
        return code
    settings = words(
        SPOT % (wide, "whole"),
        f"particles.spacing={spacing} nm",
        f"domain.width={wide} um",
        "particles.fine_depth=400 nm",  # the melt is 290 nm deep in the middle
    )
    out = folder / "direct"
    code, clock, busy = timed(
        ["run", *settings, "--threads", "1", "--no-figures", "--resume", "--out", str(out)]
    )
    if code:
        return code
    print(f"direct: {clock:.1f} minutes, {busy:.1f} minutes of processors")
    whole = read_cell(open_run(out), 1e-6 * wide)
    cells = read_table(folder / "assembled" / "cells", 1e-6 * PERIOD_UM)
    assert isinstance(cells, CellTable)
    half = whole.x < 0.5e-6 * wide
    x = whole.x[half]
    local = spot(1e-6 * wide, float(cells.fluence[-1])).at
    ours = {name: lines.across(local, x, 0.0) for name, lines in cells.lines.items()}
    figure, panels = style.new_figure(2, height=5.0, share_x=True)
    for axes, name in zip(panels, ("height", "melt_depth"), strict=True):
        theirs = whole.values[name][half]
        deepest = float(np.max(-theirs if name == "height" else theirs))
        off = np.abs(ours[name] - theirs)
        worst = int(np.argmax(off))
        print(
            f"{name}: deepest {1e9 * deepest:.1f} nm; differs by {1e9 * off[worst]:.2f} nm "
            f"at most, {100.0 * off[worst] / deepest:.1f} % of it, at {1e6 * x[worst]:.2f} um, "
            f"{1e9 * float(np.sqrt(np.mean(off**2))):.2f} nm rms"
        )
        axes.plot(1e6 * x, 1e9 * theirs, color=style.COLORS[1], lw=2.5, label="one run of all")
        axes.plot(1e6 * x, 1e9 * ours[name], color=style.COLORS[0], lw=1.0, label="from cells")
        style.label(axes, "", f"{name.replace('_', ' ')} [nm]")
    style.legend_above(figure, panels[0], columns=2)
    style.label(panels[1], "x [um]", "melt depth [nm]")
    print(style.save(figure, folder / "direct.png"))
    return 0


def recover(folder: str | None = None) -> int:
    """Count in how many draws the 95 % intervals of both commands hold the hidden factor."""
    cells, found = table(), {"compare": 0, "calibrate": 0}
    if folder is not None:
        kept = read_relief(Path(folder))
        assert isinstance(kept, Relief) and isinstance(kept.table, CellTable)
        cells = kept.table
    highest, period = float(cells.fluence[-1]), cells.period
    x = np.arange(-24e-6, 24.01e-6, 0.125e-6)
    fluence = spot(center=0.9 * highest).at(*np.meshgrid(x, x))
    ours = Relief("spot", cells, x, x, fluence, 1e-10)
    middle = CASE_SHARE * highest
    lines = Relief("lines", cells, x, x, np.full((x.size, x.size), middle), 1e-10)
    for seed in range(SEEDS):
        random = np.random.default_rng(seed)
        factor = random.uniform(0.85, 1.1)
        fit = compare(ours, measured(ours, factor, random))
        low, high = fit.interval("fluence_factor")
        found["compare"] += low <= factor <= high
        words = f"{seed:2d}  hidden {factor:.4f}  compare {low:.4f} to {high:.4f}"
        with TemporaryDirectory() as place:
            measured(lines, factor, random).write(Path(place) / "line.csv")
            plan = Path(place) / "plan.toml"
            plan.write_text(PLAN.format(fluence=middle, period=1e6 * period))
            answer = calibrate_with(
                read_calibration_plan(plan),
                lambda settings: [{} for _ in settings],
                reliefs=reliefs_from(cells),
            )
        low, high = answer.posterior.quantiles(answer.posterior.unknowns[:, 0], (0.025, 0.975))
        found["calibrate"] += low <= factor <= high
        print(f"{words}  calibrate {low:.4f} to {high:.4f}, {len(answer.settings)} runs")
    for verb, count in found.items():
        print(f"{verb}: {count} of {SEEDS} intervals of 95 % hold the hidden factor")
    return 0 if min(found.values()) >= SEEDS - 1 else 1


def measured(ours: Relief, factor: float, random: np.random.Generator) -> HeightMap:
    """A profile of 44 um through the center with 5 nm of noise, tilted, moved, 1 % stretched."""
    places, scale = np.linspace(-22e-6, 22e-6, 600), 1.0 + 0.01 * random.choice([-1, 1])
    moved = (places - 0.7e-6 * random.normal()) / scale
    z = ours.at(moved, 0.0 * places, factor)
    z += 3e-9 * random.normal() + 2e-3 * random.normal() * places
    z += NOISE * random.normal(size=places.size)
    return HeightMap(places - places[0], np.zeros(1), z[None])


def reliefs_from(cells: CellTable) -> MakeReliefs:
    """Makes reliefs of lines from a table of cells."""
    places = cells.period * (np.arange(PLACES) + 0.5) / PLACES

    def make(settings: Sequence[Settings]) -> list[Relief]:
        found = []
        for one in settings:
            height = cells.at("height", one["laser.fluence"], places)
            found.append(repeating_relief(Cell(places, {"height": height}, True), cells.period))
        return found

    return make


if __name__ == "__main__":
    verb, *rest = sys.argv[1:] or [""]
    if verb not in ("spot", "direct", "recover") or (verb != "recover" and not rest):
        sys.exit(__doc__)
    if verb == "recover":
        sys.exit(recover(*rest))
    folder, *more = rest
    sys.exit(
        direct(Path(folder), more) if verb == "direct" else spot_texture(Path(folder), 50, more)
    )
