"""D^2 over ln F on runs whose craters follow Liu's line."""

from types import SimpleNamespace

import numpy as np
import pytest

from lasersph.case import load_case
from lasersph.plots.spot_threshold import spot_threshold_figure
from lasersph.studies import SpotCrater, no_spot, spot_threshold, threshold
from lasersph.studies.spot_threshold import fit

BEAM = 'laser.beam={kind="gaussian", diameter_1e2="10 um"}'
THRESHOLD, RADIUS = 3e4, 5e-6


@pytest.fixture(scope="module")
def case():
    """A Gaussian spot of 10 um."""
    return load_case("ablation-depth", [BEAM, "laser.fluence_kind=peak", "solver.dimensions=3"])


def run(case, folder):
    """A crater of Liu's diameter; one cubic micrometer removed for each squared one of D^2."""
    fluence = case.laser.fluence
    square = max(2.0 * RADIUS**2 * np.log(fluence / THRESHOLD), 0.0)
    crater = {"diameter_m": np.sqrt(square), "depth_m": 1e-6, "removed_volume_m3": 1e-6 * square,
              "volume_unit": "m^3"}  # fmt: skip
    ejecta = {"count": int(fluence > THRESHOLD)}
    energy = {"incident_J": 0.5 * np.pi * RADIUS**2 * fluence}
    summary = {"crater": crater, "ejecta": ejecta, "energy": energy, "temperature_max_K": 2730.0}
    return SimpleNamespace(summary=summary)


def test_threshold_and_radius_are_found(case, tmp_path):
    """Runs below the threshold leave no crater and do not bend the line."""
    lines = []
    found = spot_threshold(case, [2e5, 1e4, 5e4, 1e5], tmp_path, run=run, report=lines.append)
    assert found.threshold == pytest.approx(THRESHOLD)
    assert found.radius == pytest.approx(RADIUS) == found.beam_radius
    assert found.scatter < 1e-20
    assert [one.fluence for one in found.craters] == [1e4, 5e4, 1e5, 2e5]
    assert found.craters[0].efficiency == 0.0
    assert len(found.table()[0]) == 4 == len(lines)
    assert "threshold 3 J/cm2" in found.answer()
    assert SpotCrater(1e5, 1e-6, 1e-6, 2e-12, 1.0, "m^2").shown_volume == "2 um2"
    assert len(spot_threshold_figure(found.as_dict()).axes) == 2


def test_threshold_of_ablation(case, tmp_path):
    """Bisection on whether anything left."""
    found = threshold(case, "ablate", tmp_path, tolerance=0.01, run=run)
    assert found.below <= THRESHOLD <= found.above


def test_what_is_refused(case, tmp_path):
    """No spot, no peak fluence, one fluence, craters that do not grow."""
    assert "nothing is ablated" in no_spot(load_case("pulsed-heating"), [1.0, 2.0])
    assert "gaussian beam" in no_spot(load_case("ablation-depth"), [1.0, 2.0])
    mean = load_case("ablation-depth", [BEAM, "laser.fluence_kind=mean", "solver.dimensions=2"])
    assert "peak" in no_spot(mean, [1.0, 2.0])
    with pytest.raises(ValueError, match="different fluences"):
        spot_threshold(case, [1e5, 1e5], tmp_path, run=run)
    with pytest.raises(ValueError, match="left a crater"):
        spot_threshold(case, [1e4, 1e5], tmp_path, run=run)
    with pytest.raises(ValueError, match="do not grow"):
        fit([1.0, 2.0], [2.0, 1.0])
