"""Finding and reading material files: shipped ones, the user's folder, a path.

A name is looked up first in the folder named by the environment variable LASERSPH_MATERIALS, then
among the shipped files, then among their other names ("Cu", "Ti64"); anything that ends in ".toml"
or holds a path separator is a path.
"""

from __future__ import annotations

import difflib
import os
from collections.abc import Mapping
from functools import lru_cache
from pathlib import Path

from lasersph.input import CaseError, build, read_toml
from lasersph.materials.material import Material
from lasersph.materials.other_names import is_called, metals_of_family, shipped_name

LIBRARY = Path(__file__).parent / "library"
FOLDER_VARIABLE = "LASERSPH_MATERIALS"
NEAR_NAME = 0.7
"""Likeness (difflib) of names taken for misspelt: steel and steel-304, not tin and iron."""


KNOWN = (
    "known: {}; or describe it in the case: write [material] with density, heat_capacity and "
    "conductivity"
)


def available_materials() -> dict[str, Path]:
    """Files of all materials that can be named, by name; the user's folder comes first.

        list(lasersph.available_materials())  # as `lasersph material list`

    Raises CaseError where LASERSPH_MATERIALS names something that is not a folder.
    """
    found = {path.stem: path for path in sorted(LIBRARY.glob("*.toml"))}
    # materials of the user go before shipped ones of the same name
    folder = os.environ.get(FOLDER_VARIABLE, "").strip()
    if folder:
        path = Path(folder).expanduser()
        if not path.is_dir():
            raise CaseError(
                f"{FOLDER_VARIABLE} names no folder",
                "set it to a folder of .toml files",
                file=folder,
            )
        found.update({file.stem: file for file in sorted(path.glob("*.toml"))})
    return dict(sorted(found.items()))


def material_file(name_or_path: str | os.PathLike[str]) -> Path:
    """File of a material given by name or path.

    Raises CaseError, with the nearest name, where there is no such material.
    """
    text = os.fspath(name_or_path)
    if text.endswith(".toml") or os.sep in text or isinstance(name_or_path, Path):
        return Path(text).expanduser()
    # a known name, then one of its other names
    known = available_materials()
    name = text if text in known else shipped_name(text, tuple(known))
    if name in known:
        return known[name]

    # neither: a family of metals, or a name that is spelt nearly so
    near = metals_of_family(text) or difflib.get_close_matches(text, known, n=1, cutoff=NEAR_NAME)
    meant = " or ".join(f'"{one}"' for one in near)
    hint = f"do you mean {meant}?" if near else KNOWN.format(", ".join(known))
    raise CaseError(f'no material "{text}"', hint, key="material")


def materials_like(word: str) -> dict[str, Material]:
    """By name the materials whose name, title, composition or other names hold a word."""
    found = {}
    for name in available_materials():
        material = load_material(name)
        text = f"{name} {material.title} {material.composition}".lower()
        if word.lower() in text or is_called(name, word):
            found[name] = material
    return found


def load_material(name_or_path: str | os.PathLike[str]) -> Material:
    """Read a material by name ("steel-304") or path ("my-alloy.toml").

        steel = lasersph.load_material("steel-304")
        steel.conductivity_at([300.0, 1000.0, 2000.0])  # W/(m K)

    Raises CaseError with file, line and key for anything wrong with the file.
    """
    path = material_file(name_or_path)
    try:
        status = path.stat()
    except (OSError, ValueError):
        return _read(path, 0, 0)
    return _read(path, status.st_mtime_ns, status.st_size)


def _other_words() -> Mapping[str, str]:
    """Words of other programs for the keys of a material; loaded where a message needs it."""
    from lasersph.materials.other_words import MATERIAL_WORDS

    return MATERIAL_WORDS


@lru_cache(maxsize=64)
def _read(path: Path, changed: int, size: int) -> Material:
    """Read a file once per state of it: changed [ns] and size [bytes] only tell states apart."""
    return build(Material, read_toml(path, tolerant=True), other_words=_other_words)
