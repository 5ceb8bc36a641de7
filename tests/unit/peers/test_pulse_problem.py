"""The pulse on electrons and lattice that programs are compared by: its reference, and times."""

from dataclasses import replace

import numpy as np
import pulse_problem as problem
import pytest
from measurement import Measurement
from workplace import PeerFailed, Workplace


def place(folder):
    """A workplace that compares wall times."""
    return Workplace(folder, threads=1, edge=6, sheet=6, segments=2, steps=3, clock="wall")


def answer(wall, off):
    """A run whose temperature of the electrons is off at one place by a share of its rise."""
    T = np.array(problem.reference(problem.CONSTANT))
    T[0, 1, 0] += off * (T[0].max() - problem.COLD)
    return problem.Answer(10, wall, 2.0 * wall, T)


def test_reference_of_fewer_cells():
    """A grid of a quarter as many cells gives the same to 1e-4."""
    coarse = problem.fine_grid(problem.LINEAR, 300)
    apart = problem.apart_over_rise(coarse, problem.reference(problem.LINEAR), problem.LINEAR)
    assert apart < 1e-4


def test_grid_is_the_closed_form_where_nothing_warms():
    """Little light leaves C_e and k_e at their values of 300 K: both references are one."""
    faint = {"fluence": 1e-4, "times": (1e-12, 2e-12)}
    grid = problem.fine_grid(replace(problem.LINEAR, **faint), 300) - problem.COLD
    form = problem.reference(replace(problem.CONSTANT, **faint)) - problem.COLD
    assert grid == pytest.approx(form, abs=2e-3 * form[0].max())
    assert grid[1] == pytest.approx(form[1], abs=5e-3 * form[1].max())


def test_faces_reach_the_back():
    """The first cell is as thin as asked for, each wider by one ratio, to the back."""
    face = problem.stretched(2e-6, 300)
    width = np.diff(face)
    assert (face[0], width[0]) == pytest.approx((0.0, problem.FINEST), rel=1e-6, abs=0.0)
    assert face[-1] == pytest.approx(2e-6, abs=0.0)
    assert width[1:] / width[:-1] == pytest.approx(width[1] / width[0])


def test_time_of_an_error_lies_between_two_runs():
    """Straight on logarithmic scales; the first run where it is good enough; None where none is."""
    assert problem.time_at(0.01, [0.1, 0.001], [1.0, 100.0]) == pytest.approx(10.0)
    assert problem.time_at(0.2, [0.1, 0.001], [1.0, 100.0]) == 1.0
    assert problem.time_at(1e-4, [0.1, 0.001], [1.0, 100.0]) is None


def test_comparison(tmp_path):
    """Times to the errors, what the finest run is off, and how far both programs are apart."""
    runs = [answer(1.0, 0.1), answer(100.0, 0.001)]
    ours = problem.compared("electrons", "lasersph", runs, problem.CONSTANT, place(tmp_path))
    assert (ours.wall, ours.processor) == pytest.approx((10.0, 20.0))
    between = 1e3 * 100 ** (np.log(100 / 3) / np.log(100))
    wanted = {"% error of the finest run": 0.1, "ms to 0.3 %": between, "ms to 0.1 %": 1e5}
    assert ours.detail == pytest.approx(wanted, rel=1e-4)
    runs = [answer(1.0, 0.005)]
    other = problem.compared("electrons", "NTMpy", runs, problem.CONSTANT, place(tmp_path))
    assert isinstance(other, Measurement)
    assert other.detail["% between that and lasersph's"] == pytest.approx(0.4)
    with pytest.raises(PeerFailed, match="no run has an error of 1 %, but 10 %"):
        problem.compared(
            "electrons", "NTMpy", [answer(1.0, 0.1)], problem.CONSTANT, place(tmp_path)
        )
