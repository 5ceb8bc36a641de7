"""Signals that ask a command to stop: Ctrl-C, SIGTERM, the end of standard input."""

from __future__ import annotations

import os
import signal
import threading
from types import FrameType
from typing import Any

from lasersph.cli.failures import INTERRUPTED, TERMINATED


class StopSignals:
    """Notes Ctrl-C, SIGTERM and the end of standard input, so that a run stops between two steps.

    A second Ctrl-C stops at once.
    """

    def __init__(self, *, until_stdin_closes: bool = False) -> None:
        self.code = 0
        if until_stdin_closes:
            threading.Thread(target=self._note_end_of_stdin, daemon=True).start()
        self._before: dict[int, Any] = {}

    def __enter__(self) -> StopSignals:
        """Listen."""
        # The handlers of before come back at the end.
        for number in (signal.SIGINT, signal.SIGTERM):
            self._before[number] = signal.signal(number, self._note)
        return self

    def __exit__(self, *_: object) -> None:
        """Leave the signals as they were."""
        for number, handler in self._before.items():
            signal.signal(number, handler)

    def _note(self, number: int, _frame: FrameType | None) -> None:
        # A second Ctrl-C interrupts at once.
        if self.code and number == signal.SIGINT:
            raise KeyboardInterrupt
        self.code = INTERRUPTED if number == signal.SIGINT else TERMINATED

    def _note_end_of_stdin(self) -> None:
        # not sys.stdin: a thread that waits in its buffer aborts the interpreter at its end
        while os.read(0, 1):
            pass
        self.code = TERMINATED

    def asked(self) -> bool:
        """Whether a signal has come, or the end of standard input."""
        return self.code != 0
