"""PySPH: compiled right-hand sides, threads by OpenMP."""

from __future__ import annotations

import json
from functools import partial

import numpy as np
import same_particles as particles
from measurement import Measurement
from workplace import CASES, PeerFailed, Program, Workplace, output_of


def json_line(text: str) -> dict[str, float]:
    """The last line of a program's output that is JSON."""
    for line in reversed(text.splitlines()):
        if line.startswith("{"):
            return json.loads(line)
    raise PeerFailed("no line of numbers was printed")


def right_hand_side(case: str, workplace: Workplace) -> Measurement:
    """One right-hand side of a case; that of moving matter with its search for neighbors."""
    edge, folder = workplace.edge, workplace.run_folder("pysph")
    path = folder / f"{edge}.npy"
    np.save(path, particles.displaced_lattice(edge, 3))
    command = [str(workplace.python), str(CASES / "pysph_block.py"), str(path), case]
    numbers = (
        workplace.segments, particles.SUPPORT, particles.SOUND_SPEED, particles.VISCOSITY,
        particles.CONDUCTIVITY,
    )  # fmt: skip
    command += [str(number) for number in numbers]
    home = {"HOME": str(folder)}  # what it compiles is kept there
    found = json_line(
        output_of(command, folder=folder, threads=workplace.threads, environment=home)
    )
    pairs = particles.directed_pairs(edge, is_periodic=False)
    return Measurement(
        case, "PySPH", workplace.threads, edge**3, found["wall"], found["processor"], 1, pairs
    )


PROGRAM = Program(
    name="PySPH",
    package="pysph",
    is_installed=lambda workplace: workplace.has_module("pysph"),
    measures={name: partial(right_hand_side, name) for name in ("wcsph", "heat-sum")},
    differs="a block with free surfaces, right-hand sides alone; neighbors found anew for each in "
    "`wcsph`, kept in `heat-sum`",
)
