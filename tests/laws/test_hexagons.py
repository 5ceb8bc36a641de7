"""Dots of three beams on steel: their threefold symmetry, their lattice, and heat where melt rests.

The lattice of dots is turned into itself by 60 degrees, the square lattice of columns is not. What
has that symmetry has the same harmonics cos(K r) for wave vectors K of the same length, and none of
wave vectors that two dots of a rectangle a times sqrt(3) a would have only if they differed.
"""

import numpy as np
import pytest

from lasersph import open_run, run
from lasersph.case import Case, load_case

PERIOD = 2.5e-6
COARSE = (
    "particles.spacing=100 nm", "particles.coarsest=0.6 um", "domain.depth=2 um",
    "domain.width=2.5 um", "domain.breadth=4.330127019 um", "laser.beam.period=2.5 um",
    "time.step=0.5 ns", "time.end=60 ns", "output.snapshots.interval=5 ns",
)  # fmt: skip
AT_REST = (
    "material.surface_tension_slope=0 N/(m K)",
    "solver.vaporization=plateau",
    "solver.flow.surface=flat",
)
LATTICE, SECOND = ((0, 2), (1, 1)), ((2, 0), (1, 3))
"""Wave vectors of the lattice in 2 pi/a, 2 pi/(sqrt(3) a): the six shortest, the six next ones."""
BETWEEN = ((1, 0), (0, 1), (2, 1), (1, 2))
"""Wave vectors of the rectangle that the lattice does not have."""


@pytest.fixture(scope="module")
def hexagons(tmp_path_factory):
    """A coarse run with dots half as far apart, with the flow and the relief of its melt."""
    folder = tmp_path_factory.mktemp("hexagons") / "run"
    run(load_case("texture-hexagons-steel", COARSE), folder, threads=1)
    return open_run(folder)


def harmonics(field, vectors):
    """Means (m,) of a field of a quarter, (nx, ny), times cos(K r)."""
    x, y = ((np.arange(n) + 0.5) / n for n in field.shape)
    along = [np.cos(np.pi * i * x) @ field @ np.cos(np.pi * j * y) for i, j in vectors]
    return np.array(along) / field.size


def surface_at(one, time, name):
    """A field of the surface (nx, ny) of a quarter at a time [s]; z for heights."""
    step = one.surface.nearest(time)
    values = step["position"][2] if name == "z" else step[name]
    return np.asarray(values, float).reshape(one.surface.shape)


def test_temperature_has_the_symmetry_of_the_light(hexagons):
    """While the pulse lasts the first harmonics are the same within 0.3 %."""
    for time in (3e-8, 3.5e-8):
        first = harmonics(surface_at(hexagons, time, "temperature"), LATTICE)
        assert first[0] == pytest.approx(first[1], rel=3e-3, abs=0.0)


def test_relief_is_nearly_threefold(hexagons):
    """The harmonics of the relief are the same along both directions within 20 %, for six columns
    across the radius of a pool: 10 and 15 % came out, and 2 and 0.2 % with 64 nm."""
    height = surface_at(hexagons, 6e-8, "z")
    for vectors in (LATTICE, SECOND):
        first = harmonics(height, vectors)
        assert first[0] == pytest.approx(first[1], rel=0.2, abs=0.0)


def test_both_dots_of_the_rectangle_are_the_same(hexagons):
    """Nothing has the period of the rectangle alone, and the middle of each is the lowest place."""
    for name in ("temperature", "z"):
        field = surface_at(hexagons, 6e-8, name)
        most = np.abs(harmonics(field, (*LATTICE, *SECOND))).max()
        assert np.abs(harmonics(field, BETWEEN)).max() < 2e-3 * most
    height = surface_at(hexagons, 6e-8, "z")
    assert height[0, 0] < -5e-9 and height[0, 0] == height[:10].min()
    assert height[-1, -1] == pytest.approx(height[0, 0], rel=5e-3, abs=0.0)
    assert hexagons.summary["melt"]["pools_max"] == 2
    assert hexagons.summary["energy"]["imbalance_relative"] < 1e-5


@pytest.mark.slow
def test_where_nothing_flows_the_dots_are_those_of_heat(tmp_path):
    """Area, depth and volume of the melt within 1 % of conduction alone: 1e-6 came out."""
    case = load_case("texture-hexagons-steel", (*COARSE, *AT_REST))
    heat = case.resolved()
    heat["solver"] = {"kind": "conduction", "dimensions": 3}
    heat["time"] = {"end": heat["time"]["end"], "step": heat["time"]["step"]}
    cases = {"still": case, "heat": Case.model_validate(heat)}
    still, alone = (
        run(one, tmp_path / name, threads=1).summary["melt"] for name, one in cases.items()
    )
    for key in ("area_half_max_m2", "depth_half_max_m", "volume_max_m3", "pools_max"):
        assert still[key] == pytest.approx(alone[key], rel=1e-2, abs=0.0), key
