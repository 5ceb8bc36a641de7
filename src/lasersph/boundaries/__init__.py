"""Boundaries: named regions and what holds there."""

from lasersph.boundaries.flow_sides import FlowSide, FlowSides
from lasersph.boundaries.settings import Boundaries

__all__ = ["Boundaries", "FlowSide", "FlowSides"]
