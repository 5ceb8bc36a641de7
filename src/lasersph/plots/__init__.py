"""Plots: figures from files alone; matplotlib is imported when a figure is drawn."""

from lasersph.plots.animation import animate_run
from lasersph.plots.comparison import (
    melt_pools,
    speed_extrema,
    surface_speeds,
    surface_temperatures,
)
from lasersph.plots.crater_cut import crater_cut, ejecta_vectors
from lasersph.plots.crater_view import crater_scene, crater_view
from lasersph.plots.particle_map import arrangement, particle_map
from lasersph.plots.run_figures import draw_run
from lasersph.plots.surface_profiles import surface_flow_profiles, surface_profiles

__all__ = [
    "animate_run",
    "arrangement",
    "crater_cut",
    "crater_scene",
    "crater_view",
    "draw_run",
    "ejecta_vectors",
    "melt_pools",
    "particle_map",
    "speed_extrema",
    "surface_flow_profiles",
    "surface_profiles",
    "surface_speeds",
    "surface_temperatures",
]
