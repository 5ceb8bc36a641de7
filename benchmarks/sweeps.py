"""What many runs cost beside the runs: the engine, finding complete ones, listing points.

    python benchmarks/sweeps.py [--runs 64] [--workers 2] [--points 1000]

Coarse runs of dlip-steel (conduction, 32 nm, one thread each) are made one after the other by
`lasersph.run` in this process, and by workers, in two halves whose order is turned, so that other
programs disturb both alike. The processor time stands beside that of the clock, and is the one to
read where others compute. Then points are listed, checked and found whose runs are complete.
"""

from __future__ import annotations

import argparse
import json
import resource
import statistics
import tempfile
import time
from collections import defaultdict
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path

import lasersph
from lasersph.sweeps import Event, LocalEngine, Table, build_plan, make_runs

SETTINGS = {"solver.kind": "conduction", "particles.spacing": "32 nm"}
MOST_SHARE, MOST_LISTING = 1.15, 5.0
"""Asked: of the ideal time, and of a thousand points [s]."""


@dataclass
class Times:
    """Seconds of the clock and of processors."""

    clock: float = 0.0
    processor: float = 0.0

    def add(self, work) -> None:
        """Time a piece of work, of this process and of those that it waits for."""
        began, used = time.perf_counter(), processor_time()
        work()
        self.clock += time.perf_counter() - began
        self.processor += processor_time() - used


def processor_time() -> float:
    """Of this process and its children that have ended [s]."""
    every = (resource.getrusage(who) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN))
    return sum(one.ru_utime + one.ru_stime for one in every)


def plan_of(runs: int, seed: int):
    """Fluences and durations of a sweep."""
    box = {
        "laser.fluence": {"from": "0.3 J/cm^2", "to": "1.2 J/cm^2"},
        "laser.pulse.fwhm": {"from": "5 ns", "to": "20 ns"},
    }
    sampling = {"kind": "latin-hypercube", "runs": runs, "seed": seed}
    return build_plan("dlip-steel", box, set=SETTINGS, sampling=sampling)


def make(plan, folder: Path, engine) -> Table:
    """The runs of a plan."""
    return make_runs(plan.points(), folder, plan.study, engine=engine)


def gaps(folder: Path) -> list[float]:
    """Times between the end of a run and the begin of the next by the same worker [s]."""
    ends: dict[str, datetime] = {}
    found = defaultdict(list)
    for line in (folder / "sweep.jsonl").read_text().splitlines():
        entry = json.loads(line)
        clock, worker = datetime.fromisoformat(entry["clock"]), entry["worker"]
        if entry["event"] == "started" and worker in ends:
            found[worker].append((clock - ends.pop(worker)).total_seconds())
        elif entry["event"] == "complete":
            ends[worker] = clock
    return [gap for each in found.values() for gap in each]


class PretendingEngine:
    """Writes the summary of another run for each task."""

    def __init__(self, summary: str) -> None:
        self.summary = summary

    def make(self, tasks, report, should_stop) -> None:
        """Make the folders of all tasks exist."""
        for task in tasks:
            task.folder.mkdir(parents=True)
            (task.folder / "summary.json").write_text(self.summary)
            report(Event(task.run, "complete", exit_code=0))


def line(name: str, value: str, asked: str = "") -> str:
    """One line of the answer."""
    return f"{name:58s}{value:>14s}{asked:>12s}"


def measure_runs(folder: Path, runs: int, workers: int) -> str:
    """Runs one after the other and by workers; the summary of one of them."""
    alone, together = Times(), Times()
    warm = lasersph.load_case("dlip-steel", [f"{key}={value}" for key, value in SETTINGS.items()])
    lasersph.run(warm, folder / "warm", threads=1)
    engine, between = LocalEngine(workers, 1), list[float]()
    for half in range(2):
        plan = plan_of(runs // 2, half)
        cases = [point.case for point in plan.points() if point.case is not None]

        def one_by_one(cases=cases, half=half) -> None:
            for number, case in enumerate(cases):
                lasersph.run(case, folder / f"alone-{half}-{number}", threads=1)

        def by_workers(plan=plan, half=half) -> None:
            make(plan, folder / f"together-{half}", engine)

        steps = [(alone, one_by_one), (together, by_workers)]
        for times, work in steps if half == 0 else reversed(steps):
            times.add(work)
        between += gaps(folder / f"together-{half}")
    share = together.clock / (alone.clock / workers)
    print(line(f"{runs} runs one after the other", f"{alone.clock:.1f} s"))
    print(line(f"by {workers} workers", f"{together.clock:.1f} s"))
    print(line("over the ideal share of it", f"{share:.3f}", f"< {MOST_SHARE}"))
    used = together.processor / alone.processor
    print(line("processor time by workers over one after the other", f"{used:.3f}"))
    if between:
        middle = statistics.median(between)
        print(line("between two runs of a worker, median", f"{1e3 * middle:.0f} ms", "< 50 ms"))
    return (folder / "warm" / "summary.json").read_text()


def measure_points(folder: Path, points: int, summary: str) -> None:
    """List, check and find points whose runs are complete."""
    make(plan_of(points, 7), folder, PretendingEngine(summary))
    times = Times()
    times.add(lambda: make(plan_of(points, 7), folder, PretendingEngine(summary)))
    asked = f"< {MOST_LISTING:g} s"
    print(line(f"{points} points listed, checked, found", f"{times.clock:.2f} s", asked))
    print(line("    processor time", f"{times.processor:.2f} s"))
    table = Times()
    table.add(lambda: Table.read(folder).write())
    print(line("    of it table.csv made anew", f"{table.clock:.2f} s"))
    print(line("a complete run found again", f"{1e3 * times.clock / points:.1f} ms"))


def main() -> None:
    """Measure and print everything."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--runs", type=int, default=64)
    parser.add_argument("--workers", type=int, default=2)
    parser.add_argument("--points", type=int, default=1000)
    given = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        summary = measure_runs(Path(folder), given.runs, given.workers)
        measure_points(Path(folder) / "points", given.points, summary)


if __name__ == "__main__":
    main()
