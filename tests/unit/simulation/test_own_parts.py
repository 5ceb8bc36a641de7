"""Observers and recipes of one's own, handed to a run from Python."""

import pytest

from lasersph.case import load_case
from lasersph.observers import Observer, Quantity
from lasersph.output import FolderRefused, open_run
from lasersph.simulation import Stopped, run
from lasersph.simulation.recipes import ConductionRecipe

CASE = ("particles.spacing=2um", "time.end=200ns", "time.step=5ns")


class Coldest(Observer):
    """The lowest temperature."""

    columns = (Quantity("temperature_min_K", "K", "lowest temperature", end="coldest.end_K"),)

    def observe(self, view):
        """At this step."""
        return self.record(view.time, (float(view.temperature.min()),))


class OwnRecipe(ConductionRecipe):
    """As the ordinary one."""


def test_own_observer_survives_a_stop(tmp_path):
    """Its column and its part of the summary are there, also after a stop and a resumption."""
    case, steps = load_case("stefan", CASE), iter(range(1, 100))
    with pytest.raises(Stopped):
        run(case, tmp_path, observers=[Coldest()], should_stop=lambda: next(steps) == 10)
    result = run(case, tmp_path, observers=[Coldest()], resume=True)
    column = open_run(tmp_path).history["temperature_min_K"]
    assert len(column) == result.summary["steps"] + 1
    assert result.summary["coldest"]["end_K"] == column[-1]


def test_own_column_twice(tmp_path):
    """Two observers that fill the same column are refused before anything is written."""
    with pytest.raises(ValueError, match="same history column"):
        run(load_case("stefan", CASE), tmp_path / "run", observers=[Coldest(), Coldest()])
    assert not (tmp_path / "run").exists()


def test_own_recipe_is_remembered(tmp_path):
    """A run is not resumed by another recipe than the one it was started with."""
    case = load_case("stefan", CASE)
    with pytest.raises(Stopped):
        run(case, tmp_path, recipe=OwnRecipe, should_stop=lambda: True)
    with pytest.raises(FolderRefused, match="another case"):
        run(case, tmp_path, resume=True)
    assert run(case, tmp_path, recipe=OwnRecipe, resume=True).summary["steps"] > 1
