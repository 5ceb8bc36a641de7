"""`Lattice`: how particles fill the domain.

Uniform: layers of one spacing. Graded: fine layers down to `fine_depth`, then layers that grow by
1/ratio up to `coarsest`, the last one cut to the depth of the domain [Demuth2020, Section 4.1 and
eqs. (60)-(63); printed from the bottom upward: 1 um times (7/9)^k]. A layer of thickness d holds
n = round(width/d) columns of equal width, so that a whole number fills the period exactly; columns
beside `fine_width` grow outward in the same way, in all layers alike.
"""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field, model_validator

from lasersph.input import Length, Model, format_quantity

KernelName = Literal["cubic-spline", "quintic-spline", "wendland-c2"]
Size = Annotated[Length, Field(gt=0)]
USUAL_SUPPORT_RATIO = {"quintic-spline": 3.75, "cubic-spline": 3.0, "wendland-c2": 3.0}
"""Support radius over spacing by kernel: 3 h with h = 1.25 spacings, 2 h with h = 1.5 spacings."""
RESTING_SUPPORT_RATIO = {**USUAL_SUPPORT_RATIO, "quintic-spline": 2.6}
"""The same of particles of a box of liquid that rest. Study: error and time of a cavity and of a
cube, `benchmarks/flow_numbers.py --only resting`."""


class Lattice(Model):
    """Spacing, arrangement and kernel of the particles."""

    spacing: Size = Field(
        description="of the finest particles; rounded so that they fill the box",
        examples=["100 nm"],
    )
    arrangement: Literal["uniform", "graded"] = Field(
        default="uniform",
        description="one spacing everywhere, or layers that grow thicker with depth",
    )
    fine_depth: Size | None = Field(
        default=None,
        description="depth of the layers of finest spacing (graded); default: the larger of the "
        "expected melt depth plus two support radii and the laser's absorption zone",
    )
    fine_width: Size | None = Field(
        default=None,
        description="from the middle or the axis outward, of the columns of finest spacing "
        "(graded, 2-D and 3-D), beside which columns grow; default: where the light of a spot that "
        "rests falls or melts with solid beside it, else all columns",
    )
    coarsest: Size = Field(
        default=1e-6, description="thickness at which layers and columns stop growing (graded)"
    )
    ratio: Annotated[float, Field(gt=0.5, lt=1.0)] = Field(
        default=7.0 / 9.0,
        description="of the thickness of a layer to that of the one below, and of the width of a "
        "column to that of the next one outward (graded)",
    )
    kernel: KernelName = Field(
        default="quintic-spline", description="by which neighbors are weighted"
    )
    support_ratio: Annotated[float, Field(ge=1.5, le=6.0)] | None = Field(
        default=None,
        description="support radius over spacing; default 3.75 (quintic; 2.6 in boxes whose "
        "particles rest), 3 (others)",
    )

    @property
    def support_over_spacing(self) -> float:
        """Support radius over spacing, as given or as is usual for the kernel."""
        return self.support_ratio or USUAL_SUPPORT_RATIO[self.kernel]

    def at_rest(self) -> Lattice:
        """The lattice of particles of a box that rest: how far they see is said."""
        ratio = self.support_ratio or RESTING_SUPPORT_RATIO[self.kernel]
        return self.model_copy(update={"support_ratio": ratio})

    @model_validator(mode="after")
    def _check_sizes(self) -> Lattice:
        # layers can grow downward only
        if self.arrangement == "graded" and self.coarsest < self.spacing:
            raise ValueError(
                f"coarsest ({format_quantity(self.coarsest, 'm')}) is finer than the spacing "
                f"({format_quantity(self.spacing, 'm')}); give a coarsest spacing above it"
            )
        return self
