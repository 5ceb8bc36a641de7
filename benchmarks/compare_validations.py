"""Two results of `lasersph validate --json`, row by row: how far apart they are.

    python benchmarks/compare_validations.py cpu.json cuda.json
    python benchmarks/compare_validations.py before.json after.json --round-off 1e-6

Of a graphics card and the CPU a row agrees where the computed numbers differ by no more than
`SHARE` of the row's tolerance. Of two versions of the program that compute the same, with
`--round-off`, where they differ by no more than that part of the largest of both, the reference and
the tolerance: a defect that should be 0 is compared with what is allowed of it. Either way both
must have the same verdict. The exit code is 1 where a row does not agree, or only one has it.
"""

from __future__ import annotations

import argparse
import json
import sys
from pathlib import Path
from typing import Any, NamedTuple

from lasersph.validation.records import keyed_rows, relative

SHARE = 0.1
"""Part of a validation's tolerance that two backends may differ by."""


class Difference(NamedTuple):
    """Of one row: by how much it differs, over what is allowed or in parts of its size."""

    validation: str
    quantity: str
    size: float
    agrees: bool


def over_tolerance(first: dict[str, Any], second: dict[str, Any]) -> float:
    """Difference of two rows over what two backends may differ by; 0 where nothing is judged."""
    a, b, tolerance = first["computed"], second["computed"], first["tolerance"]
    if a is None or b is None or not tolerance:
        return 0.0
    return abs(a - b) / (SHARE * tolerance)


def differences(
    first: dict[str, Any], second: dict[str, Any], round_off: float | None = None
) -> list[Difference]:
    """Of every row of either result; `round_off`: None compares two backends."""
    found = []
    for name in first["validations"] | second["validations"]:
        ours, theirs = (
            keyed_rows(one["validations"].get(name, {"rows": []})["rows"])
            for one in (first, second)
        )
        for key in ours | theirs:
            size, agrees = float("inf"), False
            if key in ours and key in theirs:
                a, b = ours[key], theirs[key]
                size = over_tolerance(a, b) if round_off is None else relative(a, b)
                allowed = 1.0 if round_off is None else round_off
                agrees = size <= allowed and a["verdict"] == b["verdict"]
            found.append(Difference(name, key[0], size, agrees))
    return found


def main() -> int:
    """Print what is farthest apart first, and the largest difference of each validation."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0] if __doc__ else "")
    parser.add_argument("first", type=Path)
    parser.add_argument("second", type=Path)
    parser.add_argument("--round-off", type=float, metavar="X")
    given = parser.parse_args()
    first, second = (json.loads(path.read_text("utf-8")) for path in (given.first, given.second))
    rows = sorted(differences(first, second, given.round_off), key=lambda row: -row.size)
    for row in rows:
        word = "" if row.agrees else "NOT "
        print(f"{word}within: {row.size:8.2g}  {row.validation}: {row.quantity}")
    largest: dict[str, float] = {}
    for row in rows:
        largest.setdefault(row.validation, row.size)
    for name, size in largest.items():
        print(f"{name}: largest {size:.2g}")
    return 0 if all(row.agrees for row in rows) else 1


if __name__ == "__main__":
    sys.exit(main())
