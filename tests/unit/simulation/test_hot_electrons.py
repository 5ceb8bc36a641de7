"""What check says of light on hot electrons, beside the run and beside cold metal."""

import pytest
from short_pulses import case_of, go, solver_of

from lasersph.case import load_case
from lasersph.materials.hot_optics import HotOptics
from lasersph.physics.ablation_estimates import skin_fluence
from lasersph.simulation.case_forecast import skin_estimate
from lasersph.simulation.forecast import forecast
from lasersph.simulation.hot_electrons import (
    mean_reflectivity,
    optics_of_hot_electrons,
    vaporizing_fluence,
)


def optics_of(case) -> HotOptics:
    """Its optics of hot electrons."""
    found = optics_of_hot_electrons(case)
    assert found is not None
    return found


def test_skin_of_cold_metal():
    """Electrons that change nothing: rho h_v d / A, as with cold metal, and R of cold metal."""
    case = load_case("short-pulse-gold", ["material.electrons.plasma_frequency=1 rad/s"])
    optics = optics_of(case)
    R, depth = (float(one) for one in optics.at(300.0, 300.0))
    assert mean_reflectivity(case, optics) == pytest.approx(R, rel=1e-9)
    expected = skin_fluence(depth, 3e10, 1.0 - R)
    assert vaporizing_fluence(case, optics, 3e10) == pytest.approx(expected, rel=1e-9)


def test_mean_beside_the_run(tmp_path):
    """The skin that keeps its heat is hotter than the metal: R lies below that of the run, by less
    than a tenth of what is absorbed."""
    case = load_case("short-pulse-gold", ["particles.spacing=5nm"])
    solver = solver_of(case)
    go(solver, 1e-12)
    seen = solver.state.energy
    found = 1.0 - mean_reflectivity(case, optics_of(case))
    assert 1.0 < found / (seen["absorbed"] / seen["incident"]) < 1.1


def test_who_has_hot_optics(tmp_path):
    """None with one temperature, with a reflectivity of the laser, and without light."""
    assert optics_of_hot_electrons(case_of(tmp_path)) is None
    for change in ("solver.heat=one-temperature", "laser.reflectivity=0.7", "laser="):
        given = [change, "boundaries.surface=fixed-temperature"] if change == "laser=" else [change]
        given += ["boundaries.surface_temperature=500 K"] if change == "laser=" else []
        assert optics_of_hot_electrons(load_case("short-pulse-gold", given)) is None


def test_check_says_so():
    """`lasersph check` names the reflectivity of hot electrons, and a skin that takes less."""
    case = load_case("short-pulse-gold")
    text = str(forecast(case))
    assert "with hot electrons, in the mean over the pulse" in text
    cold = skin_estimate(load_case("short-pulse-gold", ["laser.reflectivity=0.706"]))
    hot = skin_estimate(case)
    assert hot is not None and cold is not None and hot < 0.6 * cold
