"""State of a run after a step, for observers: host arrays, SI, never changed by the observer.

Where half a period, or half or a quarter of a spot is computed, amounts are those of the whole:
`of_whole` counts each particle with its mirror images, once for all observers. Sums over `volume`
and `mass`, and the energies, then need no further factor.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import NoReturn

import numpy as np

from lasersph.observers.ablation_view import AblationView
from lasersph.observers.area_relief import AreaRelief
from lasersph.observers.electron_view import ElectronView
from lasersph.observers.flow_view import FlowView
from lasersph.observers.relief import Relief


@dataclass(frozen=True)
class View:
    """State of a run after a step.

    Attributes:
        time, step, time_step: seconds; steps done; seconds.
        position: (dim, n) [m]; the last axis is z, the original surface lies at z = 0.
        width: (dim, n) cell widths [m].
        volume: (n,) [m^dim], mass: (n,) [kg per (3 - dim) lengths], of a particle together with its
            mirror images.
        temperature, enthalpy: (n,) [K], [J/kg].
        melt_fraction, vapor_fraction: (n,) [1].
        surface: indices of the particles of the surface layer; where particles move, of those
            that lie at the surface now.
        symmetry_factor: 2 where half a period is computed, else 1; multiplies widths.
        mirror_images: how many times the computed part makes up the whole: 2 of a half, 4 of a
            quarter; 1 of a section (r, z), whose rings are whole.
        halves_spot: whether the axis of a resting spot lies on the lower or the upper end of x, so
            that its other half is not computed.
        energy: what the solver has booked since the start, by `energy_budget.BOOKED` [J], per unit
            area in 1-D, per unit length in 2-D.
        latent_heats: of melting and of vaporization that the enthalpy holds [J/kg].
        iterations: iterations of this step, by solver part.
        limit: name of the limit that bound the time step.
        solidus, liquidus, vaporization: corner temperatures of the material [K], None where it
            has none.
        critical: temperature that a surface which evaporates must not reach [K]; None where a
            plateau holds it below.
        evaporated: (columns,) thickness that has evaporated from each column of cells [m], where
            the run follows it. column_share: (columns,) shares of the surface that these have,
            their sum is 1; in a section (r, z) those of rings.
        relief: heights of the surface by columns, over x or, in 3-D, over x and y; None where it
            stays flat. columns: those of a flat surface in 3-D below which melt flows, at 0; None
            elsewhere.
        electrons: temperature and energy of hot electrons; None in a run with one temperature.
        flow: velocity, pressure and what belongs to them; None in a run without flow.
        ablation: crater and ejecta; None in a run without ablation.
    """

    # the step, and the particles after it
    time: float
    step: int
    time_step: float
    position: np.ndarray
    width: np.ndarray
    volume: np.ndarray
    mass: np.ndarray
    temperature: np.ndarray
    enthalpy: np.ndarray
    melt_fraction: np.ndarray
    vapor_fraction: np.ndarray
    surface: np.ndarray
    # of the whole run
    symmetry_factor: int = 1
    mirror_images: int = 1
    halves_spot: tuple[bool, bool] = (False, False)
    energy: dict[str, float] = field(default_factory=dict)
    latent_heats: tuple[float, float] = (0.0, 0.0)
    iterations: dict[str, int] = field(default_factory=dict)
    limit: str = ""
    # of the metal
    solidus: float | None = None
    liquidus: float | None = None
    vaporization: float | None = None
    critical: float | None = None
    # parts that only some runs have
    evaporated: np.ndarray | None = None
    column_share: np.ndarray | None = None
    relief: Relief | AreaRelief | None = None
    columns: AreaRelief | None = None
    electrons: ElectronView | None = None
    flow: FlowView | None = None
    ablation: AblationView | None = None

    def __getattr__(self, name: str) -> NoReturn:
        """Say where a quantity is that belongs to one of the parts. Raises AttributeError."""
        parts = {"flow": FlowView, "relief": Relief, "ablation": AblationView}
        parts |= {"electrons": ElectronView}
        # a quantity of a part is told as such, with the view that has it
        found = [f"view.{part}.{name}" for part, kind in parts.items() if name in names_of(kind)]
        if found:
            text = f"it is {' or '.join(found)}, where the run has that"
        else:
            text = f"it has {', '.join(sorted(names_of(View)))}; see docs/api.md"
        raise AttributeError(f"a view has no {name!r}: {text}")

    @property
    def dimension(self) -> int:
        """Number of space dimensions."""
        return self.position.shape[0]


def of_whole(view: View, images: int) -> View:
    """A view whose amounts are those of the whole body.

    Args:
        view: with the amounts of the part that is computed. images: see `View.mirror_images`.
    """
    if images == 1:
        return view
    # what has left the metal, and what has entered through the level sides of a box
    ablation = None if view.ablation is None else view.ablation.of_whole(images)
    flow = None if view.flow is None else view.flow.of_whole(images)
    return replace(
        view,
        mirror_images=images,
        volume=images * view.volume,
        mass=images * view.mass,
        energy={name: images * value for name, value in view.energy.items()},
        ablation=ablation,
        flow=flow,
        relief=None if view.relief is None else replace(view.relief, mirror_images=images),
    )


def names_of(kind: type) -> set[str]:
    """Names of the quantities that a part of a view holds."""
    return {name for name in (*kind.__annotations__, *vars(kind)) if not name.startswith("_")}


def lower_faces(view: View) -> np.ndarray:
    """Depth of the lower face of every cell below the original surface, (n,) [m]."""
    # the width as it is: where all cells are alike it takes no memory
    return 0.5 * (view.width[-1] - 2.0 * view.position[-1])


def largest_depth(faces: np.ndarray, chosen: np.ndarray) -> float:
    """Largest of some depths, those where `chosen` is true; 0 if none [m]."""
    return max(float(np.max(np.where(chosen, faces, 0.0))), 0.0)
