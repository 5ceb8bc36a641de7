"""Particles laid out anew below a relief, so that what melts there next starts evenly.

So they are in a pause between pulses. And where a surface recedes: particles below it share what
evaporates, and once one has less than MIN_VOLUME_RATIO of its volume, all are laid out before each
step, with what they carry. Else rows at the surface become thinner without end, above the melt that
comes from below; lower than the gap that is kept below the surface, none would count as lying at
it: steel that melts and evaporates under steady light, six rows in D/v, had no surface after five
rows. In a section (r, z) rows become as thin where the melt flows out of their columns.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from lasersph.compute.array_types import Array
from lasersph.compute.vectors import same
from lasersph.particles.relief_layout import ReliefLayout, carry_over, lay_below
from lasersph.solvers.conduction.body import HISTORY, Body
from lasersph.solvers.melt_pool.domain import PoolDomain
from lasersph.solvers.melt_pool.heat_pairs import HeatPairs
from lasersph.solvers.melt_pool.particle_kinds import ParticleKinds
from lasersph.solvers.step_control import StepFailed

HEIGHT_RANGE = (0.7, 1.4)
"""Height of particles laid out below a relief over the spacing. Geometry: the row at the surface
lies half a cell below it and counts as far as a spacing, the next 1.5 cells deep; more than one row
would count as that at the surface, or none."""
MIN_VOLUME_RATIO = 0.6
"""Volume of a particle over that of a cell of the lattice below which the surface recedes.
Geometry: a row of it lies as deep as `moving_surface.MIN_DEPTH`. In deep melt four spacings have
evaporated then."""


class UnevenRelief(StepFailed):
    """The relief is too deep for the layers below it."""


class LayoutRenewal:
    """Lays the particles of a pool out below its surface.

    Attributes:
        volume: that they have gained in pauses so far [m^3]. recedes: whether they are laid out
            before each step.
    """

    def __init__(
        self, body: Body, domain: PoolDomain, kinds: ParticleKinds, pairs: HeatPairs
    ) -> None:
        self.body, self.domain, self.kinds, self.pairs = body, domain, kinds, pairs
        self.volume, self.recedes = 0.0, False
        columns = body.filling.fine_surface
        thickness = domain.layers.thickness
        self._cell = float(np.prod(domain.layers.column_width()[:, 0])) * float(thickness[0])
        fine = int(np.count_nonzero(thickness <= thickness[0] * (1.0 + 1e-9))) * columns
        self._fine_volume = body.backend.head(body.particles["volume"], fine)
        # of rings their lengths, else 1
        lattice = domain.lattice
        self._measure = lattice.geometry.measure(lattice.position[:, :fine])

    def checkpoint_scalars(self) -> dict[str, float]:
        """Numbers that survive a step."""
        return {"rearranged": self.volume, "recedes": float(self.recedes)}

    def restore(self, numbers: Mapping[str, float]) -> None:
        """Continue from `checkpoint_scalars`."""
        self.volume, self.recedes = numbers["rearranged"], bool(numbers["recedes"])

    def lay_out(self) -> None:
        """Lay the particles of the finest layers out evenly below the surface as it is.

        Their volume becomes what lies below it, and their mass that of the metal in it.

        Raises:
            UnevenRelief: the relief is too deep for these layers.
        """
        # even columns below the surface as it is; what it remembers of the flow is gone
        layout, surface = self._layout(), self.domain.surface
        self.volume += float(np.sum(self._measure * (layout.volume - self._fine("volume"))))
        self.recedes = False
        surface.reset()

        # mass of the cold metal in the new volumes
        mass = self.body.material.density_reference * self._measure * layout.volume
        self._place({"position": layout.position, "volume": layout.volume, "mass": mass})

    def follow_recession(self) -> None:
        """Below a surface that recedes, lay them out with what they carry: mass, heat and momentum
        stay.

        Raises:
            UnevenRelief: the relief is too deep for these layers.
        """
        # a plane stays where it is, whatever its particles stand for
        if not self.domain.surface.moves:
            return
        if not self.recedes:
            fields: dict[str, Array] = {"value": self._fine_volume}
            (least,) = self.body.backend.pointwise(same, fields, (None,), reduce=("min",))
            self.recedes = least < MIN_VOLUME_RATIO * self._cell
        if not self.recedes:
            return
        # even columns again, of bodies that take over h, p and v of those that were there
        layout, body = self._layout(), self._measure * self._fine("volume")
        carried = [self._fine(name) for name in ("enthalpy", "pressure", "velocity")]
        density = np.sum(self._fine("mass")) / np.sum(body)
        even = layout._replace(volume=self._measure * layout.volume)
        body, (h, p, *v) = carry_over(
            self.domain.layers, even, self._fine("position"), body, np.vstack(carried)
        )

        # the same mass and heat as before, without a past that a step could extrapolate
        new = {"position": layout.position, "volume": body / self._measure, "mass": density * body}
        new |= {"pressure": p, "velocity": np.array(v)} | {name: h for name in HISTORY}
        self._place(new | {"enthalpy_excess": 0.0 * h})

    def _fine(self, name: str) -> NDArray[np.float64]:
        """A field of the particles of the finest layers, on the host."""
        values = self.body.backend.to_host(self.body.particles[name])
        return np.array(values[..., : self._fine_volume.shape[0]])

    def _layout(self) -> ReliefLayout:
        domain = self.domain
        height = domain.surface.heights(self.body.filling.fine_surface)
        more = "give a larger particles.fine_depth (of a box domain.depth)"
        try:
            keeps = domain.lattice.geometry.is_axisymmetric
            layout = lay_below(domain.layers, height, keep_columns=keeps)
        except ValueError as error:
            raise UnevenRelief(f"{error}; {more}") from None

        # cells neither flat nor tall, so that one row lies at the surface
        least, most = (size / domain.spacing for size in layout.heights)
        if least < HEIGHT_RANGE[0] or most > HEIGHT_RANGE[1]:
            raise UnevenRelief(
                f"particles below the relief would be {least:.3g} to {most:.3g} spacings high; "
                f"{more}, fewer pulses or an earlier end"
            )
        return layout

    def _place(self, fields: dict[str, NDArray[np.float64]]) -> None:
        """Give the particles of the finest layers new fields, and all of them new pairs."""
        body, domain, surface = self.body, self.domain, self.domain.surface
        particles, backend = body.particles, body.backend
        # new values of the finest layers, the old ones below
        for name, values in fields.items():
            whole = np.array(backend.to_host(particles[name]))
            whole[..., : values.shape[-1]] = values
            particles.set(name, whole)
        body.update_temperature()
        self.kinds.find_fluid(particles["melt_fraction"])
        self.kinds.remember()
        # pairs of all particles that lie elsewhere now, and of those near them
        position = particles["position"]
        surface.find(position)
        domain.cover_fine_layers()
        block = domain.block_for(position, self.kinds)
        has_row = backend.zeros(block.count)
        backend.fill(has_row, 1.0)
        block.find_pairs(position, domain.keep_resting(has_row))
        self.pairs.update(block)
