"""Fluence threshold on a run whose temperature is proportional to its energy."""

from types import SimpleNamespace

import pytest

from lasersph.cli import main
from lasersph.input import Model
from lasersph.lasers import Laser
from lasersph.materials import Material, load_material
from lasersph.output.study_mark import read_mark
from lasersph.studies import threshold
from lasersph.studies.fluence_threshold import Threshold, Trial, show_energy, usual_runs

STEEL = load_material("steel-304-demuth")
MELTS, BOILS = 3000.0, 7000.0  # fluences at which the stand-in reaches liquidus and boiling point


class SmallCase(Model):
    """A case as far as the study looks at it."""

    laser: Laser
    material: Material = STEEL


def case(**energy):
    """A uniform square pulse."""
    pulse = {"kind": "square", "duration": 1e-8}
    return SmallCase(laser=Laser(pulse=pulse, absorption={"kind": "surface"}, **energy))


def run(case, folder):
    """Melts at MELTS, boils at BOILS (J/m2), the temperature held at the boiling point."""
    fluence = case.laser.mean_fluence
    hottest = min(300.0 + fluence / BOILS * (3273.0 - 300.0), 3273.0)
    melt = {"start_s": 1e-8 if fluence >= MELTS else None}
    return SimpleNamespace(summary={"temperature_max_K": hottest, "melt": melt})


@pytest.mark.parametrize("guess", [1e2, 2.9e3, 1e5])
@pytest.mark.parametrize(("of", "value"), [("melt", MELTS), ("vaporize", BOILS)])
def test_threshold_is_bracketed_from_any_guess(tmp_path, of, value, guess):
    """From far below, nearby and far above; the bracket holds it within the tolerance."""
    found = threshold(case(fluence=guess), of, tmp_path, tolerance=0.005, run=run)
    assert found.below < value <= found.above
    assert found.value == pytest.approx(value, rel=0.005)
    assert found.tolerance <= 0.005
    assert found.key == "laser.fluence"
    assert found.trials[0].value == guess
    assert len(found.trials) < 22


def test_the_cases_own_energy_is_varied(tmp_path):
    """A case given by intensity gets its threshold as an intensity; each run has its folder."""
    folders, lines = [], []

    def remember(case, folder):
        folders.append(folder.name)
        return run(case, folder)

    found = threshold(
        case(intensity=1e11), "melt", tmp_path, bracket=(5e11, 1e11), run=remember,
        report=lines.append,
    )  # fmt: skip
    assert found.key == "laser.intensity"
    assert found.value == pytest.approx(MELTS / 1e-8, rel=0.01)
    assert folders[:2] == ["intensity-10000000", "intensity-50000000"]
    assert lines[0].startswith("run 1: laser.intensity = 1.0000e+07 W/cm^2: 724.7 K, not reached")


@pytest.mark.parametrize("guess", [1e2, 2.9e3, 1e5])
def test_several_at_a_time_go_the_same_way(tmp_path, guess):
    """What is made ahead is what comes: three at a time need half the rounds for the same trials,
    and what lies there complete is made no more."""
    alone = threshold(case(fluence=guess), "melt", tmp_path, run=run)
    rounds = []

    def prepare(cases):
        rounds.append(len(cases))
        for folder in cases:
            folder.mkdir(exist_ok=True)
            (folder / "summary.json").touch()

    def run_prepared(case, folder):
        assert (folder / "summary.json").exists()
        return run(case, folder)

    options = {"run": run_prepared, "prepare": prepare, "at_once": 3}
    assert threshold(case(fluence=guess), "melt", tmp_path, **options) == alone
    assert max(rounds) == 3 and len(rounds) <= len(alone.trials) // 2 + 1
    before = len(rounds)
    assert threshold(case(fluence=guess), "melt", tmp_path, **options) == alone
    assert len(rounds) == before


def test_wrong_bracket_and_no_bracket_are_said(tmp_path):
    """A bracket that holds nothing; a threshold farther away than allowed."""
    with pytest.raises(ValueError, match="do not bracket"):
        threshold(case(fluence=1.0), "melt", tmp_path, bracket=(4e3, 5e3), run=run)
    with pytest.raises(ValueError, match="lies above"):
        threshold(case(fluence=1.0), "melt", tmp_path, largest_factor=16.0, run=run)
    with pytest.raises(ValueError, match="lies below"):
        threshold(case(fluence=1e6), "melt", tmp_path, largest_factor=16.0, run=run)


def test_impossible_events_are_refused_before_any_run(tmp_path):
    """A material without melting data, an unknown event, a silly tolerance."""
    bare = case(fluence=1.0).model_copy(
        update={"material": STEEL.model_copy(update={"melting": None, "vaporization": None})}
    )
    for of in ("melt", "vaporize"):
        with pytest.raises(ValueError, match=f"no threshold to {of}"):
            threshold(bare, of, tmp_path, run=None)
    with pytest.raises(ValueError, match='choose "melt", "vaporize", "ablate" or "explode"'):
        threshold(case(fluence=1.0), "burn", tmp_path, run=None)
    with pytest.raises(ValueError, match="tolerance"):
        threshold(case(fluence=1.0), "melt", tmp_path, tolerance=0.0, run=run)


def test_usual_runs_are_what_a_near_guess_takes(tmp_path):
    """Within a factor of 2 of the threshold, for several tolerances."""
    for tolerance in (0.1, 0.01, 0.001):
        for guess in (1.6e3, 2.9e3, 5.6e3):
            folder = tmp_path / f"{tolerance}-{guess}"
            found = threshold(case(fluence=guess), "melt", folder, tolerance=tolerance, run=run)
            assert abs(len(found.trials) - usual_runs(tolerance)) <= 1


def test_energies_are_shown_to_as_many_digits():
    """In a column of trials, whatever the last digits are."""
    shown = [show_energy("laser.fluence", value) for value in (2625.0, 2437.5, 2343.75)]
    assert shown == ["0.26250 J/cm^2", "0.24375 J/cm^2", "0.23438 J/cm^2"]
    assert show_energy("laser.pulse_energy", 12345.0) == "12345 J"


def test_page_of_a_threshold_tells_its_answer(tmp_path, monkeypatch):
    """The title of the folder's mark ends in the value with its error, and says which fluence."""
    trials = (Trial(2340.0, False, 1700.0), Trial(2390.0, True, 1728.0))
    found = Threshold("melt", "laser.fluence", 2340.0, 2390.0, trials)
    monkeypatch.setattr("lasersph.studies.threshold", lambda *_, **__: found)
    assert main(["threshold", "dlip-steel", "--of", "melt", "--out", str(tmp_path / "t")]) == 0
    mark = read_mark(tmp_path / "t")
    assert mark.title == (
        "threshold of dlip-steel to melt: 0.2365 ± 0.0025 J/cm², mean over a period"
    )
