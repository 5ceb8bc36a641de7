"""DualSPHysics: its program for processors, threads by OpenMP.

Its preprocessor GenCase is not needed: both files that it writes are written here.
"""

from __future__ import annotations

import os
import re
import subprocess
from collections import deque
from itertools import pairwise
from pathlib import Path
from string import Template
from time import perf_counter

import same_particles as particles
from dualsphysics_files import write_particles
from measurement import Measurement, middle
from workplace import CASES, LAST_LINES, PeerFailed, Program, Workplace

GAMMA = 7.0
"""Exponent of Tait's equation of state [1]."""
PART = re.compile(r"^\d{5}\s+[\d.]+\s+([\d,]+)\s")
"""Line at the end of a segment, with the number of steps until then."""

Segments = list[tuple[int, float, float]]
"""At the end of each segment: steps so far, wall and processor time so far [s]."""


def installed(workplace: Workplace) -> Path | None:
    """The program, where its release for Linux or one built from its source was put."""
    return next((workplace.folder / "dualsphysics").glob("DualSPHysics*CPU_linux64"), None)


def write_case(folder: Path, edge: int, segments: int, steps: int) -> Path:
    """Write a block with free surfaces; returns the path of the case without its ending."""
    name = folder / f"block-{edge}"
    position = particles.displaced_lattice(edge, 3)
    velocity = particles.vortices(position, edge)
    write_particles(name.with_suffix(".bi4"), position, velocity, (-0.5 * edge, 1.5 * edge))
    end = (segments * steps + 1) * particles.STEP  # not before the last segment has ended
    text = Template((CASES / "dualsphysics.xml").read_text(encoding="utf-8")).substitute(
        viscosity=particles.VISCOSITY, step=particles.STEP, count=edge**3,
        segment=steps * particles.STEP, end=end,
        smoothing_length=0.5 * particles.SUPPORT, stiffness=particles.SOUND_SPEED**2 / GAMMA,
    )  # fmt: skip
    name.with_suffix(".xml").write_text(text, encoding="utf-8")
    return name


def steps_done(line: str) -> int | None:
    """How many steps were done when a line was printed, None where it does not say so."""
    found = PART.match(line)
    return int(found[1].replace(",", "")) if found else None


def segment_times(segments: Segments) -> tuple[float, float]:
    """Median wall and processor time of a step [s], of all segments but the first."""
    if len(segments) < 3:
        raise PeerFailed("DualSPHysics printed no times of segments")
    times = []
    for before, after in pairwise(segments):
        steps = after[0] - before[0]
        times.append(((after[1] - before[1]) / steps, (after[2] - before[2]) / steps))
    return middle(times, 1)


def _processor_time(process: int) -> float:
    """Processor time of a running process and its threads [s]."""
    words = Path(f"/proc/{process}/stat").read_text(encoding="utf-8").rpartition(")")[2].split()
    return (int(words[11]) + int(words[12])) / os.sysconf("SC_CLK_TCK")


def _run(command: list[str], folder: Path, threads: int) -> Segments:
    """Run it and look at the clocks whenever it says that a segment has ended."""
    segments, last = [], deque[str](maxlen=LAST_LINES)
    libraries = str(Path(command[0]).parent)  # of a release, which lie beside its program
    variables = {"OMP_NUM_THREADS": str(threads), "LD_LIBRARY_PATH": libraries}
    with subprocess.Popen(
        ["stdbuf", "-oL", *command], cwd=folder, text=True, stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT, env=os.environ | variables,
    ) as process:  # fmt: skip
        for line in process.stdout or ():
            steps = steps_done(line)
            if steps is not None:
                segments.append((steps, perf_counter(), _processor_time(process.pid)))
            last += [line.strip()] if line.strip() else []
    if process.returncode:
        raise PeerFailed(f"DualSPHysics ended with {process.returncode}: " + " | ".join(last))
    return segments


def wcsph(workplace: Workplace) -> Measurement:
    """Whole step of weakly compressible SPH."""
    folder, edge = workplace.run_folder("dualsphysics"), workplace.edge
    case = write_case(folder, edge, workplace.segments + 1, workplace.steps)
    command = [str(installed(workplace)), str(case), str(folder / "out"), "-sv:none", "-svres:0"]
    command += ["-cpu", f"-ompthreads:{workplace.threads}", "-cellmode:half"]  # its fastest
    wall, processor = segment_times(_run(command, folder, workplace.threads))
    pairs = particles.directed_pairs(edge, is_periodic=False)
    return Measurement(
        "wcsph", "DualSPHysics", workplace.threads, edge**3, wall, processor, 1, pairs
    )


PROGRAM = Program(
    name="DualSPHysics",
    package="dualsphysics",
    is_installed=lambda workplace: installed(workplace) is not None,
    measures={"wcsph": wcsph},
    differs="float32 but for positions, no heat, Wendland's kernel, a block with free surfaces; "
    "one right-hand side a step (Verlet), particles sorted into cells at each and no lists",
)
