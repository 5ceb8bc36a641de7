"""Snapshots as a viewer fetches them: an index of all frames, and binary blocks that never change.

The particle file stores equal arrays once (`particle_file`), and so does a viewer: a block is named

    FILE.FIELD.OFFSET.COUNT.STAMP       particles.temperature.81845.81845.ec23...-187a...

after where it lies, and after the case and the start of its run, so that a folder that was removed
and computed anew never shows what a browser kept. A block holds little-endian float32, (count,) or
(count, 3), as stored.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np

from lasersph.output.errors import read_json
from lasersph.output.generation import read_unchanged
from lasersph.output.particle_file import open_for_reading, value_range
from lasersph.output.pulse_starts import starts_of_pulses
from lasersph.output.symmetry import is_axisymmetric, is_mirrored, mirrored_axes

NAME = re.compile(r"(particles|surface)\.([a-z_]+)\.([0-9]{1,15})\.([0-9]{1,12})\.([0-9a-z-]+)")
GEOMETRY = ("width",)
"""Fields that say how a particle is drawn, not what color it has."""
HOTTEST_SHARE = 1e-3
"""Of the rise in temperature: metal that boils stays as hot for a while, and its pool grows."""


def particle_index(folder: str | Path) -> dict[str, Any]:
    """Index that a viewer reads before it fetches: times, fields, and where their blocks lie.

    Returns:
        `case`: title. `stamp`: end of all block names. `is_complete`: whether more frames come.
        `dimensions`. `mirrored`, `mirrored_y`: whether x < 0 and y < 0 mirror what was computed.
        `revolved`: whether the surface is a line that is turned about the axis of a section.
        `levels`: temperatures by name at which the metal melts and boils [K]. `pulses`: when the
        clocks of the pulses of a train begin [s]. `times` [s] and `counts` of particles, one a
        frame. `start`: frame to begin with, in the middle of the hottest. `bounds`: [smallest,
        largest] x, y, z of the first frame [m]. `fields`: `name`, `label`, `unit`, `range` over all
        frames. `blocks`: offset of each frame by name of the field, with `position` and `width`,
        (count, 3) each. `surface`: `counts` and `blocks` of a surface that moves, with its fields,
        and `shape`, its numbers of points along x and y, null of a line; else null. Before the
        first snapshot, times and fields are empty.

    Raises:
        OutputError: there is no run, or its files are damaged.
    """
    path = Path(folder)
    stamp, case = stamp_and_case(path)
    index = {
        "case": str(case.get("title") or path.name),
        "stamp": stamp,
        "is_complete": (path / "summary.json").exists(),
        "mirrored": is_mirrored(case),
        "mirrored_y": mirrored_axes(case)[1],
        "revolved": is_axisymmetric(case),
        "levels": levels_of(case.get("material") or {}),
        "pulses": starts_of_pulses(case),
    }
    particles = read_unchanged(path, lambda: frames_of(path / "particles.vtkhdf"))
    surface = read_unchanged(path, lambda: frames_of(path / "surface.vtkhdf"))
    if not surface["times"]:
        return {**index, **particles, "surface": None}
    # while a run writes a frame, its line is not there yet: it waits for it
    particles = first_frames(particles, len(surface["times"]))
    found = {key: surface[key] for key in ("counts", "blocks", "shape")}
    # what the surface alone has colors it where it is a body
    known = {one["name"] for one in particles["fields"]}
    is_body = found["shape"] is not None or index["revolved"]
    own = [one for one in surface["fields"] if is_body and one["name"] not in known]
    particles["fields"] = [*particles["fields"], *own]
    return {**index, **particles, "surface": found}


def first_frames(frames: dict[str, Any], count: int) -> dict[str, Any]:
    """Frames of one file without those after the first `count`."""
    return {
        **frames,
        "times": frames["times"][:count],
        "counts": frames["counts"][:count],
        "start": min(frames["start"], count - 1),
        "blocks": {name: offsets[:count] for name, offsets in frames["blocks"].items()},
    }


def particle_block(folder: str | Path, name: str) -> bytes:
    """One block of a run: little-endian float32.

    Raises:
        ValueError: the name is not one of a block.
        KeyError: no frame of this run has such a block.
        OutputError: there is no run, or its files are damaged.
    """
    found = NAME.fullmatch(name)
    if found is None:
        raise ValueError("not the name of a block: FILE.FIELD.OFFSET.COUNT.STAMP")
    stem = found[1]
    field = found[2]
    stamp = found[5]
    place = (int(found[3]), int(found[4]))
    path = Path(folder) / f"{stem}.vtkhdf"
    # The stamp keeps blocks of an earlier run in the same folder from being mixed with this one's.
    if stamp != stamp_and_case(Path(folder))[0] or not path.exists():
        raise KeyError(f"this run has no block {name}")

    def read() -> bytes:
        with open_for_reading(path) as file:
            # Only places that the file lists are served: names come from outside.
            offsets = offsets_of(file).get(field)
            if offsets is None or place not in zip(offsets, counts_of(file), strict=True):
                raise KeyError(f"this run has no block {name}")
            values = dataset_of(file, field)[place[0] : sum(place)]
            return np.ascontiguousarray(values, "<f4").tobytes()

    return read_unchanged(path.parent, read)


def stamp_and_case(folder: Path) -> tuple[str, dict[str, Any]]:
    """Name of a run by its case and start, and the case; resolved.json is written at the start."""
    resolved = read_json(folder / "resolved.json")
    started = (folder / "resolved.json").stat().st_mtime_ns
    return f"{resolved['case_hash']}-{started:x}", resolved["case"]


def levels_of(material: Mapping[str, Any]) -> dict[str, float]:
    """Where the metal becomes fluid and where it boils at normal pressure [K], where it does."""
    keys = {"melts": ("melting", "liquidus"), "boils": ("vaporization", "temperature")}
    tables = {word: (material.get(table), key) for word, (table, key) in keys.items()}
    return {w: float(t[key]) for w, (t, key) in tables.items() if isinstance(t, dict)}


def frames_of(path: Path) -> dict[str, Any]:
    """Frames, fields and blocks of one file; without frames where there is no file yet."""
    frames: dict[str, Any] = {"dimensions": 0, "times": [], "counts": [], "start": 0}
    frames |= {"bounds": [[0.0, 0.0]] * 3, "fields": [], "blocks": {}, "shape": None}
    if not path.exists():
        return frames
    with open_for_reading(path) as file:
        root = file["VTKHDF"]
        frames["dimensions"] = int(file.attrs["dimension"])
        if "shape" in file.attrs:
            frames["shape"] = file.attrs["shape"][:].tolist()
        frames["times"] = root["Steps/Values"][:].tolist()
        frames["counts"], frames["blocks"] = counts_of(file), offsets_of(file)
        if not frames["times"]:
            return frames

        # Axes of the viewer's box, from the ranges of the first frame.
        ranges = ranges_of(file, path)
        frames["bounds"] = ranges["position"][0].reshape(2, 3).T.tolist()
        # Scalars color the particles, with one range of colors for all frames.
        for name, dataset in root["PointData"].items():
            if dataset.ndim > 1 or name in GEOMETRY:
                continue
            span = [float(np.min(ranges[name][:, 0])), float(np.max(ranges[name][:, 1]))]
            span = span if np.all(np.isfinite(span)) else [0.0, 0.0]
            words = {"name": name, "label": name.replace("_", " ")}
            frames["fields"].append({**words, "unit": str(dataset.attrs["unit"]), "range": span})
        # First frame to show: the middle one of those in which the metal is hottest.
        hottest = ranges.get("temperature", np.zeros((1, 2)))[:, 1]
        near_hottest = np.flatnonzero(hottest >= np.max(hottest) - HOTTEST_SHARE * np.ptp(hottest))
        frames["start"] = int(near_hottest[near_hottest.size // 2])
    return frames


def counts_of(file: Any) -> list[int]:
    """Number of points of each step."""
    root = file["VTKHDF"]
    return root["NumberOfPoints"][:][root["Steps/PartOffsets"][:]].tolist()


def offsets_of(file: Any) -> dict[str, list[int]]:
    """Where the block of each step begins, by name of the field."""
    steps = file["VTKHDF/Steps"]
    fields = {name: offsets[:].tolist() for name, offsets in steps["PointDataOffsets"].items()}
    return {"position": steps["PointOffsets"][:].tolist(), **fields}


def dataset_of(file: Any, field: str) -> Any:
    """Values of a field, or the positions, of all steps end to end."""
    return file["VTKHDF/Points"] if field == "position" else file[f"VTKHDF/PointData/{field}"]


def ranges_of(file: Any, path: Path) -> dict[str, np.ndarray]:
    """Smallest and largest values of each step, (steps, 2) or, of vectors, (steps, 6)."""
    # Kept by the writer; files of earlier versions are scanned.
    if "ranges" in file:
        return {name: dataset[:] for name, dataset in file["ranges"].items()}
    state = path.stat()
    return scan_ranges(path, state.st_mtime_ns, state.st_size)


@lru_cache(maxsize=64)
def scan_ranges(path: Path, changed: int, size: int) -> dict[str, np.ndarray]:
    """The same of a file whose writer kept none: every block is read, once per state of it."""
    with open_for_reading(path) as file:
        counts, found = counts_of(file), {}
        for name, offsets in offsets_of(file).items():
            dataset = dataset_of(file, name)
            # Frames that share a block read it once.
            blocks = {
                (start, count): value_range(dataset[start : start + count])
                for start, count in set(zip(offsets, counts, strict=True))
            }
            found[name] = np.array([blocks[key] for key in zip(offsets, counts, strict=True)])
    return found
