"""What single changes do to the numbers of both papers that validations miss.

python benchmarks/one_change.py                    all tables
python benchmarks/one_change.py --only heat        extrema of steel near 0.5 J/cm2
python benchmarks/one_change.py --only rises       how long both last, by the least rise of one
python benchmarks/one_change.py --only cells       speed of steel by `clip` over the spacing
python benchmarks/one_change.py --only gradients   mean |dT/dx| and outward layer at 57 ns, by place
python benchmarks/one_change.py --only zones       fine rows of Table 5 beside recorded pools
python benchmarks/one_change.py --only norms       eq. (33) over particles and times; eq. (37)
python benchmarks/one_change.py --only weights     errors at 1 and 0.25 um with corrected weights
python benchmarks/one_change.py --only depths      crater by rule of leaving, reflectivity, spacing

The last three are of [Alshaer2017] and stand in the README of `pulsed-heating` and, depths, of
`ablation-column`; the others are of [Demuth2020] and stand in those of `dlip-tables` (zones) and
`dlip-figures`.
"""

from __future__ import annotations

import argparse
import json
import math
import tempfile
from pathlib import Path
from typing import NamedTuple

import numpy as np

from lasersph.analytic.convergence import grid_convergence_index
from lasersph.observers.flow_extrema import local_maxima
from lasersph.observers.interpolation import interpolate
from lasersph.observers.surface_speed import zero_of
from lasersph.output import Run
from lasersph.validation.ablation_depth.column import Column
from lasersph.validation.dlip_figures.rows import PRINTED, details, speed_of
from lasersph.validation.pulsed_heating.light import Light
from lasersph.validation.pulsed_heating.rows import lattice, surface
from lasersph.validation.study import Study

HEATED = (
    ("0.535 J/cm2", 0.535, 10, ""),
    ("0.55 J/cm2", 0.55, 10, ""),
    ("0.57 J/cm2", 0.57, 10, ""),
    ("0.6 J/cm2", 0.6, 10, ""),
    ("0.535 J/cm2, 7 nm", 0.535, 7, ""),
    ("0.535 J/cm2, clip", 0.535, 10, "solver.plateau=clip"),
    ("0.535 J/cm2, evaporate", 0.535, 10, "solver.plateau=evaporate"),
    ("0.535 J/cm2, published limits of the step", 0.535, 10, "solver.step_limits=published"),
    ("0.535 J/cm2, no shifting", 0.535, 10, "solver.shifting=0"),
)
"""Words, fluence [J/cm2], spacing [nm] and a setting."""
RISES = (0.05, 0.02, 0.01, 0.005)
"""Least rise of an extremum over its valley, in parts of the largest speed; ours is first."""
LOOKS = np.arange(54.5, 61.05, 0.1)
"""Times of profiles [ns]: the pool has spread, and two extrema have become one by the last."""
CELLS = ((0.8, (20, 10)), (1.0, (20, 10, 7)))
POOLS = (("dlip-steel", 10, (0.5, 0.535)), ("dlip-aluminium", 24, (1.0, 1.01, 1.02, 1.03)))
"""Case, spacing [nm] and fluences [J/cm2]: that of the text, then with more heat."""
RECORDS = Path(__file__).parents[1] / "docs" / "validation"
ZONES = (("dlip-steel", "steel", 50), ("dlip-aluminium", "aluminium", 250))
"""Validation, name of the metal in `dlip-tables`, step of the printed depths [nm]."""
BELOW, SUPPORTS = 20, 2 * 3.75 * 3.97
"""[nm]: all depths of Table 5 are 20 nm more than a multiple of that step; two supports of the
published spacing, which our own fine rows hold below the pool."""
PRINTED_ERROR, PRINTED_ORDER = -0.0086, 1.12
"""Eqs. (36) and (35) of [Alshaer2017]."""
DEPTHS = (
    ("published", 0.80, 0.2),
    ("enthalpy", 0.80, 0.2),
    ("enthalpy", 0.75, 0.2),
    ("enthalpy", 0.75, 0.05),
)
"""Rule of leaving, reflectivity, spacing [um] of a column that is ablated: one change at a time."""


class Surface(NamedTuple):
    """The surface outward from the maximum of the light, (m,) each.

    x: [um]. T: [K]. slope: |dT/dx| [K/um]. speed: [m/s]. liquid: whether it flows.
    """

    x: np.ndarray
    T: np.ndarray
    slope: np.ndarray
    speed: np.ndarray
    liquid: np.ndarray

    def mean(self, chosen: np.ndarray | None = None, weight: np.ndarray | float = 1.0) -> float:
        """Mean slope over the length, of the liquid or of what is chosen (m,)."""
        part = self.liquid if chosen is None else chosen
        return float(np.average(self.slope[part], weights=(np.gradient(self.x) * weight)[part]))


def steel(study: Study, fluence: float, spacing: int, end: int, *settings: str) -> Run:
    """A run of the pool in steel."""
    return study.run(
        f"{fluence}-{spacing}-{settings}".replace(" ", "")[:60],
        f"laser.fluence={fluence} J/cm^2",
        f"particles.spacing={spacing} nm",
        f"time.end={end} ns",
        *settings,
        case="dlip-steel",
    )


def heat(study: Study) -> None:
    """Extrema of the speed beside those that the paper prints for 0.5 J/cm2."""
    print("printed:", ", ".join(f"{one.what} {one.value} {one.unit}" for one in PRINTED.values()))
    for words, fluence, spacing, setting in HEATED:
        one = steel(study, fluence, spacing, 63, *filter(None, [setting]))
        found = details(study, one)
        print(words, ", ".join(f"{key} {value:.2f}" for key, value in found.items()), flush=True)


def rises(study: Study) -> None:
    """For how long two extrema count, and the inner one is the faster one."""
    times = ", ".join(f'"{t:.1f} ns"' for t in LOOKS)
    for fluence in (0.535, 0.55, 0.57, 0.8):
        one = steel(study, fluence, 10, 62, f"output.snapshots.times=[{times}]")
        for least in RISES:
            both, faster = coexistence(one, least)
            print(f"{fluence} J/cm2, {least:g}: both {both:.1f} ns, inner faster {faster:.1f} ns")


def coexistence(one: Run, least: float) -> tuple[float, float]:
    """Time [ns] with two maxima of |u| at x > 0 that rise by `least`, and of a faster inner one."""
    both = faster = 0
    for step in one.snapshots:
        x = step["position"][0]
        chosen = np.flatnonzero((step["surface"] > 0) & (step["flows"] > 0) & (x > 0.0))
        speed = np.abs(step["surface_velocity"][chosen[np.argsort(x[chosen])]])
        if 1e9 * step["time"] < LOOKS[0] - 0.01 or not speed.size:
            continue
        speed = np.concatenate([[0.0], speed, [0.0]])
        found, _ = local_maxima(speed, least * float(np.max(speed)))
        both += found.size > 1
        faster += bool(found.size > 1 and speed[found[0]] > speed[found[-1]])
    return 0.1 * both, 0.1 * faster


def cells(study: Study) -> None:
    """Largest speed of the surface with enthalpy beyond the full L_v discarded."""
    for fluence, spacings in CELLS:
        for spacing in spacings:
            one = steel(study, fluence, spacing, 66, "solver.plateau=clip")
            print(f"{fluence} J/cm2, {spacing} nm: {speed_of(one):.2f} m/s", flush=True)


def gradients(study: Study) -> None:
    """Mean |dT/dx| and outward layer at 57 ns: printed are 1240 and 900 K/um, 68 and 115 nm."""
    for case, spacing, fluences in POOLS:
        for fluence in fluences:
            one = study.run(
                f"gradient-{case}-{fluence}",
                f"laser.fluence={fluence} J/cm^2",
                f"particles.spacing={spacing} nm",
                "time.end=57.1 ns",
                'output.snapshots.times=["57 ns"]',
                case=case,
            )
            line = surface_at(one, 57e-9)
            speed = f"largest speed {np.max(line.speed):.2f} m/s"
            print(f"{case}, {fluence} J/cm2, {spacing} nm:", speed)
            for words, value in mean_slopes(line).items():
                print(f"  {words}: {value:.0f} K/um")
            thickness = outward_layer(one, 57e-9, line.x[line.liquid], spacing)
            thickest = int(np.argmax(thickness))
            x = line.x[int(np.argmax(line.speed))], line.x[thickest]
            there = float(np.interp(x[0], line.x[line.liquid], thickness))
            print(f"  outward layer: {there:.1f} nm at the fastest place, {x[0]:.2f} um;", end=" ")
            print(f"{thickness[thickest]:.1f} nm at most, {x[1]:.2f} um", flush=True)


def surface_at(one: Run, time: float) -> Surface:
    """The surface at x > 0 at a time [s]."""
    step = one.snapshots.nearest(time)
    x = step["position"][0]
    chosen = np.flatnonzero((step["surface"] > 0) & (x > 0.0))
    chosen = chosen[np.argsort(x[chosen])]
    return Surface(
        1e6 * x[chosen],
        step["temperature"][chosen],
        1e-6 * np.abs(step["surface_gradient"][chosen]),
        np.abs(step["surface_velocity"][chosen]),
        step["flows"][chosen] > 0,
    )


def outward_layer(one: Run, time: float, places: np.ndarray, spacing: float) -> np.ndarray:
    """Depth [nm] at which u changes sign below places (m,) of the surface [um], at a time [s].

    spacing: of the particles [nm].
    """
    step = one.snapshots.nearest(time)
    depth = np.arange(0.5, 400.0 / spacing, 0.5) * spacing
    found = []
    for x in places:
        near = np.abs(step["position"][0] - 1e-6 * x) < 4e-9 * spacing
        near &= step["position"][-1] > -1e-9 * (depth[-1] + 4.0 * spacing)
        below = np.stack([np.full(depth.size, 1e-6 * x), -1e-9 * depth])
        u = interpolate(step["position"][:, near], step["velocity"][0, near], below)
        found.append(zero_of(depth, u))
    return np.array(found)


def mean_slopes(line: Surface) -> dict[str, float]:
    """Ways to read "the average temperature gradient" [K/um]."""
    x, T, slope, liquid = line.x, line.T, line.slope, line.liquid
    edge = np.flatnonzero(liquid)[-1]
    peak = int(np.argmax(line.speed))
    steepest = float(np.max(slope[liquid]))
    return {
        "maximum to edge, each particle alike, as validated": float(np.mean(slope[liquid])),
        "maximum to edge, over the length": line.mean(),
        "T from maximum to edge over the distance": float((T[0] - T[edge]) / (x[edge] - x[0])),
        "root mean square, each particle alike": float(np.sqrt(np.mean(slope[liquid] ** 2))),
        "weighted by the speed": line.mean(weight=line.speed),
        "maximum to fastest place": line.mean(x <= x[peak]),
        "fastest place to edge": line.mean(liquid & (x >= x[peak])),
        "outer four fifths": line.mean(liquid & (x > 0.2 * x[edge])),
        "outer half": line.mean(liquid & (x > 0.5 * x[edge])),
        "where above half of the steepest": line.mean(liquid & (slope > 0.5 * steepest)),
        "steepest": steepest,
        "at the fastest place": float(slope[peak]),
        "half a period, solid and all": line.mean(np.full(x.size, True)),
    }


def zones(_: Study) -> None:
    """Fine rows of Table 5, and which the recorded pools need in each reading of the plateau."""
    tables = recorded("dlip-tables")
    for name, metal, step in ZONES:
        pools = recorded(name)
        for row, printed in tables.items():
            if row.startswith(f"{metal}: fine zone at "):
                fluence = row.split(" at ")[1].split()[0]
                text = f"{metal}, {fluence} J/cm2: printed {printed['published']} nm"
                for plateau in ("clip", "hold"):
                    depth = pools[f"{fluence} {plateau}: largest depth, f_m = 1"]["computed"]
                    needed = BELOW + step * math.ceil((depth + SUPPORTS - BELOW) / step)
                    text += f"; {plateau}: pool {depth:.0f} nm, needs {needed} nm"
                print(text)


def recorded(name: str) -> dict[str, dict]:
    """Rows of the record of a validation by what they are of."""
    rows = json.loads((RECORDS / f"{name}.json").read_text(encoding="utf-8"))["rows"]
    return {row["quantity"]: row for row in rows}


def norms(study: Study) -> None:
    """Errors at 1 and 0.25 um: printed are 20 and 3 K; an index of 0.019."""
    heating = Study("pulsed-heating", study.folder, threads=1)
    light = Light(heating.plan.intensity, heating.plan.duration)
    found = {}
    for spacing in (1.0, 0.25):
        settings = (*lattice(1, spacing), "time.end=200 ns", "output.snapshots.interval=2 ns")
        one = heating.run(f"norm-{spacing}", *settings)
        found[spacing] = error_norms(one, light, 1e-6 * spacing)
    for words, coarse in found[1.0].items():
        fine = found[0.25][words]
        fall = 100.0 * (1.0 - fine / coarse)
        for R in (0.75, 0.95):  # properties are constant: errors grow as the absorbed light
            share = (1.0 - R) / (1.0 - 0.75)
            print(f"R = {R}, {words}: {share * coarse:.2f}, {share * fine:.2f} K, -{fall:.0f} %")
    for words, ratio in (("refinement", 2.0), ("h over the spacing", 1.5)):
        index = grid_convergence_index(PRINTED_ERROR, ratio, PRINTED_ORDER)
        print(f"eq. (37) from the printed error and order, r = {ratio} ({words}): {index:.4f}")


def error_norms(one: Run, light: Light, spacing: float) -> dict[str, float]:
    """Norms [K] of the error of a pulse and the dark after it, for a 1-D lattice [m]."""
    times = one.snapshots.times
    order = np.argsort(-one.snapshots[0]["position"][-1])
    T = np.array([step["temperature"][order] for step in one.snapshots])
    place = spacing * np.arange(T.shape[1])
    exact = {
        "its layer's top": light.temperature(place[None, :], times[:, None]),
        "its center": light.temperature(place[None, :] + 0.5 * spacing, times[:, None]),
    }
    lit = times <= light.duration + 1e-12
    last = int(np.flatnonzero(lit)[-1])
    norms = {}
    for where, wanted in exact.items():
        off = T - wanted
        parts = {
            "particle 1 at 100 ns": off[last, :1],
            "particle 1 at 200 ns": off[-1, :1],
            "particle 1 while lit": off[lit, 0],
            "particle 1 over 200 ns": off[:, 0],
            "all particles at 100 ns": off[last],
            "all particles at 200 ns": off[-1],
            "the upper 20 um at 100 ns": off[last, place < 20e-6],
            "all particles below the first at 100 ns": off[last, 1:],
            "all particles while lit": off[lit],
        }
        for words, part in parts.items():
            norms[f"{words}, exact at {where}, root mean square"] = float(np.sqrt(np.mean(part**2)))
        # eq. (33) as printed has no 1/N
        norms[f"all particles at 100 ns, exact at {where}, sum"] = float(np.linalg.norm(off[last]))
        norms[f"all particles at 100 ns, exact at {where}, mean of |error|"] = float(
            np.mean(np.abs(off[last]))
        )
    return norms


def weights(study: Study) -> None:
    """Error of particle 1 at the end of the pulse, which falls by a printed 85 % to 0.25 um."""
    heating = Study("pulsed-heating", study.folder, threads=1)
    light = Light(heating.plan.intensity, heating.plan.duration)
    exact = float(light.temperature(0.0, light.duration))
    for dimension in (1, 3):
        for kind in ("plain", "second-moment"):
            errors = []
            for spacing in (1.0, 0.25):
                settings = (*lattice(dimension, spacing), f"solver.weights={kind}")
                label = f"weights-{dimension}-{kind}-{spacing}"
                end = "time.end=100 ns", "output.snapshots.interval=100 ns"
                errors.append(exact - float(surface(heating.run(label, *settings, *end))[-1]))
            fall = 100.0 * (1.0 - errors[1] / errors[0])
            text = f"{errors[0]:.1f} K at 1 um, {errors[1]:.1f} K at 0.25 um"
            print(f"{dimension}-D, {kind}: {text}, -{fall:.1f} %", flush=True)


def depths(study: Study) -> None:
    """Depth after one pulse of 10 J/cm2: printed is 0.6 um."""
    ablation = Study("ablation-column", study.folder, threads=1)
    column = [setting for setting in ablation.plan.column if not setting.startswith("ejection.")]
    for model, R, spacing in DEPTHS:
        settings = [f"ejection.model={model}", f"particles.spacing={spacing} um"]
        settings.append(f"domain.width={8.0 * spacing} um")
        # the preset has R = 0.80
        rule = "ejection.preset=timeline" if model == "published" else f"laser.reflectivity={R}"
        one = ablation.run(f"depth-{model}-{R}-{spacing}", *column, *settings, rule)
        depth = Column.of(one).smooth
        print(f"{model} rule, R = {R}, {spacing} um: {depth:.2f} um", flush=True)


TABLES = (heat, rises, cells, gradients, zones, norms, weights, depths)


def main() -> None:
    """Print the tables."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--only", choices=[table.__name__ for table in TABLES])
    only = parser.parse_args().only
    with tempfile.TemporaryDirectory() as folder:
        study = Study("dlip-figures", Path(folder), threads=1)
        for table in TABLES:
            if only in (None, table.__name__):
                table(study)


if __name__ == "__main__":
    main()
