"""Heights on a grid of two axes: planes, waves in any direction, caps, volume."""

import numpy as np
import pytest
from surface_lines import line_of

from lasersph.surface.height_field import HeightField
from lasersph.surface.smoothing import EVEN_PARITY, ODD_PARITY, ORDER, multinomial, orders_along

SIDE, CUTOFF = 1.2e-6, 0.3e-6
MIRROR, PERIODIC, PINNED = ("mirror",) * 2, ("periodic",) * 2, ("pinned",) * 2


def field(ends=(MIRROR, MIRROR), shape=(24, 30)):
    """Columns of a rectangle of 1.2 um times 1.5 um."""
    return HeightField((0.0, 0.0), (SIDE / 24, SIDE / 24), shape, ends, CUTOFF)


def places(found):
    """x and y of the columns."""
    return np.meshgrid(found.centers(0), found.centers(1), indexing="ij")


def give(found, heights):
    """Heights of x and y, to which the pinned ends are held."""
    found.height = heights(*places(found))
    (x_0, x_1), (y_0, y_1) = (
        (low, low + count * width)
        for low, count, width in zip(found.start, found.shape, found.widths, strict=True)
    )
    x, y = found.centers(0), found.centers(1)
    found.pins = ((heights(x_0, y), heights(x_1, y)), (heights(x, y_0), heights(x, y_1)))


def test_orders():
    """Differences of the power of a Laplacian: (a + b)^3, and of a line alone."""
    found = {orders: multinomial(orders) for orders in orders_along(2, 3)}
    assert found == {(0, 3): 1, (1, 2): 3, (2, 1): 3, (3, 0): 1}
    assert list(orders_along(1, 4)) == [(4,)]


def test_a_plane_stays_a_plane():
    """Pinned at its own heights all around: neither smoothed nor bent, whatever its slopes."""
    found = field((PINNED, PINNED))
    give(found, lambda x, y: 0.3 * x - 0.2 * y + 1e-8)
    assert found.smoothed == pytest.approx(found.height, abs=1e-14)
    assert found.slopes[0] == pytest.approx(0.3, abs=1e-6)
    assert found.slopes[1] == pytest.approx(-0.2, abs=1e-6)
    assert found.length_ratio == pytest.approx(np.sqrt(1.13), abs=1e-6)
    assert np.abs(found.curvature).max() < 1e-4 / SIDE


@pytest.mark.parametrize("ends", [(MIRROR, MIRROR), (PERIODIC, MIRROR), (PERIODIC, PERIODIC)])
@pytest.mark.parametrize("waves", [(2, 0), (0, 2), (2, 2), (4, 2)])
def test_waves_keep_their_closed_form(ends, waves):
    """1/(1 + (s^2 |k|^2)^n) of cos kx cos ky, with the differences' own k = 2 sin(k dx/2)/dx."""
    found = field(ends)
    x, y = places(found)
    sizes = [count * width for count, width in zip(found.shape, found.widths, strict=True)]
    k = [np.pi * number / size for number, size in zip(waves, sizes, strict=True)]
    wave = np.cos(k[0] * x) * np.cos(k[1] * y)
    square = sum(
        (2.0 * np.sin(0.5 * one * width) / width) ** 2
        for one, width in zip(k, found.widths, strict=True)
    )
    kept = 1.0 / (1.0 + ((CUTOFF / (2.0 * np.pi)) ** 2 * square) ** ORDER)
    assert found.smooth(wave) == pytest.approx(kept * wave, abs=1e-8)

    # damping takes the rest, and no volume
    found.height = 1e-9 * wave
    found.damp_short_waves(1.0)
    assert found.height == pytest.approx(1e-9 * kept * wave, abs=1e-17)


def test_directions_are_alike():
    """A wave of the cut-off length keeps half along an axis and along the diagonal."""
    found = HeightField((0.0, 0.0), (1e-8, 1e-8), (60, 60), (PERIODIC, PERIODIC), CUTOFF)
    x, y = places(found)
    k = 2.0 * np.pi / CUTOFF
    along = np.cos(k * x)
    diagonal = np.cos(2.0 * np.pi / 6e-7 * x) * np.cos(2.0 * np.pi / 6e-7 * y)
    kept = [np.sum(found.smooth(wave) * wave) / np.sum(wave**2) for wave in (along, diagonal)]
    assert kept[0] == pytest.approx(0.5, abs=0.02)
    # the diagonal one is longer by sqrt(2)
    assert kept[1] == pytest.approx(1.0 / (1.0 + 0.5**ORDER), abs=0.01)


def test_curvature_is_the_sum_of_both():
    """Bowl of radius R at its bottom: -2/R; the trough of the same radius -1/R."""
    radius = 4e-6
    found = HeightField((-5e-7, -5e-7), (2.5e-8,) * 2, (40, 40), (PINNED, PINNED), 1.5e-7)
    for a, b, c, expected in ((1.0, 1.0, 0.0, -2.0), (1.0, 0.0, 0.0, -1.0), (0.0, 0.0, 2.0, 0.0)):
        shape = np.array([a, b, c]) * 0.5 / radius
        give(found, lambda x, y, s=shape: s[0] * x**2 + s[1] * y**2 + s[2] * x * y)
        # the sum of both for small slopes, up to their square
        middle = found.curvature[15:25, 15:25] * radius
        assert middle == pytest.approx(expected, abs=0.02)


def test_a_turned_trough_is_as_curved():
    """A trough along the diagonal needs eta_xy: without it the curvature of slopes errs."""
    found = HeightField((-5e-7, -5e-7), (2.5e-8,) * 2, (40, 40), (PINNED, PINNED), 1.5e-7)
    x, y = places(found)
    s = (x + y) / np.sqrt(2.0)
    give(found, lambda x, y: 0.25 * (x + y) ** 2 / 6e-7)
    slope = s / 6e-7
    expected = -1.0 / 6e-7 / (1.0 + slope**2) ** 1.5
    inside = np.s_[12:28, 12:28]
    assert found.curvature[inside] == pytest.approx(expected[inside], rel=0.02)


@pytest.mark.parametrize("ends", [(MIRROR, MIRROR), (PERIODIC, MIRROR), (PINNED, MIRROR)])
def test_volume(ends):
    """Fluxes along both axes and damping move volume and make none."""
    found, rng = field(ends), np.random.default_rng(1)
    flux = [rng.normal(size=(25, 30)), rng.normal(size=(24, 31))]
    for axis, Q in enumerate(flux):
        sides = np.moveaxis(Q, axis, 0)
        sides[-1] = sides[0] = 0.0
    found.height = found.heights_after(1e-9, *flux)
    found.damp_short_waves(0.3)
    moved = np.abs(found.height).sum()
    assert moved > 0.0 and abs(found.height.sum()) < 1e-12 * moved


@pytest.mark.parametrize("ends", [MIRROR, PERIODIC, PINNED])
def test_even_along_y_is_the_line(ends):
    """Heights that do not vary along y: slope, curvature and means of the grid with one axis."""
    found, line = field((ends, MIRROR)), line_of(0.0, SIDE / 24, 24, ends, CUTOFF)
    line.height = 3e-8 * np.cos(np.pi * line.centers() / SIDE)
    found.height = np.repeat(line.height[:, None], 30, axis=1)
    assert found.curvature[:, 7] == pytest.approx(line.curvature, rel=1e-6, abs=1e-3)
    assert found.slopes[0][:, 7] == pytest.approx(line.slopes[0], rel=1e-6, abs=1e-9)
    assert np.abs(found.slopes[1]).max() < 1e-9
    everywhere = np.ones(found.shape, bool)
    means = found.mean_of_neighbors(found.height, everywhere)
    assert means[:, 7] == pytest.approx(line.mean_of_neighbors(line.height, everywhere[:, 0]))
    assert found.first_harmonic(2.0 * SIDE) == pytest.approx(line.first_harmonic(2.0 * SIDE))


def test_first_harmonic_along_both_axes():
    """4/(Lx Ly) times the integral of a cos cos and other waves is a, less what columns average."""
    found = field()
    x, y = places(found)
    k, q = np.pi / SIDE, np.pi / np.ptp(y) * (1.0 - 1.0 / found.shape[1])
    found.height = 3e-8 * np.cos(k * x) * np.cos(q * y) + 1e-8 * np.cos(k * x) - 2e-8
    kept = np.prod([np.sinc(0.5 / count) for count in found.shape])
    found_a = found.first_harmonic(2.0 * SIDE, 2.0 * np.pi / q)
    assert found_a == pytest.approx(3e-8 * kept, rel=1e-12, abs=0.0)
    assert found.first_harmonic(2.0 * SIDE) == pytest.approx(
        1e-8 * np.sinc(0.5 / found.shape[0]), rel=1e-12, abs=0.0
    )


def test_parity_along_each_axis():
    """sin kx cos ky is odd along x alone; v along y is odd there."""
    found = field()
    x, y = places(found)
    k = 2.0 * np.pi / SIDE
    u = np.sin(0.5 * k * x) * np.cos(np.pi * y / (1.25 * SIDE))
    slope = found.derivative(u, ODD_PARITY)
    assert slope == pytest.approx(
        0.5 * k * np.cos(0.5 * k * x) * np.cos(np.pi * y / (1.25 * SIDE)), abs=1e-4 * k
    )
    v = np.cos(0.5 * k * x) * np.sin(np.pi * y / (1.25 * SIDE))
    assert found.smooth(v, (EVEN_PARITY, ODD_PARITY)) == pytest.approx(v, abs=1e-3)
