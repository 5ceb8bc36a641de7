"""From a case to the surface of what flows, its columns at the start, and what its faces do."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from lasersph.boundaries.flow_conditions import FREE
from lasersph.boundaries.initial_surface import InitialSurface
from lasersph.boundaries.settings import DIRICHLET
from lasersph.case import Case
from lasersph.compute.backend import Backend
from lasersph.particles.layers import Layers
from lasersph.physics.recoil import tabulated_recoil
from lasersph.solvers.melt_pool.face_conditions import FaceConditions
from lasersph.solvers.melt_pool.liquid import Liquid
from lasersph.solvers.melt_pool.settings import MeltPoolSettings
from lasersph.surface.flat_surface import FlatSurface, ImposedTemperature
from lasersph.surface.forcing import SurfaceForcing
from lasersph.surface.height_field import HeightField, cutoff_of
from lasersph.surface.moving_surface import MovingSurface
from lasersph.surface.pressure_condition import SurfaceLiquid
from lasersph.surface.pressure_gradient import DifferenceGradient, SymmetricGradient
from lasersph.surface.riding_surface import RidingSurface
from lasersph.surface.smoothing import End, Ends
from lasersph.surface.surface import Surface


def surface_of(
    case: Case,
    settings: MeltPoolSettings,
    layers: Layers,
    liquid: Liquid,
    support: float,
    backend: Backend,
    count: int,
) -> Surface:
    """A surface that moves, a flat free one, or none below a lid, for `count` particles.

    Args:
        support: of the finest particles [m].
    """
    if case.surface_moves:
        kind = RidingSurface if case.geometry.is_axisymmetric else MovingSurface
        return kind(
            backend,
            count,
            line=surface_line(case, layers),
            bottom=-layers.fine_depth,
            spacing=layers.spacing,
            support=support,
            liquid=_surface_liquid(case, liquid),
            has_stress=settings.marangoni,
            forcing=_forcing(case),
        )
    conditions, gradient = face_conditions(case, layers), SymmetricGradient()
    if conditions.flow_kind("surface") not in FREE:
        # no wall whose force is wanted, no axis along which momentum stays
        if conditions.are_mirrors:
            gradient = DifferenceGradient()
        return Surface(backend, count, 0.0, layers.dimension, pressure_gradient=gradient)
    is_section = case.geometry.is_axisymmetric
    return FlatSurface(
        backend,
        count,
        dimension=layers.dimension,
        plane=0.0,
        spacing=layers.spacing,
        support=support,
        material=case.material,
        viscosity=liquid.viscosity * liquid.density,
        has_stress=settings.marangoni,
        given=_given_temperature(case),
        pressure_gradient=DifferenceGradient() if is_section else gradient,
    )


def _surface_liquid(case: Case, liquid: Liquid) -> SurfaceLiquid:
    """The melt that a moving surface bounds."""
    return SurfaceLiquid(
        liquid.density,
        case.material.density_reference,
        liquid.viscosity * liquid.density,
        liquid.relative_viscosity,
        case.material,
    )


def _forcing(case: Case) -> SurfaceForcing:
    """Temperature, pressure, mass flux and recoil that are imposed on a moving surface."""
    boundaries = case.boundaries
    return SurfaceForcing(
        _given_temperature(case),
        boundaries.pressure_drive,
        boundaries.surface_mass_flux_wave,
        recoil_of(case),
    )


def face_conditions(case: Case, layers: Layers) -> FaceConditions:
    """Heat and flow at the faces of what may flow, which stays among the fine columns."""
    box = (*layers.fine_bounds, (-float(layers.thickness.sum()), 0.0))
    return FaceConditions(
        box,
        case.boundaries,
        case.flow,
        case.initial_temperature,
        has_axis=case.geometry.is_axisymmetric,
    )


def surface_line(case: Case, layers: Layers) -> HeightField:
    """Columns of a surface below which melt flows, at their heights at the start.

    It goes on as the flow does beyond its ends; at walls it is pinned at its height there.
    """
    conditions = face_conditions(case, layers)
    shape = tuple(map(int, layers.fine_only.columns[:, 0]))
    sides = conditions.box[:-1]
    widths = tuple((high - low) / n for (low, high), n in zip(sides, shape, strict=True))
    kinds: dict[str, End] = {"symmetry": "mirror", "free-slip": "mirror", "periodic": "periodic"}
    ends: tuple[Ends, ...] = tuple(
        (kinds.get(conditions.flow_kind(a), "pinned"), kinds.get(conditions.flow_kind(b), "pinned"))
        for a, b in conditions.faces[:-1]
    )
    line = HeightField(
        *(tuple(low for low, _ in sides), widths, shape, ends, cutoff_of(max(widths))),
        is_axisymmetric=case.geometry.is_axisymmetric,
    )
    start = case.initial_surface
    # Heights at the start; at walls the ends stay where they are.
    if start is not None:
        line.height = mean_heights(case, line.places, widths)
        line.pins = tuple(
            (_heights_at(start, line, axis, low), _heights_at(start, line, axis, high))
            for axis, (low, high) in enumerate(sides)
        )
    return line


def _heights_at(
    start: InitialSurface, line: HeightField, axis: int, end: float
) -> float | NDArray[np.float64]:
    """Heights at an end of an axis [m], one for each line of columns that ends there."""
    if len(line.shape) == 1:
        return float(start.at(np.array(end)))
    along = line.centers(1 - axis)
    places = [along, along]
    places[axis] = np.full(along.size, end)
    return start.shape_at(places[0], places[1])


def mean_heights(
    case: Case, places: tuple[NDArray[np.float64], ...], widths: tuple[float, ...]
) -> NDArray[np.float64]:
    """Heights at the start in the mean over columns around places [m]."""
    start = case.initial_surface
    assert start is not None
    if len(places) == 1:
        return start.at(places[0], widths[0], is_ring=case.geometry.is_axisymmetric)
    return start.mean_over_columns((places[0], places[1]), (widths[0], widths[1]))


def recoil_of(case: Case) -> Callable[[NDArray[np.float64]], NDArray[np.float64]] | None:
    """Gauge recoil [Pa] of the vapor at temperatures [K], where vapor leaves the surface."""
    vapor = case.material.vaporization
    if vapor is None or not case.solver.has_vapor_flux:
        return None
    return tabulated_recoil(vapor, case.boundaries.pressure_of_surroundings)


def _given_temperature(case: Case) -> ImposedTemperature | None:
    if case.boundaries.kind_of("surface") not in DIRICHLET:
        return None
    mean = case.boundaries.temperature_of("surface", case.initial_temperature)
    return ImposedTemperature(mean, case.boundaries.temperature_drive)
