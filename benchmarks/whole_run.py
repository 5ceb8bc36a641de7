"""A run with all its files in a process of its own, whose time and largest memory are measured."""

import json
import os
import subprocess
import sys
from dataclasses import dataclass
from time import perf_counter

RUN = """
import json, sys
from lasersph.case import load_case
from lasersph.simulation.time_loop import run

name, settings, out, threads = json.loads(sys.argv[1])
run(load_case(name, settings), out, threads=threads)
"""


@dataclass(frozen=True)
class Measured:
    """Wall time [s], largest memory [bytes] and summary of a run."""

    wall: float
    memory: int
    summary: dict


def measured(name, settings, folder, threads):
    """Run a shipped case with settings below `folder`."""
    out = str(folder / "run")
    begin = perf_counter()
    process = subprocess.Popen(
        [sys.executable, "-c", RUN, json.dumps([name, settings, out, threads])]
    )
    _, status, usage = os.wait4(process.pid, 0)
    wall = perf_counter() - begin
    process.returncode = os.waitstatus_to_exitcode(status)
    assert process.returncode == 0
    with open(f"{out}/summary.json", encoding="utf-8") as stream:
        return Measured(wall, 1024 * usage.ru_maxrss, json.load(stream))
