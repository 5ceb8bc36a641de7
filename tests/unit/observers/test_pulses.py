"""The life of melt and boiling after each pulse, from made-up views."""

from types import SimpleNamespace

import numpy as np

from lasersph.observers.pulses import Pulses


def view_at(time, fraction, temperature):
    """Two particles, the first at the surface; the metal boils at 3000 K."""
    return SimpleNamespace(
        time=time, melt_fraction=np.array([fraction, 0.0]), ablation=None, vaporization=3000.0,
        temperature=np.array([temperature, 300.0]), surface=np.array([0]),
    )  # fmt: skip


def test_each_pulse_has_its_own_life():
    """Melt of the first pulse from 2 to 3, of the second, which boils, from 12 to 14, no third."""
    observer, restored = (Pulses(4, 10.0, (0.0, 10.0, 20.0)) for _ in range(2))
    states = [(0, 0, 300), (2, 1, 2000), (3, 1, 1800), (4, 0.5, 1700), (10, 0, 300),
              (12, 1, 3000), (14, 1, 2000), (20, 0, 300), (22, 0.9, 1700)]  # fmt: skip
    for time, fraction, temperature in states[:3]:
        observer.observe(view_at(float(time), fraction, temperature))
    restored.restore(observer.state())
    for time, fraction, temperature in states[3:]:
        restored.observe(view_at(float(time), fraction, temperature))
    found = restored.summary()["pulses"]
    assert (found["count"], found["period_s"], found["starts_s"]) == (4, 10.0, [0.0, 10.0, 20.0])
    assert found["melt_starts_s"] == [2.0, 12.0, None]
    assert found["melt_ends_s"] == [3.0, 14.0, None]
    assert found["boiling_starts_s"] == [None, 12.0, None]
    assert found["boiling_ends_s"] == [None, 12.0, None]
