"""When particles of a column leave by the published rule, and craters of spots by both rules."""

from __future__ import annotations

import numpy as np

from lasersph.output import Run
from lasersph.output.height_map import height_map
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
from lasersph.validation.ablation_aluminium.figures import draw
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


def compare(study: Study) -> None:
    """The column by the published rule, and spots by both."""
    rules, plan = study.plan.rules, study.plan
    column = study.run("column", *plan.column, *rules["published"])
    spots = {name: study.run(f"spot-{name}", *rule, *plan.spot) for name, rule in rules.items()}
    study.add_group("column", column)
    study.add_group("text", column)
    acceleration = column.summary["traces"]["center"]["acceleration_m_s2"]
    study.add("acceleration_claim", acceleration > EJECTION_ACCELERATION)
    add_estimates(study)
    for name, spot in spots.items():
        study.add_group("spot", spot, name=name)
        study.add("asymmetry", 1e6 * asymmetry(spot), name=name)
    draw(study, column, spots, GAS)


def add_estimates(study: Study) -> None:
    """Eq. (5) at the temperatures of the paper, light in the metal and in the vapor."""
    study.add("pressure_30", 1e-5 * saturation_pressure(3744.0, **GAS))
    study.add("pressure_35", 1e-5 * saturation_pressure(3807.6, **GAS))
    study.add("light_5", 1e9 * depth_of_light(0.0498, ALPHA))
    study.add("light_0", 1e9 * depth_of_light(4e-5, ALPHA))
    study.add("light_250", 100.0 * light_left(250e-9, ALPHA))
    study.add("light_vapor", 100.0 * absorbed_by_vapor(6e-7))
    study.add("vapor_length", 1.0 / VAPOR_ABSORPTION)
    for T in (GAS["T_b"], 3744.0, 3807.6):
        study.add("speed_by_effusion", effusion_velocity(T, GAS["R_s"]), T=T)
    study.add("speed_by_mean", mean_normal_velocity(GAS["T_b"], GAS["R_s"]))
    hot, cold = GAS["T_b"], 300.0
    lost = 20.0 * (hot - cold) + 0.09 * STEFAN_BOLTZMANN * (hot**4 - cold**4)
    study.add("losses", lost / (0.25 * 1e13))


def asymmetry(spot: Run) -> float:
    """Largest difference of the height map from its mirror images [m]."""
    z = height_map(spot.snapshots[-1]).z
    images = [z[:, ::-1], z[::-1], *([z.T] if z.shape[0] == z.shape[1] else [])]
    return max(float(np.max(np.abs(z - image))) for image in images)
