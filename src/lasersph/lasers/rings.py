"""Light on rings about its axis, for sections (r, z): exact means of a profile around the axis.

    mean of f over a ring = (E(r_2) - E(r_1)) / (pi (r_2^2 - r_1^2)),   E(r) = 2 pi int_0^r f s ds

A measured beam counts with its mean over the angle, see `MeasuredEnvelope.enclosed`.
"""

from __future__ import annotations

from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from lasersph.lasers.beam_image import MeasuredEnvelope
from lasersph.lasers.interference import InterferenceBeam
from lasersph.lasers.laser import Laser

Array = NDArray[np.float64]


class RoundLight(Protocol):
    """Light that is the same all around its axis."""

    def enclosed(self, r: Array) -> Array:
        """Integral of the profile over the circle of radius r [m], any shape [m^2]."""
        ...


def round_light(laser: Laser) -> RoundLight | None:
    """The profile of a laser that is the same around the axis; None of waves that interfere."""
    if laser.spot is not None and laser.spot.extent == "whole":
        return laser.spot.envelope if laser.beam.is_uniform else None
    return None if isinstance(laser.beam, InterferenceBeam) else laser.beam


def ring_means(laser: Laser, inner: Array, outer: Array) -> Array:
    """(n,) means of round light that rests over the rings between two circles [m], (n,) each.

    They are what `Laser.energy_density` takes as its resting means.
    """
    profile = round_light(laser)
    assert profile is not None
    light = profile.enclosed(outer) - profile.enclosed(inner)
    return light / (np.pi * (outer**2 - inner**2))


def ellipticity(laser: Laser) -> float:
    """Smaller over larger width of a measured beam [ISO11146-1]; 1 of all others."""
    profile = round_light(laser)
    return profile.ellipticity if isinstance(profile, MeasuredEnvelope) else 1.0
