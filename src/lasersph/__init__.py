"""lasersph simulates what a laser pulse does to metal, with smoothed particle hydrodynamics.

import lasersph

case = lasersph.load_case("texture-steel", ["laser.fluence=0.8 J/cm^2"])
print(lasersph.check(case))  # what it needs, before anything runs
result = lasersph.run(case, "runs/steel")
print(result)  # the main numbers
run = lasersph.open_run(result.folder)
run.history["time_s"], run.snapshots[-1]["temperature"]  # arrays; run.units has their units
run.relief().z  # the relief [m]
lasersph.plot(run, "temperature")  # a figure of Matplotlib
lasersph.write_report(run)  # all figures and report.html

The functions are the verbs of the command line, with the same words for their arguments:
check, run, compare, export, sweep, texture, converge, threshold, spot, map, sensitivity, calibrate,
find, validate. `help(lasersph.sweep)` explains one.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from lasersph import plots
    from lasersph.case import Case, available_cases, load_case
    from lasersph.input import CaseError
    from lasersph.materials import available_materials, load_material
    from lasersph.output import open_run
    from lasersph.output.export import export
    from lasersph.plots import draw_run, plot
    from lasersph.report import write_report
    from lasersph.report.run_comparison import compare_runs
    from lasersph.simulation import check, run
    from lasersph.studies import assess_sensitivity as sensitivity
    from lasersph.studies import calibrate, converge, find, threshold
    from lasersph.studies import process_map as map
    from lasersph.studies import spot_threshold as spot
    from lasersph.studies.comparison import compare
    from lasersph.studies.texture.texture import texture
    from lasersph.sweeps import sweep
    from lasersph.validation import validate

__version__ = "0.1.0"
__all__ = [
    "Case",
    "CaseError",
    "__version__",
    "available_cases",
    "available_materials",
    "calibrate",
    "check",
    "compare",
    "compare_runs",
    "converge",
    "draw_run",
    "export",
    "find",
    "load_case",
    "load_material",
    "map",
    "open_run",
    "plot",
    "plots",
    "run",
    "sensitivity",
    "spot",
    "sweep",
    "texture",
    "threshold",
    "validate",
    "write_report",
]

_ROOMS = {
    "Case": "lasersph.case",
    "CaseError": "lasersph.input",
    "available_cases": "lasersph.case",
    "available_materials": "lasersph.materials",
    "calibrate": "lasersph.studies",
    "check": "lasersph.simulation",
    "compare": "lasersph.studies.comparison",
    "compare_runs": "lasersph.report.run_comparison",
    "converge": "lasersph.studies",
    "draw_run": "lasersph.plots",
    "export": "lasersph.output.export",
    "find": "lasersph.studies",
    "load_case": "lasersph.case",
    "load_material": "lasersph.materials",
    "map": "lasersph.studies:process_map",
    "open_run": "lasersph.output",
    "plot": "lasersph.plots",
    "plots": "lasersph.plots",
    "run": "lasersph.simulation",
    "sensitivity": "lasersph.studies:assess_sensitivity",
    "spot": "lasersph.studies:spot_threshold",
    "sweep": "lasersph.sweeps",
    "texture": "lasersph.studies.texture.texture",
    "threshold": "lasersph.studies",
    "validate": "lasersph.validation",
    "write_report": "lasersph.report",
}
"""Room of each public name; after a colon its name there, where that is another."""


def __getattr__(name: str) -> Any:
    """Import a public name from its room when it is first asked for."""
    if name not in _ROOMS:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    from importlib import import_module

    room, _, inside = _ROOMS[name].partition(":")
    value = import_module(room)
    if room != f"{__name__}.{name}":  # which would be the room itself
        value = getattr(value, inside or name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    """The public names, for completion in a shell."""
    return sorted(__all__)
