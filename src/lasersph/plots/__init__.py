"""Plots: figures from files alone; matplotlib is imported when a figure is drawn.

`lasersph.plot(run, name)` gives the figures of a run by name. Each function here that takes a run
takes its folder as well and returns a figure of Matplotlib, or None where the run has nothing of
what it shows. Of a train of pulses these show the whole of it, `plot` the last pulse.
"""

from lasersph.plots.ablation_history import crater_history, trace_figure
from lasersph.plots.animation import animate_run
from lasersph.plots.comparison import (
    melt_pools,
    reliefs,
    speed_extrema,
    surface_speeds,
    surface_temperatures,
)
from lasersph.plots.crater_cut import crater_cut, ejecta_vectors
from lasersph.plots.crater_view import crater_scene, crater_view
from lasersph.plots.flow_cells import flow_cell_map
from lasersph.plots.flow_history import (
    center_line_figure,
    extrema_history,
    layer_history,
    nusselt_history,
    quality_history,
    speed_history,
    surface_pressure_history,
)
from lasersph.plots.flow_map import box_flow_map, pool_flow_map
from lasersph.plots.fluence import fluence_figure
from lasersph.plots.history import (
    energy_history,
    melt_pool_history,
    temperature_history,
    time_step_history,
)
from lasersph.plots.particle_map import arrangement, particle_map
from lasersph.plots.pictures import draw_run
from lasersph.plots.process_map import draw_process_map
from lasersph.plots.pulses import pulses_compared
from lasersph.plots.relief import (
    final_relief,
    relief_after_pulses,
    relief_map,
    relief_profiles,
    topography_history,
)
from lasersph.plots.run_figures import captions, plot
from lasersph.plots.surface_maps import (
    surface_flow_map,
    surface_height_map,
    surface_sections,
    surface_temperature_map,
)
from lasersph.plots.surface_profiles import surface_flow_profiles, surface_profiles
from lasersph.plots.texture import texture_figure
from lasersph.plots.uncertainty import tornado_chart

__all__ = [
    "animate_run",
    "arrangement",
    "box_flow_map",
    "captions",
    "center_line_figure",
    "crater_cut",
    "crater_history",
    "crater_scene",
    "crater_view",
    "draw_process_map",
    "draw_run",
    "ejecta_vectors",
    "energy_history",
    "extrema_history",
    "final_relief",
    "flow_cell_map",
    "fluence_figure",
    "layer_history",
    "melt_pool_history",
    "melt_pools",
    "nusselt_history",
    "particle_map",
    "plot",
    "pool_flow_map",
    "pulses_compared",
    "quality_history",
    "relief_after_pulses",
    "relief_map",
    "relief_profiles",
    "reliefs",
    "speed_extrema",
    "speed_history",
    "surface_flow_map",
    "surface_flow_profiles",
    "surface_height_map",
    "surface_pressure_history",
    "surface_profiles",
    "surface_sections",
    "surface_speeds",
    "surface_temperature_map",
    "surface_temperatures",
    "temperature_history",
    "texture_figure",
    "time_step_history",
    "topography_history",
    "tornado_chart",
    "trace_figure",
]
