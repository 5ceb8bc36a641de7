"""The measuring of the hot loops on a graphics card, or its simulator, with few particles."""

import pytest
from conftest import backends
from hot_loops import card, ceilings, solves
from hot_loops.table import as_dict, ceilings_line

pytestmark = pytest.mark.skipif("cuda" not in backends(), reason="no CUDA device or simulator")


def test_card_is_measured(monkeypatch):
    """Every loop of the table, with the card's name, bytes, floor and time."""
    for module, name in ((card, "ROUNDS"), (ceilings, "ROUNDS"), (ceilings, "LAUNCHES"),
                         (solves, "ITERATIONS")):  # fmt: skip
        monkeypatch.setattr(module, name, 1)
    found = []
    card.measure_card((16,), large=16, counted=100, report=found.append)
    limits, *loops = found
    assert limits.device and ceilings_line(limits).startswith(limits.device)
    names = {one.name for one in loops}
    assert {"pair sum 2-D", "pair sum 3-D", "neighbor list 3-D", "CG iteration"} <= names
    assert len(names) == len(loops) >= 11
    for one in loops:
        assert one.time > 0.0 and one.floor > 0.0 and one.least.traffic > 0.0, one.name
    assert as_dict([limits], loops)["ceilings"][0]["device"] == limits.device
