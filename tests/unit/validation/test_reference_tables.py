"""Stored tables: complete, and the misprints of a published one are found."""

import numpy as np
import pytest
from cavity_differences import Cavity, extrapolated

from lasersph.validation.lid_driven_cavity.center_lines import center_line, misprints
from lasersph.validation.study import home_of
from lasersph.validation.tables import read_table

REYNOLDS_NUMBERS = (100, 400, 1000)


@pytest.mark.parametrize("reynolds", REYNOLDS_NUMBERS)
def test_center_lines(reynolds):
    """17 points from wall to wall; at rest at the walls but for the lid; small stated errors."""
    for component, last in (("u", 1.0), ("v", 0.0)):
        line = center_line(component, reynolds)
        assert line.share.size == 17
        assert (line.share[0], line.share[-1]) == (1.0, 0.0)
        assert line.value[[0, -1]] == pytest.approx([last, 0.0], abs=1e-4)
        assert line.ghia[[0, -1]] == pytest.approx([last, 0.0])
        assert np.max(line.error) < 0.004
        assert np.count_nonzero(line.inner) == 15


def test_misprints_of_the_printed_table():
    """Two numbers leave the smooth error of their neighbors: -0.04775 (u) and -0.23827 (v)."""
    found = {
        (component, reynolds): line.ghia[line.is_misprint].tolist()
        for component in ("u", "v")
        for reynolds in REYNOLDS_NUMBERS
        if (line := center_line(component, reynolds)).is_misprint.any()
    }
    assert found == {("u", 100): [-0.04775], ("v", 400): [-0.23827]}


def test_a_misprint_stands_out_from_both_sides():
    """A spike is one, a step, a slope and rounding are none."""
    assert np.flatnonzero(misprints(np.array([1e-3, 2e-3, 0.1, 2e-3, 1e-3]))).tolist() == [2]
    assert not misprints(np.array([1e-3, 1e-3, 0.1, 0.1, 0.1])).any()
    assert not misprints(np.array([1e-6, 1e-6, 4e-4, 1e-6])).any()


def test_natural_convection_table():
    """Four Rayleigh numbers; a cell that the paper leaves empty is NaN; means of Nu agree."""
    table = read_table(home_of("natural-convection") / "reference.csv")
    assert table["Ra"].tolist() == [1e3, 1e4, 1e5, 1e6]
    assert np.isnan(table["psi_max"]).tolist() == [True, True, False, False]
    assert table["Nu_half"] == pytest.approx(table["Nu"], rel=1e-3)
    assert table["Nu_0"] == pytest.approx(table["Nu"], rel=3e-3)


def test_center_lines_by_another_program():
    """Differences on 32 and 64 cells, extrapolated, give the stored center lines at Re 100."""
    coarse, fine = (Cavity(n, 100.0).solve().velocity() for n in (32, 64))
    u, w = extrapolated(fine, coarse)
    for component, along in (("u", u[16]), ("v", w[:, 16])):
        line = center_line(component, 100)
        k = np.round(32 * line.share).astype(int)
        shared = np.isclose(32 * line.share, k)
        assert np.count_nonzero(shared) > 4
        assert along[k[shared]] == pytest.approx(line.value[shared], abs=1e-3)
