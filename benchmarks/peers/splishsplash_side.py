"""SPlisHSPlasH: weakly compressible SPH of a falling block, threads by OpenMP."""

from __future__ import annotations

from pathlib import Path

from measurement import Measurement
from pysph_side import json_line
from workplace import CASES, Program, Workplace, output_of

DISPATCH = Path("/usr/lib/x86_64-linux-gnu/libGLdispatch.so.0")
"""Loaded first, or the import fails for want of memory for threads."""


def wcsph(workplace: Workplace) -> Measurement:
    """Whole step of its own block."""
    folder = workplace.run_folder("splishsplash")
    command = [str(workplace.python), str(CASES / "splishsplash_block.py"), str(folder)]
    command += [str(workplace.edge), str(workplace.segments * workplace.steps)]
    first = {"LD_PRELOAD": str(DISPATCH)} if DISPATCH.exists() else {}
    found = json_line(
        output_of(command, folder=folder, threads=workplace.threads, environment=first)
    )
    return Measurement(
        "wcsph", "SPlisHSPlasH", workplace.threads, int(found["count"]), found["wall"],
        found["processor"], 1, found["pairs"],
    )  # fmt: skip


PROGRAM = Program(
    name="SPlisHSPlasH",
    package="splishsplash",
    is_installed=lambda workplace: workplace.has_module("pysplishsplash*"),
    measures={"wcsph": wcsph},
    differs="float32, no heat, a falling block with walls, and a support of 2 spacings that cannot "
    "be chosen (28 neighbors)",
)
