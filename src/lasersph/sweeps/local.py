"""Runs on this machine: worker processes of the standard library, each for many runs.

Workers import the package by themselves, not the driver's script, so a script needs no
`if __name__ == "__main__"`. A worker that dies is replaced and its run goes on from its checkpoint.
"""

from __future__ import annotations

import json
import os
import queue
import subprocess
import sys
import threading
from collections import deque
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import lasersph.sweeps
from lasersph.case.checks import LARGEST_COST_SHARE
from lasersph.case.size import machine_memory, size_of
from lasersph.compute.threads import available
from lasersph.simulation import forecast
from lasersph.sweeps.engine import STOPPED, Event, Report, Task

POLL = 0.1
"""Longest wait for an event before the driver asks whether to stop [s]."""
LAST_LINES = 20
"""Of what a worker said on standard error."""
WORKER = "from lasersph.sweeps.worker import main; main()"


class WorkerProcess:
    """A worker and the pipes to it.

    Attributes:
        name: "1", "2", ...; says which in the log. task: the run in hand. attempt: how often its
            workers died before.
    """

    def __init__(
        self, name: str, threads: int, messages: queue.SimpleQueue[tuple[WorkerProcess, str | None]]
    ) -> None:
        self.name, self.task, self.attempt = name, None, 0
        self.task: Task | None
        self._said: deque[str] = deque(maxlen=LAST_LINES)
        self.process = subprocess.Popen(
            # -P: a file of the user's beside the plan must not hide a library
            [sys.executable, "-P", "-c", WORKER, str(threads)],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            env=_environment(threads),
        )
        self._readers = [
            threading.Thread(target=self._hand_on, args=(messages,), daemon=True),
            threading.Thread(target=self._listen, daemon=True),
        ]
        for reader in self._readers:
            reader.start()

    def begin(self, task: Task, attempt: int) -> None:
        """Give the worker a run."""
        self.task, self.attempt = task, attempt
        try:
            assert self.process.stdin is not None
            self.process.stdin.write(json.dumps(task.as_dict()).encode() + b"\n")
            self.process.stdin.flush()
        except OSError:  # it died: its output ends as well, which is a message
            pass

    def ask_to_stop(self) -> None:
        """Close the worker's input: its run writes a checkpoint, and it ends."""
        try:
            assert self.process.stdin is not None
            self.process.stdin.close()
        except OSError:
            pass

    def wait(self) -> int:
        """Wait for the end of the process; its exit code."""
        code = self.process.wait()
        for reader in self._readers:
            reader.join()
        return code

    def last_words(self) -> str:
        """The last line that it said on standard error."""
        return next((line for line in reversed(self._said) if line), "")

    def _hand_on(self, messages: queue.SimpleQueue[tuple[WorkerProcess, str | None]]) -> None:
        assert self.process.stdout is not None
        for line in self.process.stdout:
            messages.put((self, line.decode("utf-8", "replace")))
        messages.put((self, None))

    def _listen(self) -> None:
        assert self.process.stderr is not None
        for line in self.process.stderr:
            self._said.append(line.decode("utf-8", "replace").strip())


@dataclass(frozen=True)
class LocalEngine:
    """Runs on this machine.

    Attributes:
        workers: processes; None for `most_workers`.
        threads: of each worker; None for the processors over the workers.
        retries: how often a run is tried again whose worker died or that failed for a reason that
            may pass; a wrong case and steps that do not converge are not.
    """

    workers: int | None = None
    threads: int | None = None
    retries: int = 2

    def make(self, tasks: Sequence[Task], report: Report, should_stop: Callable[[], bool]) -> None:
        """Make the folders of all tasks exist; see `Engine.make`."""
        if not tasks:
            return
        # processors are divided among the workers
        count = min(self.workers or most_workers(tasks), len(tasks))
        pool = _Pool(count, self.threads or max(1, available() // count), self.retries, report)
        pool.waiting.extend((task, 0) for task in tasks)
        try:
            pool.go(should_stop)
        finally:
            pool.close()


def most_workers(tasks: Sequence[Task]) -> int:
    """As many as there are processors, fewer where that many of the largest case need more memory
    than this machine has.

    The estimates, which leave out what graded layers add, choose the largest case; what it needs
    is its forecast, by which a run is accepted or refused.
    """
    # largest case by the estimate, its memory by the forecast
    largest = max((task.case for task in tasks), key=lambda case: size_of(case).bytes)
    memory = max(size_of(largest).bytes, forecast(largest).memory)
    return max(1, int(min(available(), LARGEST_COST_SHARE * machine_memory() / memory)))


@dataclass
class _Pool:
    """The workers of one call and the tasks that wait."""

    count: int
    threads: int
    retries: int
    report: Report
    waiting: deque[tuple[Task, int]] = field(default_factory=deque)
    workers: list[WorkerProcess] = field(default_factory=list)
    messages: Any = field(default_factory=queue.SimpleQueue)
    started: int = 0
    is_stopping: bool = False
    has_stepped: bool = False
    """Whether a run has taken a step: until then the other workers wait, so that what no cache
    holds yet is compiled once, not by each of them."""

    def go(self, should_stop: Callable[[], bool]) -> None:
        """Until no run is in hand and none waits."""
        self._fill()
        while self.waiting or any(worker.task for worker in self.workers):
            if should_stop():
                self.stop()
                return
            self._assign()
            try:
                worker, line = self.messages.get(timeout=POLL)
            except queue.Empty:
                continue
            self._receive(worker, line)

    def stop(self) -> None:
        """End all runs with their checkpoints."""
        # running ones write checkpoints, waiting ones are reported, then all processes end
        self.is_stopping = True
        for worker in self.workers:
            worker.ask_to_stop()
        for task, _ in self.waiting:
            self.report(Event(task.run, "stopped", message="not started", exit_code=STOPPED))
        self.waiting.clear()
        while self.workers:
            worker, line = self.messages.get()
            if line is None:
                self.workers.remove(worker)
                code = worker.wait()
                if worker.task:
                    self.report(Event(worker.task.run, "stopped", worker.name, exit_code=code))
            else:
                self._tell(worker, Event(**json.loads(line)))

    def close(self) -> None:
        """Leave no process behind."""
        for worker in self.workers:
            worker.ask_to_stop()
        for worker in self.workers:
            worker.wait()

    def _fill(self) -> None:
        """Start workers, at most as many as there are tasks for."""
        # no more workers than runs in hand and tasks that wait
        busy = sum(worker.task is not None for worker in self.workers)
        while len(self.workers) < min(self.count, busy + len(self.waiting)):
            self.started += 1
            self.workers.append(WorkerProcess(str(self.started), self.threads, self.messages))

    def _assign(self) -> None:
        for worker in self.workers:
            # the first run compiles for all: others wait for its first step
            in_hand = any(other.task for other in self.workers)
            if worker.task is None and self.waiting and (self.has_stepped or not in_hand):
                worker.begin(*self.waiting.popleft())

    def _receive(self, worker: WorkerProcess, line: str | None) -> None:
        if line is not None:
            self._tell(worker, Event(**json.loads(line)))
            return
        self.workers.remove(worker)
        # a worker that has died: its run is tried again by another one
        code, task = worker.wait(), worker.task
        if task is not None:
            said = worker.last_words()
            text = f"its worker ended with {_named(code)}" + (f": {said}" if said else "")
            self._try_again(worker, task, Event(task.run, "failed", worker.name, text, code))
        self._fill()

    def _tell(self, worker: WorkerProcess, event: Event) -> None:
        """Report an event of a worker; where its run ended, the worker is free."""
        task, event = worker.task, replace(event, worker=worker.name)
        self.has_stepped |= event.kind not in ("started", "waiting")
        if event.kind not in ("complete", "failed", "wrong", "stopped"):
            self.report(event)
            return
        worker.task = None
        # a wrong case and a failed step would fail again
        may_pass = event.kind in ("failed", "stopped") and not event.is_final
        if may_pass and task is not None and not self.is_stopping:
            self._try_again(worker, task, event)
        else:
            self.report(event)

    def _try_again(self, worker: WorkerProcess, task: Task, event: Event) -> None:
        """Let a run go on from its checkpoint, as long as there are retries left."""
        if worker.attempt < self.retries:
            self.waiting.append((task, worker.attempt + 1))
            self.report(replace(event, kind="retry"))
        else:
            text = f"{event.message} (tried {worker.attempt + 1} times)"
            self.report(replace(event, kind="failed", message=text))


def _named(code: int) -> str:
    """An exit code, negative for a signal, in words."""
    return f"signal {-code}" if code < 0 else f"exit code {code}"


def _environment(threads: int) -> dict[str, str]:
    """Of a worker: its threads, and the folder that this package was imported from."""
    # the package from where it is now, before whatever the user's path holds
    home = str(Path(lasersph.sweeps.__path__[0]).parents[1])
    paths = [home, *os.environ.get("PYTHONPATH", "").split(os.pathsep)]
    return {
        **os.environ,
        "NUMBA_NUM_THREADS": str(threads),
        "OPENBLAS_NUM_THREADS": "1",
        "PYTHONPATH": os.pathsep.join(path for path in paths if path),
    }
