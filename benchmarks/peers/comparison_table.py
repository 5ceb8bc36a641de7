"""Tables of a comparison: one per case, with the ratio of lasersph's speed to each program's.

A ratio is taken in every round between measurements of that round, and its median is printed, so
that a machine that grows slower or busier between rounds changes it little.
"""

from __future__ import annotations

from dataclasses import dataclass
from statistics import median

from measurement import Clock, Measurement

OURS = "lasersph"
TITLES = {
    "wcsph": "Weakly compressible SPH with heat, 3-D, whole step with its share of lists",
    "heat": "Heat between particles at rest, 3-D, whole step",
    "heat-sum": "Heat between particles at rest, 3-D, sum over the pairs alone",
    "implicit": "One implicit step of heat, 2-D, D dt / dx^2 = 5",
    "electrons": "A pulse of 150 fs on electrons and lattice, 1-D, constant coefficients: the run "
    "with an error of 1 % as one step",
    "hot-electrons": "The same with C_e and k_e that grow as T_e",
}
AIMS = {
    ("wcsph", "LAMMPS"): 3.0,
    ("wcsph", "DualSPHysics"): 2.0,
    ("heat-sum", "LAMMPS"): 4.0,
    ("heat-sum", "PySPH"): 8.0,
    ("implicit", "OpenFOAM"): 0.5,
    ("electrons", "NTMpy"): 1.0,
    ("hot-electrons", "NTMpy"): 1.0,
    ("hot-electrons", "laserttm"): 1.0,
}
"""Ratio that lasersph is to reach. OpenFOAM's is below 1: its rows are nine times as short."""
BUSY = 0.9
"""Share of its processors that a program must have for wall times to be worth comparing."""

Rounds = list[list[Measurement]]


@dataclass(frozen=True)
class Line:
    """A program's line: medians over the rounds; ratio: None for lasersph itself."""

    program: str
    threads: int
    particles: int
    time: float
    step_rate: float
    pair_rate: float
    ratio: float | None
    aim: float | None
    detail: dict[str, float]


def share_of_processors(measurement: Measurement) -> float:
    """Share of its processors that a program had while it was timed [1]."""
    return measurement.processor / (measurement.threads * measurement.wall)


def lines_of(case: str, rounds: Rounds, clock: Clock) -> list[Line]:
    """Lines of a case, lasersph first, the others in the order of measurement."""
    found: dict[str, list[Measurement]] = {}
    ratios: dict[str, list[float]] = {}
    for measured in rounds:
        of_case = [m for m in measured if m.case == case]
        ours = next((m for m in of_case if m.program == OURS), None)
        for m in of_case:
            found.setdefault(m.program, []).append(m)
            if ours is not None and m is not ours:
                ratio = ours.speed(clock) / m.speed(clock)
                ratios.setdefault(m.program, []).append(ratio)
    order = sorted(found, key=lambda program: program != OURS)
    return [_line(found[p], ratios.get(p), AIMS.get((case, p)), clock) for p in order]


def _line(some: list[Measurement], ratios: list[float] | None, aim: float | None, clock: Clock):
    """Medians of the measurements of one program."""
    first = some[0]
    return Line(
        first.program,
        first.threads,
        first.particles,
        median(m.time(clock) for m in some),
        median(m.particles / m.time(clock) for m in some),
        median(m.pair_rate(clock) for m in some),
        median(ratios) if ratios else None,
        aim if ratios else None,
        {name: median(m.detail[name] for m in some) for name in first.detail},
    )


def table(case: str, lines: list[Line]) -> str:
    """A case's table as text."""
    rows = [("", "threads", "particles", "ms/step", "M part./s", "M pairs/s", "lasersph/it", "aim")]
    rows += [
        (
            line.program,
            str(line.threads),
            str(line.particles),
            f"{1e3 * line.time:.1f}",
            f"{1e-6 * line.step_rate:.3g}",
            f"{1e-6 * line.pair_rate:.0f}" if line.pair_rate else "",
            "" if line.ratio is None else f"{line.ratio:.2f}",
            "" if line.aim is None else f"{line.aim:g}",
        )
        for line in lines
    ]
    widths = [max(len(row[k]) for row in rows) for k in range(len(rows[0]))]
    text = [TITLES[case]]
    text += [
        "  " + row[0].ljust(widths[0]) + "".join(
            "  " + cell.rjust(width) for cell, width in zip(row[1:], widths[1:], strict=True)
        )
        for row in rows
    ]  # fmt: skip
    for line in lines:
        if line.detail:
            known = ", ".join(f"{name} {value:.3g}" for name, value in line.detail.items())
            text.append(f"  {line.program}: {known}")
    return "\n".join(line.rstrip() for line in text)


def busy_note(rounds: Rounds, clock: Clock) -> str:
    """A warning where programs had to share their processors and wall times are compared."""
    least = min((share_of_processors(m) for measured in rounds for m in measured), default=1.0)
    if clock == "processor" or least >= BUSY:
        return ""
    return (
        f"A program had only {100.0 * least:.0f} % of its processors: others use this machine. "
        "Wait, or compare by --clock processor."
    )
