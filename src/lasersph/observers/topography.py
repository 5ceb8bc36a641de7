"""The relief of a surface that moves: depth, rim, and the parameters of ISO 21920-2 or ISO 25178.

Heights z count from the original surface, upward; the profile parameters count them from their
mean over the width that is computed, which mirrors and periods make whole periods:

    Pa = mean |z|,   Pq = sqrt(mean z^2),   Pz = highest peak + deepest pit,   Psk = mean z^3 / Pq^3

[ISO21920-2, 4.3]. No filter is applied, so that they are those of the primary profile; Pz is taken
over the whole width, where the standard takes the mean over five sections. Heights are those of
columns; highest and lowest points lie between them, where a parabola through three has its vertex.
The first harmonic of a pattern of period lambda is a1 = (2/lambda) int z cos(2 pi x/lambda) dx.

In 3-D the areal parameters of ISO 25178 stand in their place (`areal_parameters`), of whole periods
and as little filtered, and the first harmonic of a pattern of periods Lx and Ly is

    a11 = 4/(Lx Ly) int int z cos(2 pi x/Lx) cos(2 pi y/Ly) dx dy.

Volumes are those that are missing below z = 0 and that stand above it; rings of a section (r, z)
count with their areas. There the relief of a spot has a shape [Bennett1997], by its height on the
axis, its lowest point and the highest one beyond that:

    bowl       the axis is lowest
    sombrero   the axis stands above a moat, and a rim beyond it above the original surface
    bump       the axis stands above all around it, and no rim does

Left out: waviness and roughness apart.
Reference: [ISO21920-2] ISO 21920-2:2021, Geometrical product specifications, Surface texture:
Profile, Part 2: Terms, definitions and surface texture parameters.
[Bennett1997] Bennett, Krajnovich, Grigoropoulos, Baumgart, Tam: Marangoni mechanism in pulsed laser
texturing of magnetic disk substrates, J. Heat Transfer 119, 589 (1997).
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from lasersph.observers.area_relief import AreaRelief
from lasersph.observers.even_places import refuse_parts
from lasersph.observers.observer import Observer, Row
from lasersph.observers.quantity import Quantity
from lasersph.observers.relief import Relief
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
    refuse_parts(relief.width, period)
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


SIZES = (
    _at_the_end("depth_m", "m", "depth of the surface's lowest point"),
    _at_the_end("rim_height_m", "m", "height of the surface's highest point"),
    _at_the_end("peak_to_valley_m", "m", "peak to valley of the relief"),
    _at_the_end("center_m", "m", "height of the surface at x = 0 (and y = 0) or on the axis"),
    _at_the_end("displaced_volume_m3", "m^3", "volume missing below the original surface"),
    _at_the_end("raised_volume_m3", "m^3", "volume above the original surface"),
)
OF_PROFILE = (
    _at_the_end("Pa_m", "m", "arithmetic mean height Pa of the profile"),
    _at_the_end("Pq_m", "m", "root mean square height Pq of the profile"),
    _at_the_end("Pz_m", "m", "highest peak and deepest pit of the profile, Pz"),
    _at_the_end("Psk", "", "skewness Psk of the profile"),
)
OF_AREA = (
    _at_the_end("Sa_m", "m", "arithmetic mean height Sa of the area"),
    _at_the_end("Sq_m", "m", "root mean square height Sq of the area"),
    _at_the_end("Sz_m", "m", "highest peak and deepest pit of the area, Sz"),
    _at_the_end("Ssk", "", "skewness Ssk of the area"),
    _at_the_end("Sdr", "", "developed area over the projected one, less 1, Sdr"),
)
HARMONIC = _at_the_end("first_harmonic_m", "m", "first harmonic of the relief")


class Topography(Observer):
    """Observes the relief of a surface that moves.

    Args:
        period: of what drives the surface [m], for the first harmonic; None without.
        period_y: of a run in 3-D along y [m]; None where nothing repeats there.
        dimensions: of the run, 2 or 3.
        is_section: whether the run is a section (r, z), whose relief is that of a spot.
    """

    title = "topography"
    note = (
        "Heights count from the original surface. Pa, Pq, Pz and Psk are the profile parameters of "
        "ISO 21920-2 over the whole width, unfiltered; in a section (r, z) over the radius, where "
        "places are distances from the axis and volumes those of rings. In 3-D Sa, Sq, Sz, Ssk and "
        "Sdr are the areal parameters of ISO 25178 over whole periods, unfiltered, of columns."
    )
    columns = (*SIZES, *OF_PROFILE, *OF_AREA, HARMONIC)
    results = (
        Quantity("topography.lowest_x_m", "m", "place of the surface's lowest point"),
        Quantity("topography.rim_x_m", "m", "place of the surface's highest point"),
        Quantity("topography.lowest_y_m", "m", "place of the surface's lowest point along y"),
        Quantity("topography.rim_y_m", "m", "place of the surface's highest point along y"),
        Quantity("topography.shape", "", "shape of the relief of a spot", is_main=True),
        Quantity(
            "topography.after_pulses_m", "m", "peak to valley after each pulse before a pause"
        ),
    )
    kept = ("places", "after_pulses", "shape")

    def __init__(
        self,
        period: float | None = None,
        period_y: float | None = None,
        *,
        dimensions: int = 2,
        is_section: bool = False,
    ) -> None:
        self.period, self.period_y, self.is_section = period, period_y, is_section
        self.dimensions = dimensions
        # a pattern has a harmonic, a spot has none
        parameters = OF_AREA if dimensions == 3 else OF_PROFILE
        self.columns = (*SIZES, *parameters, *(() if period is None else (HARMONIC,)))
        super().__init__()
        # of the lowest and the highest point, along x and y
        self.places = [[0.0] * (dimensions - 1) for _ in range(2)]
        self.after_pulses, self.shape = list[float](), ""

    def observe(self, view: View) -> Row:
        """Depth, rim, parameters and first harmonic [m]."""
        relief = view.relief
        if relief is None:
            raise ValueError("the surface of this run does not move")
        (lowest_place, lowest), (rim_place, rim) = relief.lowest(), relief.highest()
        self.places = [list(np.atleast_1d(place).tolist()) for place in (lowest_place, rim_place)]
        # one relief for each pulse of a train whose pauses are jumped over
        if view.limit == "pause":  # jumped over after a pulse
            self.after_pulses.append(rim - lowest)
        sizes = (max(-lowest, 0.0), max(rim, 0.0), rim - lowest, relief.center, *relief.volumes())
        return self.record(view.time, (*sizes, *self._parameters(relief)))

    def _parameters(self, relief: Relief | AreaRelief) -> tuple[float, ...]:
        """Parameters of the profile or of the area, and the first harmonic of a pattern."""
        if isinstance(relief, AreaRelief):
            if self.period is None:
                return relief.parameters()
            return (*relief.parameters(), relief.first_harmonic(self.period, self.period_y))
        if self.is_section:
            self.shape = shape_of_spot(relief)
        harmonic = () if self.period is None else (first_harmonic(relief, self.period),)
        return (*profile_parameters(relief), *harmonic)

    def values(self) -> dict[str, object]:
        """Places of the lowest and the highest point."""
        found: dict[str, object] = {
            f"topography.{name}_{axis}_m": place
            for name, places in zip(("lowest", "rim"), self.places, strict=True)
            for axis, place in zip("xy", places, strict=False)
        }
        if self.is_section:
            found["topography.shape"] = self.shape
        return found | {"topography.after_pulses_m": self.after_pulses}
