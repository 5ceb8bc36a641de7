"""The list of validations; each is imported when it is run.

A validation is a module with `TITLE` and `run(out_dir, *, quick) -> Report`.
"""

from __future__ import annotations

from importlib import import_module
from pathlib import Path

from lasersph.input import CaseError, nearest
from lasersph.validation.report import Report
from lasersph.validation.runs import computing

MODULES = {
    "kernels": "kernels",
    "kernel-correction": "kernel_correction",
    "stefan": "stefan",
    "pulsed-heating": "pulsed_heating",
    "quasi-1d-heating": "quasi_1d_heating",
    "gaussian-pulse": "gaussian_pulse",
    "dlip-thermal": "dlip_thermal",
    "lid-driven-cavity": "lid_driven_cavity",
    "taylor-green": "taylor_green",
    "marangoni-layer": "marangoni_layer",
    "natural-convection": "natural_convection",
    "sound-wave": "sound_wave",
    "hydrostatic-column": "hydrostatic_column",
    "dam-break": "dam_break",
    "dlip-steel": "dlip_steel",
    "dlip-aluminium": "dlip_aluminium",
    "ablation-aluminium": "ablation_aluminium",
    "ablation-depth": "ablation_depth",
}


def names() -> tuple[str, ...]:
    """Names of all validations, in the order in which they are best run."""
    return tuple(MODULES)


def titles() -> dict[str, str]:
    """Name and the question that it answers."""
    return {name: _module(name).TITLE for name in MODULES}


def validate(
    name: str,
    out_dir: str | Path,
    *,
    quick: bool = False,
    threads: int | None = None,
    backend: str = "cpu",
) -> Report:
    """Run one validation and draw its figures into `out_dir`.

    Runs that an earlier call with the same sources left there are taken or continued.

    Args:
        quick: shortened, with tolerances as stated in its rows; still judged.
        threads: of each run; None takes all processors. backend: "cpu" or "cuda".

    Raises:
        CaseError: no such validation; says the nearest name. NoDevice: no graphics card.
    """
    folder = Path(out_dir)
    module = _module(name)
    folder.mkdir(parents=True, exist_ok=True)
    with computing(threads, backend):
        return module.run(folder, quick=quick)


def _module(name: str):
    if name not in MODULES:
        near = nearest(name, MODULES)
        hint = f'do you mean "{near}"?' if near else "there are " + ", ".join(MODULES)
        raise CaseError(f'no validation "{name}"', hint)
    return import_module(f"lasersph.validation.{MODULES[name]}")
