"""Figures of `ablation_depth`: depth over fluence as in Figs. 24 and 25, and over the spacing."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from lasersph.plots import style

CITED = ((10.0, 0.6, "s", "SPH, paper"), (10.0, 0.8, "D", "experiment (Lutey et al., as cited)"))
"""Values in the text for 10 ns: fluence [J/cm2], depth [um], marker, name."""
CITED_RANGE = (20.0, 1.0, 1.2)
MARKERS = "o^v"


def over_fluence(out_dir: Path, duration: int, exact, columns, published) -> Path:
    """Depth over fluence: Stefan solution, both rules, values cited in the text (10 ns)."""
    figure, (axes,) = style.new_figure(height=4.4)
    fluences = sorted(f for ns, f in exact if ns == duration)
    depth = [1e6 * exact[duration, f].depth for f in fluences]
    axes.plot(fluences, depth, color=style.GRAY, label="Stefan solution", zorder=1)
    spacings = sorted({d for ns, _, d in columns if ns == duration}, reverse=True)
    for k, d in enumerate(spacings):
        values = [columns[duration, f, d].whole for f in fluences]
        axes.plot(fluences, values, MARKERS[k], ms=4, color=style.COLORS[k],
                  label=f"enthalpy, {d:g} µm")  # fmt: skip
    for k, preset in enumerate(sorted({key[0] for key in published})):
        found = {f: one.whole for (p, ns, f, d), one in published.items()
                 if p == preset and ns == duration and d == spacings[0]}  # fmt: skip
        axes.plot(sorted(found), [found[f] for f in sorted(found)], "--", lw=1.0,
                  color=style.COLORS[3 + k], label=f"published rule, {preset}")  # fmt: skip
    if duration == 10:
        for fluence, value, marker, name in CITED:
            axes.plot(fluence, value, marker, ms=6, mfc="none", color="black", label=name)
        at, low, high = CITED_RANGE
        axes.plot([at, at], [low, high], "-", lw=3.0, color="black", label="paper, at 20 J/cm$^2$")
    letter = "Fig. 24" if duration == 10 else "Fig. 25"
    style.label(axes, "fluence [J/cm$^2$]", "depth of ablation [µm]",
                title=f"{letter}: pulses of {duration} ns, R = 0.75")  # fmt: skip
    axes.set_ylim(bottom=0.0)
    style.legend_above(figure, axes, columns=3)
    return style.save(figure, out_dir / f"depth-{duration}ns.png")


def over_spacing(out_dir: Path, exact, columns, published) -> Path:
    """Depth at 10 and 20 J/cm2 in 10 ns over the spacing, (a) enthalpy, (b) published rule."""
    figure, axes = style.new_figure(1, 2, height=3.6)
    for k, fluence in enumerate((10, 20)):
        spacings = np.array(sorted(d for ns, f, d in columns if (ns, f) == (10, fluence)))
        stefan = 1e6 * exact[10, fluence].depth
        color = style.COLORS[k]
        axes[0].axhline(stefan, color=color, lw=0.8, ls=":")
        found = [columns[10, fluence, d] for d in spacings]
        axes[0].plot(spacings, [one.whole for one in found], "o-", ms=4, color=color,
                     label=f"{fluence} J/cm$^2$, whole layers")  # fmt: skip
        axes[0].plot(spacings, [one.smooth for one in found], "^--", ms=4, color=color,
                     label="with what was about to leave")  # fmt: skip
    for k, preset in enumerate(sorted({key[0] for key in published})):
        found = {d: one.whole for (p, ns, f, d), one in published.items()
                 if (p, ns, f) == (preset, 10, 10)}  # fmt: skip
        axes[1].plot(sorted(found), [found[d] for d in sorted(found)], "s-", ms=4,
                     color=style.COLORS[3 + k], label=f"10 J/cm$^2$, {preset}")  # fmt: skip
    titles = ("(a) enthalpy; dotted: Stefan solution", "(b) published rule")
    for one, title in zip(axes, titles, strict=True):
        style.label(one, "spacing [µm]", "depth of ablation [µm]", title=title)
        one.set_xlim(left=0.0)
        one.set_ylim(bottom=0.0)
        style.legend(one)
    return style.save(figure, out_dir / "depth-spacing.png")
