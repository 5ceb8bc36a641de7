"""Plots: figures from files alone; matplotlib is imported when a figure is drawn."""

from lasersph.plots.animation import animate_run
from lasersph.plots.arrangement import arrangement
from lasersph.plots.comparison import (
    melt_pools,
    speed_extrema,
    surface_speeds,
    surface_temperatures,
)
from lasersph.plots.particle_map import particle_map
from lasersph.plots.run_figures import draw_run
from lasersph.plots.surface_flow import surface_flow_profiles
from lasersph.plots.surface_profiles import surface_profiles

__all__ = [
    "animate_run",
    "arrangement",
    "draw_run",
    "melt_pools",
    "particle_map",
    "speed_extrema",
    "surface_flow_profiles",
    "surface_profiles",
    "surface_speeds",
    "surface_temperatures",
]
