"""Textures: what a spot of 24 cells costs, and whether a hidden fluence is found in a profile.

python benchmarks/texture.py spot DIR       a spot of 50 um, 5 um period, 24 cells at 16 nm, two
                                            workers; the same command again goes on
python benchmarks/texture.py recover        20 made-up profiles with hidden factors on the
                                            fluence, tilts, 5 nm of noise, 1 % in lateral scale
"""

from __future__ import annotations

import sys
import time
from pathlib import Path

import numpy as np

from lasersph.cli import main
from lasersph.output.height_map import HeightMap
from lasersph.studies.texture.compare import Relief, compare

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "tests"))
from texture_cells import HIGHEST, spot, table

SPOT = (
    "solver.flow.surface=moving",
    "material.base=steel-304-demuth",
    "material.surface_tension=1.6 N/m",
    "particles.spacing=16 nm",
    'laser.spot={diameter="50 um", definition="1/e^2"}',
)
SEEDS, NOISE = 20, 5e-9


def spot_cost(folder: str, *more: str) -> int:
    """Compute the texture of a spot and say how long it took."""
    start = time.monotonic()
    settings = [word for one in SPOT for word in ("--set", one)]
    command = ["texture", "dlip-steel", *settings, "--cells", "24", "--workers", "2"]
    code = main([*command, "--threads", "1", "--out", folder, *more])
    print(f"{(time.monotonic() - start) / 60.0:.1f} minutes")
    return code


def recover() -> int:
    """Count in how many draws the 95 % interval holds the hidden factor."""
    x = np.arange(-24e-6, 24.01e-6, 0.125e-6)
    fluence = spot(center=0.9 * HIGHEST).at(*np.meshgrid(x, x))
    ours, found = Relief("made-up", table(), x, x, fluence, 1e-10), 0
    for seed in range(SEEDS):
        random = np.random.default_rng(seed)
        factor = random.uniform(0.85, 1.1)
        places, scale = np.linspace(-22e-6, 22e-6, 600), 1.0 + 0.01 * random.choice([-1, 1])
        moved = (places - 0.7e-6 * random.normal()) / scale
        z = ours.at(moved, 0.0 * places, factor)
        z += 3e-9 * random.normal() + 2e-3 * random.normal() * places
        z += NOISE * random.normal(size=places.size)
        fit = compare(ours, HeightMap(places - places[0], np.zeros(1), z[None]))
        low, high = fit.interval("fluence_factor")
        found += low <= factor <= high
        print(f"{seed:2d}  hidden {factor:.4f}  found {low:.4f} to {high:.4f}")
    print(f"{found} of {SEEDS} intervals of 95 % hold the hidden factor")
    return 0 if found >= SEEDS - 1 else 1


if __name__ == "__main__":
    verb, *rest = sys.argv[1:] or [""]
    if verb not in ("spot", "recover") or (verb == "spot") != bool(rest):
        sys.exit(__doc__)
    sys.exit(spot_cost(*rest) if verb == "spot" else recover())
