"""Numbers of the flow in melt pools of interference patterning: published and by finite volumes.

The finite-volume program couples heat and melting with a staggered projection under the same flat
lid and readings of the paper (f_m = 1 flows, plateau `hold`). The paper's own numbers are shown and
judge nothing: those of steel need 6-8 % more heat than its parameters give.
"""

from __future__ import annotations

from dataclasses import dataclass

PAPER = "Demuth & Lasagni 2020"
VOLUMES = "independent finite volumes with flow"
INSTANT = 57.0
"""[ns] at which the paper and the reference state velocities."""


@dataclass(frozen=True)
class Flow:
    """What is known of one metal at the fluence that the paper follows in detail.

    Attributes:
        fluence: [J/cm2]. largest: speed of the surface [m/s] and when [ns], over the run.
        surface, below, back: at INSTANT the largest speed of the surface, one row (4 nm) below it,
            and of the return flow [m/s].
        place: of the largest speed from the maximum [um]; layer: thickness that flows outward [nm].
        profile: depth [nm] and u [m/s] below that place at INSTANT.
        size_tolerance: of width and depth against the same run without flow [nm].
        gradient, paper_layer, estimate, estimate_time, surface_over_estimate: mean |dT/dx| [K/um],
            delta_m [nm], eqs. (79) [m/s] and (80) [ns], and speed over estimate as published.
        sayings: further numbers of the text: what, unit, published, section of the summary, key,
            factor.
        experiment: period [um], fluence [J/cm2] and what was measured: what, unit, published, key
            of `melt`, factor [Fig. 12].
    """

    fluence: float
    largest: tuple[float, float]
    surface: float
    below: float
    back: float
    place: float | None
    layer: float | None
    profile: tuple[tuple[float, float], ...]
    size_tolerance: float
    gradient: float
    paper_layer: float
    estimate: float
    estimate_time: float
    surface_over_estimate: float
    sayings: tuple[tuple[str, str, str, str, float], ...]
    experiment: tuple[float, float, tuple[tuple[str, str, str, str, float], ...]]


FLOWS = {
    "steel": Flow(
        fluence=0.5,
        largest=(3.04, 56.0),
        surface=2.98,
        below=2.69,
        back=0.97,
        place=None,
        layer=None,
        profile=(),
        size_tolerance=8.0,
        gradient=1240.0,
        paper_layer=68.0,
        estimate=5.13,
        estimate_time=487.0,
        surface_over_estimate=0.68,
        sayings=(
            ("largest speed of the inner extremum", "m/s", "4", "inner_speed_max_m_s", 1.0),
            ("largest speed of the outer extremum", "m/s", "not much above 3.5",
             "outer_speed_max_m_s", 1.0),
            ("both extrema exist for", "ns", "more than 4", "coexist_lasted_s", 1e9),
            ("the inner one is faster for", "ns", "1.7", "inner_exceeds_lasted_s", 1e9),
        ),
        experiment=(5.05, 0.6, (
            ("molten width (measured)", "um", "3.2", "width_max_m", 1e6),
            ("molten depth (measured: depression)", "nm", "200", "depth_max_m", 1e9),
        )),
    ),
    "aluminium": Flow(
        fluence=1.0,
        largest=(17.1, 56.3),
        surface=17.0,
        below=16.2,
        back=2.9,
        place=1.10,
        layer=116.0,
        profile=((2.0, 16.6), (20.0, 12.8), (40.0, 9.0), (68.0, 4.6), (100.0, 1.0),
                 (150.0, -1.8), (200.0, -2.7), (300.0, -2.2), (600.0, -0.4)),
        size_tolerance=15.0,
        gradient=900.0,
        paper_layer=115.0,
        estimate=20.6,
        estimate_time=121.0,
        surface_over_estimate=0.85,
        sayings=(
            ("inner extrema separate from the outer for", "ns", "not completely",
             "coexist_lasted_s", 1e9),
        ),
        experiment=(4.5, 1.015, (
            ("molten depth (measured: height of the structure)", "um", "0.8", "depth_max_m", 1e6),
        )),
    ),
}  # fmt: skip
