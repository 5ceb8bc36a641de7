"""When particles of a column leave by the published rule, and what the text says of Figs. 17-24."""

from __future__ import annotations

import numpy as np

from lasersph.physics.ablation_estimates import (
    EJECTION_ACCELERATION,
    VAPOR_ABSORPTION,
    absorbed_by_vapor,
    depth_of_light,
    light_left,
)
from lasersph.physics.evaporation import (
    NO_CRITICAL_POINT,
    STANDARD_ATMOSPHERE,
    effusion_velocity,
    mean_normal_velocity,
    saturation_pressure,
)
from lasersph.physics.losses import STEFAN_BOLTZMANN
from lasersph.validation.ablation_column.figures import draw
from lasersph.validation.ablation_depth.column import Column
from lasersph.validation.study import Study

GAS = {
    "p_b": STANDARD_ATMOSPHERE,
    "T_b": 2730.0,
    "L_b": 10.53e6,
    "T_c": NO_CRITICAL_POINT,
    "R_s": 308.17,
}
"""Of eq. (5): pressure [Pa] and temperature [K] of boiling, its constant heat [J/kg], R/M."""
ALPHA = 1.23e8
"""Absorption coefficient of aluminium that eq. (3) takes [1/m]."""


DEPTHS = ((10, 0.6, 0.6, 0.2), (20, "1.0-1.2", 1.1, 0.3))
"""Fluence [J/cm2], depth as printed and its middle, half of its range and a layer [um]."""


def compare(study: Study) -> None:
    """The column by the published rule, and depths by the balance of energy."""
    column = study.run("column", *study.plan.column)
    # By the published rule: crater, ejecta, pressure, acceleration.
    study.add_group("column", column)
    study.add_group("text", column)
    study.add("text_pressure", 1e-5 * float(np.max(column.snapshots[-1]["vapor_pressure"])))
    acceleration = column.summary["traces"]["center"]["acceleration_m_s2"]
    study.add("acceleration_claim", acceleration > EJECTION_ACCELERATION)
    # By the text: estimates, and depths of the rule with latent heat.
    add_estimates(study)
    add_depths(study)
    draw(study, column, GAS)


def add_depths(study: Study) -> None:
    """Add depths of the rule with latent heat at 10 and 20 J/cm2, beside those of the text."""
    for fluence, published, middle, share in DEPTHS:
        settings = [f"laser.fluence={fluence} J/cm2", *study.plan.depth]
        one = study.run(f"depth-{fluence}", *settings, case="ablation-depth")
        depth = Column.of(one).smooth
        study.add("text_depth", depth, middle, published=published, share=share, fluence=fluence)
        if fluence == 10:
            study.add("text_measured", depth)


def add_estimates(study: Study) -> None:
    """Eq. (5) at the temperatures of the paper, light in the metal and in the vapor."""
    # Pressures of eq. (5) at two temperatures.
    study.add("pressure_30", 1e-5 * saturation_pressure(3744.0, **GAS))
    study.add("pressure_35", 1e-5 * saturation_pressure(3807.6, **GAS))
    # Light left at some depths, and light that the vapor takes.
    study.add("light_5", 1e9 * depth_of_light(0.0498, ALPHA))
    study.add("light_0", 1e9 * depth_of_light(4e-5, ALPHA))
    study.add("light_250", 100.0 * light_left(250e-9, ALPHA))
    study.add("light_vapor", 100.0 * absorbed_by_vapor(6e-7))
    study.add("vapor_length", 1.0 / VAPOR_ABSORPTION)
    # Velocities of the vapor, by effusion and by the mean normal component.
    for T in (GAS["T_b"], 3744.0, 3807.6):
        study.add("speed_by_effusion", effusion_velocity(T, GAS["R_s"]), T=T)
    study.add("speed_by_mean", mean_normal_velocity(GAS["T_b"], GAS["R_s"]))
    # Radiation and convection of the surface over a quarter of the absorbed intensity.
    hot, cold = GAS["T_b"], 300.0
    lost = 20.0 * (hot - cold) + 0.09 * STEFAN_BOLTZMANN * (hot**4 - cold**4)
    study.add("losses", lost / (0.25 * 1e13))
