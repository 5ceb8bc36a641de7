"""The light of a case in words: pattern, spot, fluences and what they mean, pulses per spot."""

from __future__ import annotations

from math import isnan
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from lasersph.case import Case
    from lasersph.lasers import Laser
    from lasersph.simulation.heating import HeatingForecast


def light_rows(laser: Laser) -> list[tuple[str, str]]:
    """Rows of `lasersph check` about the light of one pulse and of several."""
    from lasersph.input import format_quantity
    from lasersph.lasers import InterferenceBeam
    from lasersph.lasers.beam_image import MeasuredEnvelope

    # Shape of the pattern; without a spot its mean fluence says all.
    beam = laser.beam
    spot = laser.spot
    peak = laser.peak_fluence
    rows, kind = [], "everywhere"
    if isinstance(beam, InterferenceBeam):
        rows.append(("pattern", beam.description))
        kind = f"mean over a period; at most {_fluence(peak)}"
    if spot is None and beam.area is None:
        return [*rows, ("fluence of a pulse", f"{_fluence(laser.mean_fluence)}, {kind}")]

    # The fluence of a spot differs from place to place: its center, its mean.
    local = laser.spot_fluence
    if beam.is_pattern:
        highest = peak * local.center / laser.mean_fluence
        kind = f"mean over a period; at most {_fluence(highest)}"
    else:
        kind = "not averaged"

    # A measured beam says how well an ideal one fits it.
    envelope, measured = local.envelope, []
    if isinstance(envelope, MeasuredEnvelope):
        measured = [("beam image", envelope.quality)]
    rows += [
        ("spot", local.shape),
        *measured,
        ("pulse energy", format_quantity(local.energy, "J")),
        ("fluence at its center", f"{_fluence(local.center)}, {kind}"),
        (
            "fluence over the spot",
            f"{_fluence(local.mean)}, energy over the circle of 1/e^2 or the top hat",
        ),
    ]

    # What is computed is a small cell at some place of the spot.
    if spot is not None and spot.extent == "cell":
        place = ", ".join(format_quantity(each, "m") for each in spot.place)
        kind = "mean over a period" if rows[0][0] == "pattern" else "not averaged"
        rows.append(("fluence computed", f"{_fluence(laser.mean_fluence)}, {kind}, at ({place})"))

    # Pulses: how often, how much power, how far apart.
    pulse, displacement = laser.pulse, laser.displacement
    if pulse.interval is not None:
        rate = format_quantity(1.0 / pulse.interval, "Hz")
        power = format_quantity(local.energy / pulse.interval, "W")
        rows.append(("repetition", f"{rate}, {power} on average"))
    if displacement is None:
        rows.append(("pulses per spot", f"{pulse.count}, all at one place"))
    else:
        overlap = f"overlap {100.0 * local.overlap(displacement):.3g} %"
        apart = f"{format_quantity(displacement, 'm')} apart, {overlap}"
        rows.append(("pulses per spot", f"{local.diameter / displacement:.3g}, {apart}"))
    return rows


def heating_rows(case: Case, heating: HeatingForecast) -> list[tuple[str, str]]:
    """Rows of `lasersph check` about what the light does to the surface."""
    from lasersph.case.solver_choice import chooses_vaporization
    from lasersph.input import format_quantity

    cold, hot, (R, hot_R) = heating.cold, heating.temperature, heating.reflectivity
    rows = []
    # A plane section of a spot is that of a line; a section (r, z) is that of a body.
    if case.geometry.is_axisymmetric:
        rows.append(("section", "(r, z) through the axis; amounts are of the whole revolution"))
    elif heating.sideways and case.solver.dimensions == 2:
        rows.append(
            ("section", "through the axis of the spot, its light the same at all y: a line focus")
        )
    beside = "" if isnan(hot) or hot_R == R else f", {hot_R:.3g} at {hot:.0f} K"
    if heating.of_pulse is not None:
        beside = f", {heating.of_pulse:.3g} with hot electrons, in the mean over the pulse"
    # An absorptivity over time is said as it is given, and its mean over the pulse.
    over_time = case.laser is not None and case.laser.absorbs_over_time
    if over_time:
        rows.append(("absorptivity", f"over time, {1.0 - R:.3g} in the mean over the pulse"))
    else:
        rows.append(("reflectivity", f"{R:.3g} at {cold:.0f} K{beside}"))
    if isnan(hot):
        return rows
    means = "absorptivity in the mean" if over_time else f"reflectivity at {cold:.0f} K"
    if heating.of_pulse is not None:
        means = "reflectivity in the mean"
    rows.append(("absorbed fluence", f"{_absorbed(heating)}, with the {means}"))
    rows.append(("highest temperature", _highest(case, heating)))
    # Vapor leaves, or the surface keeps its boiling temperature.
    if heating.boils and case.solver.evaporates:
        gone = format_quantity(heating.evaporated, "m", 2)
        rows.append(("vapor", f"leaves the surface, up to about {gone} of metal in a pulse"))
    elif heating.boils and chooses_vaporization(case.solver):
        rows.append(("vapor", "none: the surface keeps its boiling temperature"))
    return rows


def _absorbed(heating: HeatingForecast) -> str:
    """The fluence that the surface takes in: of a spot where it is brightest."""
    peak = _fluence(heating.absorbed_peak)
    if heating.sideways:
        return f"at most {peak}"
    mean = _fluence(heating.absorbed_mean)
    return mean if heating.absorbed_peak == heating.absorbed_mean else f"{mean}, at most {peak}"


def _highest(case: Case, heating: HeatingForecast) -> str:
    """The highest temperature of the surface, and whether metal melts and boils there."""
    melting, metal = case.material.melting, case.material.vaporization
    critical = None if metal is None else metal.critical_temperature
    words = [f"{'at most ' if heating.sideways else ''}about {heating.temperature:.0f} K"]
    if critical is not None and heating.temperature > critical:
        words = [f"above the critical temperature of {critical:.0f} K"]
    if melting is not None and heating.melts is not None:
        words.append(f"{'melts' if heating.melts else 'does not melt'} ({melting.solidus:.0f} K)")
    if metal is not None and heating.boils is not None:
        words.append(f"{'boils' if heating.boils else 'does not boil'} ({metal.temperature:.0f} K)")
    return ", ".join(words)


def _fluence(value: float) -> str:
    """In J/cm^2 from J/m^2."""
    return f"{1e-4 * value:.4g} J/cm^2"
