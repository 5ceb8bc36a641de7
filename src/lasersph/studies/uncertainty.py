"""How sure the numbers of a run are: its discretization error and what uncertain inputs do to it.

Numerical part U_num: two coarser companions and the grid convergence index [Celik2008] of each
number of the summary (`analytic.convergence`), which is meant to hold the exact solution in 95 of
100 cases; sizes in whole cells are never surer than a cell.

Inputs: for each input x_i with a standard uncertainty u(x_i) two runs, at x_i +- u(x_i), and

    u_i(y) = [y(x_i + u(x_i)) - y(x_i - u(x_i))] / 2                    [GUM2008, 5.1.3, note 2]
    u_in(y)^2 = sum of u_i(y)^2                                         [GUM2008, eq. 11a, 5.1.3]

for inputs that do not depend on each other and a y that is linear over +- u(x_i). Where the middle
of the two runs lies farther from y than half their distance, y is not linear and u_i is the larger
of both differences; where a run is impossible on one side, u_i is the difference to the other.
Together, with a coverage of about 95 %,

    U(y)^2 = U_num^2 + (2 u_in)^2                                       [GUM2008, 6.2.1, 6.3.3]

All runs lie in the run folder: `companions/` beside the files of the run itself. Finished ones are
found again, stopped ones continued.

[Celik2008] Celik et al., J. Fluids Eng. 130 (2008) 078001.
[GUM2008] JCGM 100:2008, Guide to the expression of uncertainty in measurement.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

from lasersph.analytic.convergence import ROUNDING
from lasersph.case import Case
from lasersph.input import format_quantity
from lasersph.output import open_run
from lasersph.output.atomic import replace_json
from lasersph.output.older_results import RESULTS_SCHEMA
from lasersph.simulation.layers import expected_melt
from lasersph.solvers.step_control import StepFailed
from lasersph.studies.companions import (
    Input,
    coarser_cases,
    inputs_of,
    shifted,
    with_fixed_layers,
)
from lasersph.studies.spacing_study import StudyRow, assess_summaries, numbers_of
from lasersph.studies.variation import Prepare, Run, simulate

FILE = "uncertainty.json"
COVERAGE = 2.0
"""Standard deviations of a normal distribution that hold about 95 % [GUM2008, 6.3.3]."""
Numbers = dict[str, float]


def assess_uncertainty(
    case: Case,
    folder: Path,
    *,
    inputs: Sequence[Input] = (),
    run: Run | None = None,
    prepare: Prepare | None = None,
    report: Callable[[str], None] | None = None,
) -> dict[str, Any]:
    """Run a case and its companions and write what they say to uncertainty.json.

    Args:
        folder: run folder of the case; its companions go into `companions` inside.
        inputs: beside those whose uncertainty the material states, or in place of them.
        run: makes a run folder exist; None computes it. prepare: makes several at a time before
            their turn.
        report: called with one line before each companion.

    Returns:
        The content of uncertainty.json, see docs/results.md.
    """
    chosen, fixed, coarser = _plan(case, inputs)
    total = 2 * len(chosen) + (0 if isinstance(coarser, str) else len(coarser))
    # companions several at a time, after the run that they accompany
    study = _Companions(folder / "companions", run or simulate, report, total)
    if isinstance(coarser, str):  # said before hours of runs, not after
        study.note(f"no numerical part: {coarser}")
    main = study.run(case, folder).summary
    if prepare is not None:
        study.prepare(prepare, fixed, () if isinstance(coarser, str) else coarser, chosen, main)

    # numerical part: grid convergence index over three spacings
    rows: dict[str, StudyRow] = {}
    spacings: list[float] = []
    if not isinstance(coarser, str):
        found = [study.make(_name_of_spacing(each), each) for each in coarser]
        summaries = [main, *(summary for summary in found if summary is not None)]
        if len(summaries) == 3:
            spacings = [float(summary["spacing_m"]) for summary in summaries]
            rows = {row.name: row for row in assess_summaries(summaries, spacings).rows}
    numbers = numbers_of(main)

    # inputs: each higher and lower by its standard uncertainty
    shifts = {one.key: study.both_sides(fixed, one, numbers) for one in chosen}
    content = {
        "schema_version": RESULTS_SCHEMA,
        "case_hash": case.hash(),
        "coverage": COVERAGE,
        "spacings_m": spacings,
        "inputs": {o.key: {"relative": o.relative, "source": o.source} for o in chosen},
        "notes": study.notes,
        "oscillating_share": _oscillating_share(rows),
        "numbers": {
            name: _assessed(name, value, rows.get(name), shifts) for name, value in numbers.items()
        },
    }
    replace_json(folder / FILE, content)
    return content


def runs_of_assessment(case: Case, inputs: Sequence[Input] = ()) -> list[Case]:
    """Cases that cost what the runs of `assess_uncertainty` cost: the case, those that are coarser,
    and itself for both sides of each input."""
    chosen, fixed, coarser = _plan(case, inputs)
    return [case, *(() if isinstance(coarser, str) else coarser), *(2 * len(chosen) * [fixed])]


def _plan(case: Case, inputs: Sequence[Input]) -> tuple[list[Input], Case, list[Case] | str]:
    """Inputs, each once; the case with fixed layers; its coarser companions, or why not."""
    chosen = list({one.key: one for one in [*inputs_of(case), *inputs]}.values())
    melt = expected_melt(case)
    fixed = with_fixed_layers(case, melt)
    return chosen, fixed, coarser_cases(fixed, melt)


class _Companions:
    """Makes the companions exist, one after the other, and keeps what went wrong."""

    def __init__(self, folder: Path, run: Run, report: Any, total: int) -> None:
        self.folder, self.run, self.report = folder, run, report
        self.count, self.total, self.notes = 0, total, list[str]()

    def note(self, text: str) -> None:
        """Keep what a reader has to know, and say it at once."""
        self.notes.append(text)
        if self.report:
            self.report(text)

    def make(self, name: str, case: Case) -> dict[str, Any] | None:
        """Summary of a companion; None, with a note, where its run fails."""
        self.count += 1
        if self.report:
            self.report(f"companion {self.count} of {self.total}: {name}")
        try:
            return self.run(case, self.folder / name).summary
        except StepFailed as error:
            self.note(f"companion {name} failed: {error}")
            return None

    def prepare(
        self,
        prepare: Prepare,
        case: Case,
        coarser: Sequence[Case],
        inputs: Sequence[Input],
        main: dict[str, Any],
    ) -> None:
        """Make companions several at a time: coarser ones and those with a higher input, then those
        with a lower one, but for inputs that change none of the numbers."""
        # coarser companions, and each input higher
        cases = {self.folder / _name_of_spacing(each): each for each in coarser}
        higher = {one: self.folder / _name_of_shift(one, 1) for one in inputs}
        others = {folder: shifted(case, one, 1) for one, folder in higher.items()}
        prepare(cases | {path: each for path, each in others.items() if isinstance(each, Case)})

        # an input that changes nothing when it is higher is not made lower
        numbers, lower = numbers_of(main), dict[Path, Case]()
        for one, folder in higher.items():
            is_made = (folder / "summary.json").exists()
            other = shifted(case, one, -1)
            is_same = is_made and numbers_of(open_run(folder).summary) == numbers
            if not is_same and isinstance(other, Case):
                lower[self.folder / _name_of_shift(one, -1)] = other
        prepare(lower)

    def both_sides(
        self, case: Case, one: Input, numbers: Numbers
    ) -> tuple[Numbers | None, Numbers | None]:
        """Numbers with an input one standard uncertainty higher, and lower; None for impossible.

        An input that changes none of the case's `numbers` when it is higher is not made lower.
        """
        found: list[Numbers | None] = []
        for sign in (1, -1):
            if found == [numbers]:
                self.count += 1
                return numbers, numbers
            other = shifted(case, one, sign)
            if isinstance(other, str):
                self.note(f"{one.key} {_share(one, sign)}: {other}")
                found.append(None)
                continue
            summary = self.make(_name_of_shift(one, sign), other)
            found.append(None if summary is None else numbers_of(summary))
        return found[0], found[1]


def _name_of_spacing(case: Case) -> str:
    return f"spacing-{format_quantity(case.particles.spacing, 'm').replace(' ', '')}"


def _share(one: Input, sign: int) -> str:
    return f"{100.0 * sign * one.relative:+.4g}%"


def _name_of_shift(one: Input, sign: int) -> str:
    return f"{one.key}{_share(one, sign)}"


def _oscillating_share(rows: dict[str, StudyRow]) -> float | None:
    """Share of the numbers that oscillate, which the procedure asks to report."""
    kinds = [row.convergence.kind for row in rows.values()]
    return kinds.count("oscillating") / len(kinds) if kinds else None


def _assessed(
    name: str,
    value: float,
    row: StudyRow | None,
    shifts: dict[str, tuple[Numbers | None, Numbers | None]],
) -> dict[str, Any]:
    """One number: value, error that holds about 95 %, and its parts."""
    # u_i of each input, their root sum of squares, and U of both parts
    parts = {
        key: part
        for key, (plus, minus) in shifts.items()
        if (part := _part(value, (plus or {}).get(name), (minus or {}).get(name))) is not None
    }
    inputs = COVERAGE * math.hypot(*(part["standard"] for part in parts.values()))
    found = None if row is None else row.convergence
    numerical = math.nan if found is None else found.uncertainty
    entry: dict[str, Any] = {
        "value": value,
        "error": math.hypot(numerical, inputs) if math.isfinite(numerical) else None,
        "numerical": numerical,
        "from_inputs": inputs,
        "inputs": parts,
    }
    if row is not None and found is not None:
        entry |= {
            "behavior": found.kind,
            "order": found.order,
            "extrapolated": found.extrapolated,
            "values": list(row.values),
        }
    return entry


def _part(value: float, plus: float | None, minus: float | None) -> dict[str, Any] | None:
    """Contribution of one input to a number; None where neither side has it."""
    if plus is None and minus is None:
        return None
    # differences of the size of rounding are none
    smallest = ROUNDING * abs(value)
    up, down = (
        None if other is None else other - value if abs(other - value) > smallest else 0.0
        for other in (plus, minus)
    )
    if up is None or down is None:
        return {"up": up, "down": down, "standard": abs(up or down or 0.0), "is_linear": None}
    # [GUM2008, 5.1.3, note 2]; not linear: the larger difference
    half, middle = 0.5 * (up - down), 0.5 * (up + down)
    is_linear = abs(middle) <= abs(half)
    standard = abs(half) if is_linear else max(abs(up), abs(down))
    return {"up": up, "down": down, "standard": standard, "is_linear": is_linear}
