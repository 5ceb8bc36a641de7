"""A relief of a file over x and y: linear between its places, refused where it cannot be one."""

import numpy as np
import pytest

from lasersph import compute
from lasersph.boundaries.relief_grid import ReliefGrid
from lasersph.case import load_case
from lasersph.input import CaseError
from lasersph.output.surface_csv import write_heights
from lasersph.simulation.recipes import recipe_of

X, Y = np.array([0.0, 1.0, 3.0]), np.array([0.0, 1.0, 2.0])
HEIGHT = X[:, None] + 2.0 * Y
"""x + 2 y."""
DOTS = (
    "particles.spacing=200 nm",
    "particles.fine_depth=1 um",
    "domain.depth=2 um",
    "domain.width=4.8 um",
    "laser.beam.period=4.8 um",
)


def test_linear_between_places():
    """x + 2 y at places, between them, and no further than the nearest one beyond."""
    grid = ReliefGrid(X, Y, HEIGHT)
    at = np.array([0.0, 1.0, 2.5, 3.0, 9.0]), np.array([0.0, 2.0, 0.5, 1.0, -1.0])
    assert grid.at(*at) == pytest.approx([0.0, 5.0, 3.5, 5.0, 3.0])
    assert grid.steepest(0.2) == pytest.approx(np.hypot(1.0, 2.0))
    assert grid.covers(0, -1.0, 4.0, 1.0) and not grid.covers(0, -2.0, 3.0, 1.0)
    assert grid.covers(1, -1.0, 3.0, 1.0) and not grid.covers(1, 0.0, 3.5, 1.0)


def rows(text):
    """Rows of numbers."""
    return np.array([[float(one) for one in row.split()] for row in text.split(",")])


def test_rows_of_a_grid():
    """x slowest; not where one is missing, or x is fastest."""
    grid = ReliefGrid.of(rows("0 0 1, 0 1 2, 2 0 3, 2 1 4"))
    assert grid is not None and grid.height.tolist() == [[1.0, 2.0], [3.0, 4.0]]
    assert ReliefGrid.of(rows("0 0 1, 0 1 2, 2 0 3")) is None
    assert ReliefGrid.of(rows("0 0 1, 2 0 3, 0 1 2, 2 1 4")) is None
    assert ReliefGrid.of(rows("0 0 1, 0 1 2")) is None


def relief_file(folder, columns=24, depth=1e-7):
    """surface.csv of a whole period of dots, as a run writes it, and a function of its heights."""
    place = (np.arange(columns) + 0.5) * 4.8e-6 / columns - 2.4e-6
    k = 2.0 * np.pi / 4.8e-6

    def height(x, y):
        return -depth * np.cos(k * x) * np.cos(k * y)

    file = folder / "surface.csv"
    write_heights(file, place, place, height(place[:, None], place))
    return file, height


def test_a_dot_begins_at_the_relief_of_a_run(tmp_path):
    """A quarter has the heights of its columns, and its particles lie below them."""
    file, height = relief_file(tmp_path)
    settings = (*DOTS, f"solver.flow.initial_surface.path={file}")
    case = load_case("texture-dots-steel", settings)
    again = type(case).model_validate(case.resolved())
    assert again.hash() == case.hash()
    solver = recipe_of(case).build(compute.cpu(threads=1))
    line = solver.domain.surface.line
    wanted = height(*line.places)
    assert line.height == pytest.approx(wanted, rel=1e-8, abs=1e-16)

    # what is missing in the dot is missing below it
    x, y, z = solver.backend.to_host(solver.position)
    top = [z[(np.abs(x - a) < 1e-7) & (np.abs(y - a) < 1e-7)].max() for a in (1e-7, 2.3e-6)]
    spacing = line.widths[0]
    assert np.abs(np.array(top) - wanted[[0, -1], [0, -1]] + 0.5 * spacing).max() < 0.1 * spacing
    volume = solver.backend.to_host(solver.particles["volume"]).sum()
    area = line.widths[0] * line.widths[1]
    whole = area * line.count * case.domain.depth + area * wanted.sum()
    assert volume == pytest.approx(whole, rel=1e-9, abs=0.0)


@pytest.mark.parametrize(
    ("change", "settings", "words"),
    [
        ((), ("domain.breadth=9.6 um", "domain.extent=full"), "as long along y as -4.8 um to 4.8"),
        ((), ("solver.dimensions=2", "domain.extent=half", "laser.beam.beams=2"), "which has no y"),
        (("-2.3e-06,-2.1e-06", "-2.3e-06,-2.15e-06"), (), "a height for each x_m and each y_m"),
        (("x_m,y_m", "x_m,depth_m"), (), "two rows or more whose x_m rises"),
    ],
)
def test_refused(tmp_path, change, settings, words):
    """Of another breadth, in a section, with a hole, and without y: one line each."""
    file, _ = relief_file(tmp_path)
    if change:
        text = file.read_text()
        assert change[0] in text
        file.write_text(text.replace(*change))
    with pytest.raises(CaseError) as told:
        load_case(
            "texture-dots-steel", (*DOTS, f"solver.flow.initial_surface.path={file}", *settings)
        )
    assert words in str(told.value)
    assert str(told.value).count("initial_surface.path: ") == 1


def test_too_steep(tmp_path):
    """A dot of 2 um is steeper than 45 degrees."""
    file, _ = relief_file(tmp_path, depth=9e-7)
    deep = ("particles.fine_depth=2 um", "domain.depth=4 um")
    with pytest.raises(CaseError, match=r"initial_surface.path: is a slope of 1\.\d+, more than 1"):
        load_case("texture-dots-steel", (*DOTS, *deep, f"solver.flow.initial_surface.path={file}"))
