"""The relief of a surface that moves: depth, rim, and the profile parameters of ISO 21920-2.

Heights z count from the original surface, upward; the profile parameters count them from their
mean over the width that is computed, which mirrors and periods make whole periods:

    Pa = mean |z|,   Pq = sqrt(mean z^2),   Pz = highest peak + deepest pit,   Psk = mean z^3 / Pq^3

[ISO21920-2, 4.3]. No filter is applied, so that they are those of the primary profile; Pz is taken
over the whole width, where the standard takes the mean over five sections. Heights are those of
columns; highest and lowest points lie between them, where a parabola through three has its vertex.
The first harmonic of a pattern of period lambda is a1 = (2/lambda) int z cos(2 pi x/lambda) dx.

Volumes are those that are missing below z = 0 and that stand above it; rings of a section (r, z)
count with their areas. There the relief of a spot has a shape [Bennett1997], by its height on the
axis, its lowest point and the highest one beyond that:

    bowl       the axis is lowest
    sombrero   the axis stands above a moat, and a rim beyond it above the original surface
    bump       the axis stands above all around it, and no rim does

Left out: waviness and roughness apart, reliefs in two directions.
Reference: [ISO21920-2] ISO 21920-2:2021, Geometrical product specifications, Surface texture:
Profile, Part 2: Terms, definitions and surface texture parameters.
[Bennett1997] Bennett, Krajnovich, Grigoropoulos, Baumgart, Tam: Marangoni mechanism in pulsed laser
texturing of magnetic disk substrates, J. Heat Transfer 119, 589 (1997).
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from lasersph.observers.observer import Observer, Row
from lasersph.observers.quantity import Quantity
from lasersph.observers.relief import WHOLE, Relief
from lasersph.observers.view import View

SHALLOW = 0.05
"""Part of peak to valley by which a point must stand above another to tell a shape [1]. Guard: a
bowl of few columns has its lowest one beside the axis, by less than that."""


class ProfileParameters(NamedTuple):
    """Of ISO 21920-2: Pa, Pq, Pz [m] and Psk [1]; Psk of a plane is 0."""

    Pa: float
    Pq: float
    Pz: float
    Psk: float


def profile_parameters(relief: Relief) -> ProfileParameters:
    """Profile parameters about the mean height, over the width that is computed."""
    z = relief.height - np.mean(relief.height)
    Pq = float(np.sqrt(np.mean(z * z)))
    return ProfileParameters(
        Pa=float(np.mean(np.abs(z))),
        Pq=Pq,
        Pz=relief.highest()[1] - relief.lowest()[1],
        Psk=float(np.mean(z**3)) / Pq**3 if Pq > 0.0 else 0.0,
    )


def first_harmonic(relief: Relief, period: float) -> float:
    """a1 = (2/lambda) int z cos(2 pi x/lambda) dx over a period lambda [m].

    Of the width that is computed, a whole number of half periods from x = 0, its mean is taken.

    Raises:
        ValueError: another width.
    """
    halves = relief.width / (0.5 * period)
    if halves < 0.5 or abs(halves - round(halves)) > WHOLE * halves:
        raise ValueError(
            f"a width of {relief.width:g} m holds no whole half periods of {period:g} m"
        )
    # midpoint rule: exact for the harmonics that the columns resolve
    return 2.0 * float(np.mean(relief.height * np.cos(2.0 * np.pi * relief.x / period)))


def shape_of_spot(relief: Relief) -> str:
    """Shape of the relief of a section (r, z): flat, bowl, sombrero or bump."""
    lowest, highest = float(np.min(relief.height)), float(np.max(relief.height))
    least = SHALLOW * (highest - lowest)
    if highest == lowest:
        return "flat"
    if relief.center - lowest <= least:
        return "bowl"
    # beyond the moat: a rim above the original surface, or none
    beyond = relief.height[int(np.argmin(relief.height)) :]
    return "sombrero" if float(np.max(beyond)) > least else "bump"


def _at_the_end(name: str, unit: str, words: str) -> Quantity:
    """A column of history.csv whose last value is the key of the same name in summary.json."""
    key = f"topography.{name}"
    return Quantity(key, unit, words, end=key, is_main=name == "peak_to_valley_m")


class Topography(Observer):
    """Observes the relief of a surface that moves.

    Args:
        period: of what drives the surface [m], for the first harmonic; None without.
        is_section: whether the run is a section (r, z), whose relief is that of a spot.
    """

    title = "topography"
    note = (
        "Heights count from the original surface. Pa, Pq, Pz and Psk are the profile parameters of "
        "ISO 21920-2 over the whole width, unfiltered; in a section (r, z) over the radius, where "
        "places are distances from the axis and volumes those of rings."
    )
    columns = (
        _at_the_end("depth_m", "m", "depth of the surface's lowest point"),
        _at_the_end("rim_height_m", "m", "height of the surface's highest point"),
        _at_the_end("peak_to_valley_m", "m", "peak to valley of the relief"),
        _at_the_end("center_m", "m", "height of the surface at x = 0 or on the axis"),
        _at_the_end("displaced_volume_m3", "m^3", "volume missing below the original surface"),
        _at_the_end("raised_volume_m3", "m^3", "volume above the original surface"),
        _at_the_end("Pa_m", "m", "arithmetic mean height Pa of the profile"),
        _at_the_end("Pq_m", "m", "root mean square height Pq of the profile"),
        _at_the_end("Pz_m", "m", "highest peak and deepest pit of the profile, Pz"),
        _at_the_end("Psk", "", "skewness Psk of the profile"),
        _at_the_end("first_harmonic_m", "m", "first harmonic of the relief"),
    )
    results = (
        Quantity("topography.lowest_x_m", "m", "place of the surface's lowest point"),
        Quantity("topography.rim_x_m", "m", "place of the surface's highest point"),
        Quantity("topography.shape", "", "shape of the relief of a spot"),
        Quantity(
            "topography.after_pulses_m", "m", "peak to valley after each pulse before a pause"
        ),
    )
    kept = ("places", "after_pulses", "shape")

    def __init__(self, period: float | None = None, *, is_section: bool = False) -> None:
        self.period, self.is_section = period, is_section
        # a pattern has a harmonic, a spot has none
        if period is None:
            self.columns = self.columns[:-1]
        super().__init__()
        self.places, self.after_pulses, self.shape = [0.0, 0.0], list[float](), ""

    def observe(self, view: View) -> Row:
        """Depth, rim, profile parameters and first harmonic [m]."""
        relief = view.relief
        if relief is None:
            raise ValueError("the surface of this run does not move")
        (lowest_x, lowest), (rim_x, rim) = relief.lowest(), relief.highest()
        self.places = [lowest_x, rim_x]
        if self.is_section:
            self.shape = shape_of_spot(relief)
        # one relief for each pulse of a train whose pauses are jumped over
        if view.limit == "pause":  # jumped over after a pulse
            self.after_pulses.append(rim - lowest)
        parameters = profile_parameters(relief)
        harmonic = [] if self.period is None else [first_harmonic(relief, self.period)]
        sizes = (max(-lowest, 0.0), max(rim, 0.0), rim - lowest, relief.center, *relief.volumes())
        return self.record(view.time, (*sizes, *parameters, *harmonic))

    def values(self) -> dict[str, object]:
        """Places of the lowest and the highest point."""
        found: dict[str, object] = {
            "topography.lowest_x_m": self.places[0],
            "topography.rim_x_m": self.places[1],
        }
        if self.is_section:
            found["topography.shape"] = self.shape
        return found | {"topography.after_pulses_m": self.after_pulses}
