"""Textures beside an experiment: the figure, and what pages say first of the agreement."""

import json
import tomllib
from pathlib import Path

import numpy as np

from figures.stored import StoredFigure, store_figure
from lasersph.plots import style
from lasersph.studies.measured_value import read_measured
from lasersph.validation.drawing import Panel, draw, line, marks

FOLDER = Path(__file__).parents[2] / "examples" / "texture-experiment"


def reliefs() -> dict[str, tuple[str, str]]:
    """By metal the size of the relief at the nominal fluence: computed and measured, with units."""
    found = {}
    nominal = tomllib.loads((FOLDER / "nominal.toml").read_text(encoding="utf-8"))
    for metal, relief in nominal.items():
        plan = tomllib.loads((FOLDER / relief["plan"]).read_text(encoding="utf-8"))
        measured, _, error = plan["measured"][0]["values"][relief["number"]].partition(" +- ")
        unit = error.split()[1].replace("um", "µm")
        found[metal] = relief["computed"], f"{measured} {unit}"
    return found


def agreement() -> str:
    """The sentence on the relief, computed and measured, that README.md and the pages hold."""
    (steel, steel_measured), (aluminum, aluminum_measured) = (
        (f"{float(computed.split()[0]):.0f} {computed.split()[1]}", measured)
        for computed, measured in (reliefs()[metal] for metal in ("steel", "aluminum"))
    )
    return (
        f"one pulse leaves a relief {steel} deep in steel, where the experiment found "
        f"{steel_measured}, and one {aluminum} high on aluminum, where it found {aluminum_measured}"
    )


def draw_experiment(target: Path) -> None:
    """Width of the melt and depth of the relief over the factor, with what was measured."""
    runs = np.genfromtxt(FOLDER / "runs.csv", delimiter=",", names=True)
    plan = tomllib.loads((FOLDER / "plan.toml").read_text(encoding="utf-8"))
    values = plan["measured"][0]["values"]
    answer = json.loads((FOLDER / "calibration.json").read_text(encoding="utf-8"))
    factor = answer["unknowns"]["factor"]
    sizes = (
        ("melt_width_m", "melt.width_half_max_m", "width of the melt [µm]", 1e6),
        ("depth_m", "topography.depth_m", "depth of the relief [nm]", 1e9),
    )
    panels = []
    for column, _, words, scale in sizes:
        curves = [kind(runs["factor"], scale * runs[column]) for kind in (line, marks)]
        panels.append(Panel("factor on the fluence [1]", words, curves))
    figure = draw(panels, height=3.2)
    for axes, (_, number, _, scale) in zip(figure.axes, sizes, strict=True):
        measured = read_measured(values[number], "length")
        low, high = (scale * (measured.value + sign * measured.sd) for sign in (-1.0, 1.0))
        axes.axhspan(low, high, color=style.COLORS[1], alpha=0.25, lw=0.0, label="measured")
        interval = factor["low_95"], factor["high_95"]
        axes.axvspan(*interval, color=style.GRAY, alpha=0.2, lw=0.0, label="factor, 95 %")
        axes.axvline(factor["mean"], color=style.GRAY, lw=1.0)
    style.legend(figure.axes[1])
    store_figure(figure, target)


EXPERIMENT = StoredFigure(
    "texture-experiment",
    draw_experiment,
    (
        "docs/figures/experiment.py",
        "examples/texture-experiment/calibration.json",
        "examples/texture-experiment/plan.toml",
        "examples/texture-experiment/runs.csv",
    ),
)
