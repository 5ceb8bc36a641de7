"""A process that draws pictures for another one, see `drawing_processes`.

    python -m lasersph.plots.drawing_child

Pictures come as lines of JSON on its standard input; a line on its standard output answers each:
the file, null where the run has nothing of what it shows, and why it failed, empty if it did not.
Where the input ends, as it does when the other process is gone, this one ends at once: nothing is
drawn for nobody.
"""

from __future__ import annotations

import json
import os
import queue
import signal
import sys
import threading
from functools import cache
from io import BytesIO

from lasersph.output import Run, open_run
from lasersph.output.last_pulse import last_pulse
from lasersph.plots import style
from lasersph.plots.drawing_processes import Picture
from lasersph.plots.pictures import draw_picture


def answer(picture: Picture) -> dict[str, str | None]:
    """Draw a picture; no failure is raised."""
    try:
        run, shown = opened(picture.folder)
        file = draw_picture(run, shown, picture.name, picture.kind)
    except Exception as error:
        return {"file": None, "failure": " ".join(f"{type(error).__name__}: {error}".split())}
    return {"file": None if file is None else str(file), "failure": ""}


@cache
def opened(folder: str) -> tuple[Run, Run]:
    """The run in a folder and its last pulse; what was read of them serves all figures."""
    run = open_run(folder)
    return run, last_pulse(run)


def load() -> None:
    """Load fonts, and what else figures need, by an empty one."""
    figure, (axes,) = style.new_figure()
    style.label(axes, "x", "y")
    figure.savefig(BytesIO(), format="png")


def read_lines(lines: queue.SimpleQueue[bytes]) -> None:
    """Hand on the lines of the standard input; at its end the process ends, whatever it does.

    It reads without Python's buffers, whose locks a thread must not hold when Python ends.
    """
    unfinished = b""
    while block := os.read(0, 1 << 16):
        *whole, unfinished = (unfinished + block).split(b"\n")
        for line in whole:
            lines.put(line)
    os._exit(0)


def main() -> None:
    """Draw until the input ends."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # a terminal sends it to the other process, too
    # What libraries print is no answer.
    answers, sys.stdout = sys.stdout, sys.stderr
    lines: queue.SimpleQueue[bytes] = queue.SimpleQueue()
    threading.Thread(target=read_lines, args=(lines,), daemon=True).start()
    load()
    while True:
        found = answer(Picture(*json.loads(lines.get())))
        print(json.dumps(found), file=answers, flush=True)


if __name__ == "__main__":
    main()
