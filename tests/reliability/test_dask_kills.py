"""Sweeps on a real Dask cluster: nothing is lost, nothing done twice, whatever is killed."""

import json
import os
import shutil
import signal
import subprocess
import sys

import pytest
from reliability_runs import LONGEST_WAIT, wait_for, wait_until
from sweep_runs import SETTINGS, children, contents, is_alive, parent, plan_text

from lasersph.output import OutputError
from lasersph.output.folder_lock import read_owner
from lasersph.sweeps import LocalEngine, Table, build_plan, make_runs

pytest.importorskip("distributed")
if not sys.platform.startswith("linux"):
    pytest.skip("looks into /proc", allow_module_level=True)
from dask_cluster import DaskCluster

from lasersph.sweeps.dask_engine import DaskEngine, write_certificate

FLUENCES = ["0.5 J/cm^2", "0.6 J/cm^2", "0.7 J/cm^2"]
LONGER = {**SETTINGS, "time.end": "150 ns", "output.snapshots.interval": "5 ns"}
"""Runs of some seconds, which do not end between a word of them and the kill that follows it."""
CHECKPOINTS = "runs/*/checkpoint/*"
EVENTS = ["started", "finished"]


@pytest.fixture(autouse=True)
def hard_limit():
    """Fail a test that hangs, with what it waits for in the traceback."""

    def fail(*_):
        raise TimeoutError("a test of Dask hangs")

    before = signal.signal(signal.SIGALRM, fail)
    signal.alarm(round(LONGEST_WAIT))
    yield
    signal.alarm(0)
    signal.signal(signal.SIGALRM, before)


@pytest.fixture(scope="module")
def cluster(tmp_path_factory):
    """A scheduler."""
    cluster = DaskCluster(tmp_path_factory.mktemp("cluster"), workers=2)
    yield cluster
    cluster.close()


@pytest.fixture(scope="module")
def plan():
    """One run more than there are workers: where a scheduler dies, those in hand may be completed
    before their workers end."""
    return build_plan("dlip-steel", {"laser.fluence": FLUENCES}, set=LONGER)


@pytest.fixture(scope="module")
def undisturbed(plan, tmp_path_factory):
    """Folder and table of the sweep that nothing disturbs, on this machine."""
    folder = tmp_path_factory.mktemp("undisturbed")
    engine = LocalEngine(workers=1, threads=1)
    return folder, make_runs(plan.points(), folder, plan.study, engine=engine)


def assert_same_and_clean(folder, undisturbed, run_processes=()):
    """The results of the undisturbed sweep; each run finished once; no lock, no process left."""
    table = Table.read(folder)
    assert table.status == ("complete",) * len(FLUENCES)
    assert contents(folder, table) == contents(*undisturbed)
    for run in (folder / "runs").iterdir():
        events = [json.loads(line)["event"] for line in (run / "events.jsonl").open()]
        assert [events.count(kind) for kind in EVENTS] == [1, 1]
        assert not (run / ".lock").exists()
    for pid in run_processes:
        wait_for(lambda pid=pid: not is_alive(pid))


def kill(*processes):
    """Kill processes and wait for their end: until then they count as workers that are there."""
    for process in processes:
        os.kill(process, signal.SIGKILL)
        wait_for(lambda process=process: not is_alive(process))


class Killer:
    """Kills one thing after the other, each when a run that was begun anew takes its first step.

    Attributes:
        kills: names of what is to be killed yet. run_processes: that computed for what was killed.
    """

    def __init__(self, cluster, *kills):
        self.cluster, self.kills, self.run_processes = cluster, list(kills), []
        self._begun = set()

    def __call__(self, event, table):
        """Note an event."""
        if event.kind == "started":
            self._begun.add(event.run)
        if event.kind != "progress" or event.run not in self._begun or not self.kills:
            return
        self._begun.remove(event.run)
        worker, what = int(event.worker.partition(":")[2]), self.kills.pop(0)
        self.run_processes += children(worker)
        if what == "scheduler":
            self.cluster.kill_scheduler()
            self.cluster.start_scheduler()
        elif what == "run":
            kill(*children(worker))
        else:
            kill(parent(worker) if what == "nanny" else worker)
        self.cluster.start_workers()  # in place of those that lost their nanny


@pytest.mark.slow
@pytest.mark.parametrize("kills", [["worker", "nanny", "run"] * 2, ["scheduler"] * 2])
def test_killed(cluster, plan, undisturbed, tmp_path, kills):
    """A Dask worker, its nanny, the process of a run and the scheduler die twice each by SIGKILL,
    in the middle of runs; the driver goes on with what takes their place."""
    cluster.start_workers()
    killer = Killer(cluster, *kills)
    # a run that dies again at its first step has no later checkpoint: allow for all kills
    engine = DaskEngine(scheduler_file=cluster.file, threads=1, retries=len(kills))
    make_runs(plan.points(), tmp_path, plan.study, engine=engine, report=killer)
    assert not killer.kills and len(killer.run_processes) >= len(kills)
    assert_same_and_clean(tmp_path, undisturbed, killer.run_processes)


@pytest.mark.slow
def test_killed_driver(cluster, undisturbed, tmp_path):
    """`lasersph sweep` dies twice: runs stop with a checkpoint, the same command again goes on."""
    cluster.start_workers()
    (tmp_path / "plan.toml").write_text(plan_text(FLUENCES, LONGER))
    folder = tmp_path / "out"
    for _ in range(2):
        there = set(folder.glob(CHECKPOINTS))
        process = start_sweep(tmp_path, cluster)
        wait_until(process, lambda there=there: set(folder.glob(CHECKPOINTS)) - there)
        process.send_signal(signal.SIGKILL)
        process.wait(timeout=LONGEST_WAIT)
        wait_for(lambda: not list(folder.glob("runs/*/.lock")))
    again = start_sweep(tmp_path, cluster)
    assert again.wait(timeout=LONGEST_WAIT) == 0
    assert_same_and_clean(folder, undisturbed)


def start_sweep(folder, cluster, *options):
    """`lasersph sweep` of the plan in a folder, into `out` inside."""
    command = [sys.executable, "-m", "lasersph", "sweep", str(folder / "plan.toml")]
    command += ["--out", str(folder / "out"), "--scheduler-file", str(cluster.file)]
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)}
    return subprocess.Popen(
        [*command, "--threads", "1", *options], env=environment, stderr=subprocess.PIPE, text=True
    )


def owner(folder, but=0):
    """The process that computes in the one run of a sweep; 0 where none does, or only `but`."""
    for lock in folder.glob("runs/*/.lock"):
        pid = read_owner(lock).get("process", 0)
        return pid if pid != but and list(folder.glob(CHECKPOINTS)) else 0
    return 0


def test_nothing_is_computed_for_nobody(cluster, tmp_path):
    """A run without end ends with its Dask worker, and where it goes on, with the driver."""
    cluster.start_workers()
    endless = plan_text(["0.5 J/cm^2"], {**SETTINGS, "time.end": "90 us"})
    (tmp_path / "plan.toml").write_text(endless)
    folder = tmp_path / "out"
    process = start_sweep(tmp_path, cluster)
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


def test_no_worker(undisturbed, tmp_path):
    """A scheduler whose workers are all gone is not waited for without end: one line says so, what
    is complete is in the table, and with workers the same command goes on."""
    cluster = DaskCluster(tmp_path, workers=0)
    (tmp_path / "plan.toml").write_text(plan_text(FLUENCES, LONGER))
    shutil.copytree(undisturbed[0], tmp_path / "out")
    last = undisturbed[1].runs[-1]
    shutil.rmtree(tmp_path / "out" / "runs" / last)
    try:
        process = start_sweep(tmp_path, cluster, "--worker-wait", "1")
        _, said = process.communicate(timeout=LONGEST_WAIT)
        assert process.returncode == 1
        (line,) = (line for line in said.splitlines() if "no worker for" in line)
        assert line.endswith("1 runs are not complete: start workers; the same command goes on")
        assert Table.read(tmp_path / "out").status == ("complete", "complete", "missing")
        cluster.workers = 1
        cluster.start_workers()
        assert start_sweep(tmp_path, cluster).wait(timeout=LONGEST_WAIT) == 0
        assert_same_and_clean(tmp_path / "out", undisturbed)
    finally:
        cluster.close()


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
