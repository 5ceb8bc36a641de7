"""The measuring of the hot loops on few particles: all loops, in units, within the memory."""

import tracemalloc

import pytest
from hot_loops.ceilings import Ceilings
from hot_loops.counting import CountingBackend
from hot_loops.least import Least
from hot_loops.loops import list_build
from hot_loops.measure import (
    BYTES_PER_PARTICLE,
    Measured,
    _numbers_of_threads,
    loops_of,
    measure,
    memory,
)
from hot_loops.particles import jittered
from hot_loops.table import as_dict, ceilings_line, growth, table

from lasersph.sph.kernels import kernel

LOOPS = {
    "pair sum 2-D", "pair sum 3-D", "neighbor list 2-D", "neighbor list 3-D", "enthalpy update",
    "shifting 2-D", "shifting 3-D", "matrix times vector", "CG iteration", "CG iteration, factors",
    "BiCGStab iteration", "multigrid cycle", "pressure grid cycle",
}  # fmt: skip


def test_allloops_of():
    """Every hot loop has a time, a floor and a row; a measurement has its three ceilings."""
    limits, loops = [], []

    def report(one):
        (limits if isinstance(one, Ceilings) else loops).append(one)

    measure((1000, 2000), 1, large=2**16, report=report)
    assert len(limits) == 1 and limits[0].bandwidth > 1e8 and limits[0].arithmetic > 1e7
    assert 1e6 < limits[0].divisions < limits[0].arithmetic
    assert {one.name for one in loops} == LOOPS and len(loops) == 2 * len(LOOPS)
    assert all(one.time > 0.0 and one.floor > 0.0 and one.count >= 900 for one in loops)
    assert all(one.least.traffic > 8.0 and one.least.operations > 1.0 for one in loops)
    assert len(table(loops)) == len(growth(loops)) == 1 + len(LOOPS)
    numbers = as_dict(limits, loops)
    assert numbers["loops"][0]["time_over_floor"] == pytest.approx(loops[0].time / loops[0].floor)


def test_floor():
    """24 B at 12 B/s take longer than 3 operations at 3 a second, 3 divisions longer than both."""
    limits = Ceilings(1, 12.0, 3.0, 1.0)
    assert limits.floors(Least(24.0, 3.0)) == {"memory": 2.0, "arithmetic": 1.0, "division": 0.0}
    divided = Measured("sum", 100, 1, Least(), limits.floors(Least(24.0, 3.0, 3.0)), 4.5)
    assert (divided.limit, divided.floor, divided.ratio) == ("division", 3.0, 1.5)
    assert ceilings_line(limits).startswith("1 thread: ")


def test_bytes_of_a_list():
    """Two dimensions: x and the support read, the neighbors and the rows' ends written."""
    backend = CountingBackend(1)
    neighbors = jittered(backend, 10, kernel("wendland-c2", 2))
    pairs = neighbors.neighbor.shape[0]
    least = list_build(backend, neighbors).least
    assert least is not None
    assert least.traffic == 24.0 * 100 + 8.0 * pairs + 16.0 * 101
    assert least.operations == (2 + 3 + 2 + 1 + 1) * pairs


@pytest.mark.slow
def test_memory():
    """No loop takes more than is said before it starts, also while its list is made."""
    backend, count = CountingBackend(1), 60000
    for loop in loops_of(backend, count):
        loop.run()
    del loop
    tracemalloc.start()
    for loop in loops_of(backend, count):
        loop.run()
        del loop
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert 0.3 * BYTES_PER_PARTICLE * count < peak < BYTES_PER_PARTICLE * count
    assert memory(count) > peak


def _sum(count, threads, time):
    return Measured("sum", count, threads, Least(8.0, 1.0), {"memory": 1e-9}, time)


def test_speed_up_is_that_of_one_thread():
    """Rows of one loop stand together, with the time of one thread over theirs."""
    rows = table([_sum(100, 1, 4e-9), _sum(50, 2, 9e-9), _sum(100, 2, 2e-9)])
    assert [row[-1] for row in rows[1:]] == ["1.00", "2.00"]
    assert rows[0][-3] == "time / floor" and rows[1][-3] == "4.0"


def test_growth():
    """Sizes side by side, with all threads only."""
    rows = growth([_sum(100, 1, 4e-9), _sum(50, 2, 1e-9), _sum(100, 2, 2e-9)])
    assert rows[1:] == [("sum", "1.00", "2.00")]


def test_numbers_of_threads():
    """Powers of two and the most there are."""
    assert _numbers_of_threads(1) == [1]
    assert _numbers_of_threads(6) == [1, 2, 4, 6]
    assert _numbers_of_threads(8) == [1, 2, 4, 8]
