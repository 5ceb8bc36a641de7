"""The least that a sweep must move and compute: its tiles and vectors, and its function."""

from __future__ import annotations

from hot_loops.counted import Tally, as_counted
from hot_loops.least import Least
from lasersph.compute.sweeps import Sweep


def least_of_sweep(sweep: Sweep) -> Least:
    """Of one sweep, every array read once and written once; zeros that fill tiles up count too.

    Each weight is multiplied and added. The function does the same in every row, so that one row
    of ones tells what that is.
    """
    tiles, inner = sweep.tiles, sweep.inner
    written = sum(array.nbytes for array in sweep.out)
    fetched = sum(array.nbytes for array in sweep.out if all(array is not a for a in sweep.read))
    traffic = sum(array.nbytes for array in (*tiles, inner, *sweep.read)) + written + fetched
    tally = Tally()
    results = sweep.function(*(as_counted(1.0, tally) for _ in range(sweep.arguments)))
    reduces = len(results) - len(sweep.out)
    rows = sweep.out[0].shape[0]
    return Least(
        float(traffic),
        2.0 * (tiles.value.size + inner.size) + float(rows * (tally.simple + reduces)),
        float(rows * tally.divisions),
    )
