"""The `solver` key of a case: the settings of one solver, told apart by `kind`.

Without `kind` it is "conduction".
"""

from __future__ import annotations

from typing import Annotated, Any, TypeGuard

from pydantic import BeforeValidator, Discriminator

from lasersph.materials import Material
from lasersph.solvers.ablation.settings import AblationSettings
from lasersph.solvers.conduction.settings import ConductionSettings
from lasersph.solvers.heat_settings import HeatSettings
from lasersph.solvers.melt_pool.settings import MeltPoolSettings
from lasersph.solvers.solver_settings import SolverSettings

SETTINGS: tuple[type[SolverSettings], ...] = (
    ConductionSettings,
    MeltPoolSettings,
    AblationSettings,
)
SELECTIVE_KEYS = frozenset[str]().union(*(settings.reads for settings in SETTINGS))
"""Keys of a case that not every solver reads."""
FLUX_NEEDS = ("molar_mass", "critical_temperature")
"""Of [material.vaporization], beside the boiling point and its latent heat."""


def reader_of(key: str) -> str:
    """Kind of the solver that reads one of SELECTIVE_KEYS."""
    return next(each.model_fields["kind"].default for each in SETTINGS if key in each.reads)


def computes_flow(solver: SolverSettings) -> TypeGuard[MeltPoolSettings]:
    """Whether a solver computes the incompressible flow of a melt, or of a box."""
    return "flow" in type(solver).model_fields


def moves_matter(solver: SolverSettings) -> TypeGuard[AblationSettings]:
    """Whether the matter of a solver moves, compresses and leaves."""
    return "motion" in type(solver).model_fields


def has_pool(solver: SolverSettings, material: Material) -> bool:
    """Whether `solver.flow` only names the surface of a pool in a metal that melts."""
    if not computes_flow(solver) or solver.flow is None:
        return False
    melts = material.melting is not None and solver.phase_change
    return solver.flow.names_surface_only and melts


def surface_moves(solver: SolverSettings) -> bool:
    """Whether the surface of a flow moves."""
    flow = solver.flow if computes_flow(solver) else None
    return flow is not None and flow.surface.kind == "moving"


def chooses_vaporization(solver: SolverSettings) -> TypeGuard[HeatSettings]:
    """Whether the settings of a solver say what holds at the boiling point."""
    return "vaporization" in type(solver).model_fields


def allows_two_temperatures(solver: SolverSettings) -> TypeGuard[HeatSettings]:
    """Whether a solver can have a temperature for the electrons and one for the lattice."""
    return "heat" in type(solver).model_fields


def has_two_temperatures(solver: SolverSettings) -> bool:
    """Whether it has them."""
    return allows_two_temperatures(solver) and solver.has_two_temperatures


def with_vaporization(solver: SolverSettings, material: Material) -> SolverSettings:
    """The settings with `vaporization` said, where the case does not.

    Vapor takes metal away and pushes the surface that it leaves, which shows where that surface
    moves: there it leaves as a flux. Where nothing moves, and in a box that is all fluid, the
    plateau keeps the temperature, as in [Demuth2020].
    """
    # What the case says stays.
    if not chooses_vaporization(solver) or solver.vaporization is not None:
        return solver
    wants = wants_vapor_flux(solver, material) and "plateau" not in solver.model_fields_set
    chosen = "flux" if wants and not missing_for_flux(material) else "plateau"
    return solver.model_copy(update={"vaporization": chosen})


def with_frame(solver: SolverSettings, material: Material) -> SolverSettings:
    """The settings with `frame` said for a box of liquid, where the case does not.

    Particles that rest err less in less time. They move where a surface moves, where the case says
    how they are shifted, and with the schemes of [Demuth2020].
    """
    if not computes_flow(solver) or solver.flow is None or solver.frame is not None:
        return solver
    moves = surface_moves(solver) or solver.is_shifted or solver.is_published
    if moves or solver.geometry == "axisymmetric" or has_pool(solver, material):
        return solver
    return solver.model_copy(update={"frame": "eulerian"})


def wants_vapor_flux(solver: SolverSettings, material: Material) -> bool:
    """Whether the surface of a pool moves, in a metal that boils."""
    boils = material.vaporization is not None
    return boils and surface_moves(solver) and has_pool(solver, material)


def missing_for_flux(material: Material) -> tuple[str, ...]:
    """Keys of [material.vaporization] without which no flux of vapor is known."""
    return tuple(key for key in FLUX_NEEDS if getattr(material.vaporization, key, None) is None)


def _with_kind(value: Any) -> Any:
    return {"kind": "conduction", **value} if isinstance(value, dict) else value


SolverChoice = Annotated[
    ConductionSettings | MeltPoolSettings | AblationSettings,
    Discriminator("kind"),
    BeforeValidator(_with_kind),
]


def no_axis(axis: str, least: int, dimensions: int) -> str:
    """Why a key of an axis says nothing in a run of fewer dimensions than the `least`."""
    return (
        f"says nothing in {dimensions}-D, which has no {axis}; leave it out or write dimensions = "
        f"{least} in [solver]"
    )
