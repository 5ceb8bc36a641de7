"""lasersph simulates what a laser pulse does to metal, with smoothed particle hydrodynamics.

import lasersph

case = lasersph.load_case("dlip-steel", ["laser.fluence=0.8 J/cm^2"])
result = lasersph.run(case, "runs/steel")
print(result)  # the main numbers
lasersph.write_report(result.folder)  # figures and report.html
run = lasersph.open_run(result.folder)
run.history["time_s"], run.snapshots[-1]["temperature"]
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from lasersph.case import Case, load_case
    from lasersph.input import CaseError
    from lasersph.output import open_run
    from lasersph.plots import draw_run
    from lasersph.report import write_report
    from lasersph.report.run_comparison import compare_runs
    from lasersph.simulation import run
    from lasersph.studies import calibrate, find
    from lasersph.studies import process_map as map
    from lasersph.sweeps import sweep

__version__ = "0.1.0"
__all__ = [
    "Case",
    "CaseError",
    "__version__",
    "calibrate",
    "compare_runs",
    "draw_run",
    "find",
    "load_case",
    "map",
    "open_run",
    "run",
    "sweep",
    "write_report",
]

_ROOMS = {
    "Case": "lasersph.case",
    "CaseError": "lasersph.input",
    "calibrate": "lasersph.studies",
    "compare_runs": "lasersph.report.run_comparison",
    "draw_run": "lasersph.plots",
    "find": "lasersph.studies",
    "load_case": "lasersph.case",
    "map": "lasersph.studies:process_map",
    "open_run": "lasersph.output",
    "run": "lasersph.simulation",
    "sweep": "lasersph.sweeps",
    "write_report": "lasersph.report",
}
"""Room of each public name; after a colon its name there, where that is another."""


def __getattr__(name: str) -> Any:
    """Import a public name from its room when it is first asked for."""
    if name not in _ROOMS:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    from importlib import import_module

    room, _, inside = _ROOMS[name].partition(":")
    value = getattr(import_module(room), inside or name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    """The public names, for completion in a shell."""
    return sorted(__all__)
