"""Heights as text: columns whose names tell their units, and matrices of usual microscopes.

    x [um],z [nm]          a profile; also x_um z_nm, and Distance [um],Height [nm] or Depth [nm]
    x_m,height_m,...       the profile of a texture, surface.csv of a run, `lasersph export`
    # Width: 80.0 um       a matrix of Gwyddion with # Width, # Height and # Value units
    "XY calibration","277.78","nm"   a matrix of a Keyence microscope, with its unit

Separators are commas, semicolons, tabs or spaces. Nothing is guessed: without a unit it is refused.
"""

from __future__ import annotations

import re
from collections.abc import Sequence

import numpy as np

from lasersph.input import QuantityError, parse_quantity
from lasersph.output.errors import OutputError

GRID_TOLERANCE = 0.1
"""Share of a step by which places may lie beside an even grid: coordinates are rounded where they
are written, 88.2 nm to 0.0882 um, and a tenth of a step moves no line."""
NAME = re.compile(r"(.*?)[ _]*(?:\[|\(|_| )\s*([nuµμm]?m)\s*[\])]?$", re.IGNORECASE)
"""The name of a column and its unit of length: Height [nm], z_nm, x (um)."""
AXES = {
    "x": ("distance", "position", "lateral", "width"),
    "y": (),
    "z": ("height", "surface height", "elevation"),
    "-z": ("depth",),
}
"""Names of columns that count as one of x, y, z, or, of a depth that counts downward, as -z."""
SEPARATORS = re.compile(r"[,;\t ]+")
CALIBRATION = re.compile(r"XY.?calibration\D*?([0-9.eE+-]+)\W*([nuµμm]?m)", re.IGNORECASE)
HINT = (
    'name columns with their units of length, e.g. "x [um],z [nm]"; x may be called distance or '
    "position, z height or depth"
)
Grid = tuple[np.ndarray, np.ndarray, np.ndarray]


def read_text(text: str) -> Grid:
    """x (nx,), y (ny,) and z (ny, nx) [m] of a profile or a map; NaN where a height is missing.

    Raises:
        OutputError: no unit, no number, or places that are no grid of equal steps.
    """
    lines = [line.strip() for line in text.lstrip("\ufeff").splitlines() if line.strip()]
    if not lines:
        raise OutputError("it is empty")
    # Gwyddion and Keyence name their units in lines of their own; columns have them in their names.
    if any(line.startswith("# Value units") for line in lines[:10]):
        return _gwyddion(lines)
    if found := CALIBRATION.search("\n".join(lines[:40])):
        return _keyence(lines, found)
    return _columns(lines)


def _columns(lines: list[str]) -> Grid:
    # Names are parted by commas, semicolons or tabs, else by spaces.
    names = [one.strip(' "#') for one in re.split(r"[,;\t]", lines[0])]
    if len(names) < 2:
        names = lines[0].strip("# ").split()

    # The first column that can be x, y or z is taken as it.
    found: dict[str, tuple[int, float]] = {}
    for place, name in enumerate(names):
        if (known := _axis_of(name)) is not None and known[0] not in found:
            found[known[0]] = place, known[1]
    if "x" not in found or "z" not in found:
        raise OutputError(f'its first line is "{lines[0][:40]}": {HINT}')
    axes = [one for one in ("x", "y", "z") if one in found]
    columns, scales = zip(*(found[one] for one in axes), strict=True)

    # Numbers in meters.
    table = _numbers(lines[1:], len(names), columns) * scales
    if table.shape[0] < 3:
        raise OutputError(f"it holds {table.shape[0]} points, too few for a profile")

    # A profile: places in order along x.
    if len(axes) == 2:
        order = np.argsort(table[:, 0], kind="stable")
        x, z = table[order].T
        return _even(x, "x"), np.zeros(1), z[None, :]

    # A map: each point goes to its place in the grid of all x and y; places without one stay NaN.
    x, columns = np.unique(table[:, 0], return_inverse=True)
    y, rows = np.unique(table[:, 1], return_inverse=True)
    if x.size * y.size != table.shape[0]:
        raise OutputError(
            f"it holds {table.shape[0]} points at {x.size} x and {y.size} y: no rectangular grid"
        )
    z = np.full((y.size, x.size), np.nan)
    z[rows, columns] = table[:, 2]
    return _even(x, "x"), _even(y, "y"), z


def _axis_of(name: str) -> tuple[str, float] | None:
    """Axis x, y or z that a column holds and meters in its unit, below zero for a depth; None of
    other columns."""
    if (match := NAME.match(name)) is None:
        return None
    word, scale = match[1].strip().lower(), _length(f"1 {match[2]}")
    # Names as listed, or any that begins with the letter of the axis, such as x_lateral.
    for axis, words in AXES.items():
        if word in words or re.fullmatch(rf"{axis}\w*", word):
            return axis[-1], -scale if axis == "-z" else scale
    return None


def _gwyddion(lines: list[str]) -> Grid:
    # Lines with # hold the size of the field, width and height, and the unit of the heights.
    head = dict(line[1:].split(":", 1) for line in lines if line.startswith("#") and ":" in line)
    fields = {name.strip().lower(): value.strip() for name, value in head.items()}
    for name in ("width", "height", "value units"):
        if name not in fields:
            raise OutputError(f'it misses "# {name.capitalize()}: ..."')
    z = _matrix([line for line in lines if not line.startswith("#")])
    z = z * _length(f"1 {fields['value units']}")
    steps = [
        _length(fields[k]) / n for k, n in zip(("width", "height"), z.shape[::-1], strict=True)
    ]
    return _grid(z, *steps)


def _keyence(lines: list[str], found: re.Match[str]) -> Grid:
    # The step of the pixels is the same for both axes.
    step = _length(f"{found[1]} {found[2]}")
    unit = re.search(r'"?Unit"?\W+([nuµμm]?m)\b', "\n".join(lines), re.IGNORECASE)
    if unit is None:
        raise OutputError('it misses the unit of its heights ("Unit")')
    # The matrix follows the line "Height".
    start = next((n for n, line in enumerate(lines) if line.strip('", ').lower() == "height"), None)
    if start is None:
        raise OutputError('it misses the line "Height" before its matrix')
    z = _matrix([line.replace('"', "").strip(",") for line in lines[start + 1 :]])
    return _grid(z * _length(f"1 {unit[1]}"), step, step)


def _grid(z: np.ndarray, dx: float, dy: float) -> Grid:
    return dx * np.arange(z.shape[1]), dy * np.arange(z.shape[0]), z


def _matrix(lines: list[str]) -> np.ndarray:
    count = len(SEPARATORS.split(lines[0])) if lines else 0
    if count < 3:
        raise OutputError("it holds no matrix of heights")
    return _numbers(lines, count)


def _numbers(lines: list[str], count: int, columns: Sequence[int] | None = None) -> np.ndarray:
    """Numbers (lines, count), or of some columns only; a word such as BAD or nan is a height that
    is missing."""
    rows = [[one for one in SEPARATORS.split(line) if one] for line in lines]
    # Rows of one length only: a torn file is refused at its line.
    for number, row in enumerate(rows):
        if len(row) != count:
            raise OutputError(f"row {number + 1} holds {len(row)} numbers, not {count}")
    if columns is not None:
        rows = [[row[k] for k in columns] for row in rows]
    try:
        return np.array(rows, dtype=float)
    except ValueError:
        # Word by word, where one of them marks a height that is missing.
        return np.array([[_number(one, n + 1) for one in row] for n, row in enumerate(rows)])


def _number(word: str, row: int) -> float:
    if re.fullmatch(r"(?i)bad|nan|-+|no|data|\*+", word):
        return np.nan
    try:
        return float(word)
    except ValueError:
        raise OutputError(f'row {row}: "{word}" is no number') from None


def _length(text: str) -> float:
    try:
        return parse_quantity(text.replace("μ", "u").replace("µ", "u"), "length")
    except QuantityError as error:
        raise OutputError(str(error)) from None


def _even(places: np.ndarray, name: str) -> np.ndarray:
    """Places of equal steps. Raises OutputError where the steps differ."""
    # Compare with equal steps between the same ends.
    even = np.linspace(places[0], places[-1], places.size)
    if places.size > 1 and np.max(np.abs(places - even)) > GRID_TOLERANCE * (even[1] - even[0]):
        steps = np.diff(places)
        raise OutputError(
            f"the steps of {name} differ, from {steps.min():.4g} m to "
            f"{steps.max():.4g} m: resample it to equal steps"
        )
    return even
