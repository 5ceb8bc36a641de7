"""Gaussian processes through some runs: known functions, errors, stairs, refusals."""

import sys
from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.stats import qmc

from lasersph.output import OutputError
from lasersph.studies import box_of, fit_emulator

FLUENCES, DURATIONS = (3e3, 1.2e4), (1e-9, 50e-9)
BOX = box_of((FLUENCES[0], DURATIONS[0]), (FLUENCES[1], DURATIONS[1]), (False, True))


def depth(points):
    """A smooth melt depth [m] over fluence [J/m^2] and duration [s]."""
    fluence, duration = np.asarray(points, float).T
    return 3e-7 * np.sqrt(1.0 + (fluence / 4e3) ** 2) * (duration / 1e-8) ** 0.2


def runs(count, seed=3):
    """Points of a Sobol sequence in the box."""
    return BOX.restored(qmc.Sobol(2, rng=seed).random(count))


def test_box_scales_and_restores():
    """Ends are 0 and 1, the middle of a logarithmic key is the geometric one."""
    points = np.array([[3e3, 1e-9], [1.2e4, 50e-9], [7.5e3, np.sqrt(50.0) * 1e-9]])
    assert_allclose(BOX.scaled(points), [[0, 0], [1, 1], [0.5, 0.5]], atol=1e-12)
    assert_allclose(BOX.restored(BOX.scaled(points)), points, rtol=1e-12)


def test_known_function():
    """16 runs give a smooth function to 1 % of its range, and most of it within two deviations."""
    found = fit_emulator(runs(16), depth(runs(16)), box=BOX)
    new = runs(256, seed=8)
    mean, deviation = found.predict(new)
    errors = np.abs(mean - depth(new))
    assert errors.max() < 0.03 * np.ptp(depth(new))
    assert np.sqrt(np.mean(errors**2)) < 0.01 * np.ptp(depth(new))
    assert np.mean(errors < 2.0 * deviation) > 0.85
    assert found.predictivity > 0.98
    assert np.all(found.predict(runs(16))[1] < 0.05 * deviation.max() + 1e-12)


def test_same_bits():
    """The same runs give the same emulator, bit for bit; draws as well."""
    new = runs(32, seed=8)
    first, second = (fit_emulator(runs(16), depth(runs(16)), box=BOX) for _ in range(2))
    for a, b in zip(first.predict(new), second.predict(new), strict=True):
        assert np.array_equal(a, b)
    assert np.array_equal(first.draw(3)(new), second.draw(3)(new))


def test_leave_one_out_is_what_a_fit_without_the_run_says():
    """The closed form equals a process of the same kernel through the other runs."""
    x, y = runs(8), depth(runs(8))
    found = fit_emulator(x, y, box=BOX, noise=3e-9)
    errors, deviations = found.leave_one_out()
    for k in range(8):
        others = np.arange(8) != k
        kept = {"inputs": found.inputs[others], "outputs": y[others], "noise": found.noise[others]}
        reduced = replace(found, **kept)
        mean, deviation = reduced.predict(x[k])
        assert_allclose(errors[k], y[k] - mean[0], rtol=1e-6)
        noisy = np.hypot(deviation[0], found.scale * np.sqrt(found.noise[k]))
        assert_allclose(deviations[k], noisy, rtol=1e-6)


def test_without_some_runs():
    """The other runs' own emulator; those left out are predicted as well as any."""
    x, y = runs(16), depth(runs(16))
    left_out = np.arange(16) % 4 == 0
    found = fit_emulator(x, y, box=BOX).without(left_out)
    assert found.outputs.size == 12
    mean, deviation = found.predict(x[left_out])
    assert np.all(np.abs(mean - y[left_out]) < 3.0 * deviation)
    with pytest.raises(ValueError, match="too few"):
        found.without(np.arange(12) > 2)


def test_stairs_are_smoothed():
    """Depths in whole cells: the emulator is nearer to the depth than the stairs are."""
    cell = 24e-9
    x = 3e3 + 9e3 * qmc.Sobol(1, rng=1).random(32)  # in no step with the cells
    smooth = depth(np.hstack([x, np.full_like(x, 1e-8)]))
    stairs = cell * np.round(smooth / cell)
    found = fit_emulator(x, stairs, noise=cell / np.sqrt(12.0))
    mean, deviation = found.predict(x)
    rms = np.sqrt(np.mean((mean - smooth) ** 2))
    assert rms < 0.6 * np.sqrt(np.mean((stairs - smooth) ** 2))
    assert np.mean(np.abs(mean - smooth) < 2.0 * deviation) > 0.9
    assert np.all(found.noise >= (cell / np.sqrt(12.0) / found.scale) ** 2)


def test_draws_scatter_as_the_process_says():
    """Mean and deviation of many drawn functions; each draw is one function."""
    x = np.linspace(0.0, 1.0, 6)[:, None]
    found = fit_emulator(x, np.sin(5.0 * x[:, 0]), noise=0.05)
    new = np.linspace(0.0, 1.0, 41)[:, None]
    mean, deviation = found.predict(new)
    functions = found.draw(800, seed=2)
    values = functions(new)
    assert_allclose(functions(new[7:9]), values[:, 7:9], rtol=1e-9, atol=1e-12)
    assert_allclose(values.mean(axis=0), mean, atol=0.2 * deviation.max())
    assert_allclose(values.std(axis=0), deviation, rtol=0.25, atol=0.02 * deviation.max())


def test_inside():
    """In the hull of scattered runs, between the ends of one key, in no hull of a line."""
    x = np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [0.3, 0.3]])
    found = fit_emulator(x, x.sum(axis=1) + x[:, 0] ** 2)
    assert found.is_inside([[0.2, 0.2], [0.9, 0.9], [0.0, 1.0]]).tolist() == [True, False, True]
    single = fit_emulator([[1.0], [2.0], [4.0]], [1.0, 2.0, 3.0])
    assert single.is_inside([[1.0], [3.0], [4.1]]).tolist() == [True, True, False]
    line = fit_emulator(np.linspace([0, 0], [1, 1], 5), np.arange(5.0))
    with pytest.raises(ValueError, match="vary their keys together"):
        line.is_inside([[0.5, 0.5]])


@pytest.mark.parametrize(
    ("x", "y", "text"),
    [
        ([[0.0], [1.0]], [1.0, 2.0], "too few: an emulator needs 3"),
        ([[0.0], [1.0], [2.0]], [1.0, 2.0], "3 runs have 2 outputs"),
        ([[0.0], [1.0], [2.0]], [1.0, np.nan, 2.0], "finite"),
        ([[0.0], [1.0], [2.0]], [2.0, 2.0, 2.0], "all 3 runs give 2"),
        ([[1.0], [1.0], [1.0]], [2.0, 2.0, 3.0], "high above low"),
    ],
)
def test_refusals(x, y, text):
    """What no emulator can be fitted to."""
    with pytest.raises(ValueError, match=text):
        fit_emulator(x, y)


def test_logarithms_need_positive_keys():
    """A range or a point at zero is refused."""
    with pytest.raises(ValueError, match="must be positive"):
        box_of([0.0], [1.0], [True])
    with pytest.raises(ValueError, match="must be positive"):
        BOX.scaled([[5e3, 0.0]])


def test_without_scikit_learn(monkeypatch):
    """One line says what to install."""
    monkeypatch.setitem(sys.modules, "sklearn.gaussian_process", None)
    with pytest.raises(OutputError, match=r"scikit-learn is not installed.*lasersph\[study\]"):
        fit_emulator([[0.0], [1.0], [2.0]], [1.0, 2.0, 4.0])
