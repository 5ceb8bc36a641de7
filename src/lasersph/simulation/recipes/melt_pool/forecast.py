"""What flow adds to the forecast of a case: expected speed, step limits, and how well it resolves.

Speeds are estimates: a wall's or a start's own; a surface of imposed temperature that of slow flow
(`analytic.thermocapillary_layer`); a box heated at its sides a fifth of g beta dT L under the root
(natural convection at Ra 1e3 to 1e5 has 0.14 to 0.26 of it); a melt pool the estimate
delta/eta |dgamma/dT dT/dx| [Demuth2020, eq. (79)] with delta = sqrt(nu t) of the pulse and the
liquid's range of temperatures over a quarter of the pattern.
"""

from __future__ import annotations

from math import pi, sqrt

import numpy as np
from numpy.typing import NDArray

from lasersph.analytic.thermocapillary_layer import ThermocapillaryLayer
from lasersph.boundaries.flow_conditions import FREE
from lasersph.boundaries.initial_flow import TaylorGreenFlow
from lasersph.boundaries.settings import DIRICHLET
from lasersph.boundaries.surface_line import cutoff_of
from lasersph.boundaries.surface_waves import surface_limits
from lasersph.case import Case
from lasersph.input import format_quantity
from lasersph.irradiation.light import COLDEST, HOTTEST
from lasersph.lasers import GaussianBeam, InterferenceBeam
from lasersph.materials.sections import Vaporization
from lasersph.particles.layers import Layers
from lasersph.physics.evaporation import latent_heat, vapor_constants
from lasersph.physics.flow_limits import flow_limits
from lasersph.physics.knudsen_layer import outflow_tables
from lasersph.physics.losses import evaporation_loss
from lasersph.simulation.layers import caloric_curve, expected_melt
from lasersph.simulation.recipes.melt_pool.build import TABLE_NODES, TABLE_START
from lasersph.simulation.recipes.recipe import FlowForecast
from lasersph.solvers.melt_pool.layout_renewal import EVEN
from lasersph.solvers.melt_pool.settings import MeltPoolSettings

BUOYANT_SHARE = 0.2
MOLTEN_PULSES = 8.0
"""How long a pool lasts, in durations of the pulse."""
FEWEST_ROWS = 8
ROOM = 1.2
"""Of the depth that is asked for over the least one, for what the estimate misses."""


def flow_forecast(case: Case, solver: MeltPoolSettings, spacing: float) -> FlowForecast:
    """Forecast of the flow of a melt-pool case; spacing as used [m]."""
    material = case.material
    T = material.flow_temperature
    nu, density = float(material.kinematic_viscosity_at(T)), material.density_liquid
    slope = abs(_slope(case, T)) if solver.marangoni else 0.0
    if case.flow is None:
        layer, gradient, duration = _pool(case, nu)
        speed = layer / (nu * density) * slope * gradient
    else:
        layer, gradient, duration = None, _imposed_gradient(case), case.time.end
        speed = _box_speed(case, solver.gravity, nu, density, slope)
        if case.flow.surface.kind not in FREE:
            gradient = 0.0
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
    )
    if case.surface_moves and has_gamma:
        gamma = float(material.surface_tension_at(T))
        limits |= surface_limits(gamma, density, nu, cutoff_of(spacing))
    return FlowForecast(speed, layer, duration, limits, tuple(_warnings(layer, spacing)))


def _slope(case: Case, temperature: float) -> float:
    """d gamma/dT [N/(m K)], 0 where the material has none."""
    try:
        return float(case.material.surface_tension_slope_at(temperature))
    except ValueError:
        return 0.0


def _pool(case: Case, viscosity: float) -> tuple[float, float, float]:
    """Layer [m], gradient of temperature [K/m] and duration [s] of a pool."""
    pulse_time, first, length = case.time.end, 0.0, case.domain.width or case.domain.depth
    if case.laser is not None:
        pulse = case.laser.pulse
        pulse_time = pulse.on_time or 100.0 * pulse.resolution
        beam = case.laser.beam
        if isinstance(beam, InterferenceBeam) and beam.lateral_period:
            length = beam.lateral_period
        elif isinstance(beam, GaussianBeam):
            length = 2.0 * beam.radius
        marks = pulse.breakpoints(0.0, case.time.end)
        first = min((float(mark) for mark in marks if mark > 0.0), default=0.0)
    layer = min(sqrt(viscosity * pulse_time), case.domain.depth)
    duration = min(MOLTEN_PULSES * pulse_time, max(case.time.end - first, 0.0))
    return layer, _temperature_range(case) / (0.25 * length), duration


def _temperature_range(case: Case) -> float:
    """How much temperatures of the liquid may differ [K]."""
    material, faces = case.material, case.boundaries
    if case.flow is None:
        boiling = material.vaporization.temperature if material.vaporization else None
        return (boiling or 1.5 * material.flow_temperature) - material.flow_temperature
    given = [
        faces.temperature_of(face, case.initial_temperature)
        for face in ("surface", "bottom", "left", "right")
        if faces.kind_of(face) in DIRICHLET
    ]
    return max([*given, case.initial_temperature]) - min([*given, case.initial_temperature])


def _imposed_gradient(case: Case) -> float:
    """Largest gradient of the temperature imposed on the surface of a box [K/m]."""
    wave = case.boundaries.surface_temperature_wave
    if wave is not None:
        return 2.0 * pi * abs(wave.amplitude) / wave.period
    (x,) = case.domain.lateral(2)
    return _temperature_range(case) / (x[1] - x[0])


def _box_speed(case: Case, gravity: float, viscosity: float, density: float, slope: float) -> float:
    """Largest speed to expect in a box [m/s]."""
    assert case.flow is not None
    speeds = [abs(side.velocity) for side in case.flow.faces.values()]
    if isinstance(case.flow.initial, TaylorGreenFlow):
        speeds.append(case.flow.initial.speed)
    difference = _temperature_range(case)
    T = case.material.flow_temperature
    lift = gravity * float(case.material.expansion_at(T)) * difference
    speeds.append(BUOYANT_SHARE * sqrt(lift * case.domain.depth))
    wave = case.boundaries.surface_temperature_wave
    if case.flow.surface.kind in FREE and slope:
        eta = viscosity * density
        if wave is not None:
            layer = ThermocapillaryLayer(
                case.domain.depth, wave.period, wave.amplitude, -slope, eta
            )
            speeds.append(abs(layer.surface_speed))
        else:
            speeds.append(0.25 * case.domain.depth / eta * slope * _imposed_gradient(case))
    return max(speeds)


def recession_warning(case: Case, layers: Layers) -> str:
    """What is said where the finest layers are too shallow for what light evaporates; else nothing.

    All of their particles become lower where the surface recedes, which the run bears down to
    `layout_renewal.EVEN[0]` of a spacing. Where they could be too shallow if all light that is
    absorbed made vapor, the depth is estimated, see `analytic.melt_depth`.
    """
    metal, laser = case.material.vaporization, case.laser
    if not case.surface_moves or not case.solver.has_vapor_flux or metal is None or laser is None:
        return ""
    pulses = laser.pulse.count if case.pause != "compute" else 1
    bearable = (1.0 - EVEN[0]) * layers.fine_depth / pulses
    constants, (ratio, flux, _) = vapor_constants(metal), outflow_tables()
    T = np.linspace(TABLE_START, constants["T_c"], TABLE_NODES)
    constants |= {"p_e": case.boundaries.pressure_of_surroundings}
    loss = (evaporation_loss(t, **constants, ratio_nodes=ratio, flux_nodes=flux) for t in T)
    heat, _, mass = np.array(list(loss)).T
    _, R = laser.reflectivity_table(case.material, COLDEST, HOTTEST)
    light = laser.mean_fluence if isinstance(laser.beam, InterferenceBeam) else laser.peak_fluence
    absorbed = (1.0 - min(R)) * light * float(laser.pulse.delivered(0.0, case.end_of_pulse))
    if absorbed <= bearable * case.material.density_reference * _least_heat_of_vapor(
        case, metal, T
    ):
        return ""
    melt = expected_melt(case, lambda at: (np.interp(at, T, mass), np.interp(at, T, heat)))
    if melt is None or melt.evaporated <= bearable:
        return ""
    gone, times = pulses * melt.evaporated, 1.0 / (1.0 - EVEN[0])
    key = "particles.fine_depth" if case.particles.arrangement == "graded" else "domain.depth"
    return (
        f"about {format_quantity(gone, 'm', 2)} will evaporate; the finest layers must be "
        f"{times:.2g} times as deep, and reach {format_quantity(layers.fine_depth, 'm', 3)}: the "
        f'run would stop; write {key} = "{format_quantity(ROOM * times * gone, "m", 2)}"'
    )


def _least_heat_of_vapor(case: Case, metal: Vaporization, T: NDArray[np.float64]) -> float:
    """Least heat that metal takes with it as vapor of one of these temperatures [J/kg]."""
    curve, vapor = caloric_curve(case), vapor_constants(metal)
    h = np.interp(T, curve.temperature, curve.enthalpy)
    (h1, h2), (T1, T2) = curve.enthalpy[-2:], curve.temperature[-2:]
    h += np.maximum(T - T2, 0.0) * (h2 - h1) / (T2 - T1)
    latent = [latent_heat(t, vapor["T_b"], vapor["L_b"], vapor["T_c"]) for t in T]
    return float(np.min((h + latent)[case.material.flow_temperature < T]))


def _warnings(layer: float | None, spacing: float) -> list[str]:
    if layer is None or layer >= FEWEST_ROWS * spacing:
        return []
    return [
        f"the layer that the surface drags along is about {format_quantity(layer, 'm', 3)} thick, "
        f"less than {FEWEST_ROWS} spacings of {format_quantity(spacing, 'm', 3)}: take a finer one"
    ]
