"""Figures of the documentation that are stored: by name what draws each."""

from figures.gallery import GALLERY
from figures.methods import METHODS
from figures.stored import StoredFigure

REGISTRY = {figure.name: figure for figure in (*METHODS, *(entry.figure for entry in GALLERY))}

__all__ = ["GALLERY", "METHODS", "REGISTRY", "StoredFigure"]
