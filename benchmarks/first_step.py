"""Run a command until its first time step and print as JSON where the time went.

    python benchmarks/first_step.py BEGUN run CASE ...

BEGUN is the time of the clock at which the process was started [s]. Each moment belongs to the
innermost section that is open then: an import, or a function of SECTIONS. Used by `start_up.py`.
"""

from __future__ import annotations

import builtins
import importlib
import json
import os
import sys
import time
from collections import defaultdict
from collections.abc import Callable
from typing import Any

SECTIONS = {
    "pydantic._internal._model_construction": {"ModelMetaclass.__new__": "models of pydantic"},
    "lasersph.case": {"load_case": "reading the case"},
    "lasersph.simulation.time_loop": {"build": "building particles and solver"},
    "lasersph.compute.loops": {"_ready": "text of the loops"},
    "numba.core.dispatcher": {"Dispatcher._compile_for_args": "loading compiled loops"},
}
"""Functions by module, with the words for their time; those that do not exist are passed over."""
LIBRARIES = {"numpy", "numba", "scipy", "h5py", "pydantic", "typer", "lasersph", "pint", "rich"}
ALIASES = {"llvmlite": "numba", "pydantic_core": "pydantic"}
REST = "the rest of the command and the first step"


def clocks() -> tuple[float, float]:
    """Time of the clock and of the processor [s]."""
    return time.time(), time.process_time()


class Sections:
    """Time by section, each moment in the innermost one."""

    def __init__(self) -> None:
        self.start = self._last = clocks()
        self._open = [REST]
        self.parts: dict[str, list[float]] = defaultdict(lambda: [0.0, 0.0])

    def charge(self) -> None:
        """Add the time since the last call to the innermost open section."""
        now, part = clocks(), self.parts[self._open[-1]]
        for k in range(2):
            part[k] += now[k] - self._last[k]
        self._last = now

    def timed(self, function: Callable, name: str) -> Callable:
        """The function, whose time belongs to a section."""

        def call(*arguments: Any, **options: Any) -> Any:
            self.charge()
            self._open.append(name)
            try:
                return function(*arguments, **options)
            finally:
                self.charge()
                self._open.pop()

        return call

    def wrap_loaded(self) -> None:
        """Time the functions of SECTIONS whose modules are loaded by now."""
        for module in [name for name in SECTIONS if name in sys.modules]:
            if getattr(sys.modules[module].__spec__, "_initializing", False):
                continue
            for path, section in SECTIONS.pop(module).items():
                *owners, attribute = path.split(".")
                owner: Any = sys.modules[module]
                for step in owners:
                    owner = getattr(owner, step, None)
                if hasattr(owner, attribute):
                    setattr(owner, attribute, self.timed(getattr(owner, attribute), section))

    def timed_import(self, function: Callable) -> Callable:
        """An import function, whose time belongs to the library that it loads."""

        def load(name: str, *arguments: Any, **options: Any) -> Any:
            library = name.partition(".")[0]
            library = ALIASES.get(library, library)
            is_new = library in LIBRARIES and name not in sys.modules
            timed = self.timed(function, f"importing {library}") if is_new else function
            module = timed(name, *arguments, **options)
            self.wrap_loaded()
            return module

        return load


def main() -> None:
    """Run the command."""
    begun, command = float(sys.argv[1]), sys.argv[2:]
    sections = Sections()

    def end(*_: object) -> None:
        sections.charge()
        wall, processor = sections.start
        sections.parts["starting Python"] = [wall - begun, processor]
        total, used = clocks()
        print(json.dumps({"wall": total - begun, "processor": used, "parts": sections.parts}))
        sys.stdout.flush()
        os._exit(0)

    builtins.__import__ = sections.timed_import(builtins.__import__)
    importlib.import_module = sections.timed_import(importlib.import_module)
    from lasersph.cli import main as run_command
    from lasersph.cli.progress import ProgressDisplay

    ProgressDisplay.__call__ = end  # pyright: ignore[reportAttributeAccessIssue]
    run_command(command)


if __name__ == "__main__":
    main()
