"""The first steps of small cases, compared with each other as far as they are alike."""

from __future__ import annotations

import hashlib
from functools import lru_cache
from typing import Any

import numpy as np

from lasersph import compute
from lasersph.case import Case, load_case
from lasersph.simulation.recipes import recipe_of
from lasersph.solvers.step_control import choose_step

END = 1.0 - 1e-9
"""Share of the time to compute at which all is done, for the rounding of the last step."""
BACKEND = compute.cpu(threads=1)
"""One for all: what binds the loops of a case is known to the next one."""


class FirstSteps:
    """Words of a case's layers and of each of its steps, computed when they are asked for."""

    def __init__(self, case: Case) -> None:
        recipe = recipe_of(case)
        layers, self._end = recipe.layers, END * case.time.end
        self._solver: Any = recipe.build(BACKEND)
        self._words = [repr((layers.columns.tolist(), layers.thickness.tolist()))]

    def word(self, step: int) -> str:
        """Limits, times, energies and fields after a step, the last one at most; 0: the layers."""
        while len(self._words) <= step and self._solver.state.time < self._end:
            self._words.append(self._advance())
        return self._words[min(step, len(self._words) - 1)]

    def _advance(self) -> str:
        """Advance by a step; returns its word."""
        solver = self._solver
        limits = solver.time_step_limits()
        solver.step(choose_step(limits)[1])
        state = solver.state
        found = hashlib.sha256(repr((sorted(limits.items()), state.time, state.energy)).encode())
        for field in solver.particles:
            values = solver.backend.host_view(solver.particles[field])
            found.update(np.ascontiguousarray(values).tobytes())
        return found.hexdigest()


@lru_cache(maxsize=32)
def steps_of(name: str, settings: tuple[str, ...]) -> FirstSteps:
    """First steps of a case with settings, kept: most keys are tried beside the same."""
    return FirstSteps(load_case(name, settings))


def are_other_steps(one: FirstSteps, other: FirstSteps, steps: int) -> bool:
    """Whether layers or one of so many steps differ; the first difference ends the comparison."""
    return any(one.word(k) != other.word(k) for k in range(steps + 1))
