"""The recipe of melt pools and of closed boxes of fluid."""

from lasersph.simulation.recipes.melt_pool.recipe import MeltPoolRecipe

__all__ = ["MeltPoolRecipe"]
