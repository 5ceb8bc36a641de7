"""Volumes, areas, masses and energies of half a period, half and a quarter of a spot are those of
the whole, in history and summary; each particle of a snapshot keeps its own mass."""

import numpy as np
import pytest
from law_runs import go, solver_of

from lasersph import load_case, open_run, run
from lasersph.observers.melt_pool import MeltPool
from lasersph.simulation.recipes import recipe_of

PERIOD = ("particles.spacing=125nm", "particles.arrangement=uniform", "particles.ratio=",
          "domain.depth=4.5um", "time.step=0.5ns", "time.end=70ns", "output.history_every=1",
          "solver.kind=conduction")  # fmt: skip
SPOT = ("laser.beam={kind='gaussian', radius_1e2='2.5um'}", "laser.fluence_kind=peak",
        "laser.fluence=4 J/cm^2", "domain.depth=2um", "particles.spacing=0.5um",
        "particles.coarsest=0.5um", "time.step=1ns")  # fmt: skip


def test_half_a_period(tmp_path):
    """All amounts of half a period agree with those of the whole one, at each step and at the end;
    its own particles hold half of the heat."""
    found = {}
    for extent in ("full", "half"):
        case = load_case("dlip-steel", (*PERIOD, f"domain.extent={extent}"))
        run(case, tmp_path / extent, threads=1, warn=False)
        found[extent] = open_run(tmp_path / extent)
    whole, half = found["full"], found["half"]
    assert (whole.summary["mirror_images"], half.summary["mirror_images"]) == (1, 2)
    assert whole.summary["melt"]["volume_max_m3"] > 1e-13
    volumes = [one.summary["melt"]["volume_max_m3"] for one in (half, whole)]
    assert volumes[0] == pytest.approx(volumes[1], rel=1e-5, abs=0.0)
    for name in ("incident", "absorbed", "stored", "latent", "lost"):
        column = f"energy_{name}_J"
        largest = np.abs(whole.history[column]).max()
        assert half.history[column] == pytest.approx(whole.history[column], abs=1e-5 * largest)
        assert half.summary["energy"][f"{name}_J"] == half.history[column][-1]
    assert half.summary["energy"]["imbalance_relative"] < 1e-9
    last = half.snapshots[-1]
    heat = float(np.sum(last["mass"] * last["enthalpy"]))
    assert 2.0 * heat == pytest.approx(half.summary["energy"]["stored_J"], rel=1e-9, abs=0.0)


def test_half_and_quarter_of_a_spot():
    """Of a spot in 3-D whose axis lies on a plane of symmetry, or on two."""
    parts = {
        "whole": ("domain.width=8um", "domain.breadth=8um", "domain.extent=full"),
        "half": ("domain.width=8um", "domain.breadth=8um"),
        "side": ("domain.width=8um", "domain.breadth=4um", "domain.extent=full",
                 "laser.position=['0um', '2um']"),
        "quarter": ("domain.width=8um", "domain.breadth=4um", "laser.position=['0um', '-2um']"),
        "corner": ("domain.width=4um", "domain.breadth=4um", "domain.extent=full",
                   "laser.position=['-2um', '-2um']"),
    }  # fmt: skip
    found = {}
    for name, settings in parts.items():
        case, solver = solver_of("dots-steel", *SPOT, *settings)
        go(solver, 6e-8)
        view = recipe_of(case).view(solver, 1, "")
        found[name] = (view.mirror_images, MeltPool(3).observe(view) | view.energy)
    images = {name: one[0] for name, one in found.items()}
    assert images == {"whole": 1, "half": 2, "side": 2, "quarter": 4, "corner": 4}
    whole = found["whole"][1]
    assert whole["melt_volume_m3"] > 1e-18 and whole["melt_area_m2"] > 1e-12
    for _, numbers in found.values():
        for name in ("melt_volume_m3", "melt_area_any_m2", "melt_area_m2", "melt_depth_half_m",
                     "incident", "absorbed", "lost"):  # fmt: skip
            assert numbers[name] == pytest.approx(whole[name], rel=1e-5, abs=0.0), name
