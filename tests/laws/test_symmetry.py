"""A symmetric pattern stays symmetric, and half of it is enough."""

import numpy as np
import pytest
from law_runs import go, host, solver_of

from lasersph.simulation.layers import lay_out

SETTINGS = ("particles.spacing=125nm", "particles.arrangement=uniform", "particles.ratio=",
            "domain.depth=4.5um",
            "time.step=0.5ns")  # fmt: skip
END = 7e-8


@pytest.fixture(scope="module")
def full():
    """Solver of the full period after the pulse."""
    _, solver = solver_of("dlip-steel", *SETTINGS, "domain.extent=full")
    go(solver, END)
    return solver


def lattice_order(solver):
    """Positions rounded to lattice points, to match particles."""
    count = solver.body.count
    return np.round(solver.body.filling.position[:, :count] * 1e12).astype(np.int64)


def test_mirror_symmetry(full):
    """T(x) = T(-x) within the tolerance of the implicit step."""
    points, T = lattice_order(full), host(full, "temperature")
    here = {tuple(p): k for k, p in enumerate(points.T)}
    mirror = [here[(-x, z)] for x, z in points.T]
    assert T.max() > 1673.0
    assert T[mirror] == pytest.approx(T, abs=1e-3)


def test_half_period_equals_full_period(full):
    """The half period between mirrors gives the temperatures of the full one, half the energy."""
    _, half = solver_of("dlip-steel", *SETTINGS)
    go(half, END)
    points = {tuple(p): T for p, T in zip(lattice_order(full).T, host(full, "temperature"),
                                          strict=True)}  # fmt: skip
    expected = [points[tuple(p)] for p in lattice_order(half).T]
    assert host(half, "temperature") == pytest.approx(np.array(expected), abs=1e-3)
    for name in ("incident", "absorbed"):
        assert 2 * half.state.energy[name] == pytest.approx(full.state.energy[name], rel=1e-7)


def test_periodic_sides_equal_mirrors(full):
    """The pattern is symmetric about both sides, so periodic sides change nothing."""
    _, periodic = solver_of("dlip-steel", *SETTINGS, "domain.extent=full",
                            "boundaries.sides=periodic")  # fmt: skip
    go(periodic, END)
    assert host(periodic, "temperature") == pytest.approx(host(full, "temperature"), abs=1e-3)


@pytest.mark.parametrize("spacing", ["62.5nm", "64.9nm"])
def test_odd_columns_are_harmless(spacing):
    """Where the full width holds an odd number of columns, half of it holds half a column more or
    less: only in deeper layers (62.5 nm: 80 columns at the surface) or at the surface too (77, 38).
    """
    ends, widths = [], []
    for extent in ("full", "half"):
        case, solver = solver_of(
            "dlip-steel", f"particles.spacing={spacing}", f"domain.extent={extent}",
            "time.step=0.5ns",
        )  # fmt: skip
        columns = lay_out(case).columns[0]
        if extent == "full":
            assert np.any(columns % 2 == 1)
            assert columns[0] % 2 == (0 if spacing == "62.5nm" else 1)
        go(solver, END)
        surface = solver.body.filling.surface
        ends.append(host(solver, "temperature")[surface].max())
        cells = host(solver, "melt_fraction")[surface] * solver.body.filling.width[0, surface]
        widths.append(case.domain.symmetry_factor * cells.sum())
    tolerance = 1e-5 if spacing == "62.5nm" else 5e-3
    assert ends[1] == pytest.approx(ends[0], rel=tolerance)
    assert widths[1] == pytest.approx(widths[0], rel=tolerance)
