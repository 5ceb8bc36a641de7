"""Observers look at a run after each step and never change it."""

from lasersph.observers.energy_budget import EnergyBudget
from lasersph.observers.flow_view import FlowView
from lasersph.observers.melt_pool import MeltPool
from lasersph.observers.probes import Probe, Probes
from lasersph.observers.progress import Progress, Standing, duration
from lasersph.observers.snapshots import SnapshotPlan, SnapshotSchedule, snapshot_fields
from lasersph.observers.steps import Steps
from lasersph.observers.surface_temperature import SurfaceTemperature
from lasersph.observers.together import Observer, Observers, flow_observers, heat_observers
from lasersph.observers.vaporization import Vaporization
from lasersph.observers.view import ENERGY_UNITS, View

__all__ = [
    "ENERGY_UNITS",
    "EnergyBudget",
    "FlowView",
    "MeltPool",
    "Observer",
    "Observers",
    "Probe",
    "Probes",
    "Progress",
    "SnapshotPlan",
    "SnapshotSchedule",
    "Standing",
    "Steps",
    "SurfaceTemperature",
    "Vaporization",
    "View",
    "duration",
    "flow_observers",
    "heat_observers",
    "snapshot_fields",
]
