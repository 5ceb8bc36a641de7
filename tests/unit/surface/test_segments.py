"""Which parts of a surface move, and how their lines end."""

import numpy as np
import pytest
from surface_lines import line_of

from lasersph.surface.segments import MIN_COLUMNS, SurfaceSegments, overrun


def segments(ends, molten):
    """Segments of a line of columns whose heights are their numbers."""
    whole = line_of(0.0, 1e-8, len(molten), ends, 3e-7)
    whole.height = np.arange(len(molten), dtype=float)
    found = SurfaceSegments(whole)
    found.choose(np.array(molten, bool))
    found.update_heights()
    return found


def test_all_molten():
    """One part: the whole line itself."""
    found = segments(("mirror", "mirror"), [1] * 40)
    assert found.parts[0].line is found.whole and found.is_molten.all()


def test_two_pools_and_a_spot_too_narrow():
    """Pinned at the heights of the solid beside them; at the plane of symmetry mirrored."""
    molten = [1] * 15 + [0] * 5 + [1] * (MIN_COLUMNS - 1) + [0] * 3 + [1] * 20 + [0] * 2
    found = segments(("mirror", "mirror"), molten)
    first, second = found.parts
    assert first.columns.tolist() == list(range(15)) and first.line.ends[0] == ("mirror", "pinned")
    assert first.line.pins[0][1] == 15.0
    begin = 15 + 5 + MIN_COLUMNS - 1 + 3
    assert second.columns.tolist() == list(range(begin, begin + 20))
    assert second.line.ends[0] == ("pinned", "pinned")
    assert second.line.pins[0] == (begin - 1.0, begin + 20.0)
    assert found.is_molten.sum() == 35


def test_pool_across_a_period():
    """One part, whose columns go on at the other end."""
    found = segments(("periodic", "periodic"), [1] * 10 + [0] * 10 + [1] * 10)
    (part,) = found.parts
    assert part.columns.tolist() == [*range(20, 30), *range(10)]
    assert part.line.ends[0] == ("pinned", "pinned") and part.line.pins[0] == (19.0, 10.0)
    assert part.line.height == pytest.approx(part.columns)


def test_lines_of_the_same_length_do_not_share_heights():
    """What they share is the smoothing."""
    found = segments(("mirror", "mirror"), [0] + [1] * 20 + [0] * 3 + [1] * 20 + [0])
    first, second = found.parts
    assert first.line is not second.line
    assert first.line.height[0] == 1.0 and second.line.height[0] == 24.0


@pytest.mark.parametrize("width", [MIN_COLUMNS // 2 - 1, MIN_COLUMNS // 2])
def test_half_of_a_pool_moves_as_the_whole_does(width):
    """At a plane of symmetry the columns of the image count."""
    whole = segments(("pinned", "pinned"), [0] * 9 + [1] * 2 * width + [0] * 9)
    half = segments(("mirror", "pinned"), [1] * width + [0] * 9)
    assert len(half.parts) == len(whole.parts) == (2 * width >= MIN_COLUMNS)


@pytest.mark.parametrize("end, expected", [("mirror", [9]), ("periodic", [0, 9])])
def test_melt_advances_over_lower_solid(end, expected):
    """Lower by more than half a column: not on the right of the first run, and across a period."""
    whole = line_of(0.0, 1.0, 40, (end, end), 30.0)
    thick = np.zeros(40, bool)
    thick[10:30] = thick[38:] = True
    whole.height = 1.0 * thick
    whole.height[[9, 30, 37]] = 0.4, 0.6, 2.0
    assert np.flatnonzero(overrun(whole, thick)).tolist() == expected
