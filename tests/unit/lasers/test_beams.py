"""Beams: hand-worked values, cell means against fine sampling, whole areas."""

import numpy as np
import pytest

from lasersph.lasers import GaussianBeam, InterferenceBeam, TopHatBeam, UniformBeam, Wave

ORIGIN = np.zeros(2)


def cells(low, high, n, dimension=2):
    """Corners of n cells per direction between low and high."""
    edges = np.linspace(low, high, n + 1)
    if dimension == 1:
        return edges[None, :-1], edges[None, 1:]
    grid = [np.meshgrid(e, e, indexing="ij") for e in (edges[:-1], edges[1:])]
    return tuple(np.stack([axis.ravel() for axis in pair]) for pair in grid)


def sampled_mean(beam, lower, upper, axis=ORIGIN, n=400):
    """Mean over one cell by the midpoint rule on points (cells of no dimension at shifted axes)."""
    points = [
        low + (np.arange(n) + 0.5) / n * (high - low)
        for low, high in zip(lower, upper, strict=True)
    ]
    grid = np.stack([p.ravel() for p in np.meshgrid(*points, indexing="ij")])
    if grid.shape[0] == 1:
        grid = np.vstack([grid, np.zeros_like(grid)])
    nothing = np.empty((0, 1))
    values = [
        beam.cell_means(nothing, nothing, axis - point)[0]
        for point in grid.T[:: max(1, grid.shape[1] // 20000)]
    ]
    return float(np.mean(values))


def test_uniform_beam_is_one_in_every_dimension():
    """Also for a column without lateral extent."""
    for dimension in (0, 1, 2):
        corners = np.zeros((dimension, 3))
        assert UniformBeam().cell_means(corners, corners + 1.0, ORIGIN).tolist() == [1.0] * 3


def test_two_waves_are_equation_1():
    """Period lambda/(2 sin(theta/2)); values 2, 1, 0 at 0, a quarter, half a period."""
    beam = InterferenceBeam(wavelength=355e-9, angle=0.071)
    assert beam.lateral_period == pytest.approx(5.00105e-6, rel=1e-6)
    x = beam.lateral_period * np.array([[0.0, 0.25, 0.5]])
    assert beam.cell_means(x - 1e-15, x + 1e-15, ORIGIN) == pytest.approx(
        [2.0, 1.0, 0.0], abs=1e-12
    )
    assert (beam.mean, beam.peak) == (1.0, 2.0)


def test_interference_cell_means_are_exact():
    """Mean of 1 + cos over [0, P/8] by hand: 1 + 8/(2 pi) sin(pi/4); all cells add up to 1."""
    beam = InterferenceBeam(period=5e-6)
    lower, upper = cells(-2.5e-6, 2.5e-6, 8, 1)
    means = beam.cell_means(lower, upper, ORIGIN)
    assert means[4] == pytest.approx(1.0 + 8.0 / (2.0 * np.pi) * np.sin(np.pi / 4.0), rel=1e-14)
    assert means.mean() == pytest.approx(1.0, abs=1e-15)


def test_two_general_waves_equal_the_short_form():
    """Two waves from +-theta/2 give the two-beam pattern."""
    half = 0.0355
    general = InterferenceBeam(
        wavelength=355e-9, waves=(Wave(polar=half), Wave(polar=half, azimuth=np.pi))
    )
    short = InterferenceBeam(wavelength=355e-9, angle=0.071)
    corners = cells(-3e-6, 4e-6, 29, 1)
    assert general.cell_means(*corners, ORIGIN) == pytest.approx(
        short.cell_means(*corners, ORIGIN), abs=1e-9
    )
    assert general.lateral_period == pytest.approx(short.lateral_period)


@pytest.mark.parametrize("polarization", [None, 0.4])
def test_n_waves_are_the_squared_sum_of_fields(polarization):
    """|sum E_j exp(i k_j.x)|^2 / sum |E_j|^2 at points of the plane."""
    waves = tuple(
        Wave(polar=0.3, azimuth=2 * np.pi * j / 3 + 0.1, amplitude=1 + 0.2 * j, phase=0.3 * j,
             polarization=polarization)
        for j in range(3)
    )  # fmt: skip
    beam = InterferenceBeam(wavelength=1e-6, waves=waves)
    points = np.random.default_rng(1).uniform(-3e-6, 3e-6, (2, 20))
    k = 2 * np.pi / 1e-6
    field = sum(
        w.field()[:, None] * np.exp(1j * (k * w.direction()[:2] @ points + w.phase)) for w in waves
    )
    expected = (np.abs(field) ** 2).sum(axis=0) / sum(w.amplitude**2 for w in waves)
    assert beam.cell_means(points, points, ORIGIN) == pytest.approx(expected, rel=1e-12)


def test_crossed_polarizations_lose_contrast():
    """Fields in the x-z plane of two waves at +-45 degrees are perpendicular: no pattern."""
    pair = [Wave(polar=np.pi / 4, azimuth=a, polarization=0.0) for a in (0.0, np.pi)]
    beam = InterferenceBeam(wavelength=1e-6, waves=tuple(pair))
    assert beam.peak == pytest.approx(1.0)
    along_y = [wave.model_copy(update={"polarization": np.pi / 2}) for wave in pair]
    assert InterferenceBeam(wavelength=1e-6, waves=tuple(along_y)).peak == pytest.approx(2.0)


def test_four_waves_make_a_square_pattern():
    """Four waves from +-x and +-y: peak 4 = n, the same period along both axes, even."""
    waves = tuple(Wave(polar=0.1, azimuth=j * np.pi / 2) for j in range(4))
    beam = InterferenceBeam(wavelength=1e-6, waves=waves)
    assert beam.peak == pytest.approx(4.0)
    assert beam.lateral_period == pytest.approx(1e-6 / np.sin(0.1))
    assert beam.lateral_period_y == pytest.approx(beam.lateral_period)
    assert beam.is_even


def test_open_peak_and_uneven_pattern_are_known():
    """Phases on three waves leave the peak open; a phase between two waves shifts the maximum."""
    waves = [Wave(polar=0.1, azimuth=a, phase=p) for a, p in ((0, 0), (2, 1), (4, 0))]
    assert InterferenceBeam(wavelength=1e-6, waves=tuple(waves)).peak is None
    shifted = InterferenceBeam(wavelength=1e-6, waves=tuple(waves[:2]))
    assert shifted.peak == pytest.approx(2.0)
    assert not shifted.is_even


@pytest.mark.parametrize("dimension", [1, 2])
@pytest.mark.parametrize("beam", [GaussianBeam(radius_1e2=1e-5), TopHatBeam(radius=1e-5)])
def test_cell_means_match_fine_sampling(beam, dimension):
    """A cell across the edge of the spot, beam off center, in a strip and in the plane."""
    lower, upper = np.array([[4e-6], [-2e-6]])[:dimension], np.array([[9e-6], [7e-6]])[:dimension]
    axis = np.array([-2e-6, 1e-6])
    exact = beam.cell_means(lower, upper, axis)[0]
    n = 4000 if dimension == 1 else 140
    assert exact == pytest.approx(sampled_mean(beam, lower[:, 0], upper[:, 0], axis, n), rel=2e-3)


@pytest.mark.parametrize("beam", [GaussianBeam(diameter_1e2=2e-5), TopHatBeam(radius=1e-5)])
def test_all_cells_together_hold_the_whole_beam(beam):
    """Cell means times cell areas add up to the area of the beam."""
    lower, upper = cells(-4e-5, 4.1e-5, 27)
    axis = np.array([1e-6, -3e-6])
    total = (beam.cell_means(lower, upper, axis) * np.prod(upper - lower, axis=0)).sum()
    assert total == pytest.approx(beam.area, rel=1e-10)


def test_cell_inside_and_outside_a_top_hat():
    """1 inside, 0 outside, pi/4 for the cell that holds one quarter exactly."""
    beam = TopHatBeam(radius=1.0)
    lower = np.array([[0.0, 0.0, 2.0, -1.0], [0.0, 0.0, 2.0, -1.0]])
    upper = np.array([[0.5, 1.0, 3.0, 1.0], [0.5, 1.0, 3.0, 1.0]])
    means = beam.cell_means(lower, upper, ORIGIN)
    assert means == pytest.approx([1.0, np.pi / 4, 0.0, np.pi / 4], abs=1e-14)


def test_widths_of_a_gaussian_beam():
    """1/e^2 radius by each of the three names; the fluence halves at the FWHM."""
    assert GaussianBeam(diameter_1e2=2e-5).radius == pytest.approx(1e-5)
    beam = GaussianBeam(diameter_fwhm=1e-5)
    edge = np.array([[5e-6], [0.0]])
    nothing = np.empty((0, 1))
    assert beam.cell_means(nothing, nothing, -edge[:, 0]) == pytest.approx(0.5)


@pytest.mark.parametrize(
    ("build", "message"),
    [
        (lambda: GaussianBeam(), "got none; give one of radius_1e2"),
        (lambda: GaussianBeam(radius_1e2=1e-5, diameter_1e2=2e-5), "radius_1e2 and diameter_1e2"),
        (lambda: GaussianBeam(radius_1e2=0.0), "greater than 0"),
        (lambda: TopHatBeam(radius=-1e-6), "greater than 0"),
        (lambda: InterferenceBeam(), "from nothing; give period"),
        (lambda: InterferenceBeam(wavelength=1e-6), "from wavelength; give"),
        (lambda: InterferenceBeam(period=1e-6, angle=0.1), "from angle and period"),
        (lambda: InterferenceBeam(wavelength=1e-6, waves=(Wave(polar=0.1),)), "one wave alone"),
        (lambda: Wave(polar=1.6), "less than 1.57"),
        (
            lambda: InterferenceBeam(
                wavelength=1e-6, waves=(Wave(polar=0.1), Wave(polar=0.1, polarization=0.0))
            ),
            "to all or to none",
        ),
    ],
)
def test_impossible_beams_are_refused(build, message):
    """What is wrong and what would be right."""
    with pytest.raises(ValueError, match=message):
        build()
