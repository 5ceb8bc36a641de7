"""Figures of the documentation that are stored: by name what draws each."""

from figures.card import CARD
from figures.experiment import EXPERIMENT
from figures.gallery import GALLERY
from figures.methods import METHODS
from figures.own_relief import OWN_RELIEF
from figures.speed import PEERS
from figures.stored import StoredFigure

STORED = (*METHODS, EXPERIMENT, OWN_RELIEF, PEERS, CARD, *(entry.figure for entry in GALLERY))
REGISTRY = {figure.name: figure for figure in STORED}

__all__ = ["GALLERY", "METHODS", "REGISTRY", "StoredFigure"]
