"""The figures of one run, drawn from its folder, by name; `pictures` writes all of them."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Literal, NamedTuple

from lasersph.input import did_you_mean
from lasersph.output import OutputError, Run, RunOrFolder, open_run
from lasersph.output.last_pulse import last_pulse, starts_after_pauses
from lasersph.plots import flow_history, history, style
from lasersph.plots.ablation_fields import has_ablation
from lasersph.plots.ablation_history import crater_history, trace_figure
from lasersph.plots.crater_cut import crater_cut, ejecta_vectors
from lasersph.plots.crater_view import crater_view
from lasersph.plots.flow_cells import flow_cell_map
from lasersph.plots.flow_fields import is_box
from lasersph.plots.flow_history import center_line_figure
from lasersph.plots.flow_map import LEAST_SPREAD, box_flow_map, pool_flow_map
from lasersph.plots.particle_map import arrangement, particle_map
from lasersph.plots.pulses import pulses_compared
from lasersph.plots.relief import (
    final_relief,
    relief_after_pulses,
    relief_map,
    relief_profiles,
    topography_history,
)
from lasersph.plots.surface_maps import (
    surface_flow_map,
    surface_height_map,
    surface_sections,
    surface_temperature_map,
)
from lasersph.plots.surface_profiles import surface_flow_profiles, surface_profiles
from lasersph.plots.uncertainty import tornado_chart

if TYPE_CHECKING:
    from matplotlib.figure import Figure


class Drawing(NamedTuple):
    """A figure of a run.

    Attributes:
        name: of its file. caption: below it.
        draw: draws it; None where it does not apply.
        part: of the report in which it stands.
        has_all_pulses: whether it shows a whole train; else its last pulse alone.
    """

    name: str
    caption: str
    draw: Callable[[Run], Figure | None]
    part: Literal["results", "more", "computation"] = "results"
    has_all_pulses: bool = False


def draw_arrangement(run: Run) -> Figure | None:
    """The particles as they lay at the start."""
    if not len(run.snapshots):
        return None
    return arrangement(run.snapshots[0], across=run.across)


def unless_isothermal(draw: Callable[[Run], Figure | None]) -> Callable[[Run], Figure | None]:
    """A drawing that is left out where the temperature is the same everywhere and always."""

    def draw_or_not(run: Run) -> Figure | None:
        # Isothermal: the whole run stays within rounding of one temperature.
        history = run.history
        coldest = float(history["temperature_surface_min_K"].min())
        hottest = float(history["temperature_max_K"].max())
        return draw(run) if hottest - coldest > LEAST_SPREAD * hottest else None

    return draw_or_not


def in_one_body(draw: Callable[[Run], Figure | None]) -> Callable[[Run], Figure | None]:
    """A drawing of metal that stays in one body, with its surface at z = 0."""
    return lambda run: None if is_box(run) or has_ablation(run) else draw(run)


DRAWINGS = (
    Drawing(
        "relief-section",
        "The surface at the end over the metal, colored by how far it has been molten; the height"
        " is drawn larger than the width. Dashed: the original surface.",
        final_relief,
    ),
    Drawing(
        "relief",
        "The surface at several times. Heights count from the original surface.",
        relief_profiles,
    ),
    Drawing(
        "relief-pulses",
        "The surface as it froze after some of the pulses, the last among them.",
        relief_after_pulses,
        has_all_pulses=True,
    ),
    Drawing(
        "relief-map",
        "Height of the surface over place and time.",
        relief_map,
    ),
    Drawing(
        "surface-height",
        "Height of the surface at the end, with lines of equal height; heights count from the"
        " original surface.",
        surface_height_map,
    ),
    Drawing(
        "surface-sections",
        "Sections through the surface at the end: along x, along y and along the diagonal x = y.",
        surface_sections,
    ),
    Drawing(
        "surface-speed",
        "Speed of the surface when it was fastest, with streamlines of the liquid.",
        surface_flow_map,
    ),
    Drawing(
        "surface-temperature",
        "Temperature of the surface when it was hottest. Lines: the melting range.",
        surface_temperature_map,
    ),
    Drawing(
        "topography",
        "Depth of the lowest point and height of the rim over time (above); arithmetic and root"
        " mean square height of the profile, Pa and Pq, or of the area, Sa and Sq (below).",
        topography_history,
    ),
    Drawing(
        "pulses",
        "The pulses over each other, each over the time since its own start.",
        pulses_compared,
        has_all_pulses=True,
    ),
    Drawing(
        "crater",
        "Cut through the crater when it had its final volume: temperature of the body and of the"
        " ejecta above it, with arrows of their velocity. Dashed: the original surface. In 1-D"
        " temperature against height.",
        crater_cut,
    ),
    Drawing("crater-3d", "Surface of the crater and ejecta, colored by temperature.", crater_view),
    Drawing(
        "crater-history",
        "Depth of the crater over time (above; the shade is the power of the light) and where the"
        " absorbed energy went (below).",
        crater_history,
    ),
    Drawing(
        "ejecta",
        "Velocity of the ejecta in the cut through the crater, when a third of the volume had left"
        " (where a snapshot shows it) and when all had.",
        ejecta_vectors,
    ),
    Drawing(
        "traces",
        "Temperature and speed of single particles. Regions of the first one: heated by conduction"
        " (I), at or above the boiling point (II), ejected (III); its speed: at rest (I), the jump"
        " (II), rising until it leaves (III), steady (IV).",
        trace_figure,
    ),
    Drawing(
        "flow",
        "The melt pool when its flow was strongest: temperature; speed, with arrows whose length"
        " grows with the root of the speed; phase, with streamlines of the liquid.",
        pool_flow_map,
    ),
    Drawing(
        "flow-cells",
        "The cells in which the melt of a round spot turns, when its flow was strongest, with"
        " streamlines: red where it flows outward at the top of the cell, blue where inward. Below:"
        " how high they are and which volume they turn, over time.",
        flow_cell_map,
    ),
    Drawing(
        "box-flow",
        "The box at the end: speed, with arrows whose length grows with the root of the speed, and"
        " streamlines, over the temperature where it varies.",
        box_flow_map,
    ),
    Drawing(
        "center-lines",
        "Velocity along the lines through the middle of the box, at the end.",
        center_line_figure,
    ),
    Drawing(
        "nusselt",
        "Nusselt numbers of the sides of the box, in each step, and of the whole box.",
        flow_history.nusselt_history,
    ),
    Drawing(
        "temperature",
        "Temperature over time. The shade at the foot is the power of the incident light; gray"
        " lines, where in view, mark the melting range and the vaporization temperature.",
        unless_isothermal(history.temperature_history),
    ),
    Drawing(
        "melt-pool",
        "Size of the melt pool over time: full width at the surface and depth below the original"
        " surface, for completely fluid, half molten and any molten material. Each size is drawn"
        " once, in the middle of the time for which it stood.",
        history.melt_pool_history,
    ),
    Drawing(
        "particles",
        "Temperature and melt fraction of the particles near the surface, at the snapshot closest"
        " to the deepest melt (without melt: to the largest temperature).",
        in_one_body(particle_map),
    ),
    Drawing(
        "flow-speed",
        "Largest speeds over time: of the surface, extrapolated with the stress there; one spacing"
        " below it; of any particle; and against the outward flow.",
        flow_history.speed_history,
    ),
    Drawing(
        "energy",
        "Where the absorbed energy is (above), and the relative error of the energy balance"
        " (below).",
        unless_isothermal(history.energy_history),
    ),
    Drawing(
        "surface-profiles",
        "Temperature along the surface at several times.",
        in_one_body(surface_profiles),
        part="more",
    ),
    Drawing(
        "surface-flow",
        "Along the surface at several times: (a) temperature, (b) its gradient, (c) velocity.",
        surface_flow_profiles,
        part="more",
    ),
    Drawing(
        "flow-extrema",
        "Extrema of the surface speed over time, told apart: the outer one, there from the onset"
        " of the flow, and the inner one, closer to the maximum of the light, where it exists.",
        flow_history.extrema_history,
        part="more",
    ),
    Drawing(
        "flow-layer",
        "Thickness of the layer that flows outward, below the fastest place of the surface"
        " (above), and mean gradient of the temperature along the liquid surface (below).",
        flow_history.layer_history,
        part="more",
    ),
    Drawing(
        "surface-pressure",
        "Pressure of the liquid at its surface, beside the recoil pressure of the vapor. A flat"
        " surface holds the liquid with it and feels no recoil; its mean over the liquid is zero.",
        flow_history.surface_pressure_history,
        part="more",
    ),
    Drawing(
        "uncertainty",
        "What the errors of the main results are made of: the numerical part, and the change with"
        " each input two standard uncertainties up and down, in percent of the result.",
        tornado_chart,
        has_all_pulses=True,
    ),
    Drawing(
        "time-step",
        "Time step, colored by what limited it, and iterations of each step.",
        history.time_step_history,
        part="computation",
    ),
    Drawing(
        "flow-quality",
        "Quality of the computed flow: kinetic energy; root mean square of the divergence that"
        " the projection leaves, relative to the largest speed over the spacing; smallest distance"
        " of two particles, relative to the first.",
        flow_history.quality_history,
        part="computation",
    ),
    Drawing(
        "arrangement",
        "Particles as they lay at the start: the whole body, and a detail at the surface.",
        draw_arrangement,
        part="computation",
        has_all_pulses=True,
    ),
)


Begun = Callable[[str, int, int], None]
"""Called before something is drawn: its name, how many are drawn, of how many."""


def pulse_note(pulses: int) -> str:
    """Words that a figure of the last of several pulses bears."""
    return f"pulse {pulses} of {pulses}; times count from its start"


def captions() -> dict[str, str]:
    """Caption of each figure of a run by its name, in reading order."""
    return {drawing.name: drawing.caption for drawing in DRAWINGS}


def plot(run: RunOrFolder, name: str) -> Figure:
    """A figure of a run, as `draw_run` writes it: of a train of pulses the last one, with a note.

        figure = lasersph.plot("runs/dlip-steel", "temperature")
        figure.axes[0].set_xlim(0.0, 100.0)
        figure.savefig("temperature.pdf")

    The functions of `lasersph.plots` draw them too, at the times that one wants.

    Args:
        run: a run, or its folder.
        name: "temperature", "melt-pool", "particles", "flow", "relief", "crater", "energy" ...;
            `lasersph.plots.captions()` has all, with what they show.

    Raises:
        OutputError: the run has no history yet, or nothing of what the figure shows.
        ValueError: there is no figure of this name.
    """
    if name not in captions():
        hint = did_you_mean(name, captions()) or f"; there are {', '.join(captions())}"
        raise ValueError(f'no figure "{name}"{hint}')
    # A figure of a train shows its last pulse, and says so.
    opened = with_history(run)
    figure = figure_of(opened, last_pulse(opened), name)
    if figure is None:
        raise OutputError(f'{opened.path} has no figure "{name}": it has nothing of what it shows')
    return figure


def with_history(folder: RunOrFolder) -> Run:
    """The run in a folder. Raises OutputError where nothing can be drawn of it yet."""
    run = open_run(folder)
    if len(run.history.get("time_s", ())) < 2:
        raise OutputError(f"{run.path} has no history to draw yet")
    return run


def figure_of(run: Run, shown: Run, name: str) -> Figure | None:
    """A figure of a run, whose last pulse is `shown`, by name; None where it does not apply."""
    drawing = next(one for one in DRAWINGS if one.name == name)
    figure = drawing.draw(run if drawing.has_all_pulses else shown)
    pulses = 1 + len(starts_after_pauses(run))
    if figure is not None and pulses > 1 and not drawing.has_all_pulses:
        style.note(figure, pulse_note(pulses))
    return figure
