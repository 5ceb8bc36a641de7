"""Models: types of quantities, unknown keys, pydantic's errors in one line each."""

from typing import Annotated, Literal

import numpy
import pytest
from pydantic import Field, ValidationError, model_validator

from lasersph.input import (
    CaseError,
    Count,
    Fluence,
    Fraction,
    Length,
    Model,
    Temperature,
    build,
    parse_toml,
)


class Flat(Model):
    """A beam without settings."""

    kind: Literal["flat"] = "flat"


class Spot(Model):
    """A beam with a size."""

    kind: Literal["spot"] = "spot"
    radius: Annotated[Length, Field(gt=0)]


class Light(Model):
    """Everything that a field can be."""

    fluence: Annotated[Fluence, Field(gt=0)]
    beam: Annotated[Flat | Spot, Field(discriminator="kind")] = Flat()
    mode: Literal["mean", "peak"] = "mean"
    count: Count = 1
    share: Annotated[Fraction, Field(ge=0, le=1)] = 0.5
    position: tuple[Length, ...] = ()
    hot: Temperature = 300.0

    @model_validator(mode="after")
    def _check(self):
        if self.count > 5:
            raise ValueError("too many pulses; write at most 5")
        return self


class Root(Model):
    """The document."""

    light: Light


GOOD = 'fluence = "1 J/m2"\n'
MESSAGES = [
    ("", 'x.toml:1: light.fluence: missing; write fluence = "0.6 J/cm^2"'),
    ("fluence = 3", 'x.toml:2: light.fluence: 3 has no unit; write e.g. "0.6 J/cm^2"'),
    ("fluence = true", 'x.toml:2: light.fluence: true is not a fluence; write e.g. "0.6 J/cm^2"'),
    ("fluence = []", 'x.toml:2: light.fluence: is not a fluence; write e.g. "0.6 J/cm^2"'),
    (
        "fluence = nan",
        'x.toml:2: light.fluence: nan is not a finite number; write e.g. "0.6 J/cm^2"',
    ),
    (
        'fluence = "-1 J/m2"',
        'x.toml:2: light.fluence: must be greater than 0, got "-1 J/m2"',
    ),
    (
        'fluense = "1 J/m2"',
        'x.toml:2: light.fluense: unknown key; do you mean "fluence"?',
    ),
    (
        GOOD + "zzz = 1",
        "x.toml:3: light.zzz: unknown key; known here: fluence, beam, mode, count, share, "
        "position, hot",
    ),
    (
        GOOD + 'mode = "meen"',
        'x.toml:3: light.mode: must be "mean" or "peak", got "meen"; do you mean "mean"?',
    ),
    (
        GOOD + 'beam = { kind = "spott", radius = "1 m" }',
        'x.toml:3: light.beam.kind: must be "flat" or "spot", got "spott"; do you mean "spot"?',
    ),
    (GOOD + "beam = {}", 'x.toml:3: light.beam.kind: missing; write kind = "flat"'),
    (
        GOOD + 'beam = { kind = "spot" }',
        'x.toml:3: light.beam.radius: missing; write radius = "8 nm"',
    ),
    (
        GOOD + '[light.beam]\nkind = "spot"\nradius = "0 m"',
        'x.toml:5: light.beam.radius: must be greater than 0, got "0 m"',
    ),
    (GOOD + "count = 0", "x.toml:3: light.count: must be at least 1, got 0"),
    (GOOD + "count = true", "x.toml:3: light.count: must be a whole number, got true"),
    (GOOD + "count = 2.5", "x.toml:3: light.count: must be a whole number, got 2.5"),
    (GOOD + "count = 9", "x.toml:1: light: too many pulses; write at most 5"),
    (GOOD + 'share = "150 %"', 'x.toml:3: light.share: must be at most 1, got "150 %"'),
    (GOOD + "position = 3", "x.toml:3: light.position: must be an array [...], got 3"),
    (
        GOOD + 'position = ["1 m",\n"2 K"]',
        'x.toml:4: light.position[2]: "2 K" is a temperature, not a length; write e.g. "8 nm"',
    ),
    (
        GOOD + 'hot = "-300 degC"',
        'x.toml:3: light.hot: "-300 degC" is below absolute zero',
    ),
]


@pytest.mark.parametrize(("body", "message"), MESSAGES, ids=[body[-25:] for body, _ in MESSAGES])
def test_one_line_per_problem(body, message):
    """Each mistake gives exactly one line: file, line, key, what is wrong, what would be right."""
    with pytest.raises(CaseError) as error:
        build(Root, parse_toml("[light]\n" + body, "x.toml"))
    assert str(error.value) == message


def test_all_problems_at_once():
    """Independent mistakes are reported together, in the order of the file."""
    with pytest.raises(CaseError) as error:
        build(Root, parse_toml('[light]\ncount = 0\nfluence = 3\nshare = "2 m"', "x.toml"))
    assert [problem.line for problem in error.value.problems] == [2, 3, 4]
    assert error.value.key == "light.count"


def test_what_hides_behind_another_mistake():
    """An unknown key, a wrong value behind it, and what the model says of both together."""
    text = '[light]\ncount = 9\nfluense = 3\nmode = "peek"\nlight.share = 2'
    with pytest.raises(CaseError) as error:
        build(
            Root, parse_toml(text, "x.toml"), None, lambda: {"light": "; leave it out: it is here"}
        )
    assert str(error.value).splitlines() == [
        "x.toml:1: light: too many pulses; write at most 5",
        'x.toml:3: light.fluense: unknown key; do you mean "fluence"?',
        'x.toml:3: light.fluence: 3 has no unit; write e.g. "0.6 J/cm^2"',
        'x.toml:4: light.mode: must be "mean" or "peak", got "peek"; do you mean "peak"?',
        "x.toml:5: light.light: unknown key; leave it out: it is here",
    ]


def test_table_instead_of_value():
    """A number where a table belongs is said so."""
    with pytest.raises(CaseError, match=r"x.toml:1: light: must be a table, got 3"):
        build(Root, parse_toml("light = 3", "x.toml"))


def test_python_numbers_are_si():
    """From Python, bare numbers are SI, text with units works, NaN and bool do not."""
    assert Light(fluence=6000).fluence == 6000.0
    assert Light(fluence=numpy.float32(2.0)).fluence == 2.0
    assert Light(fluence="0.6 J/cm^2").fluence == 6000.0  # pyright: ignore[reportArgumentType]
    for bad in (float("nan"), float("inf"), True, 10**400, None):
        with pytest.raises(ValidationError):
            Light(fluence=bad)  # pyright: ignore[reportArgumentType]


def test_models_are_frozen():
    """What the solver uses is what was read."""
    light = Light(fluence=1.0)
    with pytest.raises(ValidationError, match="frozen"):
        light.fluence = 2.0  # pyright: ignore[reportAttributeAccessIssue]


def test_schema_asks_for_text_with_units():
    """JSON Schema: quantities are strings with their kind, fractions may be numbers."""
    properties = Light.model_json_schema()["properties"]
    assert properties["fluence"]["type"] == "string"
    assert properties["fluence"]["x-kind"] == "fluence"
    assert {"type": "number"} in properties["share"]["anyOf"]
