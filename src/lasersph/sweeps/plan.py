"""Plans of sweeps: TOML files that say which case is run, what varies, and how it is sampled.

    case = "dlip-steel"                  # a shipped case or a file beside the plan
    [set]                                # of every run
    "solver.kind" = "conduction"
    [vary]
    "laser.fluence" = { from = "0.3 J/cm^2", to = "1 J/cm^2", count = 8 }    # scale = "log"
    "laser.pulse.fwhm" = ["5 ns", "10 ns"]
    [sampling]
    kind = "grid"                        # grid, zip, sobol, latin-hypercube (runs, seed)
                                         # or morris (trajectories, seed)
    [table]
    columns = ["melt.depth_max_m"]

They are as strict as case files: every mistake is one line with file and line number.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from math import prod
from os import PathLike
from typing import Any, Literal

from pydantic import Field

from lasersph.case.conversion import present_place
from lasersph.input import CaseError, Count, Document, Model, Problem, build, dotted
from lasersph.input.findings import steps_of
from lasersph.input.model import did_you_mean
from lasersph.input.schema import as_toml
from lasersph.sweeps.folder import Study
from lasersph.sweeps.plan_reading import (
    RANGE_KEYS,
    Entry,
    KeyPath,
    Mistakes,
    entries_of,
    read_plan_file,
    read_template,
    refuse_twice,
)
from lasersph.sweeps.points import CaseTemplate, Point, Value, as_override
from lasersph.sweeps.sampling import Choices, Range, grid, latin_hypercube, morris, paired, sobol

NUMBERS = {"sobol": "runs", "latin-hypercube": "runs", "morris": "trajectories"}
"""Key of [sampling] that says how many points a kind of sampling has."""
MOST_RUNS = 10_000
"""Of one plan: listing and checking them takes half a minute."""


class Sampling(Model):
    """How the points lie."""

    kind: Literal["grid", "zip", "sobol", "latin-hypercube", "morris"] = "grid"
    runs: Count | None = Field(default=None, description="of sobol and latin-hypercube")
    trajectories: Count | None = Field(default=None, description="of morris, keys + 1 runs each")
    seed: int = Field(default=0, ge=0, strict=True, description="of all that is random")

    @property
    def is_random(self) -> bool:
        """Whether the points are drawn from ranges."""
        return self.kind not in ("grid", "zip")


class TableChoice(Model):
    """Columns that the table shows."""

    columns: tuple[str, ...] = Field(
        default=(), description="numbers of summaries by key; empty for all of them"
    )


class VariedCase(Model):
    """The keys of every plan that varies a case, not yet compared with the case."""

    schema_version: Literal[1] = 1
    case: str = Field(examples=["dlip-steel"])
    set: dict[str, Any] = Field(default_factory=dict)
    vary: dict[str, Any]


class PlanFile(VariedCase):
    """The keys of the plan of a sweep."""

    sampling: Sampling = Sampling()
    table: TableChoice = TableChoice()


@dataclass(frozen=True)
class SweepPlan:
    """A plan whose keys and values the case takes.

    Attributes:
        text: the file as given. template: the case with `set`.
        choices: values or a range by varied key, in the order of the file; SI.
        sampling, columns: see the file.
    """

    text: str
    template: CaseTemplate
    choices: Choices
    sampling: Sampling
    columns: tuple[str, ...]

    @property
    def varied(self) -> dict[str, str]:
        """SI unit of each varied key; empty where it has none."""
        return {key: self.template.unit(key) for key in self.choices}

    @property
    def study(self) -> Study:
        """Study that a folder must belong to for this plan to go on in it."""
        return Study.of("sweep", self.template, self.varied, self.text, self.columns)

    def points(self) -> list[Point]:
        """All points in their order, those that the case refuses with the reason."""
        kind, runs, seed = self.sampling.kind, self.sampling.runs or 0, self.sampling.seed
        # the sampling decides how values become points
        if kind == "grid":
            found = grid(self.choices)
        elif kind == "zip":
            found = paired(self.choices)
        elif kind == "morris":
            found = morris(self.choices, self.sampling.trajectories or 0, seed)
        else:
            found = (sobol if kind == "sobol" else latin_hypercube)(self.choices, runs, seed)
        return [self.template.point(values) for values in found]

    def notes(self) -> Iterator[str]:
        """Lines that a user should know of sampling and table before any run."""
        from lasersph.observers.observer_list import RESULTS

        # columns that look misspelt, and numbers of runs that sample badly
        for name in self.columns:
            near = "" if name in RESULTS else did_you_mean(name, RESULTS)
            if near and not name.endswith(("_at_s", "_x_m")):  # of a number: when and where
                yield f'no run may have a number "{name}" of [table]{near}'
        runs = self.sampling.runs or 0
        if self.sampling.kind == "sobol" and runs & (runs - 1):
            low = 1 << (runs.bit_length() - 1)
            yield f"Sobol points fill space evenly for powers of two: {low} or {2 * low} runs"
        if self.sampling.kind == "latin-hypercube":
            yield (
                "a Latin hypercube of other runs has other points, so that no run is found again; "
                'kind = "sobol" keeps the first ones'
            )


def read_plan(file: str | PathLike[str]) -> SweepPlan:
    """Read the plan of a sweep.

    Raises:
        CaseError: every mistake of the plan, or of its case, in one line with file and line.
    """
    return _plan_of_file(read_plan_file(file, "sweep"))


def build_plan(
    case: str | PathLike[str],
    vary: Mapping[str, Any],
    *,
    set: Mapping[str, Any] | None = None,
    sampling: Mapping[str, Any] | None = None,
    columns: Sequence[str] = (),
) -> SweepPlan:
    """The plan of a sweep from Python: `vary` has lists or {"from": ..., "to": ..., "count": ...}.

    Raises:
        CaseError: every mistake of the plan, or of its case.
    """
    tables = {
        "set": dict(set or {}),
        "vary": {
            key: dict(one) if isinstance(one, Mapping) else list(one) for key, one in vary.items()
        },
        "sampling": dict(sampling or {}),
        "table": {"columns": list(columns)},
    }
    # the same plan as a file: what the folder keeps
    lines = ["schema_version = 1", f"case = {as_toml(str(case))}"]
    for name, table in tables.items():
        lines += ["", f"[{name}]", *(f"{as_toml(k)} = {as_toml(v)}" for k, v in table.items())]
    data = {"case": str(case), **tables}
    return _plan_of_file(Document(data, text="\n".join(lines) + "\n"))


def _plan_of_file(document: Document) -> SweepPlan:
    entry = build(PlanFile, document)
    return compare_with_case(Mistakes(document), entry, entry.sampling, entry.table.columns)


def compare_with_case(
    mistakes: Mistakes,
    plan: VariedCase,
    sampling: Sampling,
    columns: tuple[str, ...] = (),
) -> SweepPlan:
    """The plan of a sweep whose keys and values the case takes.

    Args:
        mistakes: of the file, those that are known already.

    Raises:
        CaseError: every mistake of the plan, or of its case.
    """
    settings, varied = entries_of(plan.set, ("set",)), entries_of(plan.vary, ("vary",))
    if not varied:
        mistakes.add(("vary",), "nothing varies", 'write e.g. "laser.fluence" = ["1 J/cm^2"]')
    refuse_twice(mistakes, [*settings, *varied])
    for key, path, raw in varied:
        for problem, hint, where in _mistakes(raw, sampling):
            mistakes.add((*path, *where), problem, hint, key=key)
    # the plan by itself
    for path, problem, hint in _sampling_mistakes(sampling, varied):
        mistakes.add(path, problem, hint)
    mistakes.raise_any()
    # the plan with its case: keys, then every value
    template = read_template(mistakes, plan.case, {key: raw for key, _, raw in settings})
    _check_with_case(template, settings, varied, mistakes)
    mistakes.raise_any()
    # values and ranges in SI
    choices: Choices = {}
    for key, path, raw in varied:
        if isinstance(raw, list):
            choices[key] = tuple(template.to_si(key, value) for value in raw)
            same = len(choices[key]) - len({str(value) for value in choices[key]})
            if same and sampling.kind != "zip":
                mistakes.add(path, "a value is given twice", "remove one", key=key)
        else:
            choices[key] = _range(template, key, raw, path, mistakes)
    mistakes.raise_any()
    # zip pairs values one by one
    counts = {key: len(values) for key, values in choices.items()}
    if sampling.kind == "zip" and len(set(counts.values())) > 1:
        shown = ", ".join(f"{key} has {count}" for key, count in counts.items())
        mistakes.add(("vary",), f"zip needs as many values of each key: {shown}")
    elif sampling.kind == "zip":
        rows = [str(row) for row in paired(choices)]
        if len(set(rows)) < len(rows):
            mistakes.add(("vary",), "two runs of the zip have the same values", "remove one")
    mistakes.raise_any()
    return SweepPlan(mistakes.document.text, template, choices, sampling, columns)


def _mistakes(raw: Any, sampling: Sampling) -> Iterator[tuple[str, str, KeyPath]]:
    """Mistakes of a list or range before the case sees it: problem, hint, path below."""
    is_random = sampling.is_random
    example = '{ from = "0.3 J/cm^2", to = "1 J/cm^2"' + (" }" if is_random else ", count = 8 }")
    if isinstance(raw, list):
        if is_random:
            yield "points are drawn from a range, not from a list", f"write e.g. {example}", ()
        elif not raw:
            yield "an empty list", "write at least one value", ()
        for number, value in enumerate(raw):
            if isinstance(value, list | dict):
                yield "a value must be a number, text with a unit or a word", "", (number,)
        return
    if not isinstance(raw, dict):
        yield "must be a list or a range", f"write e.g. [{as_toml(raw)}] or {example}", ()
        return
    # a range: its keys, its ends, its count, its scale
    for name in raw:
        if name not in RANGE_KEYS:
            near = did_you_mean(name, RANGE_KEYS).strip(" ()")
            yield f'unknown key "{name}"', near or f"write e.g. {example}", (name,)
    for name in ("from", "to", *(() if is_random else ("count",))):
        if name not in raw:
            yield f'misses "{name}"', f"write e.g. {example}", ()
    for name in ("from", "to"):
        if isinstance(raw.get(name), bool | list | dict):
            yield f'"{name}" must be a number or text with a unit', f"write e.g. {example}", (name,)
    if "count" in raw and is_random:
        yield "count is for grid and zip; points are drawn from this range", "remove it", ()
    elif "count" in raw and not (type(raw["count"]) is int and raw["count"] >= 2):
        yield "count must be a whole number of at least 2", "", ("count",)
    if raw.get("scale", "linear") not in ("linear", "log"):
        yield 'scale must be "linear" or "log"', "", ("scale",)


def _sampling_mistakes(
    sampling: Sampling, varied: list[Entry]
) -> Iterator[tuple[KeyPath, str, str]]:
    # a random sampling has a number of points, a grid has none
    wanted = NUMBERS.get(sampling.kind)
    if wanted and getattr(sampling, wanted) is None:
        yield ("sampling",), f"{sampling.kind} misses {wanted}", f"write e.g. {wanted} = 32"
    for name in ("runs", "trajectories"):
        if name != wanted and getattr(sampling, name) is not None:
            kinds = " and ".join(kind for kind, number in NUMBERS.items() if number == name)
            yield ("sampling", name), f"{name} is for {kinds}, not {sampling.kind}", ""
    # no more points than can be listed
    runs = (sampling.trajectories or 0) * (len(varied) + 1) or sampling.runs or 0
    if wanted and runs > MOST_RUNS:
        yield ("sampling", wanted), f"more than {MOST_RUNS} runs", "write fewer"
    counts = [
        len(raw) if isinstance(raw, list) else raw.get("count", 1)
        for _, _, raw in varied
        if isinstance(raw, list | dict)
    ]
    is_grid = sampling.kind == "grid" and all(type(count) is int for count in counts)
    if is_grid and prod(counts) > MOST_RUNS:
        yield ("vary",), f"{prod(counts)} runs, more than {MOST_RUNS}", "vary fewer values"


def _check_with_case(
    template: CaseTemplate,
    settings: list[Entry],
    varied: list[Entry],
    mistakes: Mistakes,
) -> None:
    """Try every value by itself: its key, unit and limits, not what contradicts other keys.

    Raises:
        CaseError: the case file itself is wrong.
    """
    # values to try: all of a list, both ends of a range
    ends = {
        key: [((n,), value) for n, value in enumerate(raw)]
        if isinstance(raw, list)
        else [((name,), raw[name]) for name in ("from", "to")]
        for key, _, raw in varied
    }
    places = {key: path for key, path, _ in [*settings, *varied]}
    # the first value of each key together, since keys may need each other
    firsts: dict[str, Value] = {key: values[0][1] for key, values in ends.items()}
    known = [as_override(key, value) for key, value in template.settings.items()]
    try:
        template.learn_kinds(firsts)
    except CaseError as error:
        own = list[Problem]()
        for one in error.problems:
            key = next((key for key in places if _concerns(one.key, key)), None)
            if key is None:
                own.append(one)
            elif key in template.settings:
                mistakes.add(places[key], one.problem, one.hint, key=key)
        if own and not mistakes.found:
            raise CaseError(own) from None
    # then each value with the first ones of the others
    for key, values in ends.items():
        others = [as_override(k, v) for k, v in firsts.items() if k != key]
        for below, value in values:
            try:
                template.file.contents([*known, *others, as_override(key, value)])
            except CaseError as error:
                one = next((p for p in error.problems if _concerns(p.key, key)), None)
                if one is not None:
                    hint = one.hint
                    if one.problem == "unknown key":  # plans write keys in full
                        table = key.rpartition(".")[0]
                        hint = re.sub(r'^(do you mean ")(\w+"\?)$', rf"\1{table}.\2", hint)
                    mistakes.add((*places[key], *below), one.problem, hint, key=key)


def _concerns(place: str, key: str) -> bool:
    """Whether a problem at `place` is about a key or about something in it."""
    present = dotted(present_place(steps_of(key)))
    return place == present or place.startswith((f"{present}.", f"{present}["))


def _range(
    template: CaseTemplate, key: str, raw: dict[str, Any], path: KeyPath, mistakes: Mistakes
) -> Range:
    # ends in SI, both numbers, different, and positive on a log scale
    first, last = (template.to_si(key, raw[name]) for name in ("from", "to"))
    scale = raw.get("scale", "linear")
    if isinstance(first, str) or isinstance(last, str):
        mistakes.add(path, "a range needs numbers", "write a list of values instead", key=key)
        return Range(0.0, 1.0)
    if first == last:
        mistakes.add(path, "from and to are the same", "write a list of one value instead", key=key)
    if scale == "log" and min(first, last) <= 0.0:
        problem = "a log scale needs from and to above 0"
        mistakes.add(path, problem, 'write scale = "linear"', key=key)
    is_whole = isinstance(first, int) and isinstance(last, int)
    return Range(float(first), float(last), raw.get("count", 0), scale, is_whole)
