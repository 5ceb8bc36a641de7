"""Which cases have an active region, and what that saves."""

import math

import pytest

from lasersph.case import load_case
from lasersph.case.size import active_share, has_active_region, size_of


@pytest.mark.parametrize(
    ("name", "overrides", "expected"),
    [
        ("ablation-depth", [], True),
        ("ablation-depth", ["solver.active_region=false"], False),
        ("ablation-depth", ["solver.gravity=9.81 m/s^2"], False),
        ("dam-break", [], False),
        ("sound-wave", [], False),
        ("dlip-steel", [], False),
    ],
)
def test_who_has_an_active_region(name, overrides, expected):
    """Matter at rest under light, without gravity."""
    assert has_active_region(load_case(name, overrides)) is expected


def test_active_share_by_hand():
    """9.6 sqrt(D t) and four supports, over the depth."""
    case = load_case("ablation-depth")
    depth = 9.6 * math.sqrt(167.0 / (2705.0 * 896.0) * 15e-9) + 4 * 0.3e-6
    assert active_share(case, 0.3e-6) == pytest.approx(depth / 16e-6, rel=1e-3)
    assert active_share(load_case("ablation-depth", ["domain.depth=2 um"]), 0.3e-6) == 1.0


def test_active_region_saves_memory():
    """The published sample of 10 million particles takes a third of what all active would."""
    sample = ["solver.dimensions=3", "domain.width=20 um", "domain.depth=200 um",
              "particles.spacing=0.2 um"]  # fmt: skip
    partial = size_of(load_case("ablation-depth", sample))
    whole = size_of(load_case("ablation-depth", [*sample, "solver.active_region=false"]))
    assert partial.particles == whole.particles == pytest.approx(1e7)
    assert partial.bytes < 5.5 * 2**30 < 0.35 * whole.bytes
