"""The particles' file (.bi4) that DualSPHysics reads, and that its own preprocessor writes.

It is a head of 64 bytes and one item. An item is a definition, values, arrays and items within it;
numbers are little-endian, booleans are int32, and a text is its length and its bytes.
"""

from __future__ import annotations

import struct
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

Value = bool | str | int | float | tuple[float, float, float]

TEXT, BOOL, UINT, ULLONG, DOUBLE, DOUBLE3 = 1, 2, 8, 10, 12, 23
ARRAYS = {("u4", 1): 8, ("f4", 1): 11, ("f4", 3): 22, ("f8", 3): 23}
"""Number of an array's type, by its type here and its columns."""


def _text(words: str) -> bytes:
    return struct.pack("<I", len(words)) + words.encode("ascii")


def _value(name: str, kind: int, value: Value) -> bytes:
    """A named value."""
    if isinstance(value, str):
        packed = _text(value)
    elif isinstance(value, tuple):
        packed = struct.pack("<3d", *value)
    else:
        packed = struct.pack({BOOL: "<i", UINT: "<I", ULLONG: "<Q", DOUBLE: "<d"}[kind], value)
    return _text(name) + struct.pack("<i", kind) + packed


def _array(name: str, array: NDArray) -> bytes:
    """A named array, shape (n,) or (n, 3)."""
    columns = 1 if array.ndim == 1 else array.shape[1]
    kind = ARRAYS[array.dtype.str[1:], columns]
    sizes = struct.pack("<iiII", 0, kind, len(array), array.nbytes)
    definition = _text("\nARRAY") + _text(name) + sizes
    return struct.pack("<I", len(definition)) + definition + array.tobytes()


def _item(
    name: str,
    values: list[tuple[str, int, Value]],
    arrays: dict[str, NDArray] | None = None,
    items: tuple[bytes, ...] = (),
) -> bytes:
    """A named item with all that is in it."""
    arrays = arrays or {}
    known = _text("\nVALUES") + struct.pack("<I", len(values))
    known += b"".join(_value(*value) for value in values)
    definition = _text("\nITEM\n") + _text(name) + struct.pack("<ii", 0, 0)
    definition += _text("%.7E") + _text("%.15E")
    definition += struct.pack("<III", len(arrays), len(items), len(known))
    parts = [struct.pack("<I", len(definition)), definition, known]
    return b"".join([*parts, *(_array(*array) for array in arrays.items()), *items])


def write_particles(
    path: Path,
    position: NDArray[np.float64],
    velocity: NDArray[np.float64],
    corners: tuple[float, float],
) -> None:
    """Write particles of unit density, all of them fluid.

    Args:
        path: of the file. position: (3, n) [m]. velocity: (3, n) [m/s].
        corners: least and largest coordinate of the box beyond which particles are given up [m].
    """
    count = position.shape[1]
    low, high = ((at, at, at) for at in corners)
    part = _item(
        "PART_0000",
        [
            ("Cpart", UINT, 0), ("TimeStep", DOUBLE, 0.0), ("Npok", UINT, count),
            ("Nout", UINT, 0), ("Step", UINT, 0), ("RunTime", DOUBLE, 0.0),
            ("DomainMin", DOUBLE3, low), ("DomainMax", DOUBLE3, high),
        ],
        {
            "Idp": np.arange(count, dtype="<u4"), "Posd": position.T.astype("<f8"),
            "Vel": velocity.T.astype("<f4"), "Rhop": np.ones(count, "<f4"),
        },
    )  # fmt: skip
    still = (0.0, 0.0, 0.0)
    values: list[tuple[str, int, Value]] = [
        ("Piece", UINT, 0), ("Npiece", UINT, 1), ("CaseName", TEXT, path.stem),
        ("Data2d", BOOL, False), ("CaseNp", ULLONG, count), ("CaseNfixed", ULLONG, 0),
        ("CaseNmoving", ULLONG, 0), ("CaseNfloat", ULLONG, 0), ("CaseNfluid", ULLONG, count),
        ("CasePosMin", DOUBLE3, low), ("CasePosMax", DOUBLE3, high), ("NpDynamic", BOOL, False),
        ("H", DOUBLE, 0.0), ("MapPosMin", DOUBLE3, low), ("MapPosMax", DOUBLE3, high),
        ("PeriXinc", DOUBLE3, still), ("PeriYinc", DOUBLE3, still), ("PeriZinc", DOUBLE3, still),
    ]  # fmt: skip
    head = b"#FileJBD JPartDataBi4".ljust(58) + b"\n\0" + bytes(4)
    path.write_bytes(head + _item("JPartDataBi4", values, items=(part,)))
