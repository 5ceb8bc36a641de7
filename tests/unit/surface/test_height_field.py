"""Heights, slopes and curvatures of a line: waves, arcs, volume."""

import numpy as np
import pytest
from surface_lines import line_of

from lasersph.surface import smoothing
from lasersph.surface.capillary_waves import fastest_wave
from lasersph.surface.height_field import cutoff_of
from lasersph.surface.smoothing import ODD_PARITY, ORDER

PERIOD = 5e-6
CUTOFF = 0.3e-6


def line(ends=("mirror", "mirror"), count=158, length=PERIOD / 2):
    """Half a period between planes of symmetry, unless told otherwise."""
    return line_of(0.0, length / count, count, ends, CUTOFF)


@pytest.mark.parametrize("ends, length", [(("mirror", "mirror"), 0.5), (("periodic",) * 2, 1.0)])
def test_waves(ends, length):
    """Slope and curvature of long waves; a wave of the cut-off length counts half."""
    found = line(ends, 300, length * PERIOD)
    for waves in (1, 2):
        k = 2.0 * np.pi * waves / PERIOD
        wave = np.cos(k * found.centers())
        found.height = 1e-12 * wave
        assert found.curvature == pytest.approx(1e-12 * k**2 * wave, abs=1e-16 * k**2)
        assert found.slopes[0] == pytest.approx(
            -1e-12 * k * np.sin(k * found.centers()), abs=1e-16 * k
        )
    found = line(ends, 300, length * 10.0 * CUTOFF)
    wave = np.cos(2.0 * np.pi * found.centers() / CUTOFF)
    assert found.smooth(wave) == pytest.approx(0.5 * wave, abs=6e-3)


@pytest.mark.parametrize("waves", [1, 2, 5, 10, 17, 29])
def test_every_wave_is_pulled_back(waves):
    """The curvature of a crest is positive for long and short waves alike."""
    found = line(count=60, length=0.5e-6)
    wave = np.cos(np.pi * waves * found.centers() / 0.5e-6)
    found.height = 1e-10 * wave
    assert found.curvature @ wave > 0.0


def test_order():
    """The error of the curvature falls as the fourth power of the width of the columns."""
    errors = []
    for count in (20, 40):
        found = line_of(0.0, 0.5 * PERIOD / count, count, ("mirror",) * 2, 0.6e-6)
        k = 2.0 * np.pi / PERIOD
        found.height = 1e-12 * np.cos(k * found.centers())
        kept = 1.0 / (1.0 + (0.6e-6 / PERIOD) ** (2 * ORDER))
        exact = 1e-12 * k**2 * np.cos(k * found.centers())
        errors.append(np.abs(found.curvature / kept - exact).max())
    assert errors[1] < errors[0] / 14.0


def test_velocity_across_a_plane_of_symmetry():
    """An odd field goes through zero there, and keeps its slope."""
    found = line()
    k = 2.0 * np.pi / PERIOD
    u = np.sin(k * found.centers())
    assert found.smooth(u, ODD_PARITY) == pytest.approx(u, abs=1e-6)
    assert found.derivative(u, ODD_PARITY) == pytest.approx(
        k * np.cos(k * found.centers()), abs=1e-6 * k
    )


def matrix_of(found, respond):
    """Matrix of a linear response to the heights of a line whose pins are at 0."""
    columns = []
    for unit in np.eye(found.count):
        found.height = 1e-15 * unit
        columns.append(respond(found) / 1e-15)
    return np.array(columns).T


@pytest.mark.parametrize("count", [125, 250, 500])
def test_arc_between_pinned_ends(count):
    """A drop of chord 2 um and height 300 nm, R = 1.8166667 um: curvature 1/R, within 2 % at the
    ends."""
    half, sagitta = 1e-6, 3e-7
    radius = (half**2 + sagitta**2) / (2.0 * sagitta)
    found = line_of(-half, 2.0 * half / count, count, ("pinned", "pinned"), CUTOFF)
    edges = np.linspace(-half, half, count + 1)
    area = 0.5 * (edges * np.sqrt(radius**2 - edges**2) + radius**2 * np.arcsin(edges / radius))
    found.height = np.diff(area) / found.widths[0] - (radius - sagitta)
    inside = np.abs(found.centers()) < half - CUTOFF / 2
    assert found.curvature == pytest.approx(1.0 / radius, rel=0.02)
    assert found.curvature[inside] == pytest.approx(1.0 / radius, rel=0.002)
    # the same arc 5 nm higher than its ends are held is pulled down beside them
    found.height = found.height + 5e-9
    assert found.curvature[0] > 1.05 / radius and found.curvature[-1] > 1.05 / radius


def growth(count, width, thickness):
    """Fastest growth of capillary waves on a thin film of steel beside a pin [1/s].

    dQ/dt = -(h/rho) d(gamma kappa)/dx - 3 nu Q/h^2 with the thickness h and no Q through the ends,
    and the damping of the line.
    """
    tension, density, viscosity = 1.7, 6900.0, 1e-6
    found = line_of(0.0, width, count, ("mirror", "pinned"), cutoff_of(width))

    def response(rate):
        columns = []
        for unit in np.eye(count):
            found.height = 1e-15 * unit
            columns.append(rate() / 1e-15)
        return np.array(columns).T

    def damped():
        before = found.height
        found.damp_short_waves(1.0)
        return found.height - before

    damping = fastest_wave(tension, density, found.cutoff) * response(damped)
    gradient = np.diff(np.eye(count), axis=0) / width
    push = -thickness / density * gradient @ (tension * response(lambda: found.curvature))
    friction = 3.0 * viscosity / thickness**2 * np.eye(count - 1)
    return np.linalg.eigvals(np.block([[damping, gradient.T], [push, -friction]])).real.max()


@pytest.mark.parametrize("count, width", [(35, 32e-9), (46, 24e-9), (69, 16e-9), (24, 100e-9)])
@pytest.mark.parametrize("rows", [3, 4])
def test_waves_beside_a_pin_do_not_grow(count, width, rows):
    """Whatever the columns: none of them, but for rounding."""
    assert growth(count, width, rows * width) < 1e4


def test_smoother_ends_let_waves_grow(monkeypatch):
    """With fifth differences waves beside a pin grow tenfold in the life of a pool, 50 ns."""
    monkeypatch.setattr(smoothing, "PINNED_ORDER", ORDER)
    assert growth(46, 24e-9, 4 * 24e-9) > np.log(10.0) / 50e-9


@pytest.mark.parametrize(
    "ends", [("mirror", "mirror"), ("periodic", "periodic"), ("pinned", "mirror")]
)
def test_volume(ends):
    """Fluxes and damping move volume and make none."""
    rng = np.random.default_rng(1)
    found = line(ends)
    flux = rng.normal(size=159)
    flux[[0, -1]] = 0.0
    found.height = found.heights_after(1e-9, flux)
    found.damp_short_waves(0.3)
    moved = np.abs(found.height).sum()
    assert moved > 0.0 and abs(found.height.sum()) < 1e-12 * moved


@pytest.mark.parametrize("length", [1.0, 0.3, 0.1])
def test_damping_of_waves(length):
    """At 1 um damping takes 5.9e-6 of a wave, at 0.3 um half, at 0.1 um nearly all."""
    found = line(length=3e-6, count=375)
    wave = np.cos(2.0 * np.pi * found.centers() / (length * 1e-6))
    found.height = wave.copy()
    found.damp_short_waves(1.0)
    ratio = (0.3 / length) ** (2 * ORDER)
    lost = (wave - found.height) @ wave / (wave @ wave)
    assert lost == pytest.approx(ratio / (1.0 + ratio), rel=0.02)


def test_fine_columns():
    """At columns of 4 nm smoothing still keeps long waves to 1e-5."""
    found = line(count=625)
    wave = np.cos(2.0 * np.pi * found.centers() / PERIOD)
    assert found.smooth(wave) == pytest.approx(wave, abs=1e-5)


def test_cutoff_follows_coarse_columns():
    """0.3 um, or six columns."""
    assert cutoff_of(8e-9) == 0.3e-6 and cutoff_of(1e-6) == pytest.approx(6e-6)


def test_first_harmonic():
    """Over half a period and over a whole one."""
    for ends, length in ((("mirror", "mirror"), 0.5), (("periodic", "periodic"), 1.0)):
        found = line(ends, 100, length * PERIOD)
        k = 2.0 * np.pi / PERIOD
        found.height = 3e-9 * np.cos(k * found.centers()) * np.sinc(found.widths[0] / PERIOD) + 1e-9
        assert found.first_harmonic(PERIOD) == pytest.approx(3e-9, rel=1e-3)


def test_binomial_sums_go_around_a_period():
    """A column at each end sees the two beyond it at the other end; a line turned is the same."""
    found = line(("periodic", "periodic"), 12)
    values = np.zeros(12)
    values[0], values[1] = 16.0, 32.0
    everywhere = np.ones(12, bool)
    means = found.mean_of_neighbors(values, everywhere)
    # weights 1, 4, 6, 4, 1 over their sum
    assert means[-2:] == pytest.approx([1.0, 4.0 + 2.0])
    assert means[:4] == pytest.approx([6.0 + 8.0, 4.0 + 12.0, 1.0 + 8.0, 2.0])
    for shift in (1, 5, 11):
        turned = found.mean_of_neighbors(np.roll(values, shift), everywhere)
        assert turned == pytest.approx(np.roll(means, shift))
