"""Markdown tables of published beside computed numbers, from the JSON of `lasersph validate`."""

from typing import Any


def validation_table(results: dict[str, Any]) -> str:
    """One section a benchmark: verdict, then every number with its tolerance."""
    return ""
