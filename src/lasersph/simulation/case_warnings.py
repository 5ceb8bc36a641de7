"""Warnings about a case before its run, each a sentence with its numbers."""

from __future__ import annotations

from collections.abc import Iterator
from math import isnan, pi, sqrt

import numpy as np

from lasersph.case import Case
from lasersph.case.quick import what_is_not_shown
from lasersph.case.solver_choice import (
    allows_two_temperatures,
    chooses_vaporization,
    computes_flow,
    has_two_temperatures,
    missing_for_flux,
    wants_vapor_flux,
)
from lasersph.input import format_quantity
from lasersph.materials.caloric_curve import CaloricCurve
from lasersph.output.settings import DEFAULT_COUNT
from lasersph.particles.layers import LEAST_BESIDE, Layers
from lasersph.physics.ablation_estimates import PHASE_EXPLOSION
from lasersph.physics.electron_lattice import (
    OTHERS_SAY,
    SLOWEST,
    Electrons,
    coupling_time,
    electrons_of,
    surface_excess,
)
from lasersph.simulation.heating import HeatingForecast
from lasersph.simulation.layers import electron_reach

FEWEST_SPACINGS = 2.0
"""Spacings in the length over which light changes along the surface. Forecast: 12 of them make a
period."""
LEAST_HELD = 1e-9
"""Depth of metal kept at its boiling point of which it is worth to speak [m]. Forecast: some
atoms."""
NEAR_BOILING = 0.8
"""Expected temperature over that of boiling from which missing vapor is told. Forecast: at 0.8 the
vapor of a metal pushes with some hundredths of an atmosphere, and a temperature is expected to a
fifth."""
SHORT_PULSE = 3.0
"""Coupling times that a pulse must last for electrons and lattice to have one temperature.
Forecast: what is left of a difference after three is a twentieth."""
MOST_EXCESS = 0.05
"""Difference of electrons and lattice that is told, over the rise of the surface [1]. Forecast:
that of the table of metals on the page of short pulses, which is followed within 2.5 times."""
LEAST_RISE = 1.0
"""Rise of the temperature under light of which it is worth to speak [K]. Forecast: less is no
texturing, and the noise of many numbers."""
MOST_FRAMES = 10_000
"""Snapshots of a run that are proposed. Cost: a hundred times those of shipped cases."""
MOST_LIGHT = 100.0
"""Heat of the light over that which boils what it heats. Forecast: shipped cases, ablation
included, have less; mJ in place of uJ makes 1500 of a texture of copper."""


def run_warnings(
    case: Case, layers: Layers, curve: CaloricCurve, heating: HeatingForecast | None
) -> Iterator[str]:
    """Warnings that hold of any solver: resolution, sizes, vapor, electrons, snapshots."""
    if text := what_is_not_shown(case):
        yield text
    # Whole cells fill the domain, which moves the spacing.
    spacing = layers.spacing
    if abs(spacing - case.particles.spacing) > 1e-2 * case.particles.spacing:
        yield (
            f"spacing {format_quantity(case.particles.spacing, 'm')} is rounded to "
            f"{format_quantity(spacing, 'm')} so that whole cells fill the domain"
        )
    if case.particles.fine_width is not None and not layers.beside:
        yield (
            f"particles.fine_width of {format_quantity(case.particles.fine_width, 'm')} changes "
            "nothing: less of the block lies beside it than coarse columns need, "
            f"{LEAST_BESIDE:g} support radii of the thickest layer"
        )
    if case.laser is not None and heating is not None:
        yield from _resolution(case, layers)
        yield from _sizes(case, heating)
        yield from _no_melt(case, heating)
        yield from _vapor(case, heating)
        yield from _electrons(case, curve, heating)
        yield from _resting_spot(case)
        yield from _frames(case)
    # Where heat raises the temperature without a boiling point there is no end to it.
    changes = case.solver.phase_change and (case.laser is not None or case.material.melting)
    if changes and case.material.vaporization is None:
        hot = "" if heating is None else f" (here to {heating.temperature:.0f} K)"
        yield (
            f'no boiling point is given of "{case.material.name}": its temperature rises without '
            f"limit{hot}; give temperature and latent_heat in [material.vaporization]"
        )
    if case.time.is_fixed:
        yield "the time step is fixed: it may be unstable"


def _resting_spot(case: Case) -> Iterator[str]:
    """A spot that is said to move from pulse to pulse, which only the texture of a spot follows."""
    assert case.laser is not None
    spot = case.laser.spot
    pulses = case.laser.pulse.count
    shift = case.laser.displacement
    is_shifted = spot is not None and (spot.shift is not None or spot.scan_speed is not None)
    if is_shifted and shift is not None and pulses > 1:
        yield (
            f"the spot does not move by {format_quantity(shift, 'm')} from pulse to pulse in a "
            f"run: all {pulses} pulses fall where the first does; lasersph texture moves it"
        )


def _frames(case: Case) -> Iterator[str]:
    """Snapshots of a flow that are further apart than its pulse lasts."""
    interval = case.output.snapshots.interval or case.end_of_pulse / DEFAULT_COUNT
    duration = pulse_duration(case)
    assert case.laser is not None
    # The melt of a pulse lasts about as long as the pulse.
    if computes_flow(case.solver) and interval > duration and not case.output.snapshots.times:
        finer = 0.1 * duration
        # Ten in a pulse to the end may be more than a disk holds.
        few = case.laser.pulse.count * case.end_of_pulse / finer < MOST_FRAMES
        name = (
            f'interval = "{format_quantity(finer, "s", 2)}"' if few else "times, those of interest"
        )
        yield (
            f"snapshots are {format_quantity(interval, 's', 3)} apart, longer than the pulse of "
            f"{format_quantity(duration, 's', 3)}: figures miss the fastest flow, numbers do not; "
            f"write output.snapshots.{name}"
        )


def absorption_length(case: Case) -> float:
    """1/alpha of the light of a case [m]."""
    assert case.laser is not None
    return 1.0 / case.laser.absorption_coefficient(case.material)


def pulse_duration(case: Case) -> float:
    """Time over which a pulse delivers its energy [s]."""
    assert case.laser is not None
    return case.laser.pulse.on_time or 100.0 * case.laser.pulse.resolution


def penetration_depth(case: Case) -> float:
    """Thermal penetration of a pulse, sqrt(D t_p) [m] [Alshaer2017, eq. (34)], or where hot
    electrons carry heat further, their reach."""
    heat = sqrt(case.material.diffusivity_reference * pulse_duration(case))
    return max(heat, electron_reach(case))


def _resolution(case: Case, layers: Layers) -> Iterator[str]:
    """Heat and light that are finer than the particles, or do not fit into the domain."""
    assert case.laser is not None
    spacing = layers.spacing
    length = absorption_length(case)
    heat = penetration_depth(case)

    # Heat: three spacings in sqrt(D t_p) are the least.
    if spacing > heat / 3.0:
        yield (
            f"the heat of a pulse reaches {format_quantity(heat, 'm', 3)}, less than 3 "
            f"spacings of {format_quantity(spacing, 'm', 3)}: take a finer spacing"
        )

    # Light in depth: the energy of a layer is exact, but its shape is lost; nothing is lost where
    # heat spreads it over three spacings within the pulse.
    if 0.0 < length < spacing > heat / 3.0:
        yield (
            f"the light is absorbed within {format_quantity(length, 'm', 3)}, less than one"
            f" spacing of {format_quantity(spacing, 'm', 3)}: its profile is not resolved, though"
            " its energy is exact"
        )

    # Light along the surface: of a pattern, its period over 2 pi.
    scale = case.laser.beam.scale
    if scale < FEWEST_SPACINGS * spacing and case.solver.dimensions > 1:
        yield (
            f"the light changes along the surface within {format_quantity(scale, 'm', 3)}, a "
            f"pattern of {format_quantity(2.0 * pi * scale, 'm', 3)}, less than "
            f"{FEWEST_SPACINGS:.0f} spacings of {format_quantity(spacing, 'm', 3)}: take a finer "
            "spacing"
        )

    # The bottom is felt from about a fifth of the depth.
    if layers.thickness.sum() < 5.0 * heat:
        yield (
            f"the domain is {format_quantity(float(layers.thickness.sum()), 'm', 3)} deep, less "
            f"than 5 penetration depths of {format_quantity(heat, 'm', 3)}: the bottom will be felt"
        )

    # A pulse that begins after the end heats nothing.
    if not case.laser.pulse.delivered(0.0, case.time.end) > 0.0:
        yield (
            f"no light falls before time.end of {format_quantity(case.time.end, 's')}: nothing "
            "will be heated"
        )


def _sizes(case: Case, heating: HeatingForecast) -> Iterator[str]:
    """Energies that are so large or small that their unit is likely to be wrong."""
    assert case.laser is not None
    laser, boiling = case.laser, case.material.vaporization
    name = next(
        key for key in ("pulse_energy", "fluence", "power", "intensity") if _has(laser, key)
    )
    if isnan(heating.temperature):
        return
    # Too little light: the rise at the surface.
    rise = heating.temperature - heating.cold
    if 0.0 < rise < LEAST_RISE:
        yield (
            f"the light heats the surface by {rise:.2g} K only: is laser.{name} right, or its unit?"
        )
    if boiling is None:
        return
    # Too much light: the absorbed fluence over rho (sqrt(D t_p) + 1/alpha) c_p (T_v - T_0), the
    # heat that brings the layer which the pulse reaches to its boiling point.
    heated = case.material.density_reference * (penetration_depth(case) + absorption_length(case))
    capacity = float(case.material.heat_capacity_at(case.material.reference_temperature))
    needed = heated * capacity * (boiling.temperature - heating.cold)
    ratio = heating.absorbed_peak / needed
    if ratio > MOST_LIGHT:
        yield (
            f"the light brings {format_quantity(1e-4 * heating.absorbed_peak, '', 3)} J/cm^2, "
            f"{ratio:.2g} times what boils the layer of this metal that it heats: is laser.{name} "
            "right, or its unit (mJ where uJ is meant), or the size of the spot?"
        )


def _no_melt(case: Case, heating: HeatingForecast) -> Iterator[str]:
    """A pool under light that does not melt the metal: nothing flows, and no relief stays."""
    melting = case.material.melting
    if melting is not None and heating.melts is False and computes_flow(case.solver):
        yield (
            f"nothing melts by estimate: light heats the surface to {heating.temperature:.0f} K, "
            f"and this metal melts at {melting.solidus:.0f} K, so that nothing flows and no relief "
            "stays; lasersph threshold --of melt finds where that begins"
        )


def _has(laser: object, key: str) -> bool:
    return getattr(laser, key) is not None


def _vapor(case: Case, heating: HeatingForecast) -> Iterator[str]:
    """Metal that a plateau keeps though it should leave, and heat beyond all models of vapor."""
    metal, solver = case.material.vaporization, case.solver
    if metal is None or not chooses_vaporization(solver):
        return

    # A flux of vapor needs data that not every metal has.
    missing = " and ".join(missing_for_flux(case.material))
    add = f"; give {missing} in [material.vaporization]" if missing else ""
    boils = f"it boils at {metal.temperature:.0f} K"
    is_cold = heating.temperature < NEAR_BOILING * metal.temperature
    wants_flux = wants_vapor_flux(solver, case.material) and not solver.has_vapor_flux

    # A surface that moves and gets hot, but cannot lose vapor.
    if wants_flux and missing and not is_cold:
        yield (
            f'no vapor leaves the surface that moves, or pushes it: "{case.material.name}" has no '
            f"{missing}; light heats it to about {heating.temperature:.0f} K, {boils}{add}"
        )
    elif heating.held > LEAST_HELD:
        # A plateau that takes up so much heat that vapor would have left.
        how = "" if missing else '; solver.vaporization = "flux" computes it'
        yield (
            f"by estimate the surface is held at its boiling point of {metal.temperature:.0f} K, "
            f"with the heat that would turn {format_quantity(heating.held, 'm', 2)} of metal "
            f"into vapor: vapor that leaves, its push and a hotter surface are left out{how or add}"
        )

    # Beyond the critical temperature no model of evaporation holds.
    critical = metal.critical_temperature
    if critical is not None and heating.temperature > PHASE_EXPLOSION * critical:
        yield (
            f"light heats the surface to more than {PHASE_EXPLOSION * critical:.0f} K, "
            f"{PHASE_EXPLOSION:g} of the critical temperature: metal explodes into vapor and drops "
            "there, which is left out"
        )


def _electrons(case: Case, curve: CaloricCurve, heating: HeatingForecast) -> Iterator[str]:
    """How long electrons are hotter than the lattice, where a pulse is not much longer; with two
    temperatures, what other numbers of the electrons would change."""
    if has_two_temperatures(case.solver):
        if said := OTHERS_SAY.get(case.material.name):
            yield f"{case.material.name}: {said}"
        return
    material, pulse = case.material, pulse_duration(case)
    # A metal without data for its electrons is judged by the one that couples them most weakly.
    electrons = electrons_of(material.name)
    # Where the estimate has no temperature, the end of the curve stands for it.
    hottest = np.nan_to_num(heating.temperature, nan=float(curve.temperature[-1]))
    hottest = min(max(hottest, heating.cold), float(curve.temperature[-1]))
    density = material.density_reference
    time = coupling_time(
        electrons or SLOWEST,
        heat=density * max(float(curve.enthalpy_at(hottest)), 0.0),
        lattice=density * float(material.heat_capacity_at(material.reference_temperature)),
        cold=heating.cold,
    )
    if pulse > SHORT_PULSE * time:
        yield from _excess(case, electrons, pulse)
        return
    than = "longer than" if time > pulse else "comparable with"
    bound = "" if electrons else f', if "{material.name}" couples them as weakly as gold'
    yield (
        f"electrons are hotter than the lattice for about {format_quantity(time, 's', 2)}{bound}, "
        f"{than} the pulse of {format_quantity(pulse, 's', 3)}: this run has one temperature, and "
        f"its heat, melt and vapor are not those of such a pulse; {_two_temperatures(case)}"
    )


def _excess(case: Case, electrons: Electrons | None, pulse: float) -> Iterator[str]:
    """Electrons that stay hotter than the lattice all along a pulse, as they carry heat on."""
    material = case.material
    if electrons is None:
        return
    conductivity = float(material.conductivity_at(material.reference_temperature))
    share = surface_excess(
        electrons, conductivity, material.diffusivity_reference, absorption_length(case), pulse
    )
    if share > MOST_EXCESS:
        yield (
            f"electrons carry heat on before the lattice has it: at the surface both differ by "
            f"about {100.0 * share:.0f} % of its rise under a pulse of "
            f"{format_quantity(pulse, 's', 3)}, and this run has one temperature; "
            f"{_two_temperatures(case)}"
        )


def _two_temperatures(case: Case) -> str:
    """Say how to compute both temperatures, for this metal and solver."""
    model = 'heat = "two-temperature" in [solver] computes both'
    if not allows_two_temperatures(case.solver):
        return f'{model}, with kind = "conduction"'
    if case.material.electrons is None:
        return f"{model}, and needs heat_capacity and coupling in [material.electrons]"
    return model
