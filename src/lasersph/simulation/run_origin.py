"""Origin of a run: the case and the programs that it begins with, and what a resumed run keeps."""

from __future__ import annotations

import platform
from importlib.metadata import version
from typing import Any

from lasersph import __version__
from lasersph.case import Case
from lasersph.input import format_quantity
from lasersph.output import RunFolder
from lasersph.output.run_owner import END as END_OF_CASE
from lasersph.output.run_owner import Origin
from lasersph.simulation.recipes import Recipe

PACKAGES = ("numpy", "numba", "scipy", "h5py", "pydantic", "matplotlib")
"""Libraries whose versions a run folder keeps."""


def origin_of(case: Case, variant: str) -> Origin:
    """Origin of a run: case, versions, and the keys that a resumed run may have otherwise.

    Args:
        variant: precision of the run, and the name of a recipe of one's own.
    """
    versions = {"lasersph": __version__, "python": platform.python_version()}
    versions |= {name: version(name) for name in PACKAGES}
    # Where pauses are jumped over, the end says how long each pulse is computed
    changeable = ("output", END_OF_CASE) if case.pause == "compute" else ("output",)
    case_hash = f"{case.hash()}-{variant}"
    return Origin(case.text, case.resolved(), versions, case_hash, changeable)


def keep_layers(recipe: Recipe[Any, Any], folder: RunFolder) -> list[str]:
    """Give a recipe the layers that a run of another end began with; warnings where they differ."""
    first, case = folder.started_with.get(END_OF_CASE), recipe.case
    if first is None:
        return []
    time = case.time.model_copy(update={"end": first})
    layers, usual = type(recipe)(case.model_copy(update={"time": time})).layers, recipe.layers
    recipe.layers = layers
    if layers.particle_count == usual.particle_count:
        return []
    ends = [format_quantity(end, "s") for end in (first, case.time.end)]
    return [
        f"the {layers.particle_count} particles were laid out for an end of {ends[0]}; a run begun "
        f"with {ends[1]} has {usual.particle_count}, which are fine down to another depth"
    ]
