"""Absorption and reflectivity: exact cell shares, tables with a jump."""

import numpy as np
import pytest

from lasersph.lasers import BeerLambertAbsorption, ReflectivityTable, SurfaceAbsorption


def test_beer_lambert_cells_by_hand():
    """alpha = 1: 1 - 1/e in the first meter, 1/e - 1/e^2 in the second, and so on."""
    share = BeerLambertAbsorption().deposited([0.0, 1.0, 2.0], [1.0, 2.0, 3.0], 1.0)
    e = np.exp(-1.0)
    assert share == pytest.approx([1 - e, e - e**2, e**2 - e**3], rel=1e-15)


def test_what_no_cell_keeps_has_passed():
    """Several columns of graded cells at once: what is missing in each is exp(-alpha depth)."""
    faces = np.concatenate([[0.0], np.cumsum(4e-9 * 1.2 ** np.arange(40))])
    share = BeerLambertAbsorption().deposited(np.tile(faces[:-1], 3), np.tile(faces[1:], 3), 9.56e5)
    passed = 1.0 - share.reshape(3, -1).sum(axis=1)
    assert passed == pytest.approx([np.exp(-9.56e5 * faces[-1])] * 3, rel=1e-12)


def test_case_overrides_the_materials_coefficient():
    """The laser's own alpha is used; with none at all the message names the key."""
    own = BeerLambertAbsorption(absorption_coefficient=2.0)
    assert own.deposited([0.0, 1.0], [1.0, 2.0], 1.0)[0] == pytest.approx(1 - np.exp(-2.0))
    with pytest.raises(ValueError, match=r"in \[laser\.absorption\]"):
        BeerLambertAbsorption().deposited([0.0], [1.0])


def test_surface_absorption_feeds_the_top_cells_only():
    """1 where the cell begins at the surface, rounding allowed."""
    share = SurfaceAbsorption().deposited([0.0, 1e-20, 1e-6], [1e-6, 1e-6, 2e-6])
    assert share.tolist() == [1.0, 1.0, 0.0]


def test_reflectivity_table_with_a_jump():
    """Demuth's eq. 78 as a table: linear to the melting point, 0.65 from there on."""
    law = ReflectivityTable(
        table=((300.0, 0.92833), (933.35, 0.675687), (933.35, 0.65), (2792.0, 0.65))
    )
    assert law.at([300.0, 616.675, 933.35, 2000.0, 4000.0]) == pytest.approx(
        [0.92833, 0.8020085, 0.65, 0.65, 0.65], rel=1e-6
    )
    assert law.at(933.3) == pytest.approx(0.6757, abs=1e-4)
    nodes, _ = law.nodes()
    assert np.all(np.diff(nodes) > 0)


@pytest.mark.parametrize(
    "table", [((900.0, 0.5), (300.0, 0.6)), ((300.0, 0.5),) * 3, ((300.0, 1.5), (400.0, 0.5))]
)
def test_impossible_reflectivity_is_refused(table):
    """Falling temperatures, three rows at one, more than everything."""
    with pytest.raises(ValueError, match=r"must rise|less than or equal"):
        ReflectivityTable(table=table)
