"""Conditions at faces and walls, and what a run starts from."""

from lasersph.boundaries.flow_conditions import FlowCondition, FlowConditions
from lasersph.boundaries.initial_motion import InitialMotion
from lasersph.boundaries.settings import Boundaries
from lasersph.boundaries.vessel import Vessel

__all__ = ["Boundaries", "FlowCondition", "FlowConditions", "InitialMotion", "Vessel"]
