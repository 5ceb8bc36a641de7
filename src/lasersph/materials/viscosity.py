"""How viscous the melt is at its temperature, over that at the liquidus, as the flow takes it.

Where the dynamic viscosity is given, nu of the flow is that over the one density with which the
flow goes. Melt beside solid, and what is molten in part, counts as at the liquidus: only what has
melted flows. Above the range of its source the law keeps the value at the end, as every property
does (`property`): the source's fit carried on would be a guess of the same kind, and a lower one.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from lasersph.materials.material import Material

ViscosityTable = tuple[NDArray[np.float64], NDArray[np.float64]]
"""Temperatures [K], and the viscosity there over that at the flow's reference temperature."""
LOWEST, HIGHEST = 1.0, 2.0e4
"""Temperatures between which a law without a range is taken [K]."""
NODES = 1025
"""1.2 K from node to node for steel, 18 K for a law without a range: within 1e-4 of the law."""


def relative_viscosity_table(material: Material) -> ViscosityTable:
    """Nodes for linear interpolation, with the same value at both nodes of each end.

    Raises:
        ValueError: the material has no viscosity.
    """
    is_kinematic = material.kinematic_viscosity is not None
    name = "kinematic_viscosity" if is_kinematic else "viscosity"
    reference, law = material.flow_temperature, material.properties()[name].liquid_law
    # from the liquidus on; of a material without a solid from the law's own start
    lower = max(law.lower, LOWEST) if material.melting is None else reference
    upper = max(min(law.upper, HIGHEST), lower + 1.0)
    T, values = material.table(name, lower, upper, NODES)
    # constant beyond both ends, whose segments interpolation extends
    T = np.concatenate([[T[0] - 1.0], T, [T[-1] + 1.0]])
    return T, np.pad(values / material.at(name, reference), 1, mode="edge")


def viscosity_text(material: Material) -> str:
    """With which viscosity the melt flows, in words."""
    T, m = relative_viscosity_table(material)
    eta = 1e3 * float(material.viscosity_at(material.flow_temperature))
    if np.ptp(m) == 0.0:
        return f"{eta:.3g} mPa s at all temperatures"
    text = f"{eta * m[0]:.3g} mPa s at {T[1]:.0f} K and below"
    boiling = material.vaporization.temperature if material.vaporization else T[-2]
    # words end at the boiling point
    hottest = min(T[-2], boiling)
    beyond = " and above" if hottest == T[-2] else ", where it boils"
    return f"{text}, {eta * np.interp(hottest, T, m):.3g} mPa s at {hottest:.0f} K{beyond}"
