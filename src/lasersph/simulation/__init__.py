"""Simulation: builds particles and solver from a case, forecasts the cost, holds the time loop."""

from lasersph.simulation.forecast import Forecast, forecast
from lasersph.simulation.run import Result, run

__all__ = ["Forecast", "Result", "forecast", "run"]
