"""`lasersph.check`: what a case needs, and the refusal of what this machine cannot hold, the same
for whoever starts a run."""

import pytest

import lasersph
from lasersph.case import size as size_module
from lasersph.cli import main
from lasersph.simulation.acceptance import refuse_unresolved
from lasersph.simulation.layers import lay_out
from lasersph.simulation.recipes import recipe_of

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
    short = ["particles.spacing=4 um", "time.step=5 ns", "time.end=50 ns"]
    case = lasersph.load_case("stefan", short)
    monkeypatch.setattr(size_module, "machine_memory", lambda: ONE_MIB)
    result = lasersph.run(case, tmp_path / "run", anyway=True, warn=False)
    assert "of memory, but this machine has" in result.summary["warnings"][0]


def test_too_coarse_for_its_flow(capsys, tmp_path):
    """`run` names the number that is spoiled and asks for --anyway; --quick says so itself; `check`
    tells of it and is content."""
    folder = tmp_path / "run"
    coarse = ["--set", "particles.spacing=60 um"]
    assert main(["run", "spot-weld", *coarse, "--out", str(folder)]) == 2
    said = capsys.readouterr().err
    assert "particles.spacing: the viscous layer of the pool is about" in said
    assert "the speed of the surface will be off; the thermal layer" in said
    assert 'write spacing = "3.8 um" or less, or start it all the same: lasersph run --any' in said
    assert not folder.exists()
    assert main(["check", "spot-weld", *coarse]) == 0
    assert "lasersph run asks for --anyway or --quick" in capsys.readouterr().out
    assert main(["check", "spot-weld", *coarse, "--quick"]) == 0
    assert "asks for" not in capsys.readouterr().out


@pytest.mark.parametrize("flag", ["--anyway", "--quick"])
def test_as_coarse_as_the_user_says(flag, tmp_path, capsys):
    """It runs, and warns of what is spoiled."""
    short = [
        "--set",
        "particles.spacing=60 um",
        "--set",
        "time.end=0.1 ms",
        "--set",
        "laser.power=200 W",
    ]
    command = ["run", "spot-weld", *short, "--out", str(tmp_path / "run"), "--no-figures", flag]
    assert main(command) == 0
    assert "the speed of the surface will be off" in capsys.readouterr().err


def test_resolved_flow_is_not_refused():
    """Shipped textures and spots, and what has no flow."""
    for name in ("texture-steel", "texture-aluminium", "dlip-steel", "spot-steel", "stefan"):
        refuse_unresolved(recipe_of(lasersph.load_case(name)).flow)
    refuse_unresolved(recipe_of(lasersph.load_case("spot-weld")).flow)
    with pytest.raises(lasersph.CaseError, match="will be off"):
        coarse = lasersph.load_case("spot-weld", ["particles.spacing=12um"])
        refuse_unresolved(recipe_of(coarse).flow)
