"""`lasersph.check`: what a case needs, and the refusal of what this machine cannot hold, the same
for whoever starts a run."""

import pytest

import lasersph
from lasersph.case import size as size_module
from lasersph.cli import main
from lasersph.simulation.layers import lay_out

COARSE = ("particles.spacing=64 nm", "time.end=100 ns")
ONE_MIB = 2.0**20


@pytest.fixture
def case():
    """A coarse melt pool."""
    return lasersph.load_case("dlip-steel", COARSE)


def test_what_a_case_needs(case, capsys):
    """The particles that are laid out, the smallest limit as the binding one; printed, the rows and
    warnings of `lasersph check`."""
    cost = lasersph.check(case, threads=1)
    assert cost.particles == lay_out(case).particle_count
    assert cost.limits[cost.binding] == min(cost.limits.values())
    assert cost.memory > 0 and cost.wall_time > 0.0 and cost.threads == 1
    assert main(["check", "dlip-steel", *(f"--set={one}" for one in COARSE), "--threads=1"]) == 0
    printed = capsys.readouterr().out.splitlines()
    shown = [line for line in str(cost).splitlines() if not line.startswith("memory")]
    assert shown and all(line in printed for line in shown)
    assert all(f"warning: {text}" in printed for text in cost.warnings)


def test_too_large_is_refused_alike(case, tmp_path, monkeypatch, capsys):
    """By `check`, by `run` and by both verbs, before a folder is made."""
    monkeypatch.setattr(size_module, "machine_memory", lambda: ONE_MIB)
    folder = tmp_path / "run"
    said = set()
    for start in (lasersph.check, lambda one: lasersph.run(one, folder)):
        with pytest.raises(lasersph.CaseError, match="of memory, but this machine has") as error:
            start(case)
        said.add(str(error.value))
    assert len(said) == 1 and "anyway=True in Python" in said.pop()
    settings = [f"--set={one}" for one in COARSE]
    for verb in (["check"], ["run", "--out", str(folder)]):
        assert main([*verb, "dlip-steel", *settings]) == 2
        assert "lasersph run --anyway" in capsys.readouterr().err
    assert not folder.exists()


def test_started_anyway(tmp_path, monkeypatch):
    """The refusal becomes the first warning of the run."""
    case = lasersph.load_case("stefan", ["particles.spacing=4 um"])
    monkeypatch.setattr(size_module, "machine_memory", lambda: ONE_MIB)
    result = lasersph.run(case, tmp_path / "run", anyway=True, warn=None)
    assert "of memory, but this machine has" in result.summary["warnings"][0]
