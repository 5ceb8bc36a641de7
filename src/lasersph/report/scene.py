"""The viewer inside a report: the module, and frames as 16-bit numbers that fit into one page.

Each field is rounded to 65 536 steps between the ends of its range. A block holds the differences
from the first block of its field, modulo 65 536, so that what stayed in place costs next to
nothing; then all low and all high bytes, compressed (zlib), in base64.
"""

from __future__ import annotations

import base64
import json
import zlib
from typing import Any

import numpy as np

from lasersph.output import Run
from lasersph.output.frame_blocks import particle_block, particle_index
from lasersph.output.viewer import viewer_module

MOST_FRAMES = 24
LARGEST = 5_000_000
"""Length of all blocks of a page [bytes]: a mail still carries it."""
COLORED = ("temperature", "speed", "melt_fraction")
ON_SURFACE = ("temperature", "speed", "height")
"""Fields of a surface that is a body."""
STEPS = 65535
"""Of 16-bit numbers."""

SCRIPT = """
const view = mount(document.getElementById("viewer"),
  inline(JSON.parse(document.getElementById("frames").textContent)));
document.getElementById("viewer").parentElement.classList.toggle("is-drawn", view.works);
"""


def scene(run: Run) -> str:
    """HTML of the viewer with its frames; empty where a run has none or they are too large."""
    frames = embedded_frames(run)
    if frames is None:
        return ""
    data = json.dumps(frames, separators=(",", ":")).replace("</", "<\\/")
    return (
        '<div id="viewer"></div>\n'
        f'<script type="application/json" id="frames">{data}</script>\n'
        f'<script type="module">{viewer_module()}{SCRIPT}</script>'
    )


def embedded_frames(run: Run) -> dict[str, Any] | None:
    """Index and blocks for `inline` of viewer.js: as many frames as fit, the hottest among them."""
    # Frames at even distances, the hottest among them.
    index = particle_index(run.path)
    count, start = len(index["times"]), index["start"]
    if not count:
        return None
    names = ["position", "width", *(name for name in COLORED if name in index["blocks"])]
    places = np.linspace(0, count - 1, min(count, MOST_FRAMES)).astype(int)
    places[np.argmin(np.abs(places - start))] = start
    chosen = sorted(set(places.tolist()))
    # All blocks of these frames, each field in steps of its own range.
    encoded: dict[str, dict[str, Any]] = {}
    for field, blocks in block_names(part_of(index, names, chosen)).items():
        encoded |= encode_field(run, blocks, 3 if field.endswith(("position", "width")) else 1)
    # Half of the frames at a time, until the page is small enough.
    while True:
        found = part_of(index, names, chosen)
        used = {name for blocks in block_names(found).values() for name in blocks}
        used |= {encoded[name]["first"] for name in used} - {None}
        if sum(len(encoded[name]["data"]) for name in used) <= LARGEST:
            return {"index": found, "blocks": {name: encoded[name] for name in sorted(used)}}
        # The hottest frame stays whatever goes.
        fewer = sorted({*chosen[::2], start})
        if len(fewer) == len(chosen):
            return None
        chosen = fewer


def part_of(index: dict[str, Any], names: list[str], chosen: list[int]) -> dict[str, Any]:
    """The index of some fields and frames alone."""

    def cut(file: dict[str, Any], fields: list[str]) -> dict[str, Any]:
        blocks = {name: [file["blocks"][name][k] for k in chosen] for name in fields}
        return {"counts": [file["counts"][k] for k in chosen], "blocks": blocks}

    # A surface that moves has the same frames; as a body it has colors of its own.
    line = index["surface"]
    is_body = line is not None and (line["shape"] is not None or index["revolved"])
    blocks_of_body = line["blocks"] if line is not None and is_body else {}
    of_surface = [name for name in ON_SURFACE if name in blocks_of_body]
    return {
        **index,
        **cut(index, names),
        "times": [index["times"][k] for k in chosen],
        "start": chosen.index(index["start"]),
        "fields": [one for one in index["fields"] if one["name"] in (*names, *of_surface)],
        "surface": None
        if line is None
        else {**cut(line, ["position", *of_surface]), "shape": line["shape"]},
    }


def block_names(index: dict[str, Any]) -> dict[str, list[str]]:
    """Names of the blocks of each field, in the order of frames, each once."""
    files = {"particles": index, "surface": index["surface"] or {"blocks": {}}}
    # Blocks that frames share are named once.
    return {
        f"{stem}.{field}" if stem == "surface" else field: list(
            dict.fromkeys(
                f"{stem}.{field}.{offset}.{count}.{index['stamp']}"
                for offset, count in zip(offsets, file["counts"], strict=True)
            )
        )
        for stem, file in files.items()
        for field, offsets in file["blocks"].items()
    }


def encode_field(run: Run, names: list[str], parts: int) -> dict[str, dict[str, Any]]:
    """The blocks of one field by name: `range` of each part, `first` block, `data`.

    Args:
        parts: numbers a particle has, 1 or 3.
    """
    # NaN has no 16-bit number: it becomes 0.
    blocks = {
        name: np.nan_to_num(np.frombuffer(particle_block(run.path, name), "<f4"))
        .reshape(-1, parts)
        .T.astype(float)
        for name in names
    }
    # One range for all blocks, so that colors keep their meaning.
    low = np.min([block.min(axis=1) for block in blocks.values()], axis=0)
    high = np.max([block.max(axis=1) for block in blocks.values()], axis=0)
    step = np.where(high > low, high - low, 1.0) / STEPS
    first: dict[int, tuple[str, np.ndarray]] = {}
    encoded = {}
    # Differences from the first block of the same length: what stayed in place is zeros.
    for name, block in blocks.items():
        steps = np.round((block - low[:, None]) / step[:, None]).astype("<u2")
        base = first.get(block.shape[1])
        first.setdefault(block.shape[1], (name, steps))
        # Low and high bytes apart compress better than mixed.
        plain = (steps - base[1] if base else steps).ravel().view(np.uint8)
        data = zlib.compress(plain[0::2].tobytes() + plain[1::2].tobytes(), 6)
        ends = np.stack([low, low + STEPS * step], axis=1).tolist()
        encoded[name] = {
            "range": ends,
            "first": base[0] if base else None,
            "data": base64.b64encode(data).decode(),
        }
    return encoded
