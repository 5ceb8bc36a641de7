"""Boundaries: named regions and what holds there."""

from lasersph.boundaries.settings import Boundaries

__all__ = ["Boundaries"]
