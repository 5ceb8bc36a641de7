"""Runs on a cluster: tasks for the workers of a Dask scheduler that runs already.

The folders on disk are the truth, and what Dask says of a task is a hint: a task that it loses,
drops together with a dying worker or never starts is submitted again until its folder is complete
or its retries are used up. Two processes that are given the same run do no harm: the folder's lock
lets one of them in.
"""

from __future__ import annotations

import json
import logging
import os
import queue
import re
import socket
import threading
import time
import uuid
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from lasersph.output.checkpoint import candidates
from lasersph.output.errors import OutputError, clear_errors
from lasersph.sweeps.dask_task import make_run_folder
from lasersph.sweeps.engine import FAILED, STOPPED, Event, Report, Task

POLL = 0.2
"""Longest wait for an event before the driver asks whether to stop [s]."""
ANSWER = 10.0
"""Longest wait for an answer of the scheduler [s]."""
SILENCE = 120.0
"""A task of which nothing is heard for so long while workers are idle is submitted again [s]; a
worker that computes is heard every 10 s (`dask_task.BEAT`)."""
LOOK = 2.0
"""From one look for workers to the next [s]."""
ADDRESS = re.compile(r"(?P<protocol>tcp|tls)://(?P<host>.+):(?P<port>[0-9]+)")
MESSAGE = 300
"""Characters of an error of Dask's that are told: some hold whole stacks."""


@dataclass(frozen=True)
class DaskEngine:
    """Runs on the workers of a Dask scheduler, which must see the same disk as the driver.

    Attributes:
        scheduler_file: written by `dask scheduler --scheduler-file`; or
        address: of the scheduler, `tcp://node1:8786`.
        tls: folder with `cert.pem` and `key.pem`, the certificate and key of the cluster; without
            it whoever reaches the scheduler can run programs in your name.
        threads: of each run; None for the processors of a worker over its tasks at a time.
        retries: how often a run is tried again that failed for a reason that may pass, or whose
            worker died without a checkpoint later than that of the try before.
        patience: how long to wait for a scheduler, at the start and when it is lost [s].
        worker_wait: how long the scheduler may be without any worker, or not answer how many it
            has [s]; by default twice what a nanny is given to bring a worker back
            (`--death-timeout 300`). More where workers wait in the queue of a batch system.

    Raises:
        OutputError: `distributed` is not installed, the address is none, or files of `tls` are
            missing.
    """

    scheduler_file: Path | None = None
    address: str | None = None
    tls: Path | None = None
    threads: int | None = None
    retries: int = 2
    patience: float = 60.0
    worker_wait: float = 600.0

    def __post_init__(self) -> None:
        try:
            import distributed  # noqa: F401  # pyright: ignore[reportMissingImports]
        except ImportError as error:
            raise OutputError(
                "distributed is not installed: pip install 'lasersph[dask]' brings it"
            ) from error
        if self.address is not None:
            check_address(self.address)
        for path in self.tls_files():
            if not path.exists():
                raise OutputError(f"cannot read {path}: no such file; see the page on clusters")

    def tls_files(self) -> list[Path]:
        """Certificate and key; none without `tls`."""
        return [] if self.tls is None else [self.tls / "cert.pem", self.tls / "key.pem"]

    def place(self) -> str:
        """Where the scheduler is to be found, for messages."""
        return self.address or str(self.scheduler_file)

    def connect(self) -> Any:
        """A client of the scheduler.

        Raises:
            OSError: none answers. OutputError: the address or the encryption is not right.
        """
        from distributed import Client, Security  # pyright: ignore[reportMissingImports]

        address = self.address
        # the file of the scheduler says where it listens
        if self.scheduler_file is not None:
            address = json.loads(self.scheduler_file.read_text())["address"]
        found = check_address(address or "")
        if (found["protocol"] == "tls") != (self.tls is not None):
            hint = "does not encrypt" if self.tls else "asks for a certificate, and none is given"
            raise OutputError(f"the Dask scheduler at {self.place()} {hint}")
        # a client that finds nobody leaves threads and tracebacks behind: knock first
        socket.create_connection((found["host"].strip("[]"), int(found["port"])), ANSWER).close()
        security = None
        if self.tls is not None:
            certificate, key = map(str, self.tls_files())
            security = Security(
                tls_ca_file=certificate,  # signed by itself
                tls_client_cert=certificate,
                tls_client_key=key,
                require_encryption=True,
            )
        return Client(address, security=security, timeout=ANSWER, set_as_default=False)

    def make(self, tasks: Sequence[Task], report: Report, should_stop: Callable[[], bool]) -> None:
        """Make the folders of all tasks exist; see `Engine.make`.

        Raises:
            OutputError: no scheduler answers, lasersph is not installed where it runs, or it has
                been without workers for `worker_wait`.
        """
        # a lost scheduler is our matter: Dask tells it with tracebacks
        logging.getLogger("distributed").setLevel(logging.CRITICAL)
        waiting = {task.run: Submission(task) for task in tasks}
        client = self._wait_for_scheduler(should_stop)
        while waiting and client is not None:
            try:
                _Session(self, client, waiting, report, should_stop).go()
            finally:
                close(client)
            if waiting:
                client = self._wait_for_scheduler(should_stop)
        for run in waiting:
            text = f"the Dask scheduler at {self.place()} is gone"
            text = "not started" if should_stop() else text
            report(Event(run, "stopped", message=text, exit_code=STOPPED))

    def _wait_for_scheduler(self, should_stop: Callable[[], bool]) -> Any:
        """A client; None where it was asked to stop. Raises OutputError."""
        until = time.monotonic() + self.patience
        while not should_stop():
            try:
                client = self.connect()
            except (OSError, ValueError, KeyError) as error:  # of a file half written
                if time.monotonic() >= until:
                    reason = str(error).splitlines()[0]
                    text = f"no Dask scheduler answers at {self.place()}: {reason}"
                    raise OutputError(text) from error
                time.sleep(POLL)
                continue
            try:
                client.run_on_scheduler(find_package)
            except Exception as error:
                close(client)
                text = f"lasersph is not installed where the Dask scheduler runs: {error}"
                raise OutputError(text) from error
            return client
        return None


def check_address(text: str) -> re.Match[str]:
    """Protocol, host and port of a scheduler. Raises OutputError."""
    found = ADDRESS.fullmatch(text)
    if found is None:
        raise OutputError(f'"{text}" is no address of a scheduler; write "tcp://node1:8786"')
    return found


def write_certificate(folder: Path) -> None:
    """Write `cert.pem` and `key.pem`, which let in to a cluster who can read both: you alone.

    They are good for a year; the certificate is signed by itself.

    Raises:
        OutputError: the folder cannot be written or has them already.
    """
    from distributed import Security  # pyright: ignore[reportMissingImports]

    made = Security.temporary()
    texts = {"cert.pem": made.tls_scheduler_cert, "key.pem": made.tls_scheduler_key}
    with clear_errors("write", folder):
        folder.mkdir(parents=True, exist_ok=True)
        for name, text in texts.items():
            # readable by its owner alone from the first moment, and never over an older one
            descriptor = os.open(folder / name, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o600)
            with open(descriptor, "w", encoding="ascii") as stream:
                stream.write(text)


def find_package() -> str:
    """The version of this package, of whoever finds it."""
    from lasersph import __version__

    return __version__


def close(client: Any) -> None:
    """Close a client; one whose scheduler is gone may not end, and is left alone."""
    thread = threading.Thread(target=lambda: client.close(timeout=ANSWER), daemon=True)
    thread.start()
    thread.join(ANSWER)


@dataclass
class Submission:
    """A task and how it stands with Dask.

    Attributes:
        future: None before it is submitted. attempt: how often it was tried in vain.
        heard: when anything was heard of it [s]. is_started: whether a worker computes it.
        checkpoint: name of the last one when it was tried in vain.
    """

    task: Task
    future: Any = None
    attempt: int = 0
    heard: float = 0.0
    is_started: bool = False
    checkpoint: str = ""

    def is_complete(self) -> bool:
        """Whether the folder says so; it is listed, as file servers answer that anew."""
        folder = self.task.folder
        return folder.is_dir() and any(path.name == "summary.json" for path in folder.iterdir())

    def has_progressed(self) -> bool:
        """Whether there is a later checkpoint than the last time that this was asked."""
        found = candidates(self.task.folder / "checkpoint")
        before, self.checkpoint = self.checkpoint, found[0].name if found else ""
        return self.checkpoint > before


class _Session:
    """Tasks given to one scheduler, as long as it lives."""

    def __init__(
        self,
        engine: DaskEngine,
        client: Any,
        waiting: dict[str, Submission],
        report: Report,
        should_stop: Callable[[], bool],
    ) -> None:
        self.engine, self.client, self.waiting = engine, client, waiting
        self.report, self.should_stop = report, should_stop
        self.topic = f"lasersph-{uuid.uuid4().hex}"
        self.messages: queue.SimpleQueue[Mapping[str, Any]] = queue.SimpleQueue()
        self.seen = time.monotonic()  # a worker

    def go(self) -> None:
        """Until every task has ended, the scheduler is lost, or it is asked to stop."""
        self.client.subscribe_topic(self.topic, lambda event: self.messages.put(event[1]))
        for submission in self.waiting.values():
            self._submit(submission)
        looked = resubmitted = time.monotonic()
        while self.waiting:
            if self.should_stop():
                self._stop()
                return
            self._listen()
            if self.client.status != "running":
                return
            # tasks that have ended; then, less often, workers and tasks that are silent
            for submission in list(self.waiting.values()):
                if submission.future.done():
                    self._settle(submission)
            if time.monotonic() - looked > min(LOOK, self.engine.worker_wait):
                looked = time.monotonic()
                threads = self._count_threads()
                if time.monotonic() - resubmitted > SILENCE:
                    resubmitted = time.monotonic()
                    self._submit_silent_ones(threads)

    def _count_threads(self) -> int:
        """Runs that all workers together make at a time; 0 where the scheduler does not answer.

        Raises:
            OutputError: it has been 0 for `worker_wait`.
        """
        try:
            found = self.client.nthreads(callback_timeout=ANSWER)
        except Exception:
            found = {}
        now = time.monotonic()
        if found:
            self.seen = now
        elif now - self.seen > self.engine.worker_wait:
            for run in self.waiting:
                self.report(Event(run, "stopped", message="no worker", exit_code=STOPPED))
            raise OutputError(
                f"the Dask scheduler at {self.engine.place()} has had no worker for "
                f"{self.engine.worker_wait:g} s, and {len(self.waiting)} runs are not complete: "
                "start workers; the same command goes on"
            )
        return sum(found.values())

    def _submit(self, submission: Submission) -> None:
        task = submission.task
        submission.heard, submission.is_started = time.monotonic(), False
        # a key of its own: Dask gives the result of an equal key without computing
        submission.future = self.client.submit(
            make_run_folder,
            json.dumps(task.as_dict()),
            self.engine.threads,
            self.topic,
            key=f"{task.run}-{uuid.uuid4().hex}",
            pure=False,
        )

    def _listen(self) -> None:
        """Report what workers have said since."""
        try:
            message = self.messages.get(timeout=POLL)
            while True:
                submission = self.waiting.get(message["run"])
                if submission is not None:
                    submission.heard, submission.is_started = time.monotonic(), True
                    if "event" in message:
                        self.report(Event(**message["event"]))
                message = self.messages.get_nowait()
        except queue.Empty:
            return

    def _settle(self, submission: Submission) -> None:
        """Report how a task ended, or try it again: the folder says whether it is complete."""
        future, run = submission.future, submission.task.run
        event = Event(run, "failed", message="Dask has lost the task", exit_code=FAILED)
        try:
            if future.status == "finished":
                event = Event(**future.result(timeout=ANSWER))
            elif future.status == "error":
                error = future.exception(timeout=ANSWER)
                text = " ".join(f"{type(error).__name__}: {error}".split())
                event = replace(event, message=text[:MESSAGE])
        except Exception as error:  # its worker died after it had finished
            event = replace(event, message=f"its result cannot be had: {type(error).__name__}")
        # the folder decides, whatever Dask says
        if submission.is_complete():
            event = replace(event, kind="complete", message="", exit_code=0)
        elif event.kind == "complete":
            text = f"{event.worker} calls it complete, but {submission.task.folder} is not here"
            event = replace(event, kind="failed", message=text, exit_code=FAILED)
        if event.kind in ("complete", "wrong") or event.is_final:
            self._end(event)
            return
        # a later checkpoint than at the try before: tries count anew
        submission.attempt = 1 if submission.has_progressed() else submission.attempt + 1
        if submission.attempt > self.engine.retries:
            text = f"{event.message} (tried {submission.attempt} times)"
            self._end(replace(event, kind="failed", message=text))
            return
        self.report(replace(event, kind="retry"))
        self._submit(submission)

    def _end(self, event: Event) -> None:
        del self.waiting[event.run]
        self.report(event)

    def _submit_silent_ones(self, threads: int) -> None:
        """Submit again what a worker could compute and none does.

        Args:
            threads: of all workers.
        """
        now = time.monotonic()
        silent = [s for s in self.waiting.values() if now - s.heard > SILENCE]
        # workers that none of the tasks heard of keeps busy
        idle = threads - (len(self.waiting) - len(silent))
        for submission in silent[: max(idle, 0)]:
            self.client.cancel([submission.future])
            text = f"nothing was heard of it for {SILENCE:g} s"
            self.report(Event(submission.task.run, "retry", message=text))
            self._submit(submission)

    def _stop(self) -> None:
        """Take all tasks back; runs in progress write their checkpoints."""
        self.client.cancel([submission.future for submission in self.waiting.values()])
        until = time.monotonic() + SILENCE
        for submission in self.waiting.values():
            # a run that has started holds its folder until its checkpoint is written
            lock = submission.task.folder / ".lock"
            while submission.is_started and lock.exists() and time.monotonic() < until:
                time.sleep(POLL)
            text = "" if submission.is_started else "not started"
            event = Event(submission.task.run, "stopped", message=text, exit_code=STOPPED)
            self.report(event)
        self.waiting.clear()
