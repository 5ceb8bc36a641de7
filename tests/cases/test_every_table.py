"""Every key of every table of a case changes what is computed, or is refused."""

from __future__ import annotations

from functools import cache

import pytest
from first_steps import FirstSteps, are_other_steps, steps_of
from key_trials import BASES, BOX, EJECTION, FILM, LIT, PROPERTIES, TRIALS, WORDS
from test_every_key import SAME_NUMBERS, VALUES

from lasersph.case import Case, load_case
from lasersph.input import CaseError

STEPS = 3
LATER = (
    "laser.pulse.count",
    "laser.pulse.period",
    "laser.pulse.repetition_rate",
    "laser.beam.shift",
)
"""Keys that say when, or what a second pulse does: seen after more steps, or those whose name ends
with `_wave.end` or `_bump.end`."""
MORE_STEPS = 300
BOILING_STEPS = 60
UNTRIED = {
    "schema_version": "the format of the file",
    "title": "for reports",
    "laser.spot.image": "a file; tests/unit/lasers/test_beam_image.py",
    "laser.spot.pixel_size": "of the image",
    "laser.spot.image_digest": "filled in",
    "laser.spot.shift": "`check` says the overlap of the pulses from it",
    "laser.spot.scan_speed": "`check` says the overlap of the pulses from it",
    "solver.dimensions": "chooses another domain",
    "solver.geometry": "chooses another domain; tests/laws/test_axisymmetric_heat.py",
    "laser.absorptivity.path": "a file; tests/unit/lasers/test_absorptivity.py",
    "laser.pulse.path": "a file; tests/unit/lasers/test_pulses.py",
    "solver.flow.initial.path": "a file; bad_flow_cases.py",
    "solver.flow.initial.rows": "filled in from the file",
    "solver.flow.initial_surface.path": "a file; tests/unit/boundaries",
    "solver.flow.initial_surface.rows": "filled in from the file",
    "solver.motion.y": "3-D; bad_ablation_cases.py",
    "solver.motion.hydrostatic": "needs gravity; test_every_key.py",
    "solver.motion.amplitude": "of the shipped sound-wave",
    "solver.motion.waves": "of the shipped sound-wave",
    "probes": "what is observed; test_every_observation.py",
    "traces": "what is observed; test_every_observation.py",
    "output": "what is stored; test_every_observation.py",
}
"""Keys, and those below them, that are not tried here, each with what it does or where it is."""
ALIKE = {
    ("domain.width", "column"): "a column of a block that has it",
    ("domain.width", "column of matter"): "a column of a block that has it",
}
"""Keys that are taken and do nothing, each with the reason."""


def keys_of(node: dict, defs: dict, path: str = "") -> set[str]:
    """Every key below a part of a schema, those of lists with [], whatever the kind."""
    if "$ref" in node:
        return keys_of(defs[node["$ref"].rpartition("/")[2]], defs, path)
    found = set()
    for choice in (*node.get("anyOf", ()), *node.get("oneOf", ()), *node.get("allOf", ())):
        found |= keys_of(choice, defs, path)
    if isinstance(node.get("items"), dict):
        found |= keys_of(node["items"], defs, f"{path}[]")
    for name, part in node.get("properties", {}).items():
        key = f"{path}.{name}" if path else name
        below = keys_of(part, defs, key)
        found |= below or {key}
    return found


def all_keys() -> set[str]:
    """Of the schema, without the words that choose a kind."""
    schema = Case.model_json_schema()
    return {key for key in keys_of(schema, schema["$defs"]) if not key.endswith(".kind")}


def is_under(key: str, tables) -> bool:
    """Whether a key is one of the tables, or below one."""
    return any(key == one or key.startswith((f"{one}.", f"{one}[")) for one in tables)


def test_every_key_has_a_trial():
    """A new key cannot be forgotten."""
    known = {*VALUES, *SAME_NUMBERS, *TRIALS}
    known |= {f"solver.ejection.{key}" for key in EJECTION}
    known |= {f"material.{key}" for key in PROPERTIES}
    untried = {
        key
        for key in all_keys() - known
        if not is_under(key, UNTRIED) and not is_under(key, SAME_NUMBERS)
        if not (key.startswith("material.") and key.rpartition(".")[2] in WORDS)
    }
    assert not untried
    assert not (set(UNTRIED) & known), "tried after all"


@pytest.fixture(scope="module")
def bases(tmp_path_factory) -> dict:
    """File and settings of each small case."""
    file = tmp_path_factory.mktemp("case") / "case.toml"
    file.write_text(LIT, encoding="utf-8")
    lit = {label: (str(file), settings) for label, settings in BASES.items()}
    return lit | {"box": ("natural-convection", BOX), "film": ("moving-film", FILM)}


@cache
def loaded(name: str, settings: tuple[str, ...]) -> Case | None:
    """A small case with settings, None where it is refused: most keys are tried beside the same."""
    try:
        return load_case(name, settings)
    except CaseError:
        return None


def outcome(base, key: str, trial, steps: int) -> bool | None:
    """Whether a value changes what is computed; None where it, or what is beside it, is refused."""
    (name, settings), (value, beside) = base, trial
    around = (*settings, *beside)
    plain = loaded(name, around)
    if plain is None:
        return None
    changed = loaded(name, (*around, f"{key.replace('[]', '[1]')}={value}"))
    if changed is None or plain.hash() == changed.hash():
        return None
    return are_other_steps(steps_of(name, around), FirstSteps(changed), steps)


def is_tried_in(label: str, key: str) -> bool:
    """Whether a key is tried in a small case: what acts on a surface of melt where there is some
    from the start, and what is not of a flow under light."""
    if "_wave" in key or "_bump" in key:
        return label == "film"
    return label not in ("box", "film") or key.startswith("solver.flow")


@pytest.mark.parametrize("key", TRIALS)
def test_a_key_changes_something_or_is_refused(key, bases):
    """In each small case that takes it, and some case takes it."""
    steps = MORE_STEPS if key in LATER or key.endswith(("_wave.end", "_bump.end")) else STEPS
    found = {
        (label, *trial): outcome(base, key, trial, steps)
        for label, base in bases.items()
        if (key, label) not in ALIKE and is_tried_in(label, key)
        for trial in TRIALS[key]
    }
    assert [one for one, changes in found.items() if changes is False] == []
    assert True in found.values(), f"{key} is never taken with these values"


@pytest.mark.parametrize("key", PROPERTIES)
def test_a_property_of_a_metal_changes_what_is_computed(key, bases):
    """In a case that needs it: a metal knows more than every case asks for."""
    label, value, beside = PROPERTIES[key]
    steps = BOILING_STEPS if label == "pool" else STEPS
    assert outcome(bases[label], f"material.{key}", (value, beside), steps)


@pytest.mark.parametrize("key", EJECTION)
def test_a_key_of_ejection_changes_what_is_computed(key, bases):
    """Once matter boils."""
    plain, changed = (
        f"{{ {one} }}" if key == "model" else f"{{ model = 'published', {one} }}"
        for one in EJECTION[key]
    )
    given = ("laser.fluence=10 J/cm^2", "particles.spacing=0.05 um", f"solver.ejection={plain}")
    assert outcome(bases["column of matter"], "solver.ejection", (changed, given), MORE_STEPS)
