"""Depth of ablation over fluence as in Figs. 24 and 25 of [Alshaer2017], and over the spacing."""

from __future__ import annotations

from collections.abc import Mapping

from lasersph.validation.ablation_depth.column import Columns, Pulse
from lasersph.validation.ablation_depth.front import Ablation
from lasersph.validation.drawing import Panel, exact, line, marks
from lasersph.validation.study import Study

CITED = ((10.0, 0.6, "s", "SPH, paper"), (10.0, 0.8, "D", "experiment (Lutey et al., as cited)"))
"""Values in the text for 10 ns: fluence [J/cm2], depth [um], marker, name."""
CITED_RANGE = (20.0, 1.0, 1.2)
Solutions = Mapping[Pulse, Ablation]
ByPreset = Mapping[str, Columns]
DEPTH = "depth of ablation [µm]"


def draw_over_fluence(
    study: Study,
    duration: int,
    solutions: Solutions,
    columns: Columns,
    published: ByPreset,
) -> None:
    """Depth over fluence: Stefan solution, both rules, values cited in the text (10 ns)."""
    # The exact depth, whole layers by spacing, and both presets of the published rule.
    fluences = sorted(f for ns, f in solutions if ns == duration)
    depth = [1e6 * solutions[duration, f].depth for f in fluences]
    curves = [exact(fluences, depth, "Stefan solution")]
    for k, d in enumerate(study.plan.spacings):
        values = [columns[duration, f, d].whole for f in fluences]
        curves.append(marks(fluences, values, f"enthalpy, {d:g} µm", k, markersize=4))
    coarse = study.plan.spacings[0]
    for k, (preset, found) in enumerate(sorted(published.items())):
        values = [found[duration, f, coarse].whole for f in fluences]
        label = f"published rule, {preset}"
        curves.append(line(fluences, values, label, 3 + k, linestyle="--", linewidth=1.0))
    # The text has depths for 10 ns only.
    if duration == 10:
        hollow = {"mfc": "none", "color": "k", "markersize": 6}
        curves += [marks([f], [d], name, marker=mark, **hollow) for f, d, mark, name in CITED]
        at, low, high = CITED_RANGE
        label = "paper, at 20 J/cm$^2$"
        curves.append(line([at, at], [low, high], label, color="k", linewidth=3.0))
    title = f"Fig. {24 if duration == 10 else 25}: pulses of {duration} ns, R = 0.75"
    panel = Panel("fluence [J/cm$^2$]", DEPTH, curves, title, low=0.0)
    study.draw(f"depth-{duration}ns", panel, height=4.4, legend=3)


def draw_over_spacing(
    study: Study, solutions: Solutions, columns: Columns, published: ByPreset
) -> None:
    """Depth at 10 and 20 J/cm2 in 10 ns over the spacing, (a) enthalpy, (b) published rule."""
    spacings = study.plan.spacings
    ends = [0.0, max(spacings)]
    by_enthalpy = []
    by_rule = []
    # Both fluences over the spacing: whole layers, and with what was about to leave.
    for k, fluence in enumerate((10, 20)):
        stefan = 1e6 * solutions[10, fluence].depth
        found = [columns[10, fluence, d] for d in spacings]
        whole, smooth = [one.whole for one in found], [one.smooth for one in found]
        label = f"{fluence} J/cm$^2$, whole layers"
        late = {"linestyle": "--", "marker": "^", "markersize": 4}
        by_enthalpy += [
            line(ends, [stefan, stefan], "", k, linewidth=0.8, linestyle=":"),
            line(spacings, whole, label, k, marker="o", markersize=4),
            line(spacings, smooth, "with what was about to leave", k, **late),
        ]
    # The published rule by its presets.
    for k, (preset, found) in enumerate(sorted(published.items())):
        values = [found[10, 10, d].whole for d in spacings]
        label = f"10 J/cm$^2$, {preset}"
        by_rule.append(line(spacings, values, label, 3 + k, marker="s", markersize=4))
    study.draw(
        "depth-spacing",
        Panel("spacing [µm]", DEPTH, by_enthalpy, "(a) enthalpy; dotted: Stefan solution", low=0.0),
        Panel("spacing [µm]", DEPTH, by_rule, "(b) published rule", low=0.0),
        height=3.6,
    )
