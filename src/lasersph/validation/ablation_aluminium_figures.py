"""Figures of `ablation_aluminium` in the arrangement of Figs. 17-23 of [Alshaer2017]."""

from __future__ import annotations

from collections.abc import Mapping
from itertools import pairwise
from pathlib import Path

import numpy as np

from lasersph.output import Run
from lasersph.physics.evaporation import STANDARD_ATMOSPHERE, saturation_pressure
from lasersph.plots import crater_cut, crater_view, ejecta_vectors, style
from lasersph.plots.ablation_history import trace_figure

BOILING, LATENT_HEAT, GAS_CONSTANT = 2730.0, 10.53e6, 308.17
SNAPSHOTS = {"fig-18-19": (1e-9, 2e-9, 8e-9, 10e-9, 15e-9)}
VECTORS = (2e-9, 3e-9)
"""Times of Fig. 22 [s]; the enthalpy model ejects later: its own are drawn."""


def all_figures(out_dir: Path, column: Run, spots: Mapping[str, Run]) -> list[Path]:
    """Draw all of them; returns the files."""
    drawn = [intensity(out_dir, spots["enthalpy"]), pressures(out_dir, column)]
    traces = trace_figure(column)
    if traces is not None:
        drawn.append(style.save(traces, out_dir / "fig-20-23-traces.png"))
    for name, spot in spots.items():
        drawn += cuts(out_dir, name, spot)
        times = VECTORS if name == "published" else ()
        for label, figure in (
            ("fig-18-view", crater_view(spot)), ("fig-22-vectors", ejecta_vectors(spot, times)),
        ):  # fmt: skip
            if figure is not None:
                drawn.append(style.save(figure, out_dir / f"{label}-{name}.png"))
    return drawn


def cuts(out_dir: Path, name: str, spot: Run) -> list[Path]:
    """The cut through the crater at the times of Figs. 18 and 19."""
    drawn = []
    for time in SNAPSHOTS["fig-18-19"]:
        figure = crater_cut(spot, time)
        if figure is not None:
            path = out_dir / f"fig-19-{name}-{1e9 * time:g}ns.png"
            drawn.append(style.save(figure, path))
    return drawn


def intensity(out_dir: Path, spot: Run) -> Path:
    """Intensity over x and time of the case's top hat, and of a Gaussian of its size (Fig. 17)."""
    from lasersph.lasers import Laser

    given = spot.case["laser"]
    radius, duration = given["beam"]["radius"], given["pulse"]["duration"]
    beams = {
        "top hat, square pulse": {"beam": given["beam"]},
        "Gaussian beam, square pulse": {
            "beam": {"kind": "gaussian", "radius_1e2": radius}, "fluence_kind": "peak",
        },
    }  # fmt: skip
    figure, all_axes = style.new_figure(1, 2, height=3.2)
    edges = np.linspace(-1.6 * radius, 1.6 * radius, 161)
    times = np.linspace(0.0, 1.4 * duration, 57)
    for axes, (name, beam) in zip(all_axes, beams.items(), strict=True):
        laser = Laser.model_validate({
            "fluence": given["fluence"], "pulse": {"kind": "square", "duration": duration},
            "absorption": {"kind": "surface"}, **beam,
        })  # fmt: skip
        light = np.array([
            laser.energy_density(edges[None, :-1], edges[None, 1:], a, b) / (b - a)
            for a, b in pairwise(times)
        ])  # fmt: skip
        image = axes.imshow(
            1e-13 * light, origin="lower", aspect="auto", cmap=style.SPEED_COLORS,
            extent=(1e6 * edges[0], 1e6 * edges[-1], 0.0, 1e9 * times[-1]), vmin=0.0,
        )  # fmt: skip
        axes.grid(False)
        style.label(axes, "x [µm]", "time [ns]", title=name)
        figure.colorbar(image, ax=axes, pad=0.02).set_label("intensity [GW/cm$^2$]", fontsize=10)
    return style.save(figure, out_dir / "fig-17-intensity.png")


def pressures(out_dir: Path, column: Run) -> Path:
    """Vapor pressure over temperature: eq. (5), and what left the column (Fig. 21)."""
    figure, (axes,) = style.new_figure(height=3.4)
    last = column.snapshots[-1]
    left = last["vapor_pressure"] > 0.0
    hottest = max(3820.0, float(np.max(last["temperature"][left], initial=0.0)))
    T = np.linspace(BOILING, hottest, 200)
    bar = [
        1e-5 * saturation_pressure(t, STANDARD_ATMOSPHERE, BOILING, LATENT_HEAT, GAS_CONSTANT)
        for t in T
    ]
    axes.plot(T, bar, color=style.GRAY, label="eq. (5)")
    axes.plot(last["temperature"][left], 1e-5 * last["vapor_pressure"][left], "o", ms=3,
              color=style.COLORS[1], label="ejecta of the column")  # fmt: skip
    axes.plot(3744.0, 30.05, "s", ms=6, mfc="none", color="black", label="paper: 3744 K")
    style.label(axes, "temperature [K]", "vapor pressure [bar]")
    style.legend(axes)
    return style.save(figure, out_dir / "fig-21-pressure.png")
