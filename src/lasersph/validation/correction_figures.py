"""Figs. 3-8 of [Alshaer2017]: six functions, their derivatives by SPH, error norms."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lasersph.plots import style

Array = NDArray[np.float64]
FINE = np.linspace(1.0, 5.0, 400)


def draw(
    out_dir: Path,
    line: Array,
    functions: Sequence[Any],
    results: Mapping[str, Mapping[str, Array]],
    errors: Mapping[str, Mapping[str, float]],
) -> tuple[Path, ...]:
    """Write the six figures.

    Args:
        line: particles, (n,). functions: with name, value, first, second. results: derivatives by
            function and variant, (n,). errors: L2 by function and variant.
    """
    gradients = ("grad standard", "grad KGC")
    without = ("lap standard", "lap Schwaiger", "lap Schwaiger, no Gamma")
    corrected = ("lap standard", "lap Schwaiger + KGC")
    return (
        _panels(out_dir / "fig3-functions.png", line, functions, results, (), "value"),
        _panels(out_dir / "fig4-gradient.png", line, functions, results, gradients, "first"),
        _bars(out_dir / "fig5-gradient-errors.png", errors, gradients),
        _panels(out_dir / "fig6-schwaiger.png", line, functions, results, without, "second"),
        _panels(out_dir / "fig7-schwaiger-kgc.png", line, functions, results, corrected, "second"),
        _bars(out_dir / "fig8-laplacian-errors.png", errors, (*without, corrected[1])),
    )


def _panels(
    path: Path,
    line: Array,
    functions: Sequence[Any],
    results: Mapping[str, Mapping[str, Array]],
    variants: Sequence[str],
    kind: str,
) -> Path:
    """One panel per function: the exact curve and one row of marks per variant."""
    figure, axes = style.new_figure(2, 3, height=4.6)
    for one, function, letter in zip(axes, functions, "abcdef", strict=True):
        one.plot(FINE, getattr(function, kind)(FINE), color=style.GRAY, label="exact")
        for k, variant in enumerate(variants):
            one.plot(
                line, results[function.name][variant], "os^"[k], color=style.COLORS[k],
                markersize=3.5, label=variant.split(maxsplit=1)[1],
            )  # fmt: skip
        what = {"value": "f", "first": "df/dx", "second": "d²f/dx²"}[kind]
        style.label(one, "x [m]", what, title=f"({letter}) {function.name}")
    style.legend_above(figure, axes[0], columns=4)
    return style.save(figure, path)


def _bars(path: Path, errors: Mapping[str, Mapping[str, float]], variants: Sequence[str]) -> Path:
    """Error norms by function, one bar per variant; zeros lie below the axis."""
    figure, (axes,) = style.new_figure(height=3.4)
    place = np.arange(len(errors))
    width = 0.8 / len(variants)
    for k, variant in enumerate(variants):
        axes.bar(
            place + (k + 0.5) * width - 0.4,
            [max(found[variant], 1e-12) for found in errors.values()],
            width, color=style.COLORS[k], label=variant.split(maxsplit=1)[1],
        )  # fmt: skip
    axes.set_yscale("log")
    axes.set_ylim(bottom=1e-3)
    axes.set_xticks(place, list(errors))
    style.label(axes, "function", "$L_2$ error")
    style.legend(axes)
    return style.save(figure, path)
