"""The published sample of ablation: 20 x 20 x 200 um at 0.2 um, ten million particles.

One pulse of 10 J/cm2 and 10 ns under a top hat, steps of 0.05 ns to 15 ns [Alshaer2017, Section
4.4]. Only what heat reaches is computed. The run has a process of its own, whose largest memory is
measured. What a step costs with every particle awake is timed on a block of a tenth of the depth:
all of it would need 25 GiB for its pairs. Run: pytest benchmarks/test_ablation_sample.py -s
"""

import json
import resource
import subprocess
import sys
from time import perf_counter

from lasersph import compute
from lasersph.case import load_case
from lasersph.simulation.build import build
from lasersph.solvers.ablation.solver import Ablation

SAMPLE = (
    "solver.dimensions=3",
    "domain.width=20 um",
    "domain.depth=200 um",
    "particles.spacing=0.2 um",
    "boundaries.sides=wall",
    "laser.beam.kind=top-hat",
    "laser.beam.radius=7.5 um",
    "time.step=0.05 ns",
    "time.is_fixed=true",
    "output.snapshots.interval=5 ns",
)
SHALLOW = "domain.depth=20 um"
SAMPLE_LAYERS, SHALLOW_LAYERS = 1000, 100
THREADS = 2
WITHIN = 300.0
"""Wall time allowed [s]."""
MEMORY = 6 * 2**30
"""Memory allowed [bytes]."""


def sample(*changes):
    """The case with changes."""
    return load_case("ablation-depth", [*SAMPLE, *changes])


def seconds_per_step(*changes, before, steps):
    """Wall time of a step [s] after some `before`, and the particles that are awake."""
    _, solver = build(sample(*changes), compute.cpu(threads=THREADS))
    assert isinstance(solver, Ablation)
    for _ in range(before):
        solver.step(5e-11)
    begin = perf_counter()
    for _ in range(steps):
        solver.step(5e-11)
    awake = solver.body.total if solver.region is None else solver.region.awake_count
    return (perf_counter() - begin) / steps, awake


def test_ten_million_particles(tmp_path):
    """Within 5 minutes and 6 GiB on two threads, the run folder included."""
    code = (
        "import sys; from test_ablation_sample import *; from lasersph.simulation.run import run;"
        "run(sample(), sys.argv[1], threads=THREADS)"
    )
    begin = perf_counter()
    subprocess.run(
        [sys.executable, "-c", code, str(tmp_path / "run")],
        check=True,
        cwd=__file__.rpartition("/")[0],
    )
    wall = perf_counter() - begin
    memory = 1024 * resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss
    summary = json.loads((tmp_path / "run" / "summary.json").read_text(encoding="utf-8"))
    depth = 1e6 * summary["crater"]["depth_m"]
    print(
        f"\n{summary['particles']} particles, {summary['steps']} steps: {wall:.0f} s, "
        f"{memory / 2**30:.2f} GiB; depth at the axis {depth:.1f} um"
    )
    assert summary["particles"] == 10_000_000
    assert wall <= WITHIN
    assert memory <= MEMORY


def test_gain_over_everything_awake():
    """Time per step asleep and awake on the shallow block, and for the whole sample."""
    asleep, awake_count = seconds_per_step(SHALLOW, before=40, steps=20)
    everything, count = seconds_per_step(SHALLOW, "solver.sleep=false", before=2, steps=3)
    whole = everything * SAMPLE_LAYERS / SHALLOW_LAYERS
    print(
        f"\n20 um deep: {asleep:.3f} s a step with {awake_count} particles awake, "
        f"{everything:.3f} s with all {count}; 200 um deep, scaled: {whole:.1f} s, "
        f"{whole / asleep:.0f} times as long"
    )
    assert whole > 5.0 * asleep
