"""`ElectronView`: what observers see of electrons hotter than the lattice."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class ElectronView:
    """Electrons of a run with two temperatures, host arrays.

    Attributes:
        temperature: (n,) [K]. energy: (n,) above that at the initial temperature [J/kg], a part of
            the enthalpy.
    """

    temperature: np.ndarray
    energy: np.ndarray
