"""Scripts for Slurm do what they say, run by hand as Slurm would run them."""

import os
import shutil
import subprocess
import sys

import pytest
from reliability_runs import LONGEST_WAIT
from sweep_runs import plan_text

from lasersph.cli import main
from lasersph.sweeps import Table

if shutil.which("bash") is None:
    pytest.skip("needs bash", allow_module_level=True)

SRUN = """#!/bin/bash
while [[ $1 == --* ]]; do shift; done
for task in 1 2; do "$@" & done
wait
"""
"""Starts a program in each of two tasks, as Slurm's own does."""


@pytest.fixture
def folder(tmp_path):
    """Holds a plan; its name has a blank."""
    folder = tmp_path / "with blank"
    folder.mkdir()
    (folder / "plan.toml").write_text(plan_text(["0.5 J/cm^2", "0.6 J/cm^2"]))
    (folder / "srun").write_text(SRUN)
    (folder / "srun").chmod(0o755)
    return folder


def bash(folder, *arguments, **variables):
    """A finished bash, which finds this package as the test does, and srun."""
    path = {"PYTHONPATH": os.pathsep.join(sys.path), "PATH": f"{folder}:{os.environ['PATH']}"}
    return subprocess.run(
        ["bash", *map(str, arguments)], env={**os.environ, **path, **variables}, cwd=folder,
        capture_output=True, text=True, timeout=LONGEST_WAIT,
    )  # fmt: skip


def write(folder, option, script):
    """`lasersph sweep` with an option that writes a script, which nothing is to be said of."""
    command = ["sweep", str(folder / "plan.toml"), "--out", str(folder / "out")]
    assert main([*command, option, str(script)]) == 0
    if script.exists():
        assert bash(folder, "-n", script).returncode == 0
        if shutil.which("shellcheck"):
            subprocess.run(["shellcheck", script], check=True, cwd=folder)


def test_array_script(folder, capsys):
    """Each task makes its run; a second array has what is missing, and none when all is there."""
    script, out = folder / "array.sh", folder / "out"
    write(folder, "--slurm", script)
    assert "2 runs" in capsys.readouterr().out
    done = bash(folder, script, SLURM_ARRAY_TASK_ID="2", SLURM_CPUS_PER_TASK="1")
    assert done.returncode == 0, done.stderr
    assert Table.read(out).status == ("missing", "complete")
    assert "no run 3" in bash(folder, script, SLURM_ARRAY_TASK_ID="3").stderr
    write(folder, "--slurm", script)
    assert "1 run. " in capsys.readouterr().out
    assert bash(folder, script, SLURM_ARRAY_TASK_ID="1").returncode == 0
    assert Table.read(out).status == ("complete", "complete")
    write(folder, "--slurm", script)
    assert "all runs are complete" in capsys.readouterr().out


@pytest.mark.slow
def test_dask_script(folder):
    """A scheduler with TLS and two workers make the runs; they end, and their key is gone."""
    pytest.importorskip("distributed")
    script, out = folder / "dask.sh", folder / "out"
    write(folder, "--slurm-dask", script)
    done = bash(folder, script, SLURM_CPUS_PER_TASK="1")
    assert done.returncode == 0, done.stderr
    assert Table.read(out).status == ("complete", "complete")
    assert not list(folder.glob("out.dask-*"))
