"""Sobol indices and screening against functions whose indices are known."""

import numpy as np
import pytest
from numpy.testing import assert_allclose
from sobol_intervals import (
    CUBE,
    KEYS,
    exact_indices,
    ishigami,
    ishigami_indices,
    melt_depth,
    points_in,
)
from synthetic_sweep import grid_points, made_up_sweep

from lasersph.studies import box_of, fit_emulator
from lasersph.studies.sensitivity import assess_sensitivity, screen, sobol_indices
from lasersph.sweeps.sampling import Range, morris


@pytest.mark.parametrize(
    ("function", "box", "count"),
    [(ishigami, CUBE, 128), (melt_depth, KEYS, 32)],
    ids=["ishigami", "melt depth"],
)
def test_indices_lie_in_their_intervals(function, box, count):
    """First order and total of all three keys, from some runs; the intervals say something."""
    known = ishigami_indices() if function is ishigami else exact_indices(function, box)
    x = points_in(box, count, seed=1)
    found = sobol_indices(fit_emulator(x, function(x), box=box))
    errors = found.first_error, found.total_error
    for exact, value, error in zip(known, (found.first, found.total), errors, strict=True):
        assert np.all(np.abs(value - exact) <= error), (value, error, exact)
        assert np.all(error < 0.3)


def test_quadrature_knows_ishigami():
    """The exact indices of the melt depth are trusted because those of a known function agree."""
    found = exact_indices(ishigami, CUBE)
    for one, other in zip(found, ishigami_indices(), strict=True):
        assert_allclose(one, other, atol=1e-9)


def test_same_bits():
    """Indices are the same at each repetition; of a sum each key does alone what it does."""
    box = box_of([0.0, 0.0], [1.0, 1.0])
    x = points_in(box, 8, seed=1)
    first, second = (sobol_indices(fit_emulator(x, x @ [2.0, 1.0], box=box)) for _ in range(2))
    assert np.array_equal(first.total_error, second.total_error)
    assert_allclose(first.first, [0.8, 0.2], atol=0.02)
    assert_allclose(first.total, [0.8, 0.2], atol=0.02)


def morris_points(keys, trajectories):
    """Points of a screening in the unit box."""
    found = morris({f"k{k}": Range(0.0, 1.0) for k in range(keys)}, trajectories, seed=1)
    return np.array([list(point.values()) for point in found])


def test_trajectories_move_one_key_at_a_time():
    """Every key once in a trajectory, by 2/3 of its range, inside the box; longer plans go on."""
    points = morris_points(5, 8)
    walks = points.reshape(8, 6, 5)
    steps = np.diff(walks, axis=1)
    assert points.min() == 0.0 and points.max() <= 1.0
    assert np.all(np.count_nonzero(steps, axis=2) == 1)
    assert_allclose(np.abs(steps.sum(axis=1)), 2.0 / 3.0)
    assert np.array_equal(morris_points(5, 12)[:48], points)


def test_screening_ranks_keys():
    """A linear key has its slope and no sigma, an idle one nothing, interacting ones a sigma; a
    failed run takes its effects with it."""
    points = morris_points(4, 10)
    box = box_of([0.0] * 4, [1.0] * 4)

    def number(x):
        return 3.0 * x[:, 0] + 2.0 * x[:, 1] * x[:, 2]

    found = screen(points, number(points), box)
    assert_allclose([found.mean_size[0], found.mean_size[3]], [3.0, 0.0], atol=1e-12)
    assert_allclose([found.deviation[0], found.deviation[3]], 0.0, atol=1e-12)
    assert min(found.deviation[1:3]) > 0.3
    outputs = number(points)
    outputs[7] = np.nan
    fewer = screen(points, outputs, box)
    assert fewer.count.sum() == found.count.sum() - 2
    assert_allclose(fewer.mean_size[0], 3.0)


def test_screening_by_hand():
    """Two keys, two trajectories: effects 4 and 2 of the first key, -1 and -3 of the second."""
    x = [[0, 0], [10, 0], [10, 1], [0, 1], [10, 1], [10, 0]]
    y = [0.0, 4.0, 3.0, 1.0, 3.0, 6.0]
    found = screen(x, y, box_of([0, 0], [10, 1]))
    # the step between the trajectories moves one key as well, and is an effect too: 2
    assert_allclose(found.mean_size, [(4.0 + 2.0 + 2.0) / 3.0, 2.0])
    assert_allclose(found.deviation, [np.std([4.0, 2.0, 2.0], ddof=1), np.sqrt(2.0)])


def test_too_few_effects():
    """Scattered runs screen nothing."""
    with pytest.raises(ValueError, match="key 1 has 0 elementary effects"):
        screen([[0, 0], [1, 1], [0.5, 0.2]], [1.0, 2.0, 3.0], box_of([0, 0], [1, 1]))


def test_sensitivity_of_sweeps(tmp_path):
    """A grid gives Sobol indices, walks a screening; both say that the fluence matters most. The
    made-up depth falls with the duration only through its threshold."""
    for name in ("grid", "morris"):
        (tmp_path / name).mkdir()
    made_up_sweep(tmp_path / "grid", grid_points((5e3, 1.2e4, 4), (1e-9, 1e-8, 3)))
    found = assess_sensitivity(tmp_path / "grid", "melt.depth_max_m")
    assert found.keys == ("laser.fluence", "laser.pulse.fwhm") and found.runs == 12
    assert found.sobol.first[0] > 0.2 and 0.9 < sum(found.sobol.total) < 1.3
    assert found.predictivity > 0.9 and found.screening is None

    ranges = {"f": Range(5e3, 1.2e4), "t": Range(1e-9, 1e-8, scale="log")}
    points = [tuple(point.values()) for point in morris(ranges, 6, seed=1)]
    made_up_sweep(tmp_path / "morris", points, failed={4}, kind="morris")
    found = assess_sensitivity(tmp_path / "morris", "melt.depth_max_m")
    assert found.sobol is None and found.runs == 17
    assert np.all(found.screening.mean_size > 5e-8) and found.screening.count.sum() >= 10


def test_one_key_has_nothing_to_compare(tmp_path):
    """Nor has a sweep without a result."""
    points = [(fluence, 1e-8) for fluence in (5e3, 6e3, 7e3)]
    made_up_sweep(tmp_path, points)
    with pytest.raises(ValueError, match="a single key varies"):
        assess_sensitivity(tmp_path, "melt.depth_max_m")
    (tmp_path / "failed").mkdir()
    made_up_sweep(tmp_path / "failed", points, failed={0, 1, 2})
    with pytest.raises(ValueError, match=r"no run has melt\.depth_max_m yet"):
        assess_sensitivity(tmp_path / "failed", "melt.depth_max_m")
