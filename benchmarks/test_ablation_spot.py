"""The crater of a Gaussian spot of 10 um (1/e^2) on 20 x 20 um of aluminium at 0.1 um.

One pulse of 20 J/cm2 at the axis (10 J/cm2 on average) and 10 ns. A quarter of the spot between
adiabatic sides is computed, 16 um deep: 1.6 million particles.
Run: pytest benchmarks/test_ablation_spot.py -s
"""

import pytest
from whole_run import measured

SPOT = (
    "solver.dimensions=3",
    "domain.width=10 um",
    "boundaries.sides=adiabatic",
    "laser.beam={kind='gaussian', diameter_1e2='10 um'}",
    "laser.position=['-5 um', '-5 um']",
    "laser.fluence_kind=peak",
    "laser.fluence=20 J/cm^2",
    "output.snapshots.interval=5 ns",
)
SPACING = 1e-7
"""[m]."""
STEFAN_DEPTH = 1.334e-6
"""Of a wide beam of the same fluence [m]; see docs, Ablation."""
THREADS = 2
WITHIN = 600.0
"""Wall time allowed [s]."""


def test_crater_of_a_gaussian_spot(tmp_path):
    """Within 10 minutes on two threads, the run folder included."""
    found = measured("ablation-depth", [*SPOT, f"particles.spacing={SPACING} m"], tmp_path, THREADS)
    crater = found.summary["crater"]
    print(
        f"\n{found.summary['particles']} particles, {found.summary['steps']} steps: "
        f"{found.wall:.0f} s, {found.memory / 2**30:.2f} GiB; crater {1e6 * crater['depth_m']:.2f} "
        f"um deep, {1e6 * crater['diameter_m']:.2f} um wide"
    )
    assert crater["mirror_images"] == 4
    assert crater["depth_m"] == pytest.approx(STEFAN_DEPTH, abs=2.0 * SPACING)
    assert found.wall <= WITHIN
