"""Spacing study on a run that is a formula: orders, gaps, refusals."""

import json
from pathlib import Path
from types import SimpleNamespace

import pytest
from pydantic import ValidationError

from lasersph.input import Length, Model
from lasersph.studies import changed, converge


class Particles(Model):
    """Only the spacing."""

    spacing: Length
    rows: int = 3


class SmallCase(Model):
    """A case as far as the study looks at it."""

    particles: Particles


CASE = SmallCase(particles=Particles(spacing=8e-9))


def run(case, folder):
    """Second order in T, first in depth; no melt at the coarsest spacing; steps are no physics."""
    d = case.particles.spacing
    melt = {"depth_max_m": 1e-6 + d} if d < 30e-9 else {"depth_max_m": None}
    summary = {
        "schema_version": 1, "particles": 100, "steps": 9, "wall_time_s": 0.1, "case": "small",
        "time_step": {"min_s": 1e-12},
        "temperature_max_K": 1000.0 + 1e18 * d**2, "melt": melt, "folder": str(folder),
    }  # fmt: skip
    return SimpleNamespace(summary=summary)


def test_order_and_limit_of_every_number(tmp_path):
    """Orders 2 and 1 and the limits are found; counters are left out."""
    folders, lines = [], []

    def remember(case, folder):
        folders.append(Path(folder).name)
        return run(case, folder)

    study = converge(CASE, [4e-9, 16e-9, 8e-9], tmp_path, run=remember, report=lines.append)
    assert study.spacings == (4e-9, 8e-9, 16e-9)
    assert [row.name for row in study.rows] == ["temperature_max_K", "melt.depth_max_m"]
    hot = study["temperature_max_K"].convergence
    assert (hot.order, hot.extrapolated) == (pytest.approx(2.0), pytest.approx(1000.0))
    depth = study["melt.depth_max_m"].convergence
    assert depth.order == pytest.approx(1.0)
    assert depth.gci == pytest.approx(1.25 * 4e-9 / 1.004e-6)
    assert folders == ["spacing-16nm", "spacing-8nm", "spacing-4nm"]
    assert lines[0] == "run 1 of 3: spacing 16 nm"


def test_number_missing_in_one_run_is_called_incomplete(tmp_path):
    """No melt at 32 nm: no order, a dash in the table, None in the JSON."""
    study = converge(CASE, [8e-9, 16e-9, 32e-9], tmp_path, run=run)
    row = study["melt.depth_max_m"]
    assert row.convergence.kind == "incomplete"
    rows, head = study.table()
    assert head[:3] == ["number", "8 nm", "16 nm"]
    assert rows[1] == [
        "melt.depth_max_m", "1.008 um", "1.016 um", "-", "incomplete", "-", "-", "-",
    ]  # fmt: skip
    plain = json.loads(json.dumps(study.as_dict()))
    assert plain["numbers"]["melt.depth_max_m"]["values"][2] is None
    with pytest.raises(KeyError):
        study["flow"]


def test_sizes_in_whole_cells_are_never_surer_than_a_cell(tmp_path):
    """288 nm at 12, 24 and 48 nm: exact by chance, uncertain by 24 (width) and 12 (boiling)."""

    def stairs(case, folder):
        melt = {"width_max_m": 288e-9, "width_half_max_m": 288e-9}
        vapor = {"depth_max_m": 288e-9}
        summary = {"melt": melt, "vaporization": vapor, "surface": {"symmetry_factor": 2}}
        return SimpleNamespace(summary=summary)

    study = converge(CASE, [12e-9, 24e-9, 48e-9], tmp_path, run=stairs)
    assert [row.name for row in study.rows] == [
        "melt.width_max_m", "melt.width_half_max_m", "vaporization.depth_max_m",
    ]  # fmt: skip
    assert [row.convergence.kind for row in study.rows] == ["exact"] * 3
    gci = [row.convergence.gci for row in study.rows]
    assert gci == pytest.approx([24 / 288, 0.0, 12 / 288])


def test_rounded_spacings_count(tmp_path):
    """The spacing that the run reports is used; two that round to the same are refused."""

    def rounding(case, folder):
        used = round(case.particles.spacing * 1e9 / 4) * 4e-9
        summary = run(changed(case, "particles.spacing", used), folder).summary
        return SimpleNamespace(summary=summary | {"spacing_m": used})

    study = converge(CASE, [3.9e-9, 8.3e-9, 15e-9], tmp_path, run=rounding)
    assert study.spacings == pytest.approx((4e-9, 8e-9, 16e-9))
    assert study["temperature_max_K"].convergence.order == pytest.approx(2.0)
    with pytest.raises(ValueError, match="rounded to the same"):
        converge(CASE, [3.9e-9, 4.1e-9, 15e-9], tmp_path, run=rounding)


def test_two_spacings_are_too_few(tmp_path):
    """The message says how many and what would do."""
    with pytest.raises(ValueError, match="three different spacings, got 2"):
        converge(CASE, [8e-9, 16e-9, 16e-9], tmp_path, run=run)


def test_changed_case_is_checked_again():
    """Other keys stay, a wrong value and a wrong key are refused, the original is untouched."""
    case = SmallCase(particles=Particles(spacing=8e-9, rows=5))
    other = changed(case, "particles.spacing", "16 nm")
    assert (other.particles.spacing, other.particles.rows) == (pytest.approx(16e-9), 5)
    assert case.particles.spacing == 8e-9
    with pytest.raises(ValidationError):
        changed(case, "particles.rows", "many")
    with pytest.raises(KeyError, match="no key 'widths'"):
        changed(case, "particles.widths", 1)


def test_runs_are_prepared_together(tmp_path):
    """All of them before the first has its turn."""
    prepared, made = [], []

    def remember(case, folder):
        made.append(folder)
        return run(case, folder)

    def prepare(cases):
        assert not made
        prepared.append({folder: case.particles.spacing for folder, case in cases.items()})

    converge(CASE, [4e-9, 16e-9, 8e-9], tmp_path, run=remember, prepare=prepare)
    assert prepared == [dict(zip(made, (16e-9, 8e-9, 4e-9), strict=True))]
