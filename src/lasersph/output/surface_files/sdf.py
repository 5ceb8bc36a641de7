"""SDF, the surface data file of ISO 25178-71 in ASCII: a header, heights row by row, a trailer.

Points and rows lie on a grid of equal steps; a height that is missing stands as BAD. All lengths
are meters. A profile is a file of one row. Coordinates begin at zero in this format: where a map
lies stands in the trailer, which readers keep as text.

Reference: [ISO25178] ISO 25178-71:2017, Software measurement standards, 5.
"""

from __future__ import annotations

from datetime import UTC, datetime

import numpy as np

from lasersph.output.errors import OutputError

VERSIONS = ("aISO-1.0", "aBCR-1.0")
"""First lines of ASCII files; those of binary files begin with b."""
FLOATS, NO_CHECKSUM = 7, 0
"""Code of double precision in DataType, and of no checksum in CheckType."""
MISSING = "BAD"


def sdf_text(z: np.ndarray, dx: float, dy: float, note: str = "") -> str:
    """The file of heights z (ny, nx) [m] at steps dx, dy [m]; NaN where one is missing."""
    ny, nx = z.shape
    # Header: lengths in meters, so that the scale of z is 1 and its resolution unknown (-1).
    made = datetime.now(UTC).strftime("%d%m%Y%H%M")
    head = {
        "ManufacID": "lasersph",
        "CreateDate": made,
        "ModDate": made,
        "NumPoints": nx,
        "NumProfiles": ny,
        "Xscale": f"{dx:.12e}",
        "Yscale": f"{dy:.12e}",
        "Zscale": "1.0",
        "Zresolution": "-1",
        "Compression": 0,
        "DataType": FLOATS,
        "CheckType": NO_CHECKSUM,
    }
    lines = [VERSIONS[0], *(f"{name:<12}= {value}" for name, value in head.items()), "*"]
    # One line a row of heights; the trailer holds the note.
    for row in z:
        lines.append(" ".join(MISSING if np.isnan(one) else f"{one:.9e}" for one in row))
    return "\n".join([*lines, "*", note, "*"]) + "\n"


def read_sdf(text: str) -> tuple[np.ndarray, float, float]:
    """Heights (ny, nx) [m], NaN where missing, and both steps [m].

    Raises:
        OutputError: no ASCII file of this format, or another number of heights than its header
            says.
    """
    # Version, header and heights are parted by asterisks.
    version, _, after_version = text.lstrip("\ufeff").partition("\n")
    if version.strip() not in VERSIONS:
        raise OutputError(
            f'it begins with "{version.strip()[:20]}", not with {VERSIONS[0]}: only ASCII files of '
            "this format are read"
        )
    head, _, body = after_version.partition("*")
    entries = (line.partition("=") for line in head.splitlines() if "=" in line)
    fields = {name.strip().lower(): value.strip() for name, _, value in entries}
    try:
        nx, ny = int(fields["numpoints"]), int(fields["numprofiles"])
        steps = [float(fields[f"{axis}scale"]) for axis in "xyz"]
    except KeyError as error:
        raise OutputError(f"its header misses {error.args[0]}") from None
    except ValueError as error:
        raise OutputError(f"its header holds {error}") from None
    # Heights are scaled by Zscale to meters.
    words = body.partition("*")[0].split()
    if len(words) != nx * ny:
        raise OutputError(f"it holds {len(words)} heights, its header says {nx} times {ny}")
    try:
        values = [np.nan if one == MISSING else float(one) for one in words]
    except ValueError as error:
        raise OutputError(f"a height is no number: {error}") from None
    return steps[2] * np.array(values).reshape(ny, nx), steps[0], steps[1]
