"""Symmetry of what a run has computed, from its resolved case."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any


def is_axisymmetric(case: Mapping[str, Any]) -> bool:
    """Whether a section (r, z) of a body of revolution was computed."""
    return case.get("solver", {}).get("geometry") == "axisymmetric"


def is_mirrored(case: Mapping[str, Any]) -> bool:
    """Whether x < 0 mirrors what was computed: half or a quarter of a period, or a section."""
    return mirrored_axes(case)[0]


def mirrored_axes(case: Mapping[str, Any]) -> tuple[bool, bool]:
    """Whether x < 0, and whether y < 0, mirrors what was computed."""
    extent = case.get("domain", {}).get("extent")
    return extent in ("half", "quarter") or is_axisymmetric(case), extent == "quarter"
