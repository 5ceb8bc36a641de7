"""Numba as if the entry of its threads were gone, and what small cases compute with it.

    python numba_without.py CASES

prints, for each case, a check sum of all that a few steps give, then the notices. Cases are
separated by commas.
"""

import hashlib
import sys
import warnings
from types import SimpleNamespace

import numpy as np


def forget_entry():
    """The entry of Numba's threads is unknown."""
    import llvmlite.binding as llvm

    known = llvm.address_of_symbol
    llvm.address_of_symbol = lambda name: None if name == "numba_parallel_for" else known(name)


def _loops(total):
    """One loop of each kind: sums over pairs, reductions, a search, renewed rows, sweeps."""
    from lasersph import compute
    from lasersph.compute import key_order, row_renewal, search, sweeps

    rng = np.random.default_rng(3)
    position, count = rng.random((2, 6000)), 6000
    backend, support = compute.cpu(threads=2), np.full(count, 0.05)
    found = search.neighbor_list(backend, position, support, count, mean=_mean)
    neighbors = SimpleNamespace(
        row_end=None,
        row_start=found[0], neighbor=found[1], position=position, support=support,
        kernel=None, mean=_mean, period=(),
    )  # fmt: skip
    T, out = rng.random(count), backend.zeros(count)
    sums = backend.pair_sum(_flow, neighbors, {"T": T}, (out, None), finish=_squared,
                            reduce=("min", "sum"))  # fmt: skip
    long = np.tile(T, 20)
    total += [*found, out, sums, backend.pointwise(_product, {"a": long}, None, reduce="sum")]
    weights = backend.zeros(found[1].size)
    backend.pair_values(_weight, neighbors, {}, weights)
    rows = row_renewal.PairRows(*found, weights)
    renewed = row_renewal.RenewedRows(backend, rows)
    renewed.update(key_order.rows_where((T > 0.5).astype(np.uint8), 1.0), rows)
    total += [renewed.row_start, renewed.row_end, *renewed.first]
    total += key_order.rows_by_key((T * 7).astype(np.uint32), 7)
    order = np.lexsort((position[1], np.floor(position[0] * 60)))
    sorted_position = np.ascontiguousarray(position[:, order])
    found = search.neighbor_list(backend, sorted_position, support, count, mean=_mean)
    pairs = sweeps.ordered_pairs(backend, SimpleNamespace(row_start=found[0], neighbor=found[1]),
                                 np.ones(found[1].size))  # fmt: skip
    value = backend.zeros(count)
    sweep = sweeps.Sweep(pairs, _relaxed, {"b": T}, [value], reduces=1, scale=0.3)
    total += [sweep(), value]


def _mean(l_i, l_j):
    return 0.5 * (l_i + l_j)


def _flow(T_i, T_j, r_ij):
    return (T_j - T_i) / r_ij


def _squared(total):
    return total, total**2


def _product(a):
    return a * a


def _weight(r_ij):
    return 1.0 / r_ij


def _relaxed(total, b, scale):
    value = b - 1e-3 * scale * total
    return value, value * value


def _conduction(total):
    """Steel heated by a pulse, with implicit steps."""
    from law_runs import go, host, solver_of

    _, solver = solver_of("dlip-steel", "particles.spacing=50nm", "laser.fluence=1.2 J/cm^2")
    solver.state.time = 4.8e-8
    go(solver, 4.81e-8)
    total += [solver.checkpoint_scalars(), *(host(solver, name) for name in solver.fields)]


def _melt_pool(total):
    """A pool driven by its surface."""
    from flow_boxes import go, host_fields, pool

    solver = pool(lambda x, z: (x < 1e-6) & (z > -6e-7), slope=-5e8)
    go(solver, 3)
    total += [solver.checkpoint_scalars(), *host_fields(solver).values()]


def _ablation(total):
    """Aluminium under a pulse, until some steps after the first particles have left."""
    from lasersph import compute
    from lasersph.case import load_case
    from lasersph.simulation.recipes import recipe_of
    from lasersph.solvers.step_control import binding_limit

    case = load_case("ablation-depth", ["solver.dimensions=1", "particles.spacing=0.2 um",
                                        "laser.fluence=20 J/cm2"])  # fmt: skip
    solver = recipe_of(case).build(compute.cpu(threads=2))
    while solver.state.ejecta.number < 3:
        solver.step(binding_limit(solver.time_step_limits())[1])
    host = solver.backend.to_host
    total += [solver.checkpoint_scalars(), *map(host, solver.fields.values())]


CASES = {
    "loops": _loops,
    "conduction": _conduction,
    "melt-pool": _melt_pool,
    "ablation": _ablation,
}


def sum_of(case):
    """Check sum of a case in this process."""
    values = []
    CASES[case](values)
    return check_sum(values)


def check_sum(values):
    """Of arrays, numbers and tables of them."""
    found = hashlib.sha256()
    for value in values:
        if isinstance(value, dict):
            found.update(repr(sorted(value.items())).encode())
        else:
            found.update(np.ascontiguousarray(value).tobytes())
    return found.hexdigest()[:16]


if __name__ == "__main__":
    forget_entry()
    with warnings.catch_warnings(record=True) as notices:
        warnings.simplefilter("always")
        for case in sys.argv[1].split(","):
            print(case, sum_of(case))
    for notice in notices:
        print(notice.category.__name__, notice.message)
