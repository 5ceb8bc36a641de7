"""Simulation: builds particles and solver from a case, forecasts the cost, holds the time loop."""

from lasersph.simulation.forecast import Forecast, forecast
from lasersph.simulation.run import Result, Stopped, run

__all__ = ["Forecast", "Result", "Stopped", "forecast", "run"]
