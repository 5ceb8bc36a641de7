"""Rows of a validation: what was published, what it should be, what came out, and a verdict.

`rows.toml` in the folder of a validation says which comparisons there are:

    source = "..."             of all rows that name no other

    [front]
    quantity = "front after {end:.0f} ns, spacing {spacing} nm"
    unit = "um"                 "1" if not given
    band = "1 %"                of the reference, or a number in the unit; without it, shown only
    quick = "2 %"               the band of shortened runs, where it is another one
    published, reference        where they are the same in all runs; `band` alone compares with 0
    claim = "..."               in place of `quantity`: a statement that holds or does not; with
                                `band = 0` it is judged
    path = "melt.depth_max_m"   where a number of a run's summary is compared, and by what `factor`
    factor = 1e9                it is multiplied; rows of one `group` are added together
    reason = "..."              why the band is so wide: the reference's own uncertainty, the error
                                of discretization by a study, the reading error of a figure
    own = true                  the reference is another result of ours: shown, never judged
    changed = "..."             "was 1 % until 2026-11-20, because ...": of a band or a parameter of
                                the case that was changed after a first run

`source`, `reason` and `changed` above all tables hold for every row that names no other.
"""

from __future__ import annotations

import tomllib
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, fields
from pathlib import Path
from typing import Any

Published = float | str | None
Words = dict[str, Any]
"""Values of the names in braces of a text."""
OF_ALL = ("source", "reason", "changed")
"""Keys that may stand above all tables."""


@dataclass(frozen=True)
class Row:
    """One compared number.

    Attributes:
        quantity: its name. unit: of published, reference, computed and tolerance.
        published: as the paper prints it; a text where it gives a range; None where it is silent.
        reference: number that decides: an exact solution, a derivation or an independent program.
        computed: ours; for a claim whether it holds. tolerance: largest |computed - reference|.
        verdict: True or False; None where the number is shown and not judged.
        source: of the published number and the reference. kind: its table in `rows.toml`.
        reason: why the tolerance is so wide. changed: its former value, and why it was changed.
        own: whether the reference is another result of ours, by which nothing is judged.
    """

    quantity: str
    unit: str
    published: Published
    reference: float | None
    computed: float | str | None
    tolerance: float | None
    verdict: bool | None
    source: str
    kind: str = ""
    reason: str = ""
    changed: str = ""
    own: bool = False

    @property
    def judgement(self) -> str:
        """The verdict as a word."""
        return "own" if self.own else {True: "ok", False: "FAILED", None: "shown"}[self.verdict]


@dataclass(frozen=True)
class Comparison:
    """A kind of row, as `rows.toml` states it; texts may name values in braces."""

    quantity: str = ""
    unit: str = "1"
    band: float | str | None = None
    quick: float | str | None = None
    reference: float | None = None
    published: Published = None
    claim: str = ""
    source: str = ""
    path: str = ""
    factor: float = 1.0
    group: str = ""
    reason: str = ""
    changed: str = ""
    own: bool = False
    name: str = ""

    @property
    def is_judged(self) -> bool:
        """Whether its rows can fail."""
        return self.band is not None and not self.own

    def row(
        self,
        computed: float | None,
        reference: float | None = None,
        *,
        published: Published = None,
        judge: bool = True,
        quick: bool = False,
        share: float = 1.0,
        words: Words | None = None,
    ) -> Row:
        """The row of a computed number; None and NaN lie outside every band.

        Args:
            reference, published: those of this row, where `rows.toml` does not give them.
            judge: whether the band counts. share: of the band that is allowed.
            words: values of the names in braces.
        """
        words = words or {}
        source = self.source.format(**words)

        # A claim holds or does not.
        if self.claim:
            found = "holds" if computed else "does not hold"
            text = self.claim.format(**words)
            verdict = bool(computed) if self.is_judged and judge else None
            notes: dict[str, Any] = {"reason": self.reason, "changed": self.changed}
            return Row(text, "", "claimed", None, found, None, verdict, source, self.name, **notes)

        # Numbers of this row win over those of the file.
        reference = self.reference if reference is None else float(reference)
        published = self.published if published is None else published
        band = self.quick if quick and self.quick is not None else self.band
        value = None if computed is None else float(computed)

        # Without a band, or where it does not count, the number is only shown.
        tolerance, verdict = None, None
        if band is not None and judge:
            reference = 0.0 if reference is None else reference
            tolerance = float(share * width_of(band, reference))
            if self.is_judged:
                verdict = value is not None and abs(value - reference) <= tolerance
        return Row(
            quantity=self.quantity.format(**words),
            unit=self.unit.format(**words),
            published=published,
            reference=reference,
            computed=value,
            tolerance=tolerance,
            verdict=verdict,
            source=source,
            kind=self.name,
            reason=self.reason if tolerance is not None else "",
            changed=self.changed,
            own=self.own,
        )


def width_of(band: float | str, reference: float) -> float:
    """Half width of a band: a number as it is, "2 %" of the reference."""
    if isinstance(band, str):
        return 0.01 * float(band.removesuffix("%")) * abs(reference)
    return float(band)


def number_at(summary: Mapping[str, Any], path: str, factor: float = 1.0) -> float | None:
    """Number of a summary by its path "flow.speed_max_m_s", times a factor; None without."""
    found: Any = summary
    for key in path.split("."):
        found = found.get(key) if isinstance(found, Mapping) else None
    return None if found is None else factor * float(found)


def read_comparisons(files: Iterable[Path]) -> dict[str, Comparison]:
    """Comparisons by name from files `rows.toml`; keys in later files win.

    Raises:
        ValueError: a key that there is not, or a comparison without words.
    """
    known = {field.name for field in fields(Comparison)} - {"name"}
    # Later files add keys to the kinds of earlier ones.
    found: dict[str, dict[str, Any]] = {}
    for file in files:
        content = tomllib.loads(file.read_text(encoding="utf-8"))
        of_all = {key: content.pop(key) for key in OF_ALL if key in content}
        for name, entry in content.items():
            found[name] = of_all | found.get(name, {}) | entry
    for name, entry in found.items():
        if not entry.keys() <= known or not ("quantity" in entry) ^ ("claim" in entry):
            raise ValueError(f"[{name}] in rows.toml: wrong keys, or neither quantity nor claim")
    return {name: Comparison(**entry, name=name) for name, entry in found.items()}
