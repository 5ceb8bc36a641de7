"""3-D rates of matter that moves, all in one pass, against the bare right-hand side of SPH.

Run: pytest benchmarks/test_moving_matter.py -s
"""

import numpy as np
import pair_functions as functions
import setting

from lasersph import compute
from lasersph.solvers.ablation.equations import pair_rates, particle_rates

EDGE = 80
CONSTANTS = {
    "h_s": 1.45, "c_0": 10.0, "alpha_solid": 5.0, "alpha_liquid": 0.1, "factor": 1.0, "g": 9.81,
    "up": (0.0, 0.0, 1.0), "surroundings": np.array([300.0, 0.0, 0.0]), "step": 1.0,
}  # fmt: skip


def test_rates(benchmark):
    """Density, velocity, heat and viscosity take at most 2.5 times as long as pressure alone."""
    backend = compute.cpu(threads=2)
    neighbors = setting.jittered_cube(backend, EDGE)
    count, rng = EDGE**3, np.random.default_rng(2)
    fields = {name: 1.0 + rng.random(count) for name in ("rho", "P", "V", "V_a", "m", "T", "k")}
    fields |= {"v": rng.random((3, count)), "f_m": rng.random(count), "p": fields["P"]}
    fields |= {name: np.zeros(count) for name in ("kind", "E", "A")}
    out = (np.zeros(count), np.zeros((3, count)), np.zeros(count), None, None, None)
    bare = (np.zeros((3, count)), np.zeros(count))

    def all_rates():
        backend.pair_sum(
            pair_rates, neighbors, fields, out, finish=particle_rates,
            reduce=(None, None, None, "sum", "max", "max"), **CONSTANTS,
        )  # fmt: skip

    def pressure_alone():
        backend.pair_sum(functions.right_hand_side, neighbors, fields, bare, mu=0.1)

    benchmark.pedantic(all_rates, rounds=3, warmup_rounds=1)
    ours, least = setting.fastest(all_rates, pressure_alone, rounds=7)
    pairs = float(backend.to_host(neighbors.row_start)[-1])
    print(f"\nall rates {1e-6 * pairs / ours:.0f}, bare {1e-6 * pairs / least:.0f} million pairs/s")
    assert ours <= 2.5 * least
