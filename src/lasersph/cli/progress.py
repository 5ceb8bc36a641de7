"""How far a run is: a bar with the time left on a terminal, plain lines elsewhere."""

from __future__ import annotations

import sys
import time
from types import TracebackType
from typing import TYPE_CHECKING, Any, Self

if TYPE_CHECKING:
    from lasersph.simulation import RunProgress

LINES = 10


class ProgressDisplay:
    """Shows the progress of one run on standard error; a callback of the time loop."""

    def __init__(self, *, is_terminal: bool | None = None) -> None:
        self.is_terminal = sys.stderr.isatty() if is_terminal is None else is_terminal
        self._bar: Any = None
        self._task: Any = None
        self._start: tuple[float, float] | None = None
        self._shown = 0

    def __enter__(self) -> Self:
        """Nothing is shown before a loop is compiled or the first step is done."""
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        """Leave the bar as it stands."""
        if self._bar is not None:
            self._bar.stop()

    def __call__(self, status: RunProgress) -> None:
        """Show how far the run is, after each step."""
        fraction = min(status.work_done, 1.0)
        if self._start is None:
            self._start = (time.monotonic(), fraction)
            self._shown = int(LINES * fraction)
        text = f"{status.time * 1e9:.4g} ns, step {status.steps}, {status.hottest:.0f} K"
        if self.is_terminal:
            self._draw(fraction, text)
        elif int(LINES * fraction) > self._shown:
            self._shown = int(LINES * fraction)
            left = self._left(fraction)
            print(f"{100 * fraction:4.0f} %  {text}{left}", file=sys.stderr, flush=True)

    def compiling(self) -> None:
        """The first loop that no earlier run has left is about to be compiled."""
        text = "compiling loops as they are needed, about a minute in all; later runs find them"
        if self._bar is not None:
            self._bar.console.print(text)
        else:
            print(text, file=sys.stderr, flush=True)

    def _left(self, fraction: float) -> str:
        from lasersph.input import format_duration

        assert self._start is not None
        began, at = self._start
        if not at < fraction < 1.0:
            return ""
        left = (time.monotonic() - began) * (1.0 - fraction) / (fraction - at)
        return f", {format_duration(left)} left"

    def _draw(self, fraction: float, text: str) -> None:
        if self._bar is None:
            from rich.console import Console
            from rich.progress import BarColumn, Progress, TextColumn, TimeRemainingColumn

            self._bar = Progress(
                BarColumn(),
                TextColumn("{task.percentage:3.0f} %"),
                TimeRemainingColumn(),
                TextColumn("{task.description}"),
                console=Console(stderr=True),
            )
            self._bar.start()
            self._task = self._bar.add_task(text, total=1.0)
        self._bar.update(self._task, completed=fraction, description=text)
