"""The maps of a spot: at each pixel the value of a cell of the local fluence at the local phase.

    z(x, y) = Z(F(x, y), x mod period),   of dots Z(F(x, y), x mod Lx, y mod Ly)

F is the local fluence, mean over a period, and Z the table of cells; heights of a line and depths
of its melt lie between the edges of the melt, see `lines`. A cell knows neither heat nor melt that
the slope of F moves across a period: in a Gaussian spot of diameter D at 1/e^2 the fluence changes
by up to 2.4 p/D of that at the center over a period p.

Pulses that are moved: a pulse finds the relief of those before. Where it melts nothing, that relief
stays; where nothing has been molten before, it meets a flat surface, as a cell does. Where it
melts what another has molten, cells of one pulse say nothing, and this is refused: before any cell
is computed where it is certain, with the cells at hand at the edges of lines.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from lasersph.input import format_quantity
from lasersph.lasers import SpotFluence
from lasersph.output.image_file import Maps
from lasersph.studies.texture.cells import UNITS
from lasersph.studies.texture.dots import AnyTable

Array = NDArray[np.float64]
MOST_PIXELS = 16_000_000
"""Of a map, five of which take 0.6 GB."""
RAYS = 200
"""Points on half a side of a square around a spot among which the last molten one is looked for."""
SAMPLES_A_PERIOD, ROWS = 40, 41
"""Places at which two pulses are compared, along x, and in y over three diameters."""
CERTAIN = 1.1
"""Light at which a place certainly melts, over the least that melts by the estimate. The lines of
cells on steel (16 nm, `benchmarks/texture.py direct`) and aluminum (48 nm) are wider by 40 nm to
430 nm than the places where the pattern has so much."""
UNITS_OF_MAPS = {**UNITS, "fluence": "J/m^2"}


class NoTexture(ValueError):
    """The texture cannot be told; the text says why, in one line."""


def half_sizes(spot: SpotFluence, table: AnyTable) -> tuple[float, float]:
    """Half width and height of the area where cells change the surface, and a period more [m].

    Raises:
        NoTexture: the fluence at the center melts nothing.
    """
    # the brightest cell that changes nothing bounds the area by its fluence
    changes = (table.values[name] != 0.0 for name in ("height", "melt_depth"))
    touched = [np.any(one.reshape(table.fluence.size, -1), axis=1) for one in changes]
    changed = np.flatnonzero(touched[0] | touched[1])
    if changed.size == 0:
        raise NoTexture(
            f"no cell up to {1e-4 * table.fluence[-1]:.4g} J/cm^2 melts: there is no texture"
        )
    least = table.fluence[max(changed[0] - 1, 0)]
    places = np.linspace(-1.5 * spot.diameter, 1.5 * spot.diameter, 2 * RAYS + 1)
    bright = spot.at(places[None, :], places[:, None]) > least
    sizes = [np.abs(places[bright.any(axis=axis)]).max(initial=0.0) for axis in (0, 1)]
    return float(sizes[0]) + table.period, float(sizes[1]) + table.period


def refuse_common_melt(
    spot: SpotFluence, period: float, least: float, pulses: int, shift: float
) -> None:
    """Refuse pulses of which two certainly melt the same place, before any cell is computed.

    Args:
        period: of the pattern [m]. least: local fluence that melts, by the estimate [J/m^2].
        pulses, shift: see `texture_maps`.

    Raises:
        NoTexture: with the place.
    """
    half = 1.5 * spot.diameter
    x = np.linspace(-half, half, 2 + int(SAMPLES_A_PERIOD * 2.0 * half / period))
    y = np.linspace(-half, half, ROWS)

    def melts(x: Array) -> NDArray[np.bool_]:
        light = spot.at(x[None, :], y[:, None]) * np.cos(np.pi * x / period) ** 2
        return light >= CERTAIN * least

    # shifted pulses: two of them melt one place where both are bright enough
    first = melts(x)
    for number in range(1, min(pulses, 2 + int(2.0 * half / shift))):
        common = np.argwhere(first & melts(x - number * shift))
        if common.size:
            row, column = (int(n) for n in common[0])
            lit = np.any(spot.at(x[None, :], y[:, None]) >= least, axis=0)
            raise common_melt(number, x[column], y[row], float(np.ptp(x[lit])) + period, pulses)


def common_melt(number: int, x: float, y: float, apart: float, pulses: int) -> NoTexture:
    """Refusal of a pulse, counted from 0, that melts anew what is at a place [m], and by which
    shift it would not [m]."""
    place = ", ".join(format_quantity(at, "m") for at in (x, y))
    return NoTexture(
        f"pulse {number + 1} melts what an earlier one has molten, first at ({place}): cells of "
        "one pulse do not tell its relief; write laser.spot.shift = "
        f'"{format_quantity(apart, "m", 2)}", or leave the spot at one place, whose cells have '
        f"{pulses} pulses"
    )


def texture_maps(
    spot: SpotFluence, table: AnyTable, pixel: float, *, pulses: int = 1, shift: float = 0.0
) -> Maps:
    """Height, melt depth, largest temperature and speed, and fluence over the spot.

    Args:
        pixel: side of a pixel [m]; pixels lie evenly about the center.
        pulses: that are `shift` [m] apart along x; the first one at x = 0.

    Raises:
        NoTexture: nothing melts, too many pixels, or pulses that melt the same place.
    """
    # pixels about the center, and as far as the last pulse reaches
    half = half_sizes(spot, table)
    reach = (pulses - 1) * shift
    counts = [int(np.ceil(size / pixel)) for size in half]
    x = pixel * np.arange(-counts[0], counts[0] + int(np.ceil(reach / pixel)) + 1)
    y = pixel * np.arange(-counts[1], counts[1] + 1)
    if x.size * y.size > MOST_PIXELS:
        least = pixel * np.sqrt(x.size * y.size / MOST_PIXELS)
        raise NoTexture(
            f"{x.size} times {y.size} pixels are too many; write --pixel {1e9 * least:.0f}nm or "
            "more"
        )
    # pulse after pulse: heights add, largest values stay
    fields = {name: np.zeros((y.size, x.size)) for name in UNITS}
    fields["temperature"] += table.initial_temperature
    fluence = np.zeros((y.size, x.size))
    has_melted = np.zeros((y.size, x.size), dtype=bool)
    for number in range(pulses):
        here = x - number * shift
        local = spot.at(here[None, :], y[:, None])
        found = {name: table.in_spot(name, spot.at, here[None, :], y[:, None]) for name in UNITS}
        # a place that two pulses melt is none that a cell of one pulse knows
        melts = (found["melt_depth"] > 0.0) | (found["height"] != 0.0)
        if np.any(melts & has_melted):
            row, column = (int(n) for n in np.argwhere(melts & has_melted)[0])
            raise common_melt(number, x[column], y[row], 2.0 * half[0], pulses)
        has_melted |= melts
        fields["height"] += found["height"]
        for name in ("melt_depth", "temperature", "speed"):
            np.maximum(fields[name], found[name], out=fields[name])
        np.maximum(fluence, local, out=fluence)
    return Maps(x, y, {**fields, "fluence": fluence}, UNITS_OF_MAPS)
