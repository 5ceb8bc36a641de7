"""One number of a validation: what was published, what it should be, what came out, and a verdict.

`judged` compares with a reference and a tolerance that stand in the validation's source; `shown`
prints a number beside a published one without judging, as is done where only a paper has it.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import isfinite

Published = float | str | None


@dataclass(frozen=True)
class Row:
    """One compared number.

    Attributes:
        quantity: what it is. unit: of published, reference, computed and tolerance.
        published: as the paper prints it; a text where it gives a range; None where it is silent.
        reference: what decides: an exact solution, a derivation or an independent program.
        computed: ours; for a claim whether it holds. tolerance: largest |computed - reference|.
        verdict: True or False; None where the number is shown and not judged.
        source: of the published number and the reference.
    """

    quantity: str
    unit: str
    published: Published
    reference: float | None
    computed: float | str | None
    tolerance: float | None
    verdict: bool | None
    source: str


def judged(
    quantity: str,
    unit: str,
    computed: float | None,
    reference: float,
    tolerance: float,
    *,
    published: Published = None,
    source: str = "",
) -> Row:
    """A number that must lie within `tolerance` of `reference`; None and NaN fail."""
    value = None if computed is None else float(computed)
    good = value is not None and isfinite(value) and abs(value - reference) <= tolerance
    return Row(quantity, unit, published, float(reference), value, float(tolerance), good, source)


def at_most(
    quantity: str,
    unit: str,
    computed: float,
    limit: float,
    *,
    published: Published = None,
    source: str = "",
) -> Row:
    """A deviation or defect that must not exceed `limit`; its reference is 0."""
    return judged(quantity, unit, computed, 0.0, limit, published=published, source=source)


def shown(
    quantity: str,
    unit: str,
    computed: float | None,
    *,
    published: Published = None,
    reference: float | None = None,
    source: str = "",
) -> Row:
    """A number beside a published one, not judged."""
    value = None if computed is None else float(computed)
    return Row(quantity, unit, published, reference, value, None, None, source)


def claimed(claim: str, holds: bool, *, source: str) -> Row:
    """A claim of the paper and whether our numbers bear it out; not judged."""
    found = "holds" if holds else "does not hold"
    return Row(claim, "", "claimed", None, found, None, None, source)
