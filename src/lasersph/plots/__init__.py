"""Plots: figures from files alone; matplotlib is imported when a figure is drawn."""

from lasersph.plots.arrangement import arrangement
from lasersph.plots.comparison import melt_pools, surface_temperatures
from lasersph.plots.particle_map import particle_map
from lasersph.plots.run_figures import draw_run
from lasersph.plots.surface_profiles import surface_profiles

__all__ = [
    "arrangement",
    "draw_run",
    "melt_pools",
    "particle_map",
    "surface_profiles",
    "surface_temperatures",
]
