"""Spots with columns that grow beside them: the same heat and the same pool as in fine columns."""

import numpy as np
import pytest
from gaussian_heat import gaussian_source

from lasersph import open_run, run
from lasersph.case import load_case
from lasersph.simulation.forecast import forecast
from lasersph.solvers.step_control import StepFailed

HEAT = """
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
width = "120 um"
depth = "100 um"
[particles]
spacing = "4 um"
arrangement = "graded"
ratio = 0.9
coarsest = "20 um"
fine_depth = "60 um"
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
SPACE = ("solver.geometry=planar", "solver.dimensions=3", "domain.width=200 um",
         "domain.extent=half", "domain.depth=60 um", "particles.kernel=cubic-spline",
         "particles.coarsest=10 um", "time.step=100 ns", "time.end=1 us")  # fmt: skip
PLANE = ("solver.geometry=planar", "domain.width=240 um")
POOL = ("particles.spacing=32 nm", "time.step=200 ps", "time.end=26 ns",
        "output.snapshots.interval=26 ns")  # fmt: skip
FLAT = ("solver.geometry=planar", "domain.extent=half", "domain.width=16 um",
        "solver.flow.surface=flat")  # fmt: skip
MOVING = (*FLAT, "solver.flow.surface=moving", "material=steel-316l", "laser.reflectivity=0.3",
          "laser.absorption={ kind = 'surface' }", "time.end=24 ns")  # fmt: skip


def heated(folder, *settings):
    """Summary and last snapshot of the source, with settings."""
    folder.mkdir()
    file = folder / "spot.toml"
    file.write_text(HEAT)
    run(load_case(file, settings), folder / "run", threads=1)
    found = open_run(folder / "run")
    return found.summary, found.snapshots[-1]


def near(step, radius):
    """Temperatures by place [nm] within a radius of the axis and 20 um of the surface."""
    x, T = step["position"], step["temperature"]
    chosen = np.all(np.abs(x[:-1]) < radius, axis=0) & (x[-1] > -2e-5)
    places = (tuple(place) for place in np.rint(1e9 * x[:, chosen]).astype(int).T.tolist())
    return dict(zip(places, T[chosen], strict=True))


@pytest.mark.parametrize("name", ["section", "plane", "space"])
def test_fine_part_as_among_fine_columns(name, tmp_path):
    """1e-3 of the rise at most, with a third of the particles; energy is kept to rounding."""
    settings = {"section": (), "plane": PLANE, "space": SPACE}[name]
    whole, fine = heated(tmp_path / "whole", *settings)
    part, coarse = heated(tmp_path / "part", "particles.fine_width=40 um", *settings)
    assert coarse["position"].shape[1] < 0.75 * fine["position"].shape[1]
    expected, found = near(fine, 3.2e-5), near(coarse, 3.2e-5)
    places = sorted(expected.keys() & found.keys())
    assert len(places) > 30
    one, other = (np.array([values[k] for k in places]) for values in (expected, found))
    assert np.abs(other - one).max() < 1e-3 * (one.max() - 300.0)
    assert part["energy"]["imbalance_relative"] < 1e-12
    assert part["energy"]["absorbed_J"] == pytest.approx(whole["energy"]["absorbed_J"], rel=2e-4)


def test_second_order_beside_coarse_columns(tmp_path):
    """Against the closed form, with columns that grow half as fast where they are half as wide."""
    errors = []
    for k in (1, 2):
        _, step = heated(
            tmp_path / f"{k}", f"particles.spacing={4 / k} um", "particles.fine_width=40 um",
            f"particles.ratio={0.9 ** (1 / k)}", f"particles.coarsest={20 / k} um",
            f"time.step={25.6 / k**2} ns",
        )  # fmt: skip
        (r, z), T = step["position"], step["temperature"]
        inner = (r < 4e-5) & (z > -6e-5)
        error = T[inner] - gaussian_source(r[inner], z[inner], 2e-6)
        errors.append(np.sqrt(np.average(error**2, weights=r[inner])))
    assert np.log(errors[0] / errors[1]) / np.log(2.0) > 1.8


@pytest.mark.slow
@pytest.mark.parametrize("name", ["section", "flat", "moving"])
def test_the_same_pool(name, tmp_path):
    """What flows does not see the columns beside it: 1e-6 of volume, speed, temperature."""
    settings = (*POOL, *{"section": (), "flat": FLAT, "moving": MOVING}[name])
    found = []
    for width in ("8 um", "3 um" if name == "moving" else "2.3 um"):
        case = load_case("spot-steel", (*settings, f"particles.fine_width={width}"))
        found.append(run(case, tmp_path / width[0], threads=1).summary)
    whole, part = found
    assert part["particles"] < 0.7 * whole["particles"]
    for section, key in (
        ("melt", "volume_max_m3"),
        ("melt", "depth_half_max_m"),
        ("flow", "speed_max_m_s"),
        ("energy", "absorbed_J"),
    ):
        assert part[section][key] == pytest.approx(whole[section][key], rel=1e-6), key
    assert part["temperature_max_K"] == pytest.approx(whole["temperature_max_K"], rel=1e-7)
    # rows that see coarse columns keep their pairs: what one loses another one gains
    imbalances = [one["energy"]["imbalance_relative"] for one in found]
    assert imbalances[1] == pytest.approx(imbalances[0], rel=0.02)
    if name == "moving":
        depths = [one["topography"]["depth_m"] for one in found]
        assert depths[1] == pytest.approx(depths[0], rel=1e-5)


def test_a_pool_that_comes_too_close_is_refused(tmp_path):
    """With the place and the width to give, with which the run goes on."""
    case = load_case("spot-steel", (*POOL, "particles.fine_width=2 um"))
    with pytest.raises(StepFailed, match="flows too close to columns") as told:
        run(case, tmp_path / "run", threads=1)
    remedy = str(told.value).partition('give particles.fine_width = "')[2].partition('"')[0]
    assert 2e3 < float(remedy.removesuffix(" nm")) < 3e3


def test_a_dot_that_comes_too_close_is_refused(tmp_path):
    """In 3-D, too, with the axis, and with the checkpoint that was there."""
    settings = (
        "particles.spacing=125 nm", "domain.depth=1.5 um", "particles.fine_depth=625 nm",
        "particles.coarsest=150 nm", "particles.fine_width=1.25 um", "laser.fluence=0.3 J/cm^2",
        "laser.pulse.center=25 ns", "time.step=1 ns", "time.end=40 ns",
        "output.checkpoint_every=5",
    )  # fmt: skip
    case = load_case("texture-dots-steel", settings)
    with pytest.raises(StepFailed, match=r"the melt at x = \S+ nm flows too close to columns"):
        run(case, tmp_path / "run", threads=1)
    assert any((tmp_path / "run" / "checkpoint").iterdir())


def test_a_hundred_pools_wide_at_the_cost_of_two():
    """By default, where a spot melts: 150 um with as many particles and a quarter."""
    narrow = forecast(load_case("spot-steel"))
    wide = forecast(load_case("spot-steel", ("domain.width=150 um", "particles.coarsest=8 um")))
    assert narrow.fine_width == pytest.approx(2.85e-6, rel=0.02)
    assert wide.fine_width == pytest.approx(narrow.fine_width, rel=1e-9)
    assert wide.particles < 1.25 * narrow.particles
    assert "out to 2.848 um from the axis" in str(narrow)
    # all are fine where nothing melts, or where it is not known
    cold = forecast(load_case("spot-steel", ("laser.fluence=0.05 J/cm^2",)))
    assert cold.fine_width is None
