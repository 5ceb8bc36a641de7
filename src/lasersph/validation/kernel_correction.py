"""What corrections do at a cut support [Alshaer2017, Sections 4.1 and 4.2, Figs. 3-8].

First and second derivatives of six functions on x_i = 1 + 0.25 i, i = 0 ... 16, cubic spline with
h = 1.5 dx, by the standard operators, with kernel gradient correction (KGC) and with Schwaiger's
operator; error norm L2 = sqrt(sum_i (f_i - exact_i)^2), eq. (33), without 1/N.

The references come from the operators worked out on this line of particles by an independent
program; the paper gives its errors as figures and percentages only.
"""

from __future__ import annotations

from collections.abc import Callable
from math import ceil, floor
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.special import erfc

from lasersph.compute.backend import Backend
from lasersph.sph import correction, schwaiger
from lasersph.sph.kernels import kernel
from lasersph.sph.laplacian import diffusion
from lasersph.validation.correction_figures import draw
from lasersph.validation.lattices import all_pairs
from lasersph.validation.report import Report
from lasersph.validation.runs import backend_of_loops
from lasersph.validation.verdict import Row, at_most, claimed, judged, shown

Array = NDArray[np.float64]
TITLE = "First and second derivatives at a free end, with and without corrections"
SPACING = 0.25
LINE: Array = np.linspace(1.0, 5.0, 17)
SUPPORT = 2.0 * 1.5 * SPACING
DERIVED = "operators of Alshaer et al. 2017, eqs. (10)-(17), worked out independently"
SECTION = "Alshaer et al. 2017, Section "


class Function(NamedTuple):
    """A function of x with its first and second derivative."""

    name: str
    value: Callable[[Array], Array]
    first: Callable[[Array], Array]
    second: Callable[[Array], Array]


FUNCTIONS = (
    Function("x", lambda x: x, np.ones_like, np.zeros_like),
    Function("x^2", lambda x: x**2, lambda x: 2.0 * x, lambda x: 2.0 + 0.0 * x),
    Function("x^3", lambda x: x**3, lambda x: 3.0 * x**2, lambda x: 6.0 * x),
    Function("1/x", lambda x: 1.0 / x, lambda x: -1.0 / x**2, lambda x: 2.0 / x**3),
    Function("ln x", np.log, lambda x: 1.0 / x, lambda x: -1.0 / x**2),
    Function(
        "erfc(x/2)",
        lambda x: erfc(0.5 * x),
        lambda x: -np.exp(-0.25 * x**2) / np.sqrt(np.pi),
        lambda x: 0.5 * x * np.exp(-0.25 * x**2) / np.sqrt(np.pi),
    ),
)
VARIANTS = (
    "grad standard",
    "grad KGC",
    "lap standard",
    "lap Schwaiger",
    "lap Schwaiger, no Gamma",
    "lap Schwaiger + KGC",
)
L2_REFERENCE = {
    "x": (0.77621, 0.0, 4.6072, 0.0),
    "x^2": (5.7222, 0.52559, 34.019, 3.1728),
    "erfc(x/2)": (0.25932, 0.043642, 1.5361, 0.24873),
}
"""L2 of grad standard, grad KGC, lap standard, lap Schwaiger + KGC."""
L2_VARIANTS = (VARIANTS[0], VARIANTS[1], VARIANTS[2], VARIANTS[5])
CURVED = ("x^2", "x^3", "erfc(x/2)")
PLACES = {"particle 0": 0, "particle 1": 1, "particle 2": 2, "inside": 8}
TABLE = {
    "M": (0.49382716, 0.79012346, 0.98765432, 0.98765432),
    "Gamma": (0.49382716, 0.79012346, 0.98765432, 0.98765432),
    "KGC grad(x^2) - 2x": (0.35, 0.125, 0.0, 0.0),
    "standard lap(x^2)": (7.308642, 3.555556, 1.975309, 1.975309),
    "Schwaiger + KGC lap(x)": (0.0, 0.0, 0.0, 0.0),
    "Schwaiger + KGC lap(x^2)": (-0.24, 1.875, 2.0, 2.0),
}


def run(out_dir: Path, *, quick: bool = False) -> Report:
    """All numbers and Figs. 3-8; `quick` changes nothing, it takes seconds."""
    line = Line(backend_of_loops())
    results = {f.name: line.derivatives(f) for f in FUNCTIONS}
    errors = {f.name: l2_errors(f, results[f.name]) for f in FUNCTIONS}
    rows = [*table_rows(line, results), *l2_rows(errors), *claims(errors)]
    figures = draw(out_dir, LINE, FUNCTIONS, results, errors)
    remarks = (
        "KGC is exact on linear functions; at a one-sided support it cannot be on quadratic ones: "
        f"the error of grad x^2 falls by {reduction(errors, 'x^2', VARIANTS[0], VARIANTS[1]):.1f} %"
        ", it is not eliminated",
        "Schwaiger's operator alone reduces all errors by 10-60 %, as the paper says, without its "
        "factor tr(Gamma^-1)/n only: by 26.9 to 50.6 %, with it by less than 1 %",
    )
    return Report("kernel-correction", TITLE, tuple(rows), figures, remarks, quick)


class Line:
    """The particles of the line with their correction matrices."""

    def __init__(self, backend: Backend) -> None:
        self.backend = backend
        self.count = LINE.size
        self.neighbors = all_pairs(backend, LINE[None, :], SUPPORT, kernel("cubic-spline", 1))
        one = backend.asarray(np.ones(self.count))
        raw = backend.asarray(np.ones((1, 1, self.count)))
        C = backend.zeros((1, 1, self.count))
        volume = {"V": backend.asarray(np.full(self.count, SPACING))}
        correction.inverse_correction(backend, self.neighbors, volume, C)
        self.raw = volume | {"mu": one, "G": one, "C": raw}
        self.corrected = self.raw | {"C": C}

    def moments(self) -> dict[str, Array]:
        """M of the correction and Gamma of Schwaiger's operator, raw kernel, (n,)."""
        M = self.backend.zeros((1, 1, self.count))
        Gamma = self.backend.zeros((1, 1, self.count))
        correction.correction_matrix(self.backend, self.neighbors, self.raw, M)
        self.backend.pair_sum(schwaiger.gamma_term, self.neighbors, self.raw, Gamma)
        return {"M": self._host(M), "Gamma": self._host(Gamma)}

    def derivatives(self, function: Function) -> dict[str, Array]:
        """Derivatives of a function by all variants, (n,)."""
        backend, neighbors = self.backend, self.neighbors
        f = {"f": backend.asarray(function.value(LINE))}
        raw, corrected = self.raw | f, self.corrected | f
        slope, curvature = backend.zeros((1, self.count)), backend.zeros(self.count)
        found = {}
        correction.standard_gradient(backend, neighbors, raw, slope)
        found[VARIANTS[0]] = self._host(slope)
        correction.corrected_gradient(backend, neighbors, corrected, slope)
        found[VARIANTS[1]] = self._host(slope)
        backend.pair_sum(diffusion, neighbors, raw, curvature)
        found[VARIANTS[2]] = self._host(curvature)
        for variant, fields, use_gamma in (
            (VARIANTS[3], raw, True),
            (VARIANTS[4], raw, False),
            (VARIANTS[5], corrected, True),
        ):
            schwaiger.schwaiger_laplacian(
                backend, neighbors, fields, curvature, use_gamma=use_gamma
            )
            found[variant] = self._host(curvature)
        return found

    def _host(self, array) -> Array:
        return self.backend.to_host(array).ravel()


def l2_errors(function: Function, results: dict[str, Array]) -> dict[str, float]:
    """L2 of eq. (33) for each variant."""
    exact = {"grad": function.first(LINE), "lap": function.second(LINE)}
    return {
        variant: float(np.sqrt(np.sum((values - exact[variant.split()[0]]) ** 2)))
        for variant, values in results.items()
    }


def table_rows(line: Line, results: dict[str, dict[str, Array]]) -> list[Row]:
    """Rows of the operators at single particles, to 1e-6."""
    computed = line.moments()
    computed["KGC grad(x^2) - 2x"] = results["x^2"][VARIANTS[1]] - 2.0 * LINE
    computed["standard lap(x^2)"] = results["x^2"][VARIANTS[2]]
    computed["Schwaiger + KGC lap(x)"] = results["x"][VARIANTS[5]]
    computed["Schwaiger + KGC lap(x^2)"] = results["x^2"][VARIANTS[5]]
    return [
        judged(f"{name}, {place}", "1", computed[name][index], value, 1e-6, source=DERIVED)
        for name, values in TABLE.items()
        for (place, index), value in zip(PLACES.items(), values, strict=True)
    ]


def l2_rows(errors: dict[str, dict[str, float]]) -> list[Row]:
    """Rows of the error norms; those with a reference to 0.1 %."""
    rows = []
    for name, found in errors.items():
        references = dict(zip(L2_VARIANTS, L2_REFERENCE.get(name, ()), strict=False))
        for variant, error in found.items():
            label = f"L2 {variant}, {name}"
            if variant not in references:
                rows.append(shown(label, "1", error, source=SECTION + "4.1, 4.2, Figs. 5, 8"))
            elif references[variant] == 0.0:
                rows.append(at_most(label, "1", error, 1e-6, published=0.0, source=DERIVED))
            else:
                value = references[variant]
                rows.append(judged(label, "1", error, value, 1e-3 * value, source=DERIVED))
    return rows


def reduction(errors: dict[str, dict[str, float]], name: str, before: str, after: str) -> float:
    """By how much an error falls from one variant to another [%]."""
    return 100.0 * (1.0 - errors[name][after] / errors[name][before])


def claims(errors: dict[str, dict[str, float]]) -> list[Row]:
    """The paper's statements on the errors, beside ours."""
    grad, kgc, lap, alone, no_gamma, both = VARIANTS
    kinds = {
        "KGC": (grad, kgc), "Schwaiger alone": (lap, alone),
        "Schwaiger alone, no Gamma": (lap, no_gamma), "Schwaiger + KGC": (lap, both),
        "KGC added to Schwaiger": (alone, both),
    }  # fmt: skip
    published = {
        "KGC": {"x": "100", "x^2": "100"},
        "Schwaiger alone": {f.name: "10-60" for f in FUNCTIONS},
        "Schwaiger alone, no Gamma": {f.name: "10-60" for f in FUNCTIONS},
        "Schwaiger + KGC": {"x": "100", "x^2": "70-90", "x^3": "70-90", "erfc(x/2)": "70-90"},
        "KGC added to Schwaiger": {"1/x": "10-15", "ln x": "10-15"},
    }
    fall = {
        kind: {f.name: reduction(errors, f.name, *pair) for f in FUNCTIONS}
        for kind, pair in kinds.items()
    }
    rows = [
        shown(f"error reduced by {kind}, {name}", "%", fall[kind][name], published=text,
              source=SECTION + ("4.1" if kind == "KGC" else "4.2"))
        for kind, texts in published.items() for name, text in texts.items()
    ]  # fmt: skip
    rows.append(
        judged("error of grad x^2 reduced by KGC", "%", fall["KGC"]["x^2"], 90.8, 0.1,
               published="100", source=SECTION + "4.1; " + DERIVED)
    )  # fmt: skip
    for label, kind in (
        ("with Gamma", "Schwaiger alone"),
        ("without Gamma", "Schwaiger alone, no Gamma"),
    ):
        holds = all(10.0 <= value <= 60.0 for value in fall[kind].values())
        rows.append(
            claimed(f"claim: Schwaiger {label} alone reduces every error by 10-60 %", holds,
                    source=SECTION + "4.2")
        )  # fmt: skip
    # the reference gives the range of the six reductions in whole percent, rounded outward
    spread = [round(value, 9) for value in fall["Schwaiger alone, no Gamma"].values()]
    rows += [
        judged("Schwaiger without Gamma, smallest reduction, rounded down", "%",
               floor(min(spread)), 26.0, 0.0, published="10",
               source=SECTION + "4.2; " + DERIVED),
        judged("Schwaiger without Gamma, largest reduction, rounded up", "%",
               ceil(max(spread)), 51.0, 0.0, published="60", source=SECTION + "4.2; " + DERIVED),
        claimed("claim: KGC eliminates the error of grad x",
                errors["x"][kgc] < 1e-9, source=SECTION + "4.1"),
        claimed("claim: KGC eliminates the error of grad x^2",
                errors["x^2"][kgc] < 1e-9, source=SECTION + "4.1"),
        claimed("claim: Schwaiger + KGC eliminates the error of lap x",
                errors["x"][both] < 1e-9, source=SECTION + "4.2"),
        claimed("claim: Schwaiger + KGC reduces x^2, x^3, erfc by about 70-90 %",
                all(69.0 <= fall["Schwaiger + KGC"][n] <= 91.0 for n in CURVED),
                source=SECTION + "4.2"),
        claimed("claim: KGC added to Schwaiger reduces 1/x and ln x by only 10-15 %",
                all(fall["KGC added to Schwaiger"][n] <= 15.0 for n in ("1/x", "ln x")),
                source=SECTION + "4.2"),
    ]  # fmt: skip
    return rows
