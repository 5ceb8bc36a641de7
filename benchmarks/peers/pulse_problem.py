"""A pulse of 150 fs on a metal with electrons and lattice, the same for every program, in 1-D.

    C_e dT_e/dt = d/dz(k_e dT_e/dz) - G (T_e - T_l) + S,    C_l dT_l/dt = G (T_e - T_l)

Two metals: with constant C_e and k_e, for which there is a closed form, and with C_e and k_e that
grow as T_e, whose reference is a fine grid of finite volumes. Each program runs with several
resolutions; compared is the time that it takes to the same error of both temperatures, at some
depths and times, between its runs on logarithmic scales.
"""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from functools import cache
from math import exp, log
from typing import Any

import numpy as np
from comparison_table import OURS
from measurement import Measurement
from numpy.typing import NDArray
from pysph_side import json_line
from scipy.integrate import solve_ivp
from scipy.interpolate import CubicSpline
from scipy.sparse import bmat, diags
from workplace import CASES, PeerFailed, Workplace, output_of

from lasersph.analytic.two_temperatures import HalfSpace, pulse_rise

WANTED = (0.01, 0.003, 0.001)
"""Errors that programs are to reach, over the largest rise of that temperature [1]; by the first
they are compared, the others are printed beside it."""
COLD = 300.0
"""Temperature at the start [K]."""
CELLS, FINEST = 1200, 1e-9
"""Of the reference: cells over the depth, and the width of that at the surface [m]. Its error is
below 1e-4: with half as many cells nothing changes by more."""


@dataclass(frozen=True)
class Pulse:
    """The problem, in SI units.

    Attributes:
        is_linear: C_e = capacity T_e/T_0 and k_e = conductivity T_e/T_0, else both are constant.
        capacity, lattice: C_e at 300 K, C_l [J/(m^3 K)]. conductivity: [W/(m K)]. coupling: G
            [W/(m^3 K)]. alpha: [1/m]. fluence: absorbed [J/m^2]. fwhm, center: of the Gaussian
            [s]. thickness: of the metal, insulated on both sides [m]. times: of the comparison
            [s]. depths: [m].
    """

    is_linear: bool
    capacity: float = 2.1e4
    lattice: float = 2.49e6
    conductivity: float = 318.0
    coupling: float = 2.1e16
    alpha: float = 8e6
    fluence: float = 10.0
    fwhm: float = 150e-15
    center: float = 0.75e-12
    thickness: float = 2e-6
    times: tuple[float, ...] = (0.75e-12, 1e-12, 2e-12, 5e-12)
    depths: tuple[float, ...] = (0.0, 100e-9, 300e-9)


FINEST_OF_OURS: dict[str, NDArray[np.float64]] = {}
"""Temperatures of the finest run of lasersph, the first program of a round, by case."""
CONSTANT, LINEAR = Pulse(is_linear=False), Pulse(is_linear=True)


@dataclass(frozen=True)
class Answer:
    """What a program found with one resolution.

    Attributes:
        points: in depth. wall, processor: times of the run [s]. temperature: (2, times, depths)
            T_e and T_l [K].
    """

    points: int
    wall: float
    processor: float
    temperature: NDArray[np.float64]


@cache
def reference(pulse: Pulse) -> NDArray[np.float64]:
    """T_e and T_l [K], (2, times, depths): the closed form, or the fine grid."""
    if pulse.is_linear:
        return fine_grid(pulse, CELLS)
    body = HalfSpace(
        pulse.capacity, pulse.lattice, pulse.coupling, pulse.conductivity, pulse.alpha,
        pulse.fluence, pulse.fwhm, pulse.center,
    )  # fmt: skip
    rises = [pulse_rise(depth, np.array(pulse.times), body) for depth in pulse.depths]
    return COLD + np.moveaxis(np.array(rises), 0, 2)


def fine_grid(pulse: Pulse, cells: int) -> NDArray[np.float64]:
    """The same by finite volumes that widen with depth, integrated to 1e-8."""
    # faces z_k = a (q^k - 1), and what of the light each cell takes
    face = stretched(pulse.thickness, cells)
    center, width = 0.5 * (face[1:] + face[:-1]), np.diff(face)
    taken = -np.diff(np.exp(-pulse.alpha * face)) * pulse.fluence / width
    apart = np.diff(center)
    sigma = pulse.fwhm / np.sqrt(8.0 * np.log(2.0))

    def rates(time: float, y: NDArray[np.float64]) -> NDArray[np.float64]:
        """dT_e/dt and dT_l/dt."""
        T_e, T_l = y[:cells], y[cells:]
        hot = T_e / COLD
        flow = pulse.conductivity * 0.5 * (hot[1:] + hot[:-1]) * np.diff(T_e) / apart
        power = np.exp(-0.5 * ((time - pulse.center) / sigma) ** 2) / (sigma * np.sqrt(2 * np.pi))
        gained = np.diff(flow, prepend=0.0, append=0.0) / width + power * taken
        exchanged = pulse.coupling * (T_e - T_l)
        heated = (gained - exchanged) / (pulse.capacity * hot)
        return np.concatenate([heated, exchanged / pulse.lattice])

    itself = diags([1.0], [0], shape=(cells, cells))  # pyright: ignore[reportArgumentType]
    band = diags([1.0, 1.0, 1.0], [-1, 0, 1], shape=(cells, cells))  # pyright: ignore[reportArgumentType]
    found = solve_ivp(
        rates, (0.0, pulse.times[-1]), np.full(2 * cells, COLD), method="BDF",
        t_eval=pulse.times, rtol=1e-8, atol=1e-6, max_step=pulse.fwhm,
        jac_sparsity=bmat([[band, itself], [itself, itself]], format="csc"),
    )  # fmt: skip
    both = found.y.T.reshape(len(pulse.times), 2, cells)
    return np.array([
        [at_depths(center, both[number, part], pulse) for number in range(len(pulse.times))]
        for part in range(2)
    ])  # fmt: skip


def stretched(thickness: float, cells: int) -> NDArray[np.float64]:
    """Faces of cells from the surface on [m], the first `FINEST` wide, each wider by one ratio."""
    number = np.arange(cells + 1)
    if FINEST * cells >= thickness:
        return thickness * number / cells
    # the ratio whose sum is the thickness, by halving
    low, high = 1.0, 2.0
    while high - low > 1e-15:
        middle = 0.5 * (low + high)
        is_long = FINEST * (middle**cells - 1.0) > thickness * (middle - 1.0)
        low, high = (low, middle) if is_long else (middle, high)
    return thickness * (high**number - 1.0) / (high**cells - 1.0)  # pyright: ignore[reportReturnType]


def at_depths(depth: NDArray[Any], T: NDArray[Any], pulse: Pulse) -> NDArray[np.float64]:
    """T [K] at the depths of the problem, by splines over cells and their image at the surface."""
    order = np.argsort(depth)
    z, found = depth[order], T[order]
    both = CubicSpline(np.concatenate([-z[::-1], z]), np.concatenate([found[::-1], found]))
    return both(pulse.depths)


def error_of(answer: Answer, pulse: Pulse) -> float:
    """Largest error of both temperatures, each over the largest rise of its own [1]."""
    return apart_over_rise(answer.temperature, reference(pulse), pulse)


def apart_over_rise(found: NDArray[Any], other: NDArray[Any], pulse: Pulse) -> float:
    """Largest difference of both temperatures, each over the largest rise of its own [1]."""
    rise = np.max(reference(pulse) - COLD, axis=(1, 2), keepdims=True)
    return float(np.max(np.abs(found - other) / rise))


def time_at(error: float, errors: Sequence[float], times: Sequence[float]) -> float | None:
    """Time of a run with that error, between runs from coarse to fine; None where all have more."""
    for number, found in enumerate(errors):
        if found > error:
            continue
        if number == 0:
            return times[0]
        # logarithm of the time, linear in that of the error
        share = log(errors[number - 1] / error) / log(errors[number - 1] / found)
        return exp(log(times[number - 1]) + share * log(times[number] / times[number - 1]))
    return None


def compared(
    case: str, program: str, answers: Sequence[Answer], pulse: Pulse, workplace: Workplace
) -> Measurement:
    """Times to the errors wanted, the finest error.

    Raises:
        PeerFailed: no run has the first of the errors.
    """
    errors = [error_of(one, pulse) for one in answers]
    walls, processors = [one.wall for one in answers], [one.processor for one in answers]
    wall, processor = time_at(WANTED[0], errors, walls), time_at(WANTED[0], errors, processors)
    if wall is None or processor is None:
        text = ", ".join(f"{100.0 * error:.2g} %" for error in errors)
        raise PeerFailed(f"no run has an error of {100.0 * WANTED[0]:g} %, but {text}")
    finest = answers[-1].temperature
    detail = {"% error of the finest run": 100.0 * errors[-1]}
    if program != OURS:
        apart = 100.0 * apart_over_rise(finest, FINEST_OF_OURS[case], pulse)
        detail["% between that and lasersph's"] = apart
    else:
        FINEST_OF_OURS[case] = finest
    for error in WANTED[1:]:
        times = [workplace.time(one.wall, one.processor) for one in answers]
        found = time_at(error, errors, times)
        if found is not None:
            detail[f"ms to {100.0 * error:g} %"] = 1e3 * found
    points = answers[-1].points
    return Measurement(case, program, 1, points, wall, processor, detail=detail)


def answers_of(
    script: str, python: str, pulse: Pulse, sizes: Sequence[dict[str, float]], workplace: Workplace
) -> list[Answer]:
    """Runs of a peer's script: it is given problem and sizes in JSON and prints JSON.

    Raises:
        PeerFailed: it ends with an error.
    """
    given = json.dumps({"pulse": asdict(pulse), "cold": COLD, "sizes": list(sizes)})
    folder = workplace.run_folder(script.removesuffix(".py"))
    text = output_of([python, str(CASES / script), given], folder=folder)
    return [
        Answer(one["points"], one["wall"], one["processor"], np.array(one["temperature"]))
        for one in json_line(text)["runs"]  # pyright: ignore[reportGeneralTypeIssues]
    ]
