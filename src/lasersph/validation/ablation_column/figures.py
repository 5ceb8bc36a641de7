"""Figures in the arrangement of Figs. 17, 20, 21 and 23 of [Alshaer2017]."""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from lasersph.lasers import Laser
from lasersph.output import Run
from lasersph.physics.evaporation import saturation_pressure
from lasersph.plots import style
from lasersph.plots.ablation_history import trace_figure
from lasersph.validation.drawing import Panel, exact, marks
from lasersph.validation.study import Study


def draw(study: Study, column: Run, gas: dict[str, float]) -> None:
    """All of them."""
    draw_intensity(study)
    draw_pressures(study, column, gas)
    study.save("fig-20-23-traces", trace_figure(column))


def draw_intensity(study: Study) -> None:
    """Intensity over x and time of the case's top hat, and of a Gaussian of its size (Fig. 17)."""
    laser = study.case().laser
    assert laser is not None
    given = laser.model_dump(exclude_unset=True)
    radius, duration = given["beam"]["radius"], given["pulse"]["duration"]
    gaussian = {"kind": "gaussian", "radius_1e2": radius}

    # Both beams have the fluence of the case; the Gaussian one as its peak.
    beams = {
        "top hat, square pulse": {"beam": given["beam"]},
        "Gaussian beam, square pulse": {"beam": gaussian, "fluence_kind": "peak"},
    }
    common = {
        "fluence": given["fluence"],
        "pulse": {"kind": "square", "duration": duration},
        "absorption": {"kind": "surface"},
    }
    figure, all_axes = style.new_figure(1, 2, height=3.2)

    # Mean intensity of each cell and span of time: energy over their length.
    edges = np.linspace(-1.6 * radius, 1.6 * radius, 161)
    times = np.linspace(0.0, 1.4 * duration, 57)
    for axes, (name, beam) in zip(all_axes, beams.items(), strict=True):
        laser = Laser.model_validate(common | beam)
        cells = (edges[None, :-1], edges[None, 1:])
        light = [laser.energy_density(*cells, a, b) / (b - a) for a, b in pairwise(times)]
        image = axes.imshow(
            1e-13 * np.array(light),
            origin="lower",
            aspect="auto",
            cmap=style.SPEED_COLORS,
            extent=(1e6 * edges[0], 1e6 * edges[-1], 0.0, 1e9 * times[-1]),
            vmin=0.0,
        )
        axes.grid(False)
        style.label(axes, "x [µm]", "time [ns]", title=name)
        figure.colorbar(image, ax=axes, pad=0.02).set_label("intensity [GW/cm$^2$]", fontsize=10)
    study.save("fig-17-intensity", figure)


def draw_pressures(study: Study, column: Run, gas: dict[str, float]) -> None:
    """Vapor pressure over temperature: eq. (5), and what left the column (Fig. 21)."""
    # Pressures of what has left, over the curve of eq. (5).
    last = column.snapshots[-1]
    left = last["vapor_pressure"] > 0.0
    hottest = max(3820.0, float(np.max(last["temperature"][left], initial=0.0)))
    T = np.linspace(gas["T_b"], hottest, 200)
    bar = [1e-5 * saturation_pressure(t, **gas) for t in T]
    ejecta = 1e-5 * last["vapor_pressure"][left]
    curves = [
        exact(T, bar, "eq. (5)"),
        marks(last["temperature"][left], ejecta, "ejecta of the column", k=1, marker="o"),
        marks([3744.0], [30.05], "paper: 3744 K", color="k", marker="s", mfc="none", markersize=6),
    ]
    study.draw("fig-21-pressure", Panel("temperature [K]", "vapor pressure [bar]", curves))
