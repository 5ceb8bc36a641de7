"""Observers look at a run after each step and never change it."""

from lasersph.observers.ablation_view import AblationView
from lasersph.observers.crater import Crater
from lasersph.observers.crater_shape import CraterShape, crater_shape
from lasersph.observers.ejecta import Ejecta
from lasersph.observers.energy_budget import EnergyBudget
from lasersph.observers.flow_view import FlowView
from lasersph.observers.melt_pool import MeltPool
from lasersph.observers.observer import Observer
from lasersph.observers.observer_list import (
    COLUMNS,
    RESULTS,
    Observers,
    ablation_observers,
    flow_observers,
    heat_observers,
    numerical_sd,
)
from lasersph.observers.probes import Probes
from lasersph.observers.quantity import Quantity
from lasersph.observers.snapshots import snapshot_fields
from lasersph.observers.steps import Steps
from lasersph.observers.surface_temperature import SurfaceTemperature
from lasersph.observers.traces import Traces
from lasersph.observers.vaporization import Vaporization
from lasersph.observers.view import View

__all__ = [
    "COLUMNS",
    "RESULTS",
    "AblationView",
    "Crater",
    "CraterShape",
    "Ejecta",
    "EnergyBudget",
    "FlowView",
    "MeltPool",
    "Observer",
    "Observers",
    "Probes",
    "Quantity",
    "Steps",
    "SurfaceTemperature",
    "Traces",
    "Vaporization",
    "View",
    "ablation_observers",
    "crater_shape",
    "flow_observers",
    "heat_observers",
    "numerical_sd",
    "snapshot_fields",
]
