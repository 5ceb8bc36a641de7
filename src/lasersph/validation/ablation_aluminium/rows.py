"""Craters of spots by both rules of leaving: balance of energy, symmetry, size."""

from __future__ import annotations

import numpy as np

from lasersph.output import Run
from lasersph.output.height_map import height_map
from lasersph.validation.ablation_aluminium.figures import draw
from lasersph.validation.study import Study


def compare(study: Study) -> None:
    """A spot by either rule."""
    # One spot by each rule of leaving.
    plan = study.plan
    spots = {
        name: study.run(f"spot-{name}", *rule, *plan.spot) for name, rule in plan.rules.items()
    }
    for name, spot in spots.items():
        study.add_group("spot", spot, name=name)
        study.add("asymmetry", 1e6 * asymmetry(spot), name=name)
    draw(study, spots)


def asymmetry(spot: Run) -> float:
    """Largest difference of the height map from its mirror images [m]."""
    z = height_map(spot.snapshots[-1]).z
    # Mirror images about x, about y and, of a square, about its diagonal.
    images = [z[:, ::-1], z[::-1], *([z.T] if z.shape[0] == z.shape[1] else [])]
    return max(float(np.max(np.abs(z - image))) for image in images)
