"""`lasersph sweep` and `lasersph new --plan`: what they say and return."""

import json

import pytest
from sweep_runs import SETTINGS, PretendingEngine

from lasersph.cli import main
from lasersph.input.schema import as_toml
from lasersph.sweeps import LocalEngine

PLAN = f"""\
case = "dlip-steel"
set = {as_toml(SETTINGS)}
[vary]
"laser.fluence" = ["0.4 J/cm^2", "0.5 J/cm^2"]
"particles.coarsest" = ["1 um", "10 nm"]
"""


@pytest.fixture
def plan(tmp_path):
    """A plan of four runs, two of which the case refuses."""
    file = tmp_path / "fluences.toml"
    file.write_text(PLAN)
    return file


def test_dry_run_counts_forecasts_and_refuses(plan, capsys):
    """And writes nothing."""
    assert main(["sweep", str(plan), "--dry-run", "--workers", "2", "--threads", "1"]) == 0
    said = capsys.readouterr().out
    assert "2, and 2 points that the case refuses" in said
    assert "by 2 workers with 1 thread each" in said
    refused = [line for line in said.splitlines() if line.startswith("refused: ")]
    assert len(refused) == 2 and "particles.coarsest = 1e-08" in refused[0]
    assert "finer than the spacing" in refused[0]
    assert list(plan.parent.iterdir()) == [plan]


def pretend(monkeypatch, fails=()):
    """Let an engine answer that computes nothing."""
    engine = PretendingEngine(fails)
    monkeypatch.setattr(LocalEngine, "make", lambda _, *given: engine.make(*given))
    return engine


def test_failures_give_exit_code_1_and_are_listed(plan, tmp_path, capsys, monkeypatch):
    """With the reason and the command to look."""
    pretend(monkeypatch, fails={5000.0})
    out = tmp_path / "out"
    assert main(["sweep", str(plan), "--out", str(out)]) == 1
    said = capsys.readouterr()
    assert f"1 of 4 runs complete: {out / 'table.csv'}" in said.out
    assert "failed: no step converges" in said.err
    assert "1 of 4 runs, 1 failed, 2 refused" in said.err
    assert "lasersph info" in said.out and "wrong" in said.out
    assert (out / "plan.toml").read_text() == PLAN


def test_warnings_of_the_runs_are_told_at_the_end(plan, tmp_path, capsys, monkeypatch):
    """Each kind once, with the number of runs that have it."""
    plan.write_text(PLAN.replace(', "10 nm"', ""))
    pretend(monkeypatch)
    out = tmp_path / "out"
    main(["sweep", str(plan), "--out", str(out)])
    assert "warn" not in capsys.readouterr().err
    for number, file in enumerate(sorted(out.glob("runs/*/summary.json"))):
        warnings = [f"light within 14.5 nm of {64 + number} nm"] + ["hot: 3e3 K"] * number
        file.write_text(json.dumps({"melt": {"depth_max_m": 1e-7}, "warnings": warnings}))
    main(["sweep", str(out), "--table"])
    assert capsys.readouterr().err.splitlines() == [
        "2 of 2 complete runs warn (numbers of one of them):",
        "warning of 2 runs: light within 14.5 nm of 64 nm",
        "warning of 1 run: hot: 3e3 K",
    ]


def test_complete_sweep_and_its_table(plan, tmp_path, capsys, monkeypatch):
    """Exit code 0; --table makes the table anew."""
    plan.write_text(PLAN.replace(', "10 nm"', ""))
    engine = pretend(monkeypatch)
    out = tmp_path / "out"
    assert main(["sweep", str(plan), "--out", str(out)]) == 0
    assert main(["sweep", str(plan), "--out", str(out)]) == 0
    assert len(engine.made) == 2
    text = (out / "table.csv").read_text()
    (out / "table.csv").unlink()
    assert main(["sweep", str(out), "--table"]) == 0
    assert (out / "table.csv").read_text() == text
    assert "2 of 2 runs complete" in capsys.readouterr().out


def test_wrong_commands_write_nothing(plan, tmp_path, capsys):
    """Exit code 2 and one line."""
    (tmp_path / "other").mkdir()
    (tmp_path / "other" / "file").touch()
    new = [str(plan), "--out", str(tmp_path / "new")]
    for arguments, message in (
        ([str(tmp_path / "none.toml")], "none.toml: no such file"),
        ([str(tmp_path / "other")], "is a folder: give the plan"),
        ([str(tmp_path / "other"), "--table"], "holds no sweep"),
        ([str(plan), "--out", str(tmp_path / "other")], "is not empty and holds no sweep"),
        ([*new, "--scheduler", "tcp://a:1", "--scheduler-file", "b"], "not both"),
        ([*new, "--scheduler", "node1"], "is no address of a scheduler"),
        ([*new, "--scheduler", "tls://a:1", "--tls", str(tmp_path)], "cert.pem: no such file"),
        ([*new, "--scheduler", "tcp://a:1", "--workers", "2"], "has workers of its own"),
        ([*new, "--tls", str(tmp_path)], "--tls is for"),
        ([*new, "--worker-wait", "9"], "--worker-wait is for"),
    ):
        assert main(["sweep", *arguments]) == 2
        (line,) = capsys.readouterr().err.splitlines()
        assert message in line
    assert [path.name for path in (tmp_path / "other").iterdir()] == ["file"]
    assert not (tmp_path / "new").exists()


def test_new_plan_can_be_run(tmp_path, capsys):
    """Of the shipped case or another one; an unknown kind is refused."""
    from lasersph.sweeps import read_plan

    assert main(["new", "--plan", "sweep", str(tmp_path / "a.toml")]) == 0
    assert len(read_plan(tmp_path / "a.toml").points()) == 12
    assert main(["new", "--plan", "sweep", "dlip-aluminium", str(tmp_path / "b.toml")]) == 0
    assert read_plan(tmp_path / "b.toml").template.name == "dlip-aluminium"
    assert main(["new", "--plan", "sweep", str(tmp_path / "a.toml")]) == 2
    assert "exists already" in capsys.readouterr().err
    assert main(["new", "--plan", "sweeps", str(tmp_path / "c.toml")]) == 2
    assert 'no kind of plan "sweeps"' in capsys.readouterr().err
    assert main(["new", "dlip-steel"]) == 2
    assert "new wants a case and a file" in capsys.readouterr().err
