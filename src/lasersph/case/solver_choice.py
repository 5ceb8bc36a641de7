"""The `solver` key of a case: the settings of one solver, told apart by `kind`.

Without `kind` it is "conduction".
"""

from __future__ import annotations

from typing import Annotated, Any

from pydantic import BeforeValidator, Discriminator

from lasersph.solvers.ablation.settings import AblationSettings
from lasersph.solvers.conduction.settings import ConductionSettings
from lasersph.solvers.melt_pool.settings import MeltPoolSettings


def _with_kind(value: Any) -> Any:
    return {"kind": "conduction", **value} if isinstance(value, dict) else value


SolverChoice = Annotated[
    ConductionSettings | MeltPoolSettings | AblationSettings,
    Discriminator("kind"),
    BeforeValidator(_with_kind),
]
