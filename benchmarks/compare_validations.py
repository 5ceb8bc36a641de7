"""Two results of `lasersph validate --json`, row by row: how far a graphics card is from the CPU.

    python benchmarks/compare_validations.py cpu.json cuda.json

A row agrees where the two computed numbers differ by no more than `SHARE` of the row's tolerance
times its reference (or, beside 0, of the tolerance), and both have the same verdict. The exit code
is 1 where one does not.
"""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import Any

SHARE = 0.1
"""Part of a validation's tolerance that two backends may differ by."""


def apart(first: dict[str, Any], second: dict[str, Any]) -> float | None:
    """Difference of two rows over what is allowed; None where there is nothing to compare."""
    a, b, tolerance = first["computed"], second["computed"], first["tolerance"]
    if a is None or b is None or not tolerance:
        return None
    reference = first["reference"] if first["reference"] is not None else first["published"]
    return abs(a - b) / (SHARE * tolerance * (abs(reference) if reference else 1.0))


def compared(first: dict[str, Any], second: dict[str, Any]) -> list[tuple[str, str, float, bool]]:
    """Validation, quantity, difference over what is allowed, and whether all is well."""
    found = []
    for name, ours in first["validations"].items():
        theirs = {
            row["quantity"]: row for row in second["validations"].get(name, {"rows": []})["rows"]
        }
        for row in ours["rows"]:
            other = theirs.get(row["quantity"])
            if other is None:
                found.append((name, row["quantity"], float("inf"), False))
                continue
            distance = apart(row, other) or 0.0
            is_well = distance <= 1.0 and row["verdict"] == other["verdict"]
            found.append((name, row["quantity"], distance, is_well))
    return found


def main() -> int:
    """Print what is farthest apart first."""
    first, second = (json.loads(Path(name).read_text(encoding="utf-8")) for name in sys.argv[1:3])
    rows = sorted(compared(first, second), key=lambda row: -row[2])
    for name, quantity, distance, is_well in rows:
        print(f"{'' if is_well else 'NOT '}within: {distance:8.2g}  {name}: {quantity}")
    return 0 if all(row[3] for row in rows) else 1


if __name__ == "__main__":
    sys.exit(main())
