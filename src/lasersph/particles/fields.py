"""The table of fields: what a particle carries, with symbol, unit, shape and words.

Loops load arguments by symbol; files, figures and checkpoints take the rest from here. A field is
kept where a run cannot continue without it, and derived where each step computes it from others.
A volume in d dimensions has the unit m^d; a mass is one per 3 - d lengths.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal


@dataclass(frozen=True)
class Field:
    """One quantity of a particle.

    Attributes:
        symbol: name in pair and pointwise functions. unit: SI. words: what it is. shape: (n,),
            (dim, n) or (dim, dim, n). is_kept: whether a checkpoint needs it, else it is derived.
        storage: kind of the array: "real", "index", "offset" or "flag".
    """

    name: str
    symbol: str
    unit: str
    words: str
    shape: Literal["scalar", "vector", "tensor"] = "scalar"
    is_kept: bool = False
    storage: Literal["real", "index", "offset", "flag"] = "real"


def _table(*fields: Field) -> dict[str, Field]:
    return {field.name: field for field in fields}


# what every solver has
GEOMETRY = _table(
    Field("position", "x", "m", "place of the center", "vector", is_kept=True),
    Field("width", "w", "m", "edges of the cell", "vector"),
    Field("volume", "V", "m^d", "size of the cell"),
    Field("mass", "m", "kg", "mass"),
    Field("support", "l", "m", "support radius"),
    Field("kind", "kind", "1", "see `particles.kinds`", storage="flag"),
    Field("normal", "normal", "1", "outward normal of the surface", "vector"),
    Field("surface", "surface", "1", "1 at the surface", storage="flag"),
)
# heat and change of phase; the enthalpies of two steps extrapolate the start of an iteration
HEAT = _table(
    Field("enthalpy", "h", "J/kg", "specific enthalpy", is_kept=True),
    Field("temperature", "T", "K", "temperature"),
    Field("potential", "P", "W/m", "heat potential, the integral of k dT"),
    Field("conductivity", "k", "W/(m K)", "thermal conductivity"),
    Field("melt_fraction", "f_m", "1", "molten share"),
    Field("vapor_fraction", "f_v", "1", "share of the latent heat of vaporization taken up"),
    Field(
        "enthalpy_excess",
        "excess",
        "J/kg",
        "added by the last step beside the result of its iteration, to close its balance",
        is_kept=True,
    ),
    Field("enthalpy_before", "h_old", "J/kg", "enthalpy without excess one step ago", is_kept=True),
    Field(
        "enthalpy_two_before",
        "h_older",
        "J/kg",
        "enthalpy without excess two steps ago",
        is_kept=True,
    ),
    Field("evaporated_mass", "evaporated", "kg/m^2", "evaporated per area", is_kept=True),
    Field(
        "followed_mass",
        "followed",
        "kg/m^2",
        "of it, what the metal below the surface has followed",
        is_kept=True,
    ),
    Field(
        "electron_energy",
        "e",
        "J/kg",
        "energy of the electrons above that at the initial temperature, a part of the enthalpy",
        is_kept=True,
    ),
    Field("electron_temperature", "T_e", "K", "temperature of the electrons"),
    Field("absorbed_light", "E", "J", "light absorbed in the step"),
)
# flow of a liquid
FLOW = _table(
    Field("velocity", "v", "m/s", "velocity", "vector", is_kept=True),
    Field("speed", "speed", "m/s", "size of the velocity"),
    Field("pressure", "p", "Pa", "pressure", is_kept=True),
    Field(
        "pressure_force",
        "a_p",
        "m/s^2",
        "acceleration by the pressure of the last step",
        "vector",
        is_kept=True,
    ),
    Field(
        "settled_jump",
        "settled",
        "m/s",
        "velocity of ghosts over their sources that viscosity has settled",
        "vector",
        is_kept=True,
    ),
    Field(
        "flux_potential",
        "phi",
        "m^2/s",
        "what made the fluxes between rings free of divergence in the last step",
        is_kept=True,
    ),
    Field("flux_potential_before", "phi_old", "m^2/s", "the same one step before", is_kept=True),
    Field(
        "velocity_carried",
        "v_carried",
        "m/s",
        "velocity after the transport of the last step",
        "vector",
        is_kept=True,
    ),
    Field("was_fluid", "was_fluid", "1", "1 where it flowed one step ago", is_kept=True),
    Field(
        "has_moving_pairs",
        "has_moving_pairs",
        "1",
        "1 where its pairs were ever found anew",
        is_kept=True,
    ),
    Field("flows", "flows", "1", "1 where it flows", storage="flag"),
    Field("surface_temperature", "T_s", "K", "temperature of the surface over it"),
    Field("surface_gradient", "dT_s", "K/m", "temperature gradient along the surface over it"),
    Field("surface_velocity", "v_s", "m/s", "velocity of the surface over it"),
    Field("lid_pressure", "p_s", "Pa", "pressure under the flat surface over it"),
)
# matter that moves, tears and leaves
ABLATION = _table(
    Field("density", "rho", "kg/m^3", "density", is_kept=True),
    Field("acting_volume", "V_a", "m^d", "volume that acts on neighbors"),
    Field(
        "conducting_volume",
        "V_k",
        "m^d (W/(m K))^(1/2)",
        "volume times the root of a conductivity that is one number",
    ),
    Field("vapor_pressure", "p_v", "Pa", "vapor pressure at leaving", is_kept=True),
    Field("leaving_time", "left_at", "s", "time of leaving, 0 before", is_kept=True),
    Field("conducts", "conducts", "1", "1, or 0 of walls that let no heat pass"),
    Field("opaque", "opaque", "1", "1 until it has been ejected"),
    Field(
        "listed_position",
        "x_listed",
        "m",
        "place when its neighbors were found",
        "vector",
        is_kept=True,
    ),
    Field("lift", "lift", "m", "distance moved since it began to leave", is_kept=True),
    Field("stage", "stage", "1", "see `AblationView`"),
)
FIELDS = GEOMETRY | HEAT | FLOW | ABLATION
"""All fields that the solvers of the package use, by name."""
