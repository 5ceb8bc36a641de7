"""A worker: a process that makes run folders exist, one after the other, for a driver.

It starts once, so that libraries are imported and loops loaded once for many runs. Tasks come as
lines of JSON on its standard input, events leave as lines of JSON on its standard output. Where the
input ends, because the driver closed it or was killed, the run writes its checkpoint and the worker
ends: no run is computed for nobody.
"""

from __future__ import annotations

import gc
import json
import os
import queue
import signal
import sys
import threading
import time
from collections.abc import Callable
from dataclasses import replace
from typing import Any

from lasersph.sweeps.engine import DONE, FAILED, STOPPED, WRONG, Event, Task

SILENCE = 0.5
"""Least time between two events of progress [s]: pipes and terminals are slow."""
LOCK_WAIT = 120.0
"""A killed driver's worker needs a step and a checkpoint to leave a folder [s]."""
LOCK_POLL = 0.2


def make_run(
    task: Task,
    *,
    threads: int | None = None,
    report: Callable[[Event], None] = lambda event: None,
    should_stop: Callable[[], bool] = lambda: False,
) -> Event:
    """Make one run folder exist: find it complete, continue it, or compute it.

    Args:
        threads: of the loops; None takes all processors.
        report: called with events of progress. should_stop: asked after each step.

    Returns:
        How it ended; no failure of a run is raised.
    """
    from lasersph.input import CaseError
    from lasersph.output.errors import FolderLocked, FolderRefused
    from lasersph.simulation import RunProgress, Stopped, run
    from lasersph.solvers.step_control import StepFailed

    shown_at = float("-inf")

    def progress(status: RunProgress) -> None:
        nonlocal shown_at
        now = time.monotonic()
        if now - shown_at >= SILENCE:
            shown_at = now
            done, left = min(status.work_done, 1.0), status.remaining_s
            report(Event(task.run, "progress", work_done=done, remaining_s=left))

    # until it has ended: a folder that another process holds is waited for
    report(Event(task.run, "started"))
    patience, is_waiting = time.monotonic() + LOCK_WAIT, False
    ended = Event(task.run, "failed", exit_code=FAILED)
    while True:
        try:
            run(
                task.case,
                task.folder,
                resume=True,
                same_case=True,
                threads=threads,
                progress=progress,
                warn=False,
                should_stop=should_stop,
            )
            return Event(task.run, "complete", exit_code=DONE)
        except Stopped as stopped:
            return Event(task.run, "stopped", message=str(stopped), exit_code=STOPPED)
        except FolderLocked as error:
            if should_stop():
                return Event(task.run, "stopped", message=str(error), exit_code=STOPPED)
            if time.monotonic() > patience:
                return replace(ended, message=str(error), exit_code=WRONG, is_final=True)
            if not is_waiting:
                report(Event(task.run, "waiting", message=str(error)))
            is_waiting = True
            time.sleep(LOCK_POLL)
        except CaseError as error:
            return Event(task.run, "wrong", message=_one_line(error), exit_code=WRONG)
        except (StepFailed, FolderRefused) as error:
            return replace(ended, message=_one_line(error), is_final=True)
        except MemoryError:
            message = "not enough memory; take a coarser spacing or fewer workers"
            return replace(ended, message=message)
        except Exception as error:
            return replace(ended, message=_one_line(error))


def _one_line(error: Exception) -> str:
    return " ".join(str(error).split()) or type(error).__name__


def serve(threads: int | None) -> int:
    """Make runs until the standard input ends or SIGTERM comes; the exit code."""
    # events leave by a copy of standard output, to which nothing else writes
    events = os.fdopen(os.dup(1), "w", encoding="utf-8", buffering=1)
    os.dup2(2, 1)  # what libraries print is no event
    stopping = threading.Event()
    lines: queue.SimpleQueue[str | None] = queue.SimpleQueue()
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # a terminal sends it to the driver, which asks
    signal.signal(signal.SIGTERM, lambda *_: (stopping.set(), lines.put(None)))
    threading.Thread(target=_read_lines, args=(lines, stopping), daemon=True).start()

    def report(event: Event) -> None:
        try:
            events.write(json.dumps(event.as_dict()) + "\n")
        except (BrokenPipeError, ValueError):  # the driver is gone: the input ends as well
            stopping.set()

    gc.set_threshold(100_000)  # as on the command line
    while (line := lines.get()) is not None and not stopping.is_set():
        task = Task.from_dict(json.loads(line))
        report(make_run(task, threads=threads, report=report, should_stop=stopping.is_set))
    return STOPPED if stopping.is_set() else DONE


def _read_lines(lines: queue.SimpleQueue[str | None], stopping: threading.Event) -> None:
    """Hand on the lines of the standard input; at its end ask to stop.

    It reads without Python's buffers, whose locks a thread must not hold when Python ends.
    """
    unfinished = b""
    while block := os.read(0, 1 << 16):
        # whole lines go on, the last part waits for its end
        *whole, unfinished = (unfinished + block).split(b"\n")
        for line in whole:
            lines.put(line.decode("utf-8"))
    stopping.set()
    lines.put(None)


def main() -> None:
    """Entry point of a worker process: its argument is the number of threads, 0 for all."""
    threads: Any = int(sys.argv[1])
    code = serve(threads or None)
    sys.stderr.flush()
    os._exit(code)  # the reader may still wait for input
