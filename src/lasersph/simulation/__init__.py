"""Simulation: builds particles and solver from a case, forecasts the cost, holds the time loop."""

from lasersph.simulation.acceptance import check
from lasersph.simulation.forecast import Forecast, forecast
from lasersph.simulation.progress import RunProgress
from lasersph.simulation.time_loop import Result, RunWarning, Stopped, run

__all__ = ["Forecast", "Result", "RunProgress", "RunWarning", "Stopped", "check", "forecast", "run"]
