"""Numbers of laser interference patterning: published [Demuth2020] and by finite volumes.

The finite-volume program solves eqs. (7)-(13) with the same readings of the paper as the shipped
cases (fluence = mean; plateau `hold`; depth of 10 diffusion lengths). Its own uncertainty: T +-2 K,
times +-0.05 ns, widths +-10 nm (steel) and +-25 nm (aluminum), depths at f_m = 0.5 +-4 and +-30 nm.
"""

from __future__ import annotations

from dataclasses import dataclass

PAPER = "Demuth & Lasagni 2020"
VOLUMES = "independent finite volumes"
TIMES = (45, 50, 55, 57, 60, 70, 80, 100, 150, 200)
"""[ns]"""


@dataclass(frozen=True)
class Metal:
    """One substrate: its case, the published study, and the reference at one fluence.

    Attributes:
        fluences: mean [J/cm2]. fine_zones: Table 5 [nm]. laser_numbers: Table 5 [1],
            with its digits. table_4: L [m], then La, Ph_sl, Ph_lv, Pr, Ra, |Ma| at 0.6 J/cm2.
        reference_fluence: [J/cm2] of temperature [K] at TIMES, events [ns] and sizes [nm].
        events: melt f_m > 0, f_m = 1, T_v from, T_v to, last liquid, last mush.
        widths, depths: largest at f_m > 0, 0.5, 1. fine_widths: by `dlip_columns` in whole cells
            of columns of 4 nm (steel) and 8 nm. column_limited: level whose width in `widths`
            is farther from them than the tolerance.
        width_tolerance, depth_tolerance: [nm], the latter for f_m = 0.5.
        published_width, published_depth: texts, largest at reference_fluence.
        vaporizes_from, filled_from: fluence from which T_v is reached and L_v fully inserted.
        distinct_up_to: fluence up to which the paper calls the growth of the pool distinct.
        aspect, aspect_range: depth over width as published, and as we read it.
    """

    case: str
    fluences: tuple[float, ...]
    fine_zones: tuple[float, ...]
    laser_numbers: tuple[str, ...]
    table_4: tuple[str, ...]
    reference_fluence: float
    temperature: tuple[float, ...]
    events: tuple[float, ...]
    widths: tuple[float, float, float]
    fine_widths: tuple[float, float, float]
    column_limited: str
    depths: tuple[float, float, float]
    width_tolerance: float
    depth_tolerance: float
    published_width: str | None
    published_depth: str
    vaporizes_from: float | None
    filled_from: float
    distinct_up_to: float | None
    aspect: str
    aspect_range: tuple[float, float]


METALS = {
    "steel": Metal(
        case="dlip-steel",
        fluences=(0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0),
        fine_zones=(270, 270, 320, 320, 320, 370, 370),
        laser_numbers=("25.1434", "31.4292", "37.7151", "44.0009", "50.2868", "56.5726", "62.8585"),
        table_4=("457.8e-9", "37.7151", "0.119849", "3.10367", "0.1947", "2.31448e-8", "8.29744"),
        reference_fluence=0.6,
        temperature=(1314, 3273, 3273, 3273, 3273, 1920, 1725, 1321, 896, 732),
        events=(45.94, 46.26, 49.96, 61.04, 78.0, 87.6),
        widths=(2965, 2911, 2876),
        fine_widths=(2944, 2912, 2880),
        column_limited="f_m > 0",
        depths=(296, 285, 277),
        width_tolerance=14.0,
        depth_tolerance=10.0,
        published_width="2900",
        published_depth="270",
        vaporizes_from=0.5,
        filled_from=0.6,
        distinct_up_to=0.7,
        aspect="of the order of 0.1",
        aspect_range=(0.05, 0.2),
    ),
    "aluminium": Metal(
        case="dlip-aluminium",
        fluences=(0.6, 0.7, 0.8, 0.9, 1.0, 1.1, 1.2),
        fine_zones=(770, 770, 1020, 1020, 1270, 1270, 1520),
        laser_numbers=("152.657", "178.100", "203.543", "228.986", "254.429", "279.871", "305.314"),
        table_4=("1.517e-6", "152.657", "0.147849", "4.04443", "0.0101", "1.86969e-7", "9.76488"),
        reference_fluence=1.0,
        temperature=(746, 2540, 2792, 2403, 1786, 1033, 935, 797, 607, 548),
        events=(45.46, 45.48, 51.09, 56.30, 95.5, 95.7),
        widths=(3625, 3601, 3577),
        fine_widths=(3622, 3622, 3622),
        column_limited="f_m = 1",
        depths=(1090, 1066, 1033),
        width_tolerance=25.0,
        depth_tolerance=30.0,
        published_width=None,
        published_depth="1100",
        vaporizes_from=None,
        filled_from=1.0,
        distinct_up_to=None,
        aspect="0.2-0.3",
        aspect_range=(0.195, 0.305),
    ),
}
