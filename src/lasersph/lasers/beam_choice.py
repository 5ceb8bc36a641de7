"""`Beam`: the beams that a laser may have, told apart by their kind."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

from lasersph.lasers.beams import GaussianBeam, TopHatBeam, UniformBeam
from lasersph.lasers.interference import InterferenceBeam
from lasersph.lasers.shaped_beams import RingBeam, SuperGaussianBeam

Beam = Annotated[
    UniformBeam | TopHatBeam | GaussianBeam | SuperGaussianBeam | RingBeam | InterferenceBeam,
    Field(discriminator="kind"),
]
