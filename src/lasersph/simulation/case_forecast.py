"""`Forecast`: what a case will cost, and how `lasersph check` says it."""

from __future__ import annotations

from dataclasses import dataclass, field
from math import isfinite

from lasersph.case import Case
from lasersph.case.size import in_words, memories
from lasersph.case.solver_choice import has_two_temperatures
from lasersph.input import format_duration, format_number, format_quantity
from lasersph.input.text_table import text_table
from lasersph.materials.viscosity import viscosity_text
from lasersph.physics.ablation_estimates import skin_fluence
from lasersph.simulation.heating import HeatingForecast, reflectivity_at
from lasersph.simulation.hot_electrons import optics_of_hot_electrons, vaporizing_fluence
from lasersph.simulation.known_loops import known_loops
from lasersph.simulation.light_text import heating_rows, light_rows
from lasersph.simulation.recipes import FlowForecast

SECONDS_PER_LOOP = 0.06
"""Time to compile a loop [s]. Forecast: 158 loops of `lasersph run dlip-steel --quick` in an empty
cache took 8 s of processor time more than in a full one, on two cores."""


@dataclass(frozen=True)
class Forecast:
    """Cost and warnings of a case; printed, the rows of `lasersph check` and its warnings.

    Attributes:
        case: the case in question.
        particles: count.
        layers: count.
        pairs: estimate, of what is active.
        memory: peak [bytes].
        spacing: finest, as used [m].
        fine_depth: of the finest layers [m]. fine_width: from the middle or the axis, of the
            finest columns [m], None where columns do not grow.
        limits: time-step limits [s] while the light is on.
        binding: name of the smallest of them.
        steps: estimate.
        wall_time: rough estimate [s] on `threads` threads.
        absorption_length: 1/alpha [m], None where there is no light.
        penetration: sqrt(D t_p) [m], None where there is no light.
        warnings: sentences for a user to think about.
        flow: forecast of the flow, if there is one.
        heating: effect of the light on the surface, if there is any.
        threads: for which the time was asked.
        backend: "cpu" or "cuda", for which the memory was asked.
        half: forecast of the same case with half the spacing, where that was asked.
    """

    case: Case = field(repr=False)
    particles: int
    layers: int
    pairs: float
    memory: float
    spacing: float
    fine_depth: float
    limits: dict[str, float]
    binding: str
    steps: int
    wall_time: float
    absorption_length: float | None
    penetration: float | None
    warnings: tuple[str, ...] = field(default=())
    fine_width: float | None = None
    flow: FlowForecast | None = None
    heating: HeatingForecast | None = None
    threads: int = 1
    backend: str = "cpu"
    half: Forecast | None = field(default=None, repr=False)

    def __str__(self) -> str:
        """Rows and warnings, as `lasersph check` prints them."""
        return "\n".join([text_table(_rows(self)), *(f"warning: {text}" for text in self.warnings)])


def _rows(expected: Forecast) -> list[tuple[str, str]]:
    """Rows of what a case is and what it will cost, each with its name."""
    case = expected.case
    threads = expected.threads
    backend = expected.backend
    there = [words.format(in_words(most)) for words, most in memories(backend) if isfinite(most)]
    time = f"roughly {format_duration(expected.wall_time)} on {threads} thread{'s' * (threads > 1)}"

    # What is computed: case, light, particles, memory.
    rows = [
        ("case", case.title or case.name),
        ("material", case.material.title or case.material.name),
        ("solver", f"{case.solver.kind}, {case.solver.dimensions}-D, {case.solver.scheme_text}"),
        *([] if case.laser is None else light_rows(case.laser)),
        *([] if expected.heating is None else heating_rows(case, expected.heating)),
        ("particles", f"{expected.particles} in {expected.layers} layers"),
        ("finest spacing", _finest(expected)),
        ("memory", ", ".join([f"about {in_words(expected.memory)}", *there])),
    ]

    # The limits of the step, the smallest first.
    for name, limit in sorted(expected.limits.items(), key=lambda item: item[1]):
        binds = "  <- binding" if name == expected.binding else ""
        shown = format_quantity(limit, "s") if isfinite(limit) else "none"
        rows.append((f"step limit: {name}", shown + binds))
    if loss := _losses(case):
        rows.append(("surface loses heat", loss))

    # How much work that is.
    rows.append(("steps", f"about {expected.steps} to {format_quantity(case.time.end, 's')}"))
    rows.append(("time", time if backend == "cpu" else "not estimated for a graphics card"))
    if loops := known_loops(case):
        longer = format_duration(SECONDS_PER_LOOP * loops)
        rows.append(("besides", "start and figures, some seconds each"))
        rows.append(("first run", f"compiles up to {loops} loops, once: roughly {longer} more"))
    if (half := expected.half) is not None:
        longer = f"roughly {format_duration(half.wall_time)}"
        text = f"{half.particles} particles, {in_words(half.memory)}, {longer}"
        rows.append(("with half the spacing", text))
    if expected.flow is not None:
        rows.append(("viscosity of the melt", viscosity_text(case.material)))
        rows.append(("expected speed", f"up to about {format_number(expected.flow.speed, 2)} m/s"))
        if numbers := expected.flow.numbers:
            text = ", ".join(f"{name} {format_number(value, 2)}" for name, value in numbers.items())
            rows.append(("numbers of the pool", text))

    # Short pulses: what would vaporize the skin that the light heats at first.
    if estimate := skin_estimate(case):
        rows.append(("vaporizes its skin", f"from about {estimate:.2g} J/cm^2, by energy alone"))

    # Lengths that the particles must resolve.
    for name, length in (
        ("moving layer", expected.flow.layer if expected.flow else None),
        *(expected.flow.layers.items() if expected.flow else ()),
        ("absorption length", expected.absorption_length),
        ("thermal penetration", expected.penetration),
    ):
        if length:
            cells = f"{format_number(length / expected.spacing, 2)} spacings"
            rows.append((name, f"{format_quantity(length, 'm')}, {cells}"))
    return rows


def _finest(expected: Forecast) -> str:
    """Where particles are finest."""
    depth = format_quantity(expected.fine_depth, "m")
    text = f"{format_quantity(expected.spacing, 'm')} in the top {depth}"
    if expected.fine_width is None:
        return text
    middle = "axis" if expected.case.geometry.is_axisymmetric else "middle"
    return f"{text}, out to {format_quantity(expected.fine_width, 'm')} from the {middle}"


def _losses(case: Case) -> str:
    """Heat losses of the surface in words, and who says so; empty where there are none."""
    boundaries = case.boundaries
    # A value of the case goes before that of the metal.
    owner = "as given" if boundaries.emissivity is not None else f"of {case.material.name}"
    surroundings = boundaries.surroundings(case.material, case.initial_temperature)
    parts = []
    if surroundings.emissivity:
        parts.append(f"radiation, emissivity {surroundings.emissivity:g} {owner}")
    if surroundings.convection:
        parts.append(f"convection, {format_quantity(surroundings.convection, 'W/(m^2 K)')}")
    to = format_quantity(surroundings.temperature, "K")
    return f"{'; '.join(parts)}; to {to}" if parts else ""


def skin_estimate(case: Case) -> float | None:
    """Fluence that vaporizes the skin which light and the electrons' range heat [J/cm^2].

    None with one temperature, and for a metal that does not boil.
    """
    electrons, vapor = case.material.electrons, case.material.vaporization
    is_short = has_two_temperatures(case.solver) and case.laser is not None
    if not is_short or electrons is None or vapor is None or case.laser is None:
        return None
    # from the initial temperature to vapor, over the depth of light and electrons
    curve = case.material.caloric_curve(case.initial_temperature, "hold")
    depth = 1.0 / case.laser.absorption_coefficient(case.material)
    depth += electrons.ballistic_range or 0.0
    heat = case.material.density_reference * float(curve.enthalpy_vaporized or 0.0)
    # hot electrons take up more than cold metal
    if (optics := optics_of_hot_electrons(case)) is not None:
        return 1e-4 * vaporizing_fluence(case, optics, heat)
    absorptivity = 1.0 - reflectivity_at(case, case.initial_temperature)
    return 1e-4 * skin_fluence(depth, heat, absorptivity)
