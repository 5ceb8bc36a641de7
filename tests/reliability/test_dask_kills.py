"""Sweeps on a real Dask cluster: nothing is lost, nothing done twice, whatever is killed."""

import json
import os
import signal
import subprocess
import sys
import time

import pytest
from reliability_runs import LONGEST_WAIT, POLL, wait_until
from sweep_runs import SETTINGS, children, contents, is_alive, parent, plan_text

from lasersph.output import OutputError
from lasersph.output.folder_lock import read_owner
from lasersph.sweeps import LocalEngine, Table, build_plan, make_runs

pytest.importorskip("distributed")
if not sys.platform.startswith("linux"):
    pytest.skip("looks into /proc", allow_module_level=True)
from dask_cluster import DaskCluster

from lasersph.sweeps.dask_engine import DaskEngine, write_certificate

pytestmark = pytest.mark.cluster
FLUENCES = ["0.5 J/cm^2", "0.6 J/cm^2", "0.7 J/cm^2"]
CHECKPOINTS = "runs/*/checkpoint/*"
EVENTS = ["started", "finished"]


@pytest.fixture(scope="module")
def cluster(tmp_path_factory):
    """Two workers."""
    cluster = DaskCluster(tmp_path_factory.mktemp("cluster"), workers=2)
    yield cluster
    cluster.close()


def make(folder, engine, report=lambda event, table: None):
    """The table of the sweep."""
    plan = build_plan("dlip-steel", {"laser.fluence": FLUENCES}, set=SETTINGS)
    return make_runs(plan.points(), folder, study=plan.study, units=plan.varied, engine=engine,
                     report=report)  # fmt: skip


@pytest.fixture(scope="module")
def undisturbed(tmp_path_factory):
    """Folder and table of the sweep that nothing disturbs, on this machine."""
    folder = tmp_path_factory.mktemp("undisturbed")
    return folder, make(folder, LocalEngine(workers=1, threads=1))


def assert_same_and_clean(folder, undisturbed, run_processes):
    """The results of the undisturbed sweep; each run finished once; no lock, no process left."""
    table = Table.read(folder)
    assert table.status == ("complete",) * len(FLUENCES)
    assert contents(folder, table) == contents(*undisturbed)
    for run in (folder / "runs").iterdir():
        events = [json.loads(line)["event"] for line in (run / "events.jsonl").open()]
        assert [events.count(kind) for kind in EVENTS] == [1, 1]
        assert not (run / ".lock").exists()
    for pid in run_processes:
        while is_alive(pid):  # hangs where it never ends
            time.sleep(0.05)


class Killer:
    """Kills something at the first progress of a run, twice.

    Attributes:
        run_processes: those that computed for what was killed.
    """

    def __init__(self, act):
        self.act, self.runs, self.run_processes = act, [], []

    def __call__(self, event, table):
        """Note an event."""
        if event.kind == "progress" and event.run not in self.runs and len(self.runs) < 2:
            self.runs.append(event.run)
            pid = int(event.worker.partition(":")[2])
            self.run_processes += children(pid)
            self.act(pid)


@pytest.mark.parametrize("what", ["worker", "nanny", "run"])
def test_killed(cluster, undisturbed, tmp_path, what):
    """Workers, their nannies or the processes of runs die twice by SIGKILL."""

    def act(pid):
        victims = {"worker": [pid], "nanny": [parent(pid)], "run": children(pid)}
        for victim in victims[what]:
            os.kill(victim, signal.SIGKILL)
        cluster.start_workers()

    killer = Killer(act)
    make(tmp_path, DaskEngine(scheduler_file=cluster.file, threads=1), killer)
    assert len(killer.runs) == 2 and killer.run_processes
    assert_same_and_clean(tmp_path, undisturbed, killer.run_processes)


def test_killed_scheduler(cluster, undisturbed, tmp_path):
    """The scheduler dies twice; the driver goes on with the one that takes its place."""

    def act(pid):
        cluster.kill_scheduler()
        cluster.start_scheduler()
        cluster.start_workers()

    killer = Killer(act)
    make(tmp_path, DaskEngine(scheduler_file=cluster.file, threads=1), killer)
    assert len(killer.runs) == 2
    assert_same_and_clean(tmp_path, undisturbed, killer.run_processes)


def test_killed_driver(cluster, undisturbed, tmp_path):
    """`lasersph sweep` dies twice: runs stop with a checkpoint, the same command again goes on."""
    (tmp_path / "plan.toml").write_text(plan_text(FLUENCES))
    folder = tmp_path / "out"
    command = [sys.executable, "-m", "lasersph", "sweep", str(tmp_path / "plan.toml")]
    command += ["--out", str(folder), "--scheduler-file", str(cluster.file), "--threads", "1"]
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)}
    for _ in range(2):
        there = set(folder.glob(CHECKPOINTS))
        process = subprocess.Popen(command, env=environment)
        wait_until(process, lambda there=there: set(folder.glob(CHECKPOINTS)) - there)
        process.send_signal(signal.SIGKILL)
        process.wait(timeout=LONGEST_WAIT)
        while list(folder.glob("runs/*/.lock")):  # hangs where a run goes on for nobody
            time.sleep(0.05)
    again = subprocess.run(command, env=environment, timeout=LONGEST_WAIT, check=False)
    assert again.returncode == 0
    assert_same_and_clean(folder, undisturbed, [])


def wait_for(ready):
    """What `ready()` gives once it is true. Raises TimeoutError where it never is."""
    for _ in range(round(LONGEST_WAIT / POLL)):
        if found := ready():
            return found
        time.sleep(POLL)
    raise TimeoutError("what was waited for did not come")


def owner(folder, but=0):
    """The process that computes in the one run of a sweep; 0 where none does, or only `but`."""
    for lock in folder.glob("runs/*/.lock"):
        pid = read_owner(lock).get("process", 0)
        return pid if pid != but and list(folder.glob(CHECKPOINTS)) else 0
    return 0


def test_nothing_is_computed_for_nobody(cluster, tmp_path):
    """A run without end ends with its Dask worker, and where it goes on, with the driver."""
    plan = plan_text(["0.5 J/cm^2"]).replace('"60 ns"', '"90 us"')
    (tmp_path / "plan.toml").write_text(plan)
    folder = tmp_path / "out"
    command = [sys.executable, "-m", "lasersph", "sweep", str(tmp_path / "plan.toml")]
    command += ["--out", str(folder), "--scheduler-file", str(cluster.file), "--threads", "1"]
    process = subprocess.Popen(command, env={**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)})
    first = wait_for(lambda: owner(folder))
    os.kill(parent(first), signal.SIGKILL)
    wait_for(lambda: not is_alive(first))
    second = wait_for(lambda: owner(folder, but=first))
    process.kill()
    process.wait(timeout=LONGEST_WAIT)
    wait_for(lambda: not list(folder.glob("runs/*/.lock")))
    (checkpoint, *_) = folder.glob(CHECKPOINTS)
    assert second != first and checkpoint.exists()
    assert not list(folder.glob("runs/*/summary.json"))


def test_certificate(tmp_path):
    """A scheduler with a certificate answers who has it, and nobody else; the key is private."""
    write_certificate(tmp_path)
    assert (tmp_path / "key.pem").stat().st_mode & 0o077 == 0
    certificate, key = str(tmp_path / "cert.pem"), str(tmp_path / "key.pem")
    options = ("--tls-ca-file", certificate, "--tls-cert", certificate, "--tls-key", key)
    cluster = DaskCluster(tmp_path, 0, ("--protocol", "tls", *options))
    try:
        client = DaskEngine(scheduler_file=cluster.file, tls=tmp_path).connect()
        assert client.run_on_scheduler(os.getpid) == cluster.scheduler.pid
        client.close()
        with pytest.raises(OutputError, match="asks for a certificate, and none is given"):
            DaskEngine(scheduler_file=cluster.file, patience=0.0).make([], print, lambda: False)
    finally:
        cluster.close()


def test_no_scheduler(tmp_path):
    """One line says where none answers, and which file is missing."""
    with pytest.raises(OutputError, match=r"no Dask scheduler answers at .*No such file"):
        missing = tmp_path / "scheduler.json"
        DaskEngine(scheduler_file=missing, patience=0.0).make([], print, lambda: False)
    with pytest.raises(OutputError, match="is no address of a scheduler"):
        DaskEngine(address="node1")
    with pytest.raises(OutputError, match=r"cert\.pem: no such file"):
        DaskEngine(address="tcp://127.0.0.1:1", tls=tmp_path)
