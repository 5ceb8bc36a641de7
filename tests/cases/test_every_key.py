"""Every key of a solver and of times changes what a case computes, or is refused."""

from __future__ import annotations

import pytest
from first_steps import FirstSteps, are_other_steps, steps_of

from lasersph.case import load_case
from lasersph.case.solver_choice import SETTINGS
from lasersph.input import CaseError
from lasersph.solvers.time_settings import TimeSettings

STEEL = (
    *("particles.spacing=200 nm", "particles.arrangement=uniform", "particles.coarsest="),
    *("particles.ratio=", "domain.depth=1.6 um", "domain.width=5 um", "probes="),
    *("laser.pulse={ kind = 'square', duration = '0.6 ns' }", "laser.fluence=2 J/cm^2"),
    *("laser.beam.period=5 um", "time.end=4 ns", "time.step=0.2 ns"),
    "initial_temperature=1600 K",
)
FAINT = ("laser.fluence=0.01 J/cm^2", "time.growth=10")
"""So that steps soon are as long as allowed, and the light is over."""
BASES: dict[str, list[tuple[str, tuple[str, ...]]]] = {
    "conduction": [
        ("dlip-steel", (*STEEL, "solver.kind=conduction")),
        ("dlip-steel", (*STEEL, *FAINT, "solver.kind=conduction")),
    ],
    "conduction, explicit": [
        (
            "dlip-steel",
            (
                *(*STEEL, "solver.kind=conduction", "solver.scheme=explicit"),
                "laser.fluence=0.3 J/cm^2",
            ),
        ),
        ("pulsed-heating", ("particles.spacing=5 um", "probes=")),
    ],
    "melt-pool": [
        ("dlip-steel", STEEL),
        ("dlip-steel", (*STEEL, *FAINT)),
        ("texture-steel", STEEL),
        ("moving-film", ("particles.spacing=40 nm",)),
        ("natural-convection", ("particles.spacing=100 mm",)),
    ],
    "ablation": [
        (
            "ablation-aluminium",
            (
                *("particles.spacing=1 um", "domain.depth=6 um", "solver.dimensions=2"),
                *(
                    "domain.width=8 um",
                    "domain.extent=full",
                    "initial_temperature=900 K",
                    "probes=",
                    "traces=",
                ),
            ),
        ),
        ("dam-break", ("particles.spacing=10 mm",)),
    ],
}
"""Small cases of each solver by name and settings; a key has to change one of them."""
STEPS = 14
VALUES: dict[str, tuple[str, ...]] = {
    "solver.plateau": ("clip", "evaporate"),
    "solver.vaporization": ("flux", "plateau"),
    "solver.phase_change": ("false",),
    "solver.weights": ("plain",),
    "solver.tolerance": ("9e-3",),
    "solver.heat": ("two-temperature",),
    "solver.step_error": ("0.001",),
    "solver.equal_within": ("0.02",),
    "solver.scheme": ("explicit", "implicit"),
    "solver.iteration": ("published",),
    "solver.marangoni": ("false",),
    "solver.pressure": ("published",),
    "solver.pressure_tolerance": ("0.1",),
    "solver.viscosity": ("explicit",),
    "solver.step_limits": ("published",),
    "solver.frame": ("eulerian",),
    "solver.shifting": ("0.4",),
    "solver.gravity": ("1e6 m/s^2",),
    "solver.steady": ("0.9",),
    "solver.flow": ("{ surface = 'moving' }",),
    "solver.sound_speed": ("500 m/s",),
    "solver.viscosity_solid": ("0.5",),
    "solver.viscosity_liquid": ("2",),
    "solver.tension": ("true",),
    "solver.courant_number": ("0.1",),
    "solver.skin": ("1",),
    "solver.active_region": ("false",),
    "solver.ejecta_height": ("1 um",),
    "solver.vessel": ("{ left = '0.5 m' }", "{ left = '5 um' }"),
    "solver.motion": ("{ kind = 'rest', hydrostatic = true }",),
    "solver.ejection": ("{ model = 'published' }",),
    "time.end": ("0.3 ns",),
    "time.step": ("0.05 ns",),
    "time.is_fixed": ("true",),
    "time.temperature_change": ("0.01 K",),
    "time.cooling": ("1",),
    "time.growth": ("1.01",),
    "time.pause": ("spread",),
}
"""Values of each key, of which one has to matter."""
SAME_NUMBERS = {
    "solver.steady": "ends a run early, after many steps",
    "solver.skin": "how often neighbors are searched; the same neighbors count",
    "solver.active_region": "what is computed at all; what waits is at rest",
    "solver.ejecta_height": "where ejecta are given up, which takes many steps",
}
"""Keys that no number of the first steps follows, each with what it does."""
ALLOWS = {("melt-pool", "solver.phase_change"), ("ablation", "solver.phase_change")}
"""Keys that make a case right which would be refused: a box of a metal that melts, matter that
leaves by the published rule. What melts is refused with another value."""
CHOSEN = ("kind", "dimensions", "geometry")
"""Keys that make another solver or another domain of a case."""


def keys_of(kind: str) -> list[str]:
    """Keys of the solver of some cases, and those of times."""
    (settings,) = (one for one in SETTINGS if one.model_fields["kind"].default == kind)
    own = [f"solver.{name}" for name in settings.model_fields if name not in CHOSEN]
    return [*own, *(f"time.{name}" for name in TimeSettings.model_fields)]


EVERY = [
    (label, key)
    for label in BASES
    for key in keys_of(label.split(",")[0])
    if key not in SAME_NUMBERS and (label, key) not in ALLOWS
]


@pytest.mark.parametrize(("label", "key"), EVERY)
def test_a_key_changes_something_or_is_refused(label, key):
    """With one of its values the first steps of a small case differ, or no case takes it."""
    outcomes = set()
    for value in VALUES[key]:
        for name, settings in BASES[label]:
            changed = (*settings, f"{key}={value}")
            try:
                if load_case(name, changed).hash() == load_case(name, settings).hash():
                    continue
                other = FirstSteps(load_case(name, changed))
                outcomes.add(are_other_steps(steps_of(name, settings), other, STEPS))
            except CaseError:
                outcomes.add(None)
            if True in outcomes:
                return
    assert outcomes == {None}, f"{key} is taken and does nothing"


def test_keys_without_numbers_of_their_own_are_keys():
    """The list of them holds no key that is gone."""
    assert set(SAME_NUMBERS) <= {key for label in BASES for key in keys_of(label.split(",")[0])}
