"""Task of a Dask worker: it has a process of its own compute one run.

That process is the worker of the local engine, and ends with a checkpoint where its standard input
ends: when the Dask worker dies in whatever way, and when the driver cancels the run, dies or loses
the scheduler. No run is computed for nobody, and none needs a signal that somebody must send.
"""

from __future__ import annotations

import json
import os
import queue
import socket
from typing import Any

from lasersph.sweeps.engine import FAILED, Event, Task
from lasersph.sweeps.local import WorkerProcess
from lasersph.sweeps.progress import ENDS

POLL = 0.5
"""Longest wait for the process before it is asked whether the run is still wanted [s]."""
BEAT = 20
"""Waits of that length after which the driver hears that the worker lives."""
Messages = queue.SimpleQueue[tuple[WorkerProcess, str | None]]

_idle: list[tuple[int, WorkerProcess, Messages]] = []
"""Processes that wait for a further run, each with its number of threads."""


def make_run_folder(text: str, threads: int | None, topic: str) -> dict[str, Any]:
    """Make one run folder exist, in a process that outlives the call for further runs.

    Args:
        text: `Task.as_dict` as JSON. topic: of the events for the driver.
        threads: of the run; None divides the processors of this machine by the runs that the
            worker makes at a time.

    Returns:
        How the run ended, see `Event.as_dict`.
    """
    from distributed import get_worker  # pyright: ignore[reportMissingImports]

    from lasersph.compute.threads import available

    # who computes, and whether the folder can be seen from here
    worker = get_worker()
    key = str(worker.get_current_task())
    host = socket.gethostname()
    name = f"{host}:{os.getpid()}"
    task = Task.from_dict(json.loads(text))
    if not task.folder.parent.is_dir():
        text = f"{host} has no folder {task.folder.parent}: all workers must see the same disk"
        return Event(task.run, "failed", name, text, FAILED, is_final=True).as_dict()

    threads = threads or max(1, available() // worker.state.nthreads)
    process, messages = _idle_process(threads)
    process.begin(task, 0)
    # hand on what the process says, and end it where nobody waits for the run
    silence = 0
    while True:
        if not _is_wanted(worker, key):
            process.ask_to_stop()
        try:
            _, line = messages.get(timeout=POLL)
        except queue.Empty:
            silence += 1
            if silence % BEAT == 0:
                worker.log_event(topic, {"run": task.run})
            continue
        # its output has ended: it died
        if line is None:
            text = f"its process on {host} ended: {process.last_words() or process.wait()}"
            return Event(task.run, "failed", name, text, FAILED).as_dict()
        event = {**json.loads(line), "worker": name}
        if event["kind"] in ENDS:
            # a process that has been asked to stop takes no further run
            if event["kind"] != "stopped":
                _idle.append((threads, process, messages))
            return event
        worker.log_event(topic, {"run": task.run, "event": event})


def _idle_process(threads: int) -> tuple[WorkerProcess, Messages]:
    """A living process for a run: one that has made others, or a new one."""
    for entry in list(_idle):
        try:
            _idle.remove(entry)
        except ValueError:  # another thread of the Dask worker took it
            continue
        if entry[0] == threads and entry[1].process.poll() is None:
            return entry[1:]
        entry[1].ask_to_stop()
    messages: Messages = queue.SimpleQueue()
    return WorkerProcess("", threads, messages), messages


def _is_wanted(worker: Any, key: str) -> bool:
    """Whether the driver still waits for the task: the state of a cancelled one tells."""
    task = worker.state.tasks.get(key)
    return task is not None and task.state in ("executing", "long-running")
