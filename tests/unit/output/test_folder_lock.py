"""The lock of a run folder: one owner, named to the others; none that is dead."""

import json
import os
import signal
import subprocess
import sys
import threading
import time
from concurrent.futures import ThreadPoolExecutor

import pytest

from lasersph.output import FolderLocked, OutputError, folder_lock
from lasersph.output.folder_lock import FolderLock

HOLD = """
import sys, time
from pathlib import Path
from lasersph.output.folder_lock import FolderLock
lock = FolderLock(Path(sys.argv[1]))
print("locked", flush=True)
sys.stdin.read(1)
lock.release()
"""
ELSEWHERE = {"process": 4711, "host": "node7", "since": "2026-01-01", "machine": "another"}


@pytest.fixture
def holder(tmp_path):
    """A process that holds the folder until its stdin closes."""
    command = [sys.executable, "-c", HOLD, str(tmp_path)]
    process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
    assert process.stdout.readline() == "locked\n"
    yield process
    process.kill()
    process.wait()


@pytest.fixture
def short_silence(monkeypatch):
    """A machine counts as dead after 1 s."""
    monkeypatch.setattr(folder_lock, "SILENCE", 1.0)
    monkeypatch.setattr(folder_lock, "POLL", 0.05)


def lock_elsewhere(folder):
    """The lock of a process on another machine whose system locks do not reach here."""
    (folder / ".lock").write_text(json.dumps(ELSEWHERE))


def test_second_process_learns_who_has_the_folder(tmp_path, holder):
    """The message names process and host; when the owner leaves, the folder is free and clean."""
    with pytest.raises(FolderLocked, match=rf"process {holder.pid} on {os.uname().nodename}"):
        FolderLock(tmp_path)
    holder.stdin.close()
    holder.wait()
    assert not list(tmp_path.iterdir())
    FolderLock(tmp_path).release()
    assert not list(tmp_path.iterdir())


def test_dead_process_holds_nothing(tmp_path, holder):
    """After `kill -9` the next process has the folder at once."""
    holder.send_signal(signal.SIGKILL)
    holder.wait()
    assert (tmp_path / ".lock").exists()
    FolderLock(tmp_path).release()
    assert not list(tmp_path.iterdir())


def test_wait_for_the_owner(tmp_path, holder):
    """Who waits gets the folder when its owner leaves."""
    with ThreadPoolExecutor(1) as pool:
        waiting = pool.submit(FolderLock, tmp_path, wait=600.0)
        time.sleep(0.2)
        assert not waiting.done()
        holder.stdin.close()
        waiting.result().release()


def test_machine_that_vanished(tmp_path, short_silence):
    """The folder of a process on another machine is taken over once it is silent."""
    lock_elsewhere(tmp_path)
    lock = FolderLock(tmp_path)
    assert json.loads((tmp_path / ".lock").read_text())["process"] == os.getpid()
    lock.confirm()
    lock.release()
    assert not list(tmp_path.iterdir())


def test_machine_that_lives(tmp_path, short_silence):
    """A process on another machine that touches its lock keeps it."""
    lock_elsewhere(tmp_path)
    stop = threading.Event()

    def touch():
        while not stop.wait(0.05):
            os.utime(tmp_path / ".lock")

    thread = threading.Thread(target=touch)
    thread.start()
    with pytest.raises(FolderLocked, match="process 4711 on node7, since 2026"):
        FolderLock(tmp_path, wait=2.0)
    stop.set()
    thread.join()


def test_owner_touches_its_lock(tmp_path, monkeypatch):
    """A living owner is seen to live."""
    monkeypatch.setattr(folder_lock, "BEAT", 0.02)
    lock = FolderLock(tmp_path)
    os.utime(tmp_path / ".lock", (0, 0))
    while (tmp_path / ".lock").stat().st_mtime == 0:  # hangs where it does not
        time.sleep(0.02)
    lock.release()


def test_sleeper_notices_that_the_folder_was_taken(tmp_path, short_silence):
    """An owner that was silent for too long does not write beside the new one."""
    lock = FolderLock(tmp_path)
    (tmp_path / ".lock").unlink()
    lock_elsewhere(tmp_path)
    with pytest.raises(OutputError, match="was taken over by process 4711 on node7"):
        lock.confirm()
    lock.release()
    assert (tmp_path / ".lock").exists()


@pytest.mark.parametrize("start", ["empty", "dead", "vanished", "without system locks"])
def test_one_of_many(tmp_path, short_silence, monkeypatch, start):
    """Of eight that come at once, one gets the folder."""
    if start == "without system locks":
        monkeypatch.setattr(folder_lock, "lock_file", lambda _: None)
        monkeypatch.setattr(folder_lock, "BEAT", 0.05)
    if start in ("vanished", "without system locks"):
        lock_elsewhere(tmp_path)
    elif start == "dead":
        owner = {**ELSEWHERE, "machine": folder_lock.machine()}
        (tmp_path / ".lock").write_text(json.dumps(owner))
    barrier = threading.Barrier(8)

    def take():
        barrier.wait()
        try:
            return FolderLock(tmp_path)
        except FolderLocked:
            return None

    with ThreadPoolExecutor(8) as pool:
        results = list(pool.map(lambda _: take(), range(8)))
    owners = [lock for lock in results if lock is not None]
    assert len(owners) == 1
    owners[0].confirm()
    owners[0].release()
    assert not list(tmp_path.iterdir())
