"""Flow in the forecast of a case: expected speed, step limits, and how well it is resolved.

Speeds are estimates: a wall's or a start's own; below a surface of imposed temperature that of
slow flow (`analytic.thermocapillary_layer`), or of the layer that a moving surface drags along; in
a box heated at its sides a fifth of g beta dT L under the root (natural convection at Ra 1e3 to 1e5
has 0.14 to 0.26 of it); in a melt pool under light that of `driven_speed`, from the temperatures
that light is expected to reach along the surface; in one that its faces heat the estimate
delta/eta |dgamma/dT dT/dx| [Demuth2020, eq. (79)] with delta = sqrt(nu t) and the liquid's range of
temperatures over a quarter of the width.
"""

from __future__ import annotations

from dataclasses import replace
from math import pi, sqrt

import numpy as np
from numpy.typing import NDArray

from lasersph.analytic.melt_depth import MeltEstimate, SurfaceHistory
from lasersph.analytic.thermocapillary_layer import ThermocapillaryLayer
from lasersph.boundaries.flow_conditions import FREE
from lasersph.boundaries.initial_flow import TaylorGreenFlow
from lasersph.boundaries.settings import DIRICHLET
from lasersph.case import Case
from lasersph.case.size import has_spot_in_the_middle
from lasersph.input import format_quantity
from lasersph.particles.layers import Layers
from lasersph.physics.dimensionless import marangoni_number, peclet_number, reynolds_number
from lasersph.physics.flow_limits import flow_limits
from lasersph.simulation.layers import melt_across
from lasersph.simulation.recipes.melt_pool.driven_speed import (
    BELOW_LID,
    BELOW_MOVING_SURFACE,
    driven_speed,
)
from lasersph.simulation.recipes.melt_pool.surfaces import recoil_of
from lasersph.simulation.recipes.recipe import FEWEST_ROWS, FlowForecast, resolving_spacing
from lasersph.solvers.melt_pool.layout_renewal import HEIGHT_RANGE
from lasersph.solvers.melt_pool.settings import MeltPoolSettings
from lasersph.surface.capillary_waves import surface_limits
from lasersph.surface.height_field import cutoff_of

Array = NDArray[np.float64]
BUOYANT_SHARE = 0.2
"""Share of the speed of free fall that buoyant flow has. Forecast: a guess, on which only the
expected time depends."""
MOLTEN_PULSES = 8.0
"""How long a pool lasts, in durations of the pulse. Forecast: those of the texturing cases last 3
to 5."""
MIN_LAYERS = 8
"""Rows of melt below which there is hardly a flow. Forecast: `lasersph check` says so."""
SPEED_NODES = 65
"""Nodes of the means of viscosity and surface tension. Forecast: over the melt's temperatures."""
SPOT = 0.6
"""Melt of a round spot over that of columns in a plane, which lose less heat. Forecast: `spot-weld`
at 3.6 um, a quarter more than flow in the mean."""
DEPTH_MARGIN = 1.2
"""Depth of fine layers that is asked for over the least one. Forecast: for what the estimate
misses."""


def flow_forecast(
    case: Case, solver: MeltPoolSettings, spacing: float, heating: MeltEstimate | None
) -> FlowForecast:
    """Forecast of the flow of a melt-pool case; spacing as used [m], estimate of its heat."""
    material = case.material
    T = material.flow_temperature
    nu, density = float(material.kinematic_viscosity_at(T)), material.density_liquid
    slope = abs(_slope(case, T)) if solver.marangoni else 0.0

    # A pool: its layer delta = sqrt(nu t) under the gradient of surface tension; light gives
    # better.
    if case.flow is None:
        layer, gradient, duration = _pool(case, nu)
        speed = layer / (nu * density) * slope * gradient
        if heating is not None and heating.surface is not None:
            speed = _pool_speed(case, solver, heating.surface)
            # Where nothing melts there is no layer to resolve.
            layer = layer if heating.surface.depth.any() else None
    else:
        # A box: the largest of its own speeds; only a free surface has a gradient.
        layer = None
        gradient = _imposed_gradient(case)
        duration = case.time.end
        speed = _box_speed(case, solver.gravity, nu, density, slope)
        if case.flow.surface.kind not in FREE:
            gradient = 0.0

    # Acceleration by surface stress on one layer of particles, or by buoyancy.
    lift = solver.gravity * float(material.expansion_at(T)) * _temperature_range(case)
    acceleration = max(slope * gradient / (density * spacing), lift)
    has_gamma = material.surface_tension is not None
    limits = flow_limits(
        solver.step_limits,
        support=case.particles.support_over_spacing * spacing,
        speed=speed,
        acceleration=acceleration,
        viscosity=nu,
        diffusivity=material.diffusivity_reference,
        density=density,
        surface_tension=float(material.surface_tension_at(T)) if has_gamma else 0.0,
        is_implicit=solver.viscosity == "implicit",
        is_passing=solver.rests,
    )

    # Capillary waves limit steps where the surface moves.
    if case.surface_moves and has_gamma:
        gamma = float(material.surface_tension_at(T))
        limits |= surface_limits(gamma, density, nu, cutoff_of(spacing))
    numbers = pool_numbers(case, heating, speed) if case.flow is None else {}
    layers = {} if not numbers else boundary_layers(numbers, heating)
    thin = _thin_layers(layers, spacing)
    warnings = (*_warnings(layer, spacing), *(f"{text}; take a finer one" for text in thin))
    return FlowForecast(speed, layer, duration, limits, warnings, numbers, layers, thin)


def pool_numbers(case: Case, heating: MeltEstimate | None, speed: float) -> dict[str, float]:
    """Re, Pe, Ma and Ca of the pool that light is expected to melt; empty where nothing melts.

        Re = u d/nu,    Pe = u d/a,    Ma = |dgamma/dT| (T_max - T_l) d/(eta a),    Ca = eta u/gamma

    with its depth d and the properties of the liquidus; Ca only of a metal with a gamma.
    """
    surface = None if heating is None else heating.surface
    if surface is None or not surface.depth.any():
        return {}
    # depth and range of temperatures of the estimate
    material, depth = case.material, float(surface.depth.max())
    T = material.flow_temperature
    hot = max(float(surface.temperature.max()) - T, 0.0)
    eta, a = float(material.viscosity_at(T)), material.diffusivity_reference
    numbers = {
        "Re": reynolds_number(speed, depth, float(material.kinematic_viscosity_at(T))),
        "Pe": peclet_number(speed, depth, a),
        "Ma": abs(marangoni_number(_slope(case, T), hot, depth, eta, a)),
    }
    if material.surface_tension is not None:
        numbers["Ca"] = eta * speed / float(material.surface_tension_at(T))
    return numbers


def boundary_layers(numbers: dict[str, float], heating: MeltEstimate | None) -> dict[str, float]:
    """Thickness of the layers [m] in which velocity and temperature change, d/sqrt(Re) and
    d/sqrt(Pe), where they are thinner than the pool, whose depth is d.

    Not d/sqrt(Ma), which is the layer of heat at the speed that viscosity alone would allow: in a
    weld, whose speed inertia limits, Ma is 20 times Pe.
    """
    assert heating is not None and heating.surface is not None
    depth = float(heating.surface.depth.max())
    found = {"viscous layer": numbers["Re"], "thermal layer": numbers["Pe"]}
    return {name: depth / sqrt(number) for name, number in found.items() if number > 1.0}


def flowing_share(case: Case, layers: Layers, melt: MeltEstimate | None) -> float:
    """Share of the finest particles that flow, in the mean of the time in which any do; 1 where no
    light is expected to melt them.

    Args:
        melt: the estimate of what light melts, None without light.
    """
    # of a spot, whose finest columns reach beyond its melt, in columns from its center outward
    width = 1.0
    if layers.beside and case.laser is not None and has_spot_in_the_middle(case):
        melt = melt_across(case, 0.5 * case.laser.spot_fluence.diameter)
        if melt.surface is not None and melt.surface.column_width is not None:
            columns = melt.surface.depth.shape[1]
            width = SPOT * columns * melt.surface.column_width / layers.fine_bounds[0][1]
    surface = None if melt is None else melt.surface
    if surface is None or not surface.depth.any():
        return 1.0
    # depth in the mean of columns and of the times of melt
    molten = surface.depth.any(axis=1)
    lasting = np.diff(surface.time, prepend=surface.time[0])[molten]
    depth = np.average(surface.depth[molten].mean(axis=1), weights=lasting)
    return min(width * float(depth) / layers.fine_depth, 1.0)


def _pool_speed(case: Case, solver: MeltPoolSettings, surface: SurfaceHistory) -> float:
    """Speed of the surface of a pool under light [m/s], see `driven_speed`."""
    material, recoil = case.material, recoil_of(case)
    cold, metal = material.flow_temperature, case.material.vaporization
    if metal is not None and metal.critical_temperature is not None:  # there is no surface above
        cooler = np.minimum(surface.temperature, metal.critical_temperature)
        surface = replace(surface, temperature=cooler)
    # Tables over the temperatures of the melt.
    T = np.linspace(cold, max(cold + 1.0, float(surface.temperature.max())), SPEED_NODES)
    nu = np.array([float(material.kinematic_viscosity_at(t)) for t in T])
    slope = np.array([_slope(case, t) if solver.marangoni else 0.0 for t in T])
    drawn = driven_speed(
        surface,
        length=0.25 * _pattern_length(case),
        cold=cold,
        density=material.density_liquid,
        viscosity=lambda at: np.interp(at, T, nu),
        slope=lambda at: np.interp(at, T, slope),
        pressure=recoil if recoil is not None and case.surface_moves else np.zeros_like,
        confinement=BELOW_MOVING_SURFACE if case.surface_moves else BELOW_LID,
    )
    stress = float(np.abs(slope).max()) * (T[-1] - cold) / (0.25 * _pattern_length(case))
    crossing = crossing_speed(stress, 0.25 * _pattern_length(case), material.density_liquid, nu)
    return min(drawn, crossing) if drawn > 0.0 else drawn


def crossing_speed(stress: float, length: float, density: float, viscosity: Array) -> float:
    """Speed that liquid has which a stress [Pa] draws over a length [m], on its way alone [m/s].

    u = (2 tau/rho) sqrt(t/(pi nu)) with t = length/u, [(2 tau/rho)^2 length/(pi nu)]^(1/3): pools
    of welds, which are much larger than the layer that viscosity reaches in that time.
    """
    nu = float(np.mean(viscosity))
    return ((2.0 * stress / density) ** 2 * length / (pi * nu)) ** (1.0 / 3.0)


def _pattern_length(case: Case) -> float:
    """Length over which the light repeats, or of its spot [m]; without light that of the domain."""
    own = None if case.laser is None else case.laser.beam.lateral_length
    return own or case.domain.width or case.domain.depth


def _slope(case: Case, temperature: float) -> float:
    """d gamma/dT [N/(m K)], 0 where the material has none."""
    try:
        return float(case.material.surface_tension_slope_at(temperature))
    except ValueError:
        return 0.0


def _pool(case: Case, viscosity: float) -> tuple[float, float, float]:
    """Layer [m], gradient of temperature [K/m] and duration [s] of a pool."""
    pulse_time, first = case.time.end, 0.0
    if case.laser is not None:
        # The pool begins with the first light and lasts some durations of the pulse.
        pulse = case.laser.pulse
        pulse_time = pulse.on_time or 100.0 * pulse.resolution
        marks = pulse.breakpoints(0.0, case.time.end)
        first = min((float(mark) for mark in marks if mark > 0.0), default=0.0)
    layer = min(sqrt(viscosity * pulse_time), case.domain.depth)
    duration = min(MOLTEN_PULSES * pulse_time, max(case.time.end - first, 0.0))
    return layer, _temperature_range(case) / (0.25 * _pattern_length(case)), duration


def _temperature_range(case: Case) -> float:
    """How much temperatures of the liquid may differ [K]."""
    material, faces = case.material, case.boundaries
    # From melting to boiling; a metal without a boiling point may get half as hot again.
    if case.flow is None:
        boiling = material.vaporization.temperature if material.vaporization else None
        return (boiling or 1.5 * material.flow_temperature) - material.flow_temperature
    # Of a box, the range of what its faces and its start have.
    given = [
        faces.temperature_of(face, case.initial_temperature)
        for face in ("surface", "bottom", "left", "right")
        if faces.kind_of(face) in DIRICHLET
    ]
    return max([*given, case.initial_temperature]) - min([*given, case.initial_temperature])


def _imposed_gradient(case: Case) -> float:
    """Largest gradient of the temperature imposed on the surface of a box [K/m]."""
    drive = case.boundaries.temperature_drive
    if drive is not None:
        return drive.shape.steepest
    x, *_ = case.domain.lateral(case.geometry)
    return _temperature_range(case) / (x[1] - x[0])


def _box_speed(case: Case, gravity: float, viscosity: float, density: float, slope: float) -> float:
    """Largest speed to expect in a box [m/s]."""
    assert case.flow is not None
    # Walls and the initial flow.
    speeds = [abs(side.velocity) for side in case.flow.faces.values()]
    if isinstance(case.flow.initial, TaylorGreenFlow):
        speeds.append(case.flow.initial.speed)
    # Buoyancy: a share of the speed of free fall, sqrt(g beta dT L).
    difference = _temperature_range(case)
    T = case.material.flow_temperature
    lift = gravity * float(case.material.expansion_at(T)) * difference
    speeds.append(BUOYANT_SHARE * sqrt(lift * case.domain.depth))
    # Surface stress: by an open layer, a wave of temperature, or steady shear above a bottom.
    wave = case.boundaries.surface_temperature_wave
    if case.flow.surface.kind in FREE and slope:
        eta = viscosity * density
        if case.surface_moves:
            speeds.append(_open_layer_speed(case, slope * _imposed_gradient(case), viscosity, eta))
        elif wave is not None:
            layer = ThermocapillaryLayer(
                case.domain.depth, wave.period, wave.amplitude, -slope, eta
            )
            speeds.append(abs(layer.surface_speed))
        else:
            speeds.append(0.25 * case.domain.depth / eta * slope * _imposed_gradient(case))
    return max(speeds)


def _open_layer_speed(case: Case, stress: float, viscosity: float, eta: float) -> float:
    """Largest speed of a layer whose surface moves under a stress [Pa]: that of a half space at
    rest, Stokes' first problem, and no more than steady shear over the bottom [m/s]."""
    drive, end = case.boundaries.temperature_drive, case.time.end
    # Stokes' first problem, u = (tau/eta) 2 sqrt(nu t/pi); steady shear has u = tau d/eta.
    lasting = end if drive is None else min(drive.end or end, end) - drive.start
    return stress / eta * min(2.0 * sqrt(viscosity * max(lasting, 0.0) / pi), case.domain.depth)


def recession_warning(case: Case, layers: Layers, evaporated: float) -> str:
    """Warning where the finest layers are too shallow for what light evaporates; empty elsewhere.

    All of their particles become lower where the surface recedes, which the run bears down to
    `layout_renewal.HEIGHT_RANGE[0]` of a spacing.

    Args:
        evaporated: metal that a pulse is expected to evaporate [m].
    """
    if not case.surface_moves or not case.solver.has_vapor_flux or case.laser is None:
        return ""
    # A layer that loses `gone` must keep the least share of its thickness.
    pulses = case.laser.pulse.count if case.pause != "compute" else 1
    gone, times = pulses * evaporated, 1.0 / (1.0 - HEIGHT_RANGE[0])
    if times * gone <= layers.fine_depth:
        return ""
    key = "particles.fine_depth" if case.particles.arrangement == "graded" else "domain.depth"
    enough = format_quantity(DEPTH_MARGIN * times * gone, "m", 2)
    return (
        f"about {format_quantity(gone, 'm', 2)} will evaporate; the finest layers must be "
        f"{times:.2g} times as deep, and reach {format_quantity(layers.fine_depth, 'm', 3)}: the "
        f'run is likely to stop before its end; write {key} = "{enough}"'
    )


def _thin_layers(layers: dict[str, float], spacing: float) -> tuple[str, ...]:
    """Sentences of the boundary layers that the spacing does not resolve, and what that spoils."""
    spoiled = {
        "viscous layer": "the speed of the surface",
        "thermal layer": "the heat that the flow carries, and so depth and width",
    }
    return tuple(
        f"the {name} of the pool is about {format_quantity(thickness, 'm', 3)} thick, less than "
        f"{FEWEST_ROWS} spacings of {format_quantity(spacing, 'm', 3)}: {spoiled[name]} will be off"
        for name, thickness in layers.items()
        if thickness < FEWEST_ROWS * spacing
    )


def _warnings(layer: float | None, spacing: float) -> list[str]:
    """Say what few rows spoil in a layer: steel, 101 nm thick, has with 7.8, 3.2, 1.7 and 1
    spacings in it a surface 0, 4, 11 and 4 % off that of 12.6 and particles 7, 31, 57 and 79 % too
    slow (`lasersph run dlip-steel --anyway` with particles.spacing of 13, 32, 60 and 100 nm)."""
    if layer is None or layer >= MIN_LAYERS * spacing:
        return []
    rows = layer / spacing
    spoiled = (
        "there is no profile of speeds in it: the speed of the surface may be off by a tenth, "
        "those of particles by more than half"
        if rows < FEWEST_ROWS
        else "the flow below the surface will be too slow, by a third where it has three, that "
        "of the surface by a few percent"
    )
    return [
        f"the layer that the surface drags along is about {format_quantity(layer, 'm', 3)} thick, "
        f"{rows:.1f} spacings of {format_quantity(spacing, 'm', 3)}: {spoiled}; "
        f'particles.spacing = "{resolving_spacing(layer, MIN_LAYERS)}" resolves it'
    ]
