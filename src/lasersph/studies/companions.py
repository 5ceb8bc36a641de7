"""Companions of a run: the same case coarser, or with one uncertain input shifted.

Each is an ordinary run folder, named by what is different in it.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

from pydantic import ValidationError

from lasersph.analytic.melt_depth import MeltEstimate
from lasersph.case import Case
from lasersph.case.quick import largest_spacing
from lasersph.input import QuantityError, format_quantity
from lasersph.materials import Law
from lasersph.materials.material import VISCOSITIES
from lasersph.materials.uncertainty import relative_uncertainty
from lasersph.simulation.layers import fine_depth
from lasersph.studies.variation import changed
from lasersph.sweeps.points import find_key

USUAL_RATIO = 2.0
LEAST_RATIO = 1.3
"""Of one spacing to the next finer; below it the procedure advises against an order [Celik2008]."""
LEAST_MELT_CELLS = 4.0
"""Cells that the melt depth keeps in the coarsest companion, to be a depth and not a count."""
STEEPEST = 0.51
"""Ratio of graded layers in the coarsest companion; the case allows none of 0.5."""


@dataclass(frozen=True)
class Input:
    """An uncertain input: key of the case ("laser.fluence", "material.viscosity"), standard
    uncertainty over its value, and who states it."""

    key: str
    relative: float
    source: str


def inputs_of(case: Case) -> list[Input]:
    """The inputs whose uncertainty the material of a case states."""
    stated = case.material.uncertainties()
    return [Input(f"material.{key}", relative, who) for key, (relative, who) in stated.items()]


def read_input(case: Case, text: str) -> Input:
    """An input from "laser.fluence=5%" or "laser.pulse.fwhm=0.5 ns".

    Raises:
        QuantityError: no key=value, no number at the key, or no uncertainty of its kind.
    """
    key, equals, standard = (part.strip() for part in text.partition("="))
    if not equals:
        raise QuantityError(f'"{text}" is not KEY=U; write e.g. laser.fluence=5%')
    # a law is uncertain in parts of its values, at all temperatures alike
    value, kind = _value_at(case, key)
    constant = value.value if isinstance(value, Law) else value
    try:
        relative = relative_uncertainty(standard, constant, kind)
    except QuantityError as error:
        raise QuantityError(f"{key}: {error}") from None
    return Input(key, relative, f"given: {standard}")


def _value_at(case: Case, key: str) -> tuple[Law | float, str]:
    """Number or law at a key of a case, and the kind of its quantity. Raises QuantityError."""
    found, kind = find_key(case, key)
    if isinstance(found, Law | float):
        return found, kind
    given = "is not given in this case" if found is None else "is no number with a unit"
    raise QuantityError(f'"{key}" {given}; name a number that it gives')


def shifted(case: Case, one: Input, sign: int) -> Case | str:
    """The case with an input one standard uncertainty higher (+1) or lower (-1); the reason in one
    line where the case refuses that."""
    key, factor, material = one.key, 1.0 + sign * one.relative, case.material
    both = {name: getattr(material, name) for name in VISCOSITIES}
    # eta and nu are given: both are scaled
    if key.removeprefix("material.") in both and None not in both.values():
        key, new = (
            "material",
            material.model_copy(  # the density of the melt is their ratio
                update={name: law.scaled(factor) for name, law in both.items()}
            ),
        )
    else:
        value, _ = _value_at(case, key)
        new = value.scaled(factor) if isinstance(value, Law) else factor * value
    try:
        return changed(case, key, new)
    except ValidationError as error:
        first = error.errors(include_url=False)[0]["msg"].removeprefix("Value error, ")
        return " ".join(first.split())


def with_fixed_layers(case: Case, melt: MeltEstimate | None) -> Case:
    """The case with its estimated depth of finest layers written down, so that no companion gets
    other particles because its melt is estimated otherwise."""
    lattice = case.particles
    if lattice.arrangement != "graded" or lattice.fine_depth is not None:
        return case
    return changed(case, "particles.fine_depth", fine_depth(case, melt))


def coarser_cases(case: Case, melt: MeltEstimate | None) -> list[Case] | str:
    """Two coarser companions, the finer first, or in one line why there are none.

    Spacing, graded layers and the longest step of an implicit solver grow together, by 2 where the
    coarsest companion still shows what the case is about, so that the whole discretization is
    refined alike (the layers of a ratio q grow as those of the ratio q^r of r times the spacing).

    Args:
        melt: how deep the case is expected to melt.
    """
    lattice = case.particles
    # coarsest spacing that still shows the melt
    largest = largest_spacing(case)
    if melt is not None and melt.depth:
        largest = min(largest, melt.depth / LEAST_MELT_CELLS)
    most = largest / lattice.spacing
    if lattice.arrangement == "graded":
        most = min(most, math.log(STEEPEST) / math.log(lattice.ratio))
    # two companions: the coarser is ratio^2 times as coarse
    ratio = min(USUAL_RATIO, math.sqrt(most))
    if ratio < LEAST_RATIO:
        return (
            f"a spacing of {format_quantity(lattice.spacing, 'm')} cannot be made coarser twice "
            f"by {LEAST_RATIO:g}: above {format_quantity(most * lattice.spacing, 'm', 3)} "
            "particles no longer show what this case is about; start from a finer spacing"
        )
    return [_coarser(case, ratio), _coarser(case, ratio**2)]


def _coarser(case: Case, factor: float) -> Case:
    for key, value in _coarser_values(case, factor):
        case = changed(case, key, value)
    return case


def _coarser_values(case: Case, factor: float) -> Iterator[tuple[str, float]]:
    """Keys and values in an order in which the case stays right after each."""
    lattice = case.particles
    if lattice.arrangement == "graded":
        yield "particles.coarsest", factor * lattice.coarsest
        yield "particles.ratio", lattice.ratio**factor
        # solid beside a pool takes as many spacings
        if lattice.fine_width is not None:
            yield "particles.fine_width", factor * lattice.fine_width
    yield "particles.spacing", factor * lattice.spacing
    if case.time.step is not None and not case.solver.is_explicit:
        yield "time.step", factor * case.time.step
