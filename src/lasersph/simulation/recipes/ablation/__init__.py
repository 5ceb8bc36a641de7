"""The recipe of matter that moves, compresses and leaves."""

from lasersph.simulation.recipes.ablation.recipe import AblationRecipe

__all__ = ["AblationRecipe"]
