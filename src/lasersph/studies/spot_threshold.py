"""Threshold of ablation from the craters of a Gaussian spot, and how much light removes how much.

Where the fluence F exp(-2 r^2/w^2) exceeds the threshold F_th the metal is ablated, so that

    D^2 = 2 w^2 ln(F/F_th)

[Liu1982]: D^2 over ln F is a straight line, whose slope gives the radius w of the beam and whose
zero the threshold. The removal efficiency is the removed volume over the energy of the light that
fell on the sample.

[Liu1982] Liu, Optics Letters 7, 196 (1982).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass
from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np

from lasersph.lasers import GaussianBeam
from lasersph.studies.variation import Prepare, Run, changed, simulate

LEAST = 2
CUBIC_MICROMETERS_PER_MICROJOULE = 1e12
"""1 m^3/J in um^3/uJ."""


@dataclass(frozen=True)
class SpotCrater:
    """One run: peak fluence [J/m^2], diameter, depth at the axis [m], removed volume [m^3] and
    energy of the light [J], both of the whole spot; per length in 2-D, as `volume_unit` says."""

    fluence: float
    diameter: float
    depth: float
    volume: float
    energy: float
    volume_unit: str = "m^3"

    @property
    def shown_volume(self) -> str:
        """The volume in cubic micrometers, or square ones per length."""
        if self.volume_unit == "m^2":
            return f"{1e12 * self.volume:.5g} um2"
        return f"{1e18 * self.volume:.5g} um3"

    @property
    def efficiency(self) -> float:
        """Removed volume over energy [m^3/J]."""
        return self.volume / self.energy if self.energy > 0.0 else 0.0


@dataclass(frozen=True)
class SpotThreshold:
    """Craters in order of fluence and the line through their squared diameters.

    Attributes:
        craters: all runs, also those without a crater.
        threshold: F_th [J/m^2]. radius: w of the fit [m]. beam_radius: w of the case [m].
        scatter: root mean square distance of the squared diameters from the line [m^2].
    """

    craters: tuple[SpotCrater, ...]
    threshold: float
    radius: float
    beam_radius: float
    scatter: float

    def table(self) -> tuple[list[list[str]], list[str]]:
        """One row a run, and the head, as text."""
        rows = []
        for one in self.craters:
            fluence, diameter = f"{1e-4 * one.fluence:.5g} J/cm2", f"{1e6 * one.diameter:.4g} um"
            efficiency = f"{CUBIC_MICROMETERS_PER_MICROJOULE * one.efficiency:.4g} um3/uJ"
            depth = f"{1e6 * one.depth:.4g} um"
            rows.append([fluence, diameter, depth, one.shown_volume, efficiency])
        return rows, ["fluence", "diameter", "depth", "volume", "efficiency"]

    def answer(self) -> str:
        """Threshold and radius in one line."""
        return (
            f"threshold {1e-4 * self.threshold:.4g} J/cm2 (peak), radius {1e6 * self.radius:.4g} um"
            f" from D^2 over ln F (the beam's: {1e6 * self.beam_radius:.4g} um)"
        )

    def as_dict(self) -> dict[str, Any]:
        """Everything in SI as plain data for JSON."""
        craters = [{**asdict(one), "efficiency": one.efficiency} for one in self.craters]
        return {
            "threshold_J_m2": self.threshold,
            "radius_m": self.radius,
            "beam_radius_m": self.beam_radius,
            "scatter_m2": self.scatter,
            "craters": craters,
        }


def no_spot(case: Any, fluences: Sequence[float]) -> str:
    """Why the study is not possible; empty where it is."""
    if "ejection" not in type(case.solver).model_fields or case.laser is None:
        return "nothing is ablated here"
    if not isinstance(case.laser.beam, GaussianBeam) or case.solver.dimensions == 1:
        return "D^2 over ln F needs a gaussian beam in 2-D or 3-D"
    if case.laser.fluence is None or case.laser.fluence_kind != "peak":
        return 'the fluences are peak ones; write fluence and fluence_kind = "peak" in [laser]'
    if len(set(fluences)) < LEAST:
        return f"a line needs {LEAST} different fluences"
    return ""


def spot_threshold(
    case: Any,
    fluence: Sequence[float],
    out: str | PathLike[str],
    *,
    run: Run | None = None,
    prepare: Prepare | None = None,
    report: Callable[[str], None] | None = None,
) -> SpotThreshold:
    """Run a case with a Gaussian spot at each peak fluence [J/m^2] and fit D^2 over ln F.

        case = lasersph.load_case("spot.toml")
        found = lasersph.spot(case, [5e4, 1e5, 2e5], "runs/spot")
        print(found.answer())

    Args:
        case: the case; its laser.fluence is replaced. fluence: two or more, in any order.
        out: folder that receives one run folder for each fluence.
        run: how a case is run; None computes it. prepare: makes several runs at a time before
            their turn.
        report: called with one line after each run.

    Raises:
        ValueError: the case has no such spot, or fewer than two of the runs left a crater.
    """
    if reason := no_spot(case, fluence):
        raise ValueError(reason)
    craters = []
    # one run for each fluence, numbered from the lowest
    cases = {
        Path(out) / f"{number:02d}-fluence-{peak:.6g}": changed(case, "laser.fluence", peak)
        for number, peak in enumerate(sorted(set(fluence)), start=1)
    }
    if prepare is not None:
        prepare(cases)
    for number, (folder, each) in enumerate(cases.items(), start=1):
        peak, summary = each.laser.fluence, (run or simulate)(each, folder).summary
        craters.append(crater_of(peak, summary))
        if report:
            report(f"run {number}: {1e-4 * peak:.5g} J/cm2: {craters[-1].diameter * 1e6:.4g} um")
    # runs without a crater say nothing about the line
    deep = [one for one in craters if one.diameter > 0.0]
    threshold, radius, scatter = fit([d.fluence for d in deep], [d.diameter for d in deep])
    return SpotThreshold(tuple(craters), threshold, radius, case.laser.beam.radius, scatter)


def crater_of(fluence: float, summary: dict[str, Any]) -> SpotCrater:
    """Crater of a run, from its summary."""
    crater = summary["crater"]
    return SpotCrater(
        fluence=fluence,
        diameter=float(crater["diameter_m"]),
        depth=float(crater["depth_m"]),
        volume=float(crater["removed_volume_m3"]),
        energy=float(summary["energy"]["incident_J"]),
        volume_unit=crater["volume_unit"],
    )


def fit(fluences: Sequence[float], diameters: Sequence[float]) -> tuple[float, float, float]:
    """F_th, w and root mean square residual of D^2 = 2 w^2 ln(F/F_th), least squares.

    Raises:
        ValueError: fewer than two craters, or diameters that do not grow with the fluence.
    """
    if len(fluences) < LEAST:
        raise ValueError(f"only {len(fluences)} of the fluences left a crater; give higher ones")
    # straight line D^2 over ln F: slope 2 w^2, zero at ln F_th
    square = np.array(diameters) ** 2
    logarithm = np.log(fluences)
    slope, offset = (float(value) for value in np.polyfit(logarithm, square, 1))
    if slope <= 0.0:
        raise ValueError("the diameters do not grow with the fluence; give fluences farther apart")
    scatter = float(np.sqrt(np.mean((slope * logarithm + offset - square) ** 2)))
    return float(np.exp(-offset / slope)), float(np.sqrt(0.5 * slope)), scatter
