"""Heat and melting in 3-D under four beams: energy of a cell, symmetry, and the area that melts."""

import numpy as np
import pytest

from lasersph import open_run, run
from lasersph.case import load_case

COARSE = (
    "particles.spacing=250 nm", "particles.coarsest=1 um", "domain.depth=2 um", "time.step=1 ns",
    "time.end=72 ns", "output.snapshots.interval=4 ns",
)  # fmt: skip


@pytest.fixture(scope="module")
def dots(tmp_path_factory):
    """A coarse run of the shipped dots."""
    folder = tmp_path_factory.mktemp("dots")
    run(load_case("dots-steel", COARSE), folder / "run", threads=1)
    return open_run(folder / "run")


def test_light_of_a_cell_is_the_mean_fluence(dots):
    """All that falls on a cell in a pulse, half of which is computed: 0.25 J/cm^2 times 5 um times
    5 um."""
    incident = dots.history["energy_incident_J"][-1]
    assert incident == pytest.approx(2500.0 * 5e-6 * 5e-6, rel=2e-6, abs=0.0)
    assert dots.summary["energy"]["imbalance_relative"] < 1e-9


def test_dots_are_as_wide_along_x_as_along_y(dots):
    """The surface mirrored at the diagonal of a quarter of the cell is the same."""
    step = dots.snapshots.nearest(55e-9)
    x, y, z = step["position"]
    surface = (z > z.max() - 1e-9) & (y > 0.0)
    order = np.lexsort((y[surface], x[surface]))
    T = step["temperature"][surface][order].reshape(10, 10)
    assert pytest.approx(T.T, rel=1e-9) == T
    assert T[0, 0] == T.max() > 1.5 * T[-1, -1]


def test_molten_area_is_where_a_column_would_melt(dots, tmp_path):
    """Heat hardly spreads along the surface: the dot ends at the fluence that melts a column."""
    area = dots.summary["melt"]["area_half_max_m2"]
    edges = np.linspace(0.0, 2.5e-6, 11)
    low, high = (np.stack([a.ravel() for a in np.meshgrid(e, e)]) for e in (edges[:-1], edges[1:]))
    beam = load_case("dots-steel").laser.beam
    fluence = np.sort(2500.0 * beam.cell_means(low, high, np.zeros(2)))[::-1]
    molten = round(area / (4.0 * (edges[1] - edges[0]) ** 2))  # cells in a quarter of the dot
    assert 5 < molten < 60
    column = (*COARSE, "solver.dimensions=1", "domain.extent=full", "laser.beam={kind='uniform'}")
    for factor, melts in ((1.1, True), (0.9, False)):
        value = factor * 0.5 * (fluence[molten - 1] + fluence[molten])
        case = load_case("dots-steel", (*column, f"laser.fluence={value} J/m^2"))
        found = run(case, tmp_path / str(factor), threads=1)
        depth = found.summary.get("melt", {}).get("depth_half_max_m", 0.0)
        assert (depth > 0.0) == melts
