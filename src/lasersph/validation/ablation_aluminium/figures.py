"""Craters and ejecta in the arrangement of Figs. 18, 19 and 22 of [Alshaer2017]."""

from __future__ import annotations

from collections.abc import Mapping

from lasersph.output import Run
from lasersph.plots import crater_cut, crater_view, ejecta_vectors
from lasersph.validation.study import Study


def draw(study: Study, spots: Mapping[str, Run]) -> None:
    # Cuts at the times of Fig. 19; velocities at those of Fig. 22, which the paper has by its own
    """All of them."""
    # rule.
    for name, spot in spots.items():
        for time in study.plan.cuts:
            study.save(f"fig-19-{name}-{time:g}ns", crater_cut(spot, 1e-9 * time))
        times = tuple(1e-9 * t for t in study.plan.vectors) if name == "published" else ()
        study.save(f"fig-18-view-{name}", crater_view(spot))
        study.save(f"fig-22-vectors-{name}", ejecta_vectors(spot, times))
