"""Plans of calibrations: TOML files that say what was measured and what of the case is unknown.

    case = "dlip-steel"
    [set]                                # of every run
    "solver.kind" = "conduction"
    [unknown]
    factor = { scales = "laser.fluence", between = [0.7, 1.6] }
    fwhm = { key = "laser.pulse.fwhm", between = ["8 ns", "12 ns"], known = "10 +- 0.5 ns" }
    [[measured]]
    set = { "laser.fluence" = "0.6 J/cm^2" }
    values = { "melt.width_half_max_m" = "2.9 +- 0.1 um" }
    profile = { file = "line.csv", error = "5 nm", scale_error = "1 %" }    # of a moving surface
    [runs]
    first = 8
    most = 32

An unknown is a key of the case, a factor that `scales` a key, or `complements` a key: 1 less the
key, such as the absorptivity of laser.reflectivity.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from os import PathLike
from pathlib import Path
from typing import Any, Literal

from pydantic import BaseModel, Field

from lasersph.case.contents import CaseContents
from lasersph.input import (
    CaseError,
    Document,
    Model,
    QuantityError,
    build,
    parse_quantity,
)
from lasersph.output import OutputError
from lasersph.studies.calibration_plan import (
    CalibrationBudget,
    CalibrationPlan,
    Condition,
    Relation,
    Unknown,
)
from lasersph.studies.calibration_spot import SpotCells
from lasersph.studies.calibration_target import ProfileEntry, read_target
from lasersph.studies.measured_value import kind_of_number, read_measured
from lasersph.studies.texture.measurement import NoComparison
from lasersph.studies.texture.spot import NoTexture
from lasersph.sweeps import CaseTemplate
from lasersph.sweeps.plan_reading import (
    KeyPath,
    Mistakes,
    entries_of,
    read_plan_file,
    read_template,
    refuse_twice,
)
from lasersph.sweeps.points import find_key


class UnknownEntry(Model):
    """An unknown: one of key, scales and complements."""

    key: str | None = None
    scales: str | None = None
    complements: str | None = None
    between: tuple[float | str, float | str] = Field(examples=[[0.7, 1.6]])
    known: str | None = None


class MeasuredEntry(Model):
    """A measurement at some settings."""

    set: dict[str, Any] = Field(default_factory=dict)
    values: dict[str, str] = Field(default_factory=dict)
    profile: ProfileEntry | None = None


class PlanEntry(Model):
    """The keys of a plan, not yet compared with the case."""

    schema_version: Literal[1] = 1
    case: str = Field(examples=["dlip-steel"])
    set: dict[str, Any] = Field(default_factory=dict)
    unknown: dict[str, UnknownEntry]
    measured: tuple[MeasuredEntry, ...]
    runs: CalibrationBudget = CalibrationBudget()


def read_calibration_plan(file: str | PathLike[str]) -> CalibrationPlan:
    """Read the plan of a calibration.

    Raises:
        CaseError: every mistake of the plan, or of its case, in one line with file and line.
    """
    document = read_plan_file(file, "calibrate")
    return _Reader(document, build(PlanEntry, document)).plan()


class _Reader:
    """Compares a plan with its case."""

    def __init__(self, document: Document, entry: PlanEntry) -> None:
        self.entry, self.mistakes = entry, Mistakes(document)
        self.template = read_template(self.mistakes, entry.case, self._settings(entry.set, "set"))

    def plan(self) -> CalibrationPlan:
        """The plan. Raises CaseError."""
        entry = self.entry
        # keys and settings by themselves, then what the case says of them
        sets = [
            self._settings(one.set, "measured", number, "set")
            for number, one in enumerate(entry.measured)
        ]
        self._check_unknowns(sets)
        self.mistakes.raise_any()
        contents = self.template.file.contents(self.template.overrides({}))
        self._learn_kinds(sets)
        # values in SI, by the kinds that the case has
        unknowns = tuple(self._unknown(name, one) for name, one in entry.unknown.items())
        conditions = [self._condition(number, one, contents) for number, one in enumerate(sets)]
        self.mistakes.raise_any()
        self._complete(conditions, unknowns, contents)
        # data against unknowns
        count = sum(len(one.values) for one in conditions)
        free = [one for one in unknowns if one.known is None]
        if count < len(free) and all(one.profile is None for one in conditions):
            self.mistakes.add(
                ("unknown",),
                f"{len(free)} unknowns need at least as many measured values, not {count}",
                'measure more, or say what is known, e.g. known = "10 +- 0.5 ns"',
            )
        self.mistakes.raise_any()

        # keys with one value everywhere belong to the template, the others vary from run to run
        touched = {one.key for one in unknowns}
        every = dict.fromkeys(key for one in conditions for key in one.settings)
        seen = {key: {one.settings[key] for one in conditions} for key in every}
        same = {
            key: values.pop()
            for key, values in seen.items()
            if key not in touched and len(values) == 1
        }
        shared = {
            key: f"{value!r} {self.template.unit(key)}".strip() for key, value in same.items()
        }
        fixed = CaseTemplate(self.template.name, {**self.template.settings, **shared})
        for _, values in self._trials(sets):
            fixed.learn_kinds(values)
        units = {key: self.template.unit(key) for key in (*every, *touched) if key not in same}
        # enough runs for an emulator, and bounds that the case takes
        plan = CalibrationPlan(
            self.mistakes.document.text, fixed, unknowns, tuple(conditions), dict(units), entry.runs
        )
        entry.runs.refuse_too_few(len(units), self.mistakes)
        self._check_box(plan)
        self.mistakes.raise_any()
        return self._with_spot(plan, contents)

    def _with_spot(self, plan: CalibrationPlan, contents: CaseContents) -> CalibrationPlan:
        """The plan with the cells of its spots, where the case has a spot that was measured."""
        measured = [number for number, one in enumerate(plan.conditions) if one.profile]
        has_spot = contents.laser is not None and contents.laser.spot is not None
        if not measured or not has_spot or contents.geometry.is_axisymmetric:
            if "cells" in self.entry.runs.model_fields_set:
                self.mistakes.add(
                    ("runs", "cells"),
                    "says of how many cells a spot is assembled, and no spot is measured",
                    "remove it, or give the case laser.spot and a measurement its profile",
                )
                self.mistakes.raise_any()
            return plan
        # the middle of the box has to melt something
        low, high = (dict(zip(plan.keys, ends.tolist(), strict=True)) for ends in plan.box())
        spot = SpotCells(plan.template, plan.units, low, high, plan.runs.cells)
        for number, one in enumerate(plan.conditions):
            if one.values:
                self.mistakes.add(
                    ("measured", number, "values"),
                    "a spot that is assembled from cells has no such number",
                    "leave values out, or laser.spot",
                )
        self.mistakes.raise_any()
        try:
            spot.points({key: 0.5 * (low[key] + high[key]) for key in plan.keys})
        except (NoTexture, CaseError) as error:
            self.mistakes.add(("measured", measured[0], "profile"), str(error))
        self.mistakes.raise_any()
        return replace(plan, spot=spot)

    def _settings(self, table: Mapping[str, Any], *path: str | int) -> dict[str, Any]:
        """Settings by key of the case."""
        entries = entries_of(table, path)
        refuse_twice(self.mistakes, entries)
        return {key: raw for key, _, raw in entries}

    def _check_unknowns(self, sets: list[dict[str, Any]]) -> None:
        """Check without the case how unknowns and settings name their keys."""
        # by key: the unknown that sets it
        owners: dict[str, str] = {}
        if not self.entry.unknown:
            self.mistakes.add(
                ("unknown",),
                "nothing is unknown",
                'write e.g. factor = { scales = "laser.fluence", between = [0.7, 1.6] }',
            )
        if not self.entry.measured:
            self.mistakes.add((), "nothing is measured", "write a [[measured]] table")
        for name, one in self.entry.unknown.items():
            path = ("unknown", name)
            named = [key for key in (one.key, one.scales, one.complements) if key is not None]
            if len(named) != 1:
                self.mistakes.add(
                    path,
                    "needs one of key, scales and complements",
                    'write e.g. scales = "laser.fluence"',
                )
                continue
            if one.scales is None:
                if named[0] in owners:
                    self.mistakes.add(
                        path,
                        f"{named[0]} is unknown twice, by {owners[named[0]]} as well",
                        "remove one",
                    )
                owners[named[0]] = name
                if named[0] in self.template.settings:
                    self.mistakes.add(path, f"{named[0]} is given in [set] as well", "remove one")
        # each measurement has a value or a profile, and sets no key that is unknown or common
        for number, settings in enumerate(sets):
            if not self.entry.measured[number].values and not self.entry.measured[number].profile:
                self.mistakes.add(
                    ("measured", number),
                    "nothing is measured here",
                    'write e.g. values = { "melt.depth_max_m" = "200 +- 20 nm" }',
                )
            for key in settings:
                if key in owners or key in self.template.settings:
                    other = f"unknown ({owners[key]})" if key in owners else "given in [set]"
                    self.mistakes.add(
                        ("measured", number, "set"), f"{key} is {other} as well", "remove one"
                    )
        for name, one in self.entry.unknown.items():
            if one.scales in owners:
                self.mistakes.add(
                    ("unknown", name),
                    f"{one.scales} is unknown itself, by {owners[one.scales]}",
                    "remove one",
                )

    def _trials(self, sets: list[dict[str, Any]]) -> list[tuple[KeyPath, dict[str, Any]]]:
        """A value of each key that the plan gives, and where."""
        # settings of measurements, then both ends of each unknown
        trials: list[tuple[KeyPath, dict[str, Any]]] = [
            (("measured", number, "set", key), {key: value})
            for number, settings in enumerate(sets)
            for key, value in settings.items()
        ]
        for name, one in self.entry.unknown.items():
            key = one.key or one.complements
            for value in one.between if key else ():
                if key == one.complements:
                    value = 1.0 - value if isinstance(value, float) else value
                trials.append((("unknown", name), {str(key): value}))
        return trials

    def _learn_kinds(self, sets: list[dict[str, Any]]) -> None:
        """Learn which quantity each key reads; what the case refuses is said here."""
        for path, values in self._trials(sets):
            try:
                self.template.learn_kinds(values)
            except CaseError as error:
                first = error.problems[0]
                self.mistakes.add(path, f"{first.key}: {first.problem}", first.hint)
        self.mistakes.raise_any()

    def _unknown(self, name: str, one: UnknownEntry) -> Unknown:
        # an unknown that is a key has its unit; a factor and a complement have none
        relation: Relation = "key" if one.key else "scales" if one.scales else "complements"
        key = one.key or one.scales or one.complements or ""
        kind = self.template.kind(key) if relation == "key" else ""
        path, ends, known = ("unknown", name), [0.0, 1.0], None
        try:
            ends = [self._end(value, kind) for value in one.between]
            known = None if one.known is None else read_measured(one.known, kind)
        except QuantityError as error:
            self.mistakes.add(path, str(error))
        else:
            between = (*path, "between")
            if not ends[1] > ends[0]:
                hint = "write the lower value first"
                self.mistakes.add(between, "the range has no width", hint)
            if relation == "scales" and not ends[0] > 0.0:
                self.mistakes.add(between, "a factor must be above zero")
            if known is not None and not ends[0] < known.value < ends[1]:
                problem = "what is known lies outside of between"
                self.mistakes.add((*path, "known"), problem, "widen the range")
        unit = self.template.unit(key) if relation == "key" else ""
        return Unknown(name, key, relation, ends[0], ends[1], unit, known)

    @staticmethod
    def _end(value: float | str, kind: str) -> float:
        if isinstance(value, str):
            return parse_quantity(value, kind or "fraction")
        if kind not in ("", "fraction"):
            raise QuantityError(f"{value} has no unit; write between as text with units")
        return float(value)

    def _condition(
        self, number: int, settings: dict[str, Any], contents: CaseContents
    ) -> Condition:
        values, read = {}, {}
        # values in SI; a word cannot vary between runs that are emulated
        for key, value in settings.items():
            si = self.template.to_si(key, value)
            if isinstance(si, bool) or not isinstance(si, int | float):
                self.mistakes.add(
                    ("measured", number, "set", key), "must be a number", "write words in [set]"
                )
                continue
            read[key] = float(si)
        for column, text in self.entry.measured[number].values.items():
            try:
                values[column] = read_measured(text, kind_of_number(column))
                if column.startswith("melt.") and values[column].value < 0.0:
                    raise QuantityError(f'"{text}" is below zero, which nothing of a melt is')
            except QuantityError as error:
                self.mistakes.add(("measured", number, "values", column), str(error))
        profile, target = self.entry.measured[number].profile, None
        if profile is not None:
            try:
                target = read_target(profile, Path(self.mistakes.document.file).parent, contents)
            except (NoComparison, NoTexture, OutputError) as error:
                self.mistakes.add(("measured", number, "profile"), str(error))
        return Condition(read, values, target)

    def _complete(
        self, conditions: list[Condition], unknowns: tuple[Unknown, ...], contents: BaseModel
    ) -> None:
        """Give every condition a value of each key that another one sets or a factor scales."""
        # keys that some measurement sets or a factor scales: the others take the case's number
        scaled = {one.key: one.name for one in unknowns if one.relation == "scales"}
        wanted = dict.fromkeys([*(key for one in conditions for key in one.settings), *scaled])
        nominal: dict[str, float | None] = {}
        for key in wanted:
            try:
                found, _ = find_key(contents, key)
            except QuantityError as error:
                self.mistakes.add(("unknown", scaled.get(key, "")), str(error))
                continue
            is_number = isinstance(found, int | float) and not isinstance(found, bool)
            nominal[key] = float(found) if is_number else None
        self.mistakes.raise_any()
        for number, one in enumerate(conditions):
            for key in wanted:
                if key in one.settings:
                    continue
                if nominal[key] is None:
                    path = ("unknown", scaled[key]) if key in scaled else ("measured", number)
                    self.mistakes.add(
                        path, f"the case gives no number at {key}", "set it in [[measured]]"
                    )
            known = {key: value for key, value in nominal.items() if value is not None}
            conditions[number] = replace(one, settings={**known, **one.settings})

    def _check_box(self, plan: CalibrationPlan) -> None:
        """Refuse bounds that lead out of what the case takes."""
        low, high = plan.box()
        middle = dict(zip(plan.keys, (0.5 * (low + high)).tolist(), strict=True))
        for number, key in enumerate(plan.keys):
            if not high[number] > low[number]:
                self.mistakes.add(("unknown",), f"nothing changes {key}", "remove it")
            for value in (low[number], high[number]):
                point = plan.template.point({**middle, key: float(value)})
                if point.reason:
                    name = next((one.name for one in plan.unknowns if one.key == key), "")
                    path: KeyPath = ("unknown", name) if name else ("measured",)
                    self.mistakes.add(
                        path,
                        f"reaches {key} = {value:.6g} {plan.units[key]}, which the case refuses: "
                        f"{point.reason}",
                    )
