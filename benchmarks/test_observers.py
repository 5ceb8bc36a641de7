"""What observers take of a step: the size of a large melt pool.

Processor time is counted, since others may run. Run: pytest benchmarks/test_observers.py -s
"""

from time import process_time

import numpy as np

from lasersph.observers import MeltPool, View

ROWS, COLUMNS, CELL = 320, 1250, 10e-9
ALLOWED = 0.01
"""Time per look [s], about twice that of an idle processor."""


def large_pool():
    """400 000 particles, of which more than half are molten."""
    fraction = np.zeros((ROWS, COLUMNS))
    fraction[:260, :900] = 1.0
    x = np.tile((np.arange(COLUMNS) + 0.5) * CELL, ROWS)
    z = np.repeat(-(np.arange(ROWS) + 0.5) * CELL, COLUMNS)
    flat = fraction.ravel()
    return View(
        time=0.0,
        step=0,
        time_step=0.0,
        position=np.array([x, z]),
        width=np.full((2, flat.size), CELL),
        volume=np.full(flat.size, CELL**2),
        mass=np.full(flat.size, CELL**2),
        temperature=300.0 + 1000.0 * flat,
        enthalpy=flat,
        melt_fraction=flat,
        vapor_fraction=np.zeros(flat.size),
        surface=np.arange(COLUMNS),
        symmetry_factor=2,
    )


def test_melt_pool():
    """Within its bound, the least of some looks."""
    pool, view = MeltPool(2), large_pool()
    times = []
    for _ in range(6):
        start = process_time()
        pool.observe(view)
        times.append(process_time() - start)
    print(f"\nsize of a melt pool among {view.volume.size} particles: {1e3 * min(times):.1f} ms")
    assert min(times) <= ALLOWED
