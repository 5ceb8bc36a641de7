"""Symmetry of what a run has computed, from its resolved case."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any


def is_axisymmetric(case: Mapping[str, Any]) -> bool:
    """Whether a section (r, z) of a body of revolution was computed."""
    return case.get("solver", {}).get("geometry") == "axisymmetric"


def is_mirrored(case: Mapping[str, Any]) -> bool:
    """Whether x < 0 mirrors what was computed, half a period or a section (r, z)."""
    return case.get("domain", {}).get("extent") == "half" or is_axisymmetric(case)
