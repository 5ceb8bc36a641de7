"""X3P and SDF files of ours as an independent program reads them: SurfaceTopography (MIT).

pip install SurfaceTopography       # 0.5 GB with what it needs: in an environment of its own
python benchmarks/surface_files.py FILE.csv FILE.x3p FILE.sdf

The CSV is that of `lasersph export`, whose heights and columns the others must have.
"""

from __future__ import annotations

import sys

import numpy as np

METERS = {"m": 1.0, "mm": 1e-3, "µm": 1e-6, "nm": 1e-9}


def main(table: str, *files: str) -> int:
    """Print how heights and sides of the files differ from those of the table; 1 where they do."""
    import SurfaceTopography  # pyright: ignore[reportMissingImports]
    from SurfaceTopography.IO import open_topography  # pyright: ignore[reportMissingImports]

    x, y, z = np.loadtxt(table, delimiter=",", skiprows=1, unpack=True)
    x, y = np.unique(x), np.unique(y)
    z = z.reshape(y.size, x.size)
    sides = [np.ptp(side) * side.size / (side.size - 1) for side in (x, y)]
    worst = 0.0
    for file in files:
        reader = open_topography(file)
        found = reader.topography()
        heights = METERS[found.unit] * np.asarray(found.heights()).T  # theirs have x first
        off = float(np.abs(heights - z).max()) if heights.shape == z.shape else np.inf
        theirs = np.multiply(METERS[found.unit], found.physical_sizes)
        stretch = float(np.abs(theirs / sides - 1.0).max())
        worst = max(worst, off / np.ptp(z), stretch)
        print(
            f"{file}: SurfaceTopography {SurfaceTopography.__version__}, {type(reader).__name__}, "
            f"{found.nb_grid_pts} points; heights differ by {off:.2g} m, sides by {stretch:.2g}, "
            f"rms height {METERS[found.unit] * found.rms_height_from_area():.6g} m"
        )
    return 0 if worst < 1e-6 else 1


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    sys.exit(main(*sys.argv[1:]))
