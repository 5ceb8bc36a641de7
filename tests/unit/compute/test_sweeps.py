"""Sweeps against the same sums row by row, and the order that blocks of rows get."""

import sys
from types import SimpleNamespace

import numpy as np
import pytest

from lasersph import compute
from lasersph.compute import sweeps
from lasersph.compute.sweep_text import sweep_text
from lasersph.compute.sweeps import Sweep, ordered_pairs


def pairs_of(backend, dense):
    """List of the entries that are not 0, as neighbors and weights."""
    row, column = np.nonzero(dense)
    start = np.searchsorted(row, np.arange(len(dense) + 1))
    neighbors = SimpleNamespace(
        row_start=backend.asarray(start, "offset"), neighbor=backend.asarray(column, "index")
    )
    return neighbors, backend.asarray(dense[row, column])


def band(count, reach=3):
    """Symmetric weights between rows that are at most `reach` apart."""
    dense = np.random.default_rng(2).uniform(0.1, 1.0, (count, count))
    near = np.abs(np.subtract.outer(np.arange(count), np.arange(count)))
    return np.where((near > 0) & (near <= reach), dense + dense.T, 0.0)


def ranks(count, block):
    """Place of each row in the order of a band whose blocks have two colors."""
    row = np.arange(count)
    return np.lexsort((row, row // block % 2)).argsort()


def swept(total, b, s):
    """b + s sum, and the square of that."""
    v = b + s * total
    return v, v * v


FACTOR = 1.0
"""What `scaled` reads beside its arguments."""


def scaled(total, b, s):
    """b + s FACTOR sum, and the square of that."""
    v = b + s * FACTOR * total
    return v, v * v


def expected(dense, rank, b, s, *, backward=False):
    """v = b + s sum over what is before, row by row."""
    v = np.zeros(len(b))
    for i in np.argsort(-rank if backward else rank):
        before = rank > rank[i] if backward else rank < rank[i]
        v[i] = b[i] + s * dense[i, before] @ v[before]
    return v


def run(backend, dense, b, s, **options):
    """Sweep of a matrix."""
    ordered = ordered_pairs(backend, *pairs_of(backend, dense))
    assert ordered is not None
    v = backend.zeros(len(b))
    sweep = Sweep(ordered, swept, {"b": backend.asarray(b)}, [v], reduces=1, s=0.0, **options)
    (square,) = sweep(s=s)
    found = backend.to_host(v)
    assert square == pytest.approx(found @ found)
    return found, ordered


def test_three_rows_by_hand(backend):
    """v = b + s sum of what is before: 1, 2 + 0.5 * 1, 4 + 0.5 * (3 * 1 + 2 * 2.5)."""
    dense = np.array([[0.0, 1.0, 3.0], [1.0, 0.0, 2.0], [3.0, 2.0, 0.0]])
    b = np.array([1.0, 2.0, 4.0])
    found, ordered = run(backend, dense, b, 0.5)
    assert found.tolist() == [1.0, 2.5, 8.0]
    found, _ = run(backend, dense, b, 0.5, backward=True)
    assert found.tolist() == [1.0 + 0.5 * (6.0 + 12.0), 6.0, 4.0]
    assert backend.to_host(ordered.total).tolist() == [4.0, 3.0, 5.0]
    assert backend.to_host(ordered.after).tolist() == [4.0, 2.0, 0.0]


@pytest.mark.parametrize("backward", [False, True])
@pytest.mark.parametrize("count", [17, 40])
def test_blocks_of_two_colors(backend, backward, count, monkeypatch):
    """Several blocks, a last one that is not full: every other block first, then the rest."""
    monkeypatch.setattr(sweeps, "BLOCK", 8)
    monkeypatch.setattr(sweeps, "FILL", 9.0)
    dense, b = band(count), np.cos(np.arange(count))
    found, ordered = run(backend, dense, b, 0.05, backward=backward)
    assert found == pytest.approx(expected(dense, ranks(count, 8), b, 0.05, backward=backward))
    assert backend.to_host(ordered.total) == pytest.approx(dense.sum(axis=1))
    later = ranks(count, 8)[None, :] > ranks(count, 8)[:, None]
    assert backend.to_host(ordered.after) == pytest.approx((dense * later).sum(axis=1))


def test_blocks_that_see_each_other_have_different_colors():
    """A path of four blocks needs two colors; with its ends joined to block 1, three."""
    touches = np.eye(4, dtype=np.uint8) + np.eye(4, k=1, dtype=np.uint8)
    assert sweeps._coloring(touches).tolist() == [0, 1, 0, 1]
    touches[3, 1] = touches[0, 2] = 1
    assert sweeps._coloring(touches).tolist() == [0, 1, 2, 0]


def test_pairs_listed_twice_are_summed_and_a_row_does_not_see_itself(backend):
    """As where an image of a particle stands for the particle."""
    neighbors = SimpleNamespace(
        row_start=backend.asarray([0, 3, 6], "offset"),
        neighbor=backend.asarray([0, 1, 1, 0, 0, 1], "index"),
    )
    ordered = ordered_pairs(backend, neighbors, backend.asarray([9.0, 1.0, 2.0, 1.0, 2.0, 9.0]))
    assert backend.to_host(ordered.total).tolist() == [3.0, 3.0]
    v = backend.zeros(2)
    Sweep(ordered, swept, {"b": backend.asarray([1.0, 1.0])}, [v], reduces=1, s=1.0)()
    assert backend.to_host(v).tolist() == [1.0, 4.0]


def test_rows_far_from_each_other_are_not_arranged(backend):
    """Where rows in a row share no neighbors, tiles would hold four times the weights."""
    count = 256
    order = np.random.default_rng(0).permutation(count)
    assert ordered_pairs(backend, *pairs_of(backend, band(count))) is not None
    shuffled = band(count)[np.ix_(order, order)]
    assert ordered_pairs(backend, *pairs_of(backend, shuffled)) is None


def test_a_constant_that_changes_gives_another_sweep(monkeypatch):
    """The text of a sweep is written anew where a name in its function means something else."""
    roles = {"total": "total", "b": "field", "s": "constant"}
    first = sweep_text(scaled, roles, 1, 1, backward=False)
    assert sweep_text(scaled, roles, 1, 1, backward=False) is first
    assert sweep_text(scaled, roles, 1, 1, backward=True) != first
    monkeypatch.setattr(sys.modules[__name__], "FACTOR", 2.0)
    assert sweep_text(scaled, roles, 1, 1, backward=False) == first.replace("1.0", "2.0")


def test_threads_change_no_bit(monkeypatch):
    """The same values and sums to the last bit on one thread and on two."""
    monkeypatch.setattr(sweeps, "BLOCK", 32)
    dense, b = band(300, reach=6), np.sin(np.arange(300.0))
    runs = [run(compute.cpu(threads=threads), dense, b, 0.03)[0] for threads in (1, 2)]
    assert np.array_equal(*runs)


def test_missing_and_unfit_arguments_are_refused(backend):
    """A field that is not given, and an array of another length."""
    ordered = ordered_pairs(backend, *pairs_of(backend, band(12)))
    with pytest.raises(ValueError, match="needs b"):
        Sweep(ordered, swept, {}, [backend.zeros(12)], reduces=1, s=1.0)
    with pytest.raises(ValueError, match="is asked for"):
        Sweep(ordered, swept, {"b": backend.zeros(5)}, [backend.zeros(12)], reduces=1, s=1.0)


def test_other_memory_is_not_arranged():
    """Where arrays are not the processor's, there are no sweeps."""
    neighbors = SimpleNamespace(row_start=None, neighbor=None)
    elsewhere = SimpleNamespace(unwrap=lambda array: "on a card")
    assert ordered_pairs(elsewhere, neighbors, None) is None
