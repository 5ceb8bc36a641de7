"""From a case to the layers of its particles."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from lasersph.analytic.melt_depth import MeltEstimate, Vapor, melt_depth
from lasersph.case import Case
from lasersph.case.size import has_spot_in_the_middle
from lasersph.case.solver_choice import has_two_temperatures
from lasersph.irradiation.light import COLDEST, HOTTEST
from lasersph.materials.caloric_curve import CaloricCurve
from lasersph.particles.layers import Layers, stack
from lasersph.simulation.hot_electrons import mean_reflectivity, optics_of_hot_electrons

Array = NDArray[np.float64]
ESTIMATE_COLUMNS = 8
"""Columns of the 1-D estimate of the melt depth. Forecast: it tells the fine depth."""
LEAST_FINE_LAYERS = 8
"""Finest layers at least. Geometry: two supports of 3.75 spacings, so that surface and the first
graded layer do not meet."""
WIDTH_COLUMNS = 24
"""Columns of the estimate of the radius of the melt. Forecast: it tells the fine width."""
MOST_RADII = 4.0
"""Radii of the light and of the heat around it over which it is made. Forecast: melt ends within
one, the bound only keeps columns narrow in wide blocks."""
WIDENING = 1.25
"""Radius of a pool over that of the estimate, which leaves out how the flow widens it. Forecast:
a pool that grows further ends its run with the width to give."""
KEPT_ESTIMATES = 64
"""Estimates that a process keeps. Format: those of a study's runs, of which most differ in spacing
alone; each is some hundred kB."""
ABSORPTION_LENGTHS = 12.0
"""Depth of the finest layers in units of 1/alpha, at least. Accuracy: exp(-12) = 6e-6 of the light
goes deeper."""


def caloric_curve(case: Case) -> CaloricCurve:
    """Enthalpy curve of the case's material with the case's plateau rule."""
    return case.material.caloric_curve(
        case.initial_temperature, case.solver.curve_plateau, phase_change=case.solver.phase_change
    )


def lay_out(case: Case, melt: Callable[[], MeltEstimate | None] | None = None) -> Layers:
    """Layers of the case; where graded and not given, depth and width of the finest particles
    follow from an estimate.

    Args:
        melt: the estimate, where it is known already.
    """
    lattice = case.particles
    depth, width = lattice.fine_depth or 0.0, lattice.fine_width or np.inf
    if lattice.arrangement == "graded":
        if lattice.fine_depth is None:
            depth = fine_depth(case, melt() if melt is not None else expected_melt(case))
        if lattice.fine_width is None:
            width = fine_width(case, depth)
    return stack(case.domain, lattice, case.geometry, depth, width)


def fine_width(case: Case, fine_depth: float) -> float:
    """How far from the middle or the axis columns are finest [m]: where the light of a resting spot
    falls and melts, with solid beside it; infinite where that is not so or not known.

    Args:
        fine_depth: of the finest layers [m].
    """
    laser = case.laser
    if laser is None or not has_spot_in_the_middle(case):
        return np.inf
    radius = 0.5 * laser.spot_fluence.diameter
    melt = melt_radius(melt_across(case, radius))
    if melt == 0.0:
        return np.inf
    # a pool that flows keeps a margin to the coarse columns, and one support more
    lattice = case.particles
    ratio = lattice.support_over_spacing
    layers = stack(case.domain, lattice, case.geometry, fine_depth)
    solid = layers.solid_margin(ratio) + ratio * layers.spacing
    return max(radius, WIDENING * melt) + solid


def melt_across(case: Case, radius: float) -> MeltEstimate:
    """Expected melt of a spot in columns from its center outward.

    They lie side by side in a plane, which loses less heat than a disk.

    Args:
        radius: of the light [m].
    """
    # columns as far as heat goes, or as the block is wide
    farthest = max(max(-low, high) for low, high in case.domain.lateral(case.geometry))
    heat = float(np.sqrt(case.material.diffusivity_reference * case.end_of_pulse))
    width = min(farthest, MOST_RADII * (radius + heat)) / WIDTH_COLUMNS
    return _estimate(case, WIDTH_COLUMNS, width)


def melt_radius(melt: MeltEstimate) -> float:
    """How far from its center the light of a spot melts a metal [m], by `melt_across`; 0 where it
    does not."""
    surface = melt.surface
    if surface is None or surface.column_width is None or melt.depth == 0.0:
        return 0.0
    molten = np.flatnonzero(surface.depth.max(axis=0) > 0.0)
    return float(molten[-1] + 1) * surface.column_width


def fine_depth(case: Case, melt: MeltEstimate | None) -> float:
    """Depth of the finest layers [m]: expected melt plus two support radii, and all the light."""
    spacing = case.particles.spacing
    # At least a few layers, and all in which light is absorbed.
    least = LEAST_FINE_LAYERS * spacing
    if case.laser is not None:
        alpha = case.laser.absorption_coefficient(case.material)
        least = max(least, ABSORPTION_LENGTHS / alpha)
    if melt is None or melt.depth == 0.0:
        return least
    # The melt of the estimate with its safety, and two supports of solid below it.
    return max(least, melt.safe_depth + 2.0 * case.particles.support_over_spacing * spacing)


def electron_reach(case: Case) -> float:
    """Depth to which hot electrons carry heat [m]: their ballistic range, and that of diffusion
    while they couple, sqrt(k/G); 0 with one temperature."""
    material = case.material
    if material.electrons is None or not has_two_temperatures(case.solver):
        return 0.0
    cold = case.initial_temperature
    coupling = float(material.electrons.coupling.at(cold))
    spread = (float(material.conductivity_at(cold)) / coupling) ** 0.5
    return (material.electrons.ballistic_range or 0.0) + spread


def expected_melt(case: Case, vapor: Vapor | None = None) -> MeltEstimate | None:
    """How deep light will melt the case, and when; None without light or melting.

    Args:
        vapor: flux that leaves the surface, for what evaporates; layers do not count on it.
    """
    melts = case.solver.phase_change and case.material.melting is not None
    return expected_heating(case, vapor) if melts else None


def expected_heating(case: Case, vapor: Vapor | None = None) -> MeltEstimate | None:
    """How hot light will make the surface, of metals that do not melt as well; None without light.

    Where a plateau holds the boiling temperature it also says how much metal that keeps.
    """
    laser = case.laser
    if laser is None:
        return None
    # Hot electrons spread the heat before the lattice has it.
    if has_two_temperatures(case.solver):
        optics = optics_of_hot_electrons(case)
        laser = laser.carried_by(case.material, electron_reach(case))
        # and take up more of the light
        if optics is not None:
            reflectivity = mean_reflectivity(case, optics)
            laser = laser.model_copy(update={"reflectivity": reflectivity})
        case = case.model_copy(update={"laser": laser})

    # A pattern needs columns from a bright line to a dark one, half a period apart; a spot only the
    # one in its center.
    width = case.domain.width
    if width is not None and laser.is_even and laser.beam.is_pattern:
        return _estimate(case, ESTIMATE_COLUMNS, 0.5 * width / ESTIMATE_COLUMNS, vapor)
    return _estimate(case, 1, None, vapor)


@dataclass(frozen=True)
class _Columns:
    """Columns of an estimate, and as text all of the case that it reads."""

    case: Case = field(compare=False)
    content: str
    pause: str
    end: float
    count: int
    width: float | None
    vapor: Vapor | None


def _estimate(
    case: Case, columns: int, column_width: float | None, vapor: Vapor | None = None
) -> MeltEstimate:
    """Heat of the light in columns from its center outward; one alone has the peak fluence."""
    # what a study or a page asks for again differs in nothing that heats the metal
    content = case.model_dump_json(include={"laser", "material", "initial_temperature", "solver"})
    end = case.end_of_pulse
    return _solved(_Columns(case, content, case.pause, end, columns, column_width, vapor))


@lru_cache(maxsize=KEPT_ESTIMATES)
def _solved(given: _Columns) -> MeltEstimate:
    """The estimate, computed once in a process."""
    case, laser = given.case, given.case.laser
    columns, column_width, vapor = given.count, given.width, given.vapor
    assert laser is not None
    # Where pauses are jumped over, each pulse meets metal that is cold again.
    if case.pause != "compute":
        laser = laser.first_pulse

    fluence = np.array([laser.peak_fluence])
    if column_width is not None:
        # Mean energy per area in each column; divided by the share that is delivered, so that a
        # fluence of the whole pulse comes out.
        faces = np.arange(columns + 1) * column_width
        pulse = laser.pulse
        share = float(pulse.delivered(-np.inf, np.inf)) or 1.0
        density = laser.energy_density(faces[None, :-1], faces[None, 1:], -np.inf, np.inf)
        fluence = density / share
    curve = caloric_curve(case)
    T, R = laser.reflectivity_table(case.material, COLDEST, HOTTEST)

    def reflectivity(surface: Array, begin: float, end: float) -> Array:
        """R at temperatures of the surface [K], or that of the step where it is one over time."""
        if not laser.absorbs_over_time:
            return np.interp(surface, T, R)
        interval = (begin, end)
        _, now = laser.reflectivity_table(case.material, COLDEST, HOTTEST, interval)
        return np.full_like(surface, now[0])

    return melt_depth(
        enthalpy=curve.enthalpy,
        temperature=curve.temperature,
        potential=curve.potential,
        melt_fraction=curve.melt_fraction,
        density=case.material.density_reference,
        absorption_coefficient=laser.absorption_coefficient(case.material),
        reflectivity=reflectivity,
        fluence=fluence,
        delivered=laser.pulse.delivered,
        end_time=given.end,
        column_width=column_width,
        vapor=vapor,
        boiling=_start_of_boiling(curve),
    )


def _start_of_boiling(curve: CaloricCurve) -> tuple[float, float] | None:
    """Enthalpy at which a plateau holds the boiling temperature, and latent heat of vaporization
    [J/kg]; None where none does."""
    if curve.vaporization is None or curve.plateau == "evaporate":
        return None
    return float(curve.enthalpy_at(curve.vaporization)), curve.latent_heats[1]
