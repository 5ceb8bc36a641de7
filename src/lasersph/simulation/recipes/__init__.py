"""Recipes: all that depends on a solver's kind beside its steps, a file or a folder each."""

from typing import Any

from lasersph.case import Case
from lasersph.simulation.recipes.ablation import AblationRecipe
from lasersph.simulation.recipes.conduction import ConductionRecipe
from lasersph.simulation.recipes.melt_pool import MeltPoolRecipe
from lasersph.simulation.recipes.recipe import (
    FlowForecast,
    Recipe,
    RunStage,
    StepCost,
    StepForecast,
)

__all__ = [
    "RECIPES",
    "AblationRecipe",
    "ConductionRecipe",
    "FlowForecast",
    "MeltPoolRecipe",
    "Recipe",
    "RunStage",
    "StepCost",
    "StepForecast",
    "recipe_of",
]

RECIPES: dict[str, type[Recipe[Any, Any]]] = {
    "conduction": ConductionRecipe,
    "melt-pool": MeltPoolRecipe,
    "ablation": AblationRecipe,
}
"""By kind of the settings."""


def recipe_of(case: Case) -> Recipe[Any, Any]:
    """The recipe of a case's solver."""
    return RECIPES[case.solver.kind](case)
