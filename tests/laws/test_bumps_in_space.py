"""Round bumps on a film in three dimensions, beside the sum of waves that is exact around an axis.

A quarter of a square is computed, 5 radii wide or more, so that its other bumps are not felt.
"""

import numpy as np
import pytest
from surface_films import go

from lasersph import compute
from lasersph.analytic.film_bump import FilmBump
from lasersph.analytic.liquid_film import Drive, LiquidFilm
from lasersph.case import load_case
from lasersph.simulation.recipes import recipe_of

SQUARE = (
    "solver.dimensions=3",
    "solver.geometry=planar",
    "domain.extent=quarter",
    *(f"solver.flow.{side}=symmetry" for side in ("left", "right", "front", "back")),
)
BUMP = "boundaries.surface_temperature_bump"
ALUMINUM = (
    "material.density=2379 kg/m^3",
    "material.viscosity=2.2747 mPa s",
    "material.surface_tension=0.87 N/m",
)


def film_with_a_bump(side, *settings):
    """Solver of a quarter of a square of a side [m] of the film of `spot-film`."""
    case = load_case("spot-film", (*SQUARE, f"domain.width={side} m", *settings))
    return recipe_of(case).build(compute.cpu(threads=1))


def deviation(solver, wanted):
    """Heights less those of a function of the distance (n,), over the largest of these: the largest
    of all columns, and of those on the axis and on the diagonal."""
    line = solver.domain.surface.line
    x, y = line.places
    expected = wanted(np.hypot(x, y).ravel()).reshape(x.shape)
    found = np.abs(line.height - expected) / np.abs(expected).max()
    return found.max(), found[0].max(), np.diag(found).max()


@pytest.mark.slow
def test_driven_by_a_bump_of_temperature():
    """10 ns of 10 K: within 3 % of the largest height everywhere with five rows; 2.8 % came out,
    in the middle, as in a square of 6.7 um, and 2.5 % after 20 ns; 4.8 % with four rows, 1.2 % with
    seven."""
    radius, depth, end = 1e-6, 280e-9, 1e-8
    heat = (f"{BUMP}.amplitude=10 K", f"{BUMP}.radius={radius} m")
    solver = film_with_a_bump(5.04e-6, "particles.spacing=56 nm", *heat)
    exact = FilmBump(LiquidFilm(depth, 1.0, 6863.0, 7e-3, 1.6, -4.3e-4), radius)
    go(solver, end)
    drive = Drive(temperature=10.0, end=2e-8)
    found = deviation(solver, lambda r: exact.heights(r, [end], drive)[0])
    assert max(found) < 0.03


def test_free():
    """A bump of 1 % of the depth, twice as wide as that, when it has lost an eighth of its first
    height: within 0.5 % of this; 0.4 % came out with five rows, 0.2 % with seven. A surface tension
    that is 8 % off is seen."""
    radius, depth, height = 2e-6, 1e-6, 1e-8
    start = f"amplitude = '{height} m', radius = '{radius} m'"
    settings = (*ALUMINUM, f"domain.depth={depth} m", "particles.spacing=200 nm")
    solver = film_with_a_bump(
        1.1e-5, *settings, f"{BUMP}.amplitude=0 K", f"solver.flow.initial_surface={{ {start} }}"
    )
    film = LiquidFilm(depth, 1.0, 2379.0, 2.2747e-3, 0.87, 0.0)
    exact, end = FilmBump(film, radius), 0.5 * np.sqrt(2379.0 * depth**3 / 0.87)
    go(solver, end)
    line = solver.domain.surface.line
    wanted = exact.heights(np.hypot(*line.places).ravel(), [end], initial=height)[0]
    error = np.abs(line.height.ravel() - wanted).max() / height
    assert error < 0.005
