"""Layers of a case, and the estimate of the heat that they follow from."""

import pytest

from lasersph.case import load_case
from lasersph.simulation import layers
from lasersph.simulation.heating import estimate_with_vapor


@pytest.fixture
def counted(monkeypatch):
    """Estimates that were computed."""
    made, compute = [], layers.melt_depth

    def counting(**given):
        made.append(given["vapor"])
        return compute(**given)

    monkeypatch.setattr(layers, "melt_depth", counting)
    layers._solved.cache_clear()
    yield made
    layers._solved.cache_clear()


def test_estimate_is_computed_once(counted):
    """Cases that differ in spacing alone share it, with vapor and without; another end or another
    fluence has its own."""
    for spacing in ("50nm", "100nm"):
        case = load_case("texture-steel", [f"particles.spacing={spacing}"])
        first = layers.expected_heating(case)
        estimate_with_vapor(case, first)
    assert len(counted) == 2 and counted[0] is None and counted[1] is not None
    for setting in ("time.end=35ns", "laser.fluence=0.9 J/cm^2"):
        assert layers.expected_heating(load_case("texture-steel", [setting])) is not first
    assert len(counted) == 4
