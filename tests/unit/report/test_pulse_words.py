"""What a report and a terminal say of trains of pulses, probes and cases that only warm."""

from types import SimpleNamespace

import pytest

from lasersph.observers.quantity import MOMENT
from lasersph.report.headline import effects_of
from lasersph.report.summary_text import verdict
from lasersph.report.tables import main_numbers, moment

PULSES = {
    "count": 3,
    "period_s": 1e-4,
    "starts_s": [0.0, 1e-4, 2e-4],
    "melt_starts_s": [15e-9, 1e-4 + 15e-9, 2e-4 + 14e-9],
    "melt_ends_s": [41e-9, 1e-4 + 42e-9, 2e-4 + 42e-9],
    "boiling_starts_s": [None, 1e-4 + 18e-9, None],
    "boiling_ends_s": [None, 1e-4 + 28e-9, None],
}
MELT = {
    "start_s": 15e-9, "end_s": 2e-4 + 42e-9, "molten_at_end": False, "depth_max_m": 7e-7,
    "depth_max_at_s": 1e-4 + 29.3e-9, "width_max_m": 0.0, "width_max_at_s": None,
}  # fmt: skip
VAPOR = {
    "start_s": 1e-4 + 18e-9, "end_s": 1e-4 + 28e-9, "evaporated_thickness_max_m": 9.834e-10,
}  # fmt: skip
ENERGY = {"absorbed_J": 0.1, "stored_J": 0.1, "lost_J": 0.0, "imbalance_relative": 1e-9}
TRAIN = {
    "dimensions": 2, "temperature_max_K": 3000.0, "temperature_max_at_s": 2e-4 + 20e-9,
    "pulses": PULSES, "melt": MELT, "vaporization": VAPOR, "energy": ENERGY,
}  # fmt: skip


def test_times_of_a_train_say_which_pulse_they_follow():
    """Each pulse has its own clock, which begins with its period."""
    assert moment(TRAIN, 2e-4 + 29.3e-9) == "pulse 3 + 29.3 ns"
    assert moment(TRAIN, 1e-4) == "pulse 2 + 0 s"
    assert moment(TRAIN, 5e-9) == "pulse 1 + 5 ns"
    assert moment({}, 5e-9) == "5 ns"
    assert dict(main_numbers(TRAIN))["largest depth of completely fluid metal (f_m = 1)"] == (
        "700 nm at pulse 2 + 29.3 ns"
    )


def test_verdict_of_a_train():
    """Melt and boiling have a life after each pulse, not one over all pauses."""
    text = verdict(TRAIN)
    assert "at most 3 000 K, at pulse 3 + 20 ns." in text
    assert "fluid metal was there after each of 3 pulses, for 26 ns to 28 ns." in text
    assert "at most 700 nm deep (at pulse 2 + 29.3 ns)" in text
    assert "temperature or above after 1 of 3 pulses, for 10 ns; up to 0.98 nm evaporated." in text
    assert "200 µs" not in text


@pytest.mark.parametrize(
    ("key", "is_moment"),
    [
        ("melt.start_any_s", True),
        ("melt.depth_max_at_s", True),
        ("flow.extrema.inner_end_s", True),
        ("time_s", True),
        ("flow.extrema.inner_lasted_s", False),
        ("time_step.min_s", False),
        ("flow.surface_speed_max_m_s", False),
        ("pulses.period_s", False),
    ],
)
def test_keys_of_times_and_of_lengths_of_time(key, is_moment):
    """Only times that count from the start of the run follow a pulse."""
    assert bool(MOMENT.fullmatch(key)) == is_moment


def test_probes_are_among_the_main_numbers():
    """A reader finds the temperature of a probe without opening a figure."""
    probes = {"center": {"temperature_max_K": 800.0, "temperature_max_at_s": 2e-6}}
    found = dict(main_numbers({"dimensions": 3, "probes": probes}))
    assert found == {"largest temperature at probe center": "800 K at 2 us"}


@pytest.mark.parametrize(
    ("kind", "summary", "words"),
    [
        ("conduction", {"material": {"solidus_K": None}}, "heating"),
        ("conduction", {"material": {"solidus_K": 900.0}}, "heating and melting"),
        ("melt-pool", {"material": {"solidus_K": 900.0}}, "heating, melting and flow"),
        ("melt-pool", {"box": {}}, "flow"),
        ("ablation", {}, "flow"),
    ],
)
def test_heat_alone_is_not_said_to_flow(kind, summary, words):
    """The words for a run follow from its solver and from what could happen."""
    run = SimpleNamespace(summary=summary, case={"solver": {"kind": kind}})
    assert effects_of(run) == words
