"""The light of a case in words: pattern, spot, fluences and what they mean, pulses per spot."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from lasersph.lasers import Laser


def light_rows(laser: Laser) -> list[tuple[str, str]]:
    """Rows of `lasersph check` about the light of one pulse and of several."""
    from lasersph.input import format_quantity
    from lasersph.lasers import InterferenceBeam
    from lasersph.lasers.beam_image import MeasuredEnvelope

    beam, spot, peak = laser.beam, laser.spot, laser.peak_fluence
    rows, kind = [], "everywhere"
    if isinstance(beam, InterferenceBeam):
        rows.append(("pattern", beam.description))
        kind = f"mean over a period; at most {_fluence(peak)}"
    if spot is None and beam.area is None:
        return [*rows, ("fluence of a pulse", f"{_fluence(laser.mean_fluence)}, {kind}")]
    local = laser.spot_fluence
    if isinstance(beam, InterferenceBeam):
        highest = peak * local.center / laser.mean_fluence
        kind = f"mean over a period; at most {_fluence(highest)}"
    else:
        kind = "not averaged"
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
    if spot is not None and spot.extent == "cell":
        place = ", ".join(format_quantity(each, "m") for each in spot.place)
        kind = "mean over a period" if rows[0][0] == "pattern" else "not averaged"
        rows.append(("fluence computed", f"{_fluence(laser.mean_fluence)}, {kind}, at ({place})"))
    pulse, way = laser.pulse, laser.displacement
    if pulse.interval is not None:
        rate = format_quantity(1.0 / pulse.interval, "Hz")
        power = format_quantity(local.energy / pulse.interval, "W")
        rows.append(("repetition", f"{rate}, {power} on average"))
    if way is None:
        rows.append(("pulses per spot", f"{pulse.count}, all at one place"))
    else:
        apart = f"{format_quantity(way, 'm')} apart, overlap {100.0 * local.overlap(way):.3g} %"
        rows.append(("pulses per spot", f"{local.diameter / way:.3g}, {apart}"))
    return rows


def _fluence(value: float) -> str:
    """In J/cm^2 from J/m^2."""
    return f"{1e-4 * value:.4g} J/cm^2"
