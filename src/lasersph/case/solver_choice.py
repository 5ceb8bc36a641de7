"""The `solver` key of a case: the settings of one solver, told apart by `kind`.

Without `kind` it is "conduction".
"""

from __future__ import annotations

from typing import Annotated, Any, TypeGuard

from pydantic import BeforeValidator, Discriminator

from lasersph.solvers.ablation.settings import AblationSettings
from lasersph.solvers.conduction.settings import ConductionSettings
from lasersph.solvers.melt_pool.settings import MeltPoolSettings
from lasersph.solvers.solver_settings import SolverSettings

SETTINGS: tuple[type[SolverSettings], ...] = (
    ConductionSettings,
    MeltPoolSettings,
    AblationSettings,
)
SELECTIVE_KEYS = frozenset[str]().union(*(settings.reads for settings in SETTINGS))
"""Keys of a case that not every solver reads."""


def reader_of(key: str) -> str:
    """Kind of the solver that reads one of SELECTIVE_KEYS."""
    return next(each.model_fields["kind"].default for each in SETTINGS if key in each.reads)


def computes_flow(solver: SolverSettings) -> TypeGuard[MeltPoolSettings]:
    """Whether a solver computes the incompressible flow of a melt, or of a box."""
    return "flow" in type(solver).model_fields


def moves_matter(solver: SolverSettings) -> TypeGuard[AblationSettings]:
    """Whether the matter of a solver moves, compresses and leaves."""
    return "motion" in type(solver).model_fields


def _with_kind(value: Any) -> Any:
    return {"kind": "conduction", **value} if isinstance(value, dict) else value


SolverChoice = Annotated[
    ConductionSettings | MeltPoolSettings | AblationSettings,
    Discriminator("kind"),
    BeforeValidator(_with_kind),
]
