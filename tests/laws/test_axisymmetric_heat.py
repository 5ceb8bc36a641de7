"""Heat in a section (r, z): the closed form of a Gaussian source, a strip far out, and 3-D."""

import numpy as np
import pytest
from gaussian_heat import gaussian_source

from lasersph import open_run, run
from lasersph.case import load_case

CASE = """
material = "aluminium-aa6014"
initial_temperature = "300 K"
[laser]
intensity = "1.0e10 W/m^2"
fluence_kind = "peak"
beam = { kind = "gaussian", radius_1e2 = "20 um" }
pulse = { kind = "square", duration = "2 us" }
absorption = { kind = "beer-lambert", absorption_coefficient = "1e5 1/m" }
reflectivity = 0
[domain]
width = "80 um"
depth = "100 um"
[particles]
spacing = "4 um"
[boundaries]
emissivity = 0
[solver]
dimensions = 2
geometry = "axisymmetric"
phase_change = false
[time]
end = "2 us"
step = "25.6 ns"
"""
RING = "laser.beam={ kind = 'ring', radius = '420 um', inner_radius = '380 um' }"
STRIP = "laser.beam={ kind = 'top-hat', radius = '20 um' }"


def computed(folder, *settings):
    """Summary and last snapshot of the case with settings."""
    folder.mkdir()
    file = folder / "spot.toml"
    file.write_text(CASE)
    run(load_case(file, settings), folder / "run", threads=1)
    found = open_run(folder / "run")
    return found.summary, found.snapshots[-1]


@pytest.fixture(scope="module")
def coarse(tmp_path_factory):
    """The case at 4 um."""
    return computed(tmp_path_factory.mktemp("rz") / "coarse")


def error_of(step):
    """Root mean square error over the body [K], and the largest error over the largest rise."""
    (r, z), T = step["position"], step["temperature"]
    error = T - gaussian_source(r, z, 2e-6)
    return np.sqrt(np.average(error**2, weights=r)), np.abs(error).max() / (T.max() - 300.0)


def test_energy_of_a_pulse(coarse):
    """The whole revolution takes up I t pi w^2/2 but for what passes the bottom, and keeps it."""
    energy, taken = coarse[0]["energy"], 2e4 * 0.5 * np.pi * 4e-10 * (1.0 - np.exp(-10.0))
    assert energy["absorbed_J"] == pytest.approx(taken, rel=1e-9)
    assert energy["imbalance_relative"] < 1e-12
    assert energy["unit"] == "J"


def test_converges_to_the_closed_form(coarse, tmp_path):
    """Of second order, steps as the square of the spacing; w/12: 0.5 % of the rise anywhere."""
    ratio = 2.4
    settings = f"particles.spacing={4.0 / ratio!r} um", f"time.step={25.6 / ratio**2!r} ns"
    fine = computed(tmp_path / "fine", *settings)
    (first, _), (second, largest) = error_of(coarse[1]), error_of(fine[1])
    assert np.log(first / second) / np.log(ratio) > 1.8
    assert largest < 5e-3


def test_the_axis_makes_no_flaw(coarse):
    """Temperatures fall from the axis outward, in every row."""
    (r, z), T = coarse[1]["position"], coarse[1]["temperature"]
    top = z > -2.1e-6
    assert np.all(np.diff(T[top][np.argsort(r[top])]) < 0.0)


def test_far_from_the_axis_a_ring_is_a_strip(tmp_path):
    """40 um wide, 400 um out: the mean of what lies inward and outward is the plane's."""
    wide = ("domain.width=500 um", "particles.spacing=5 um")
    _, ring = computed(tmp_path / "ring", *wide, RING, "laser.fluence_kind=")
    _, strip = computed(
        *(tmp_path / "strip", STRIP, "laser.fluence_kind=", "particles.spacing=5 um"),
        *("domain.width=200 um", "solver.geometry=planar"),
    )
    r, T = ring["position"][0], ring["temperature"]
    near = np.abs(r - 4e-4) < 1e-4
    mirrored = 0.5 * (T[near].reshape(-1, 40) + T[near].reshape(-1, 40)[:, ::-1])
    plane = strip["temperature"].reshape(-1, 40)
    assert np.abs(mirrored - plane).max() < 1e-3 * (plane.max() - 300.0)


def test_agrees_with_space(coarse, tmp_path):
    """The same spot in 3-D at the same spacing."""
    cube = ("solver.dimensions=3", "solver.geometry=planar", "domain.width=120 um")
    summary, _ = computed(
        *(tmp_path / "cube", *cube, "particles.spacing=5 um", "domain.extent=half"),
        *("domain.depth=45 um", "time.step=80 ns", "time.end=1 us"),
    )
    section, _ = computed(
        *(tmp_path / "section", "particles.spacing=5 um", "domain.width=60 um"),
        *("domain.depth=45 um", "time.step=80 ns", "time.end=1 us"),
    )
    rise = [one["temperature_max_K"] - 300.0 for one in (summary, section)]
    assert rise[0] == pytest.approx(rise[1], rel=1e-2)


def test_melt_of_a_gaussian_spot(tmp_path):
    """Steel under 0.95 J/cm^2 in 10 ns, w = 2.5 um, at 32 nm, beside finite volumes in (r, z).

    Those (12.5 nm along r, 1 nm along z) have 0.7346 um^3 of melt and f_m = 0.5 at 205.2 nm; the
    flow that they have changes the depth by 0.3 nm and the volume not at all. Bands, set before:
    2 % of the volume, 3 % of the depth.
    """
    file = tmp_path / "spot.toml"
    file.write_text(
        'material = "steel-304-demuth"\n[domain]\nwidth = "8 um"\ndepth = "4 um"\n'
        '[particles]\nspacing = "32 nm"\narrangement = "graded"\n'
        '[laser]\nfluence = "0.95 J/cm^2"\nfluence_kind = "peak"\n'
        'absorption = { kind = "beer-lambert" }\n'
        'beam = { kind = "gaussian", radius_1e2 = "2.5 um" }\n'
        'pulse = { kind = "gaussian", fwhm = "10 ns", center = "20 ns" }\n'
        '[solver]\ngeometry = "axisymmetric"\n[time]\nend = "32 ns"\n'
    )
    melt = run(load_case(file), tmp_path / "run", threads=1).summary["melt"]
    assert melt["volume_max_m3"] == pytest.approx(0.7346e-18, rel=0.02, abs=0.0)
    assert melt["depth_half_max_m"] == pytest.approx(205.2e-9, rel=0.03)
