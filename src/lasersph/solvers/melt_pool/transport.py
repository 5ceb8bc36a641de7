"""`Transport`: melt that passes between particles that keep their columns, and what it takes along.

    F_ij = g_ij (u_i + u_j) . (x_j - x_i)/2 - g_ij (phi_j - phi_i),    sum_j F_ij = -dV_i/dt - L_i
    d(V_i a_i)/dt = - sum_j F_ij a_ij - L_i a_i                        for a = h and v

with u the velocity of the melt over that of the particles, which ride with the surface where it
moves and rest elsewhere, V_i their volumes and L_i what leaves through the surface. F_ij is the
volume that flows from i to j in a second [m^3/s], between melt and melt alone; g_ij are the weights
of pressure and conduction, so that a linear velocity flows exactly. phi makes it free of
divergence, so that what is the same everywhere stays the same; it is sought from where the last two
steps lead. What one particle gives its neighbor gets.

a_ij is the value of the particle from which the melt comes in the middle of the step, as conduction
and forces went on changing it [Bell1989] and as the flow has carried it for half a step; its slope
takes it on to the middle of the pair. So it is of second order where a is smooth. h goes on by its
gradient, and stays within the range of both, so that no new extreme appears [vanLeer1979]. v goes
on by the slope on the side that the melt comes from, twice that of its gradient less that of the
pair [Warming1976]: what this overshoots in layers along walls, sums over a kernel smooth. It is not
clipped, since a thin layer along a wall is as steep as an extreme is, and would be slowed down.
Particles at rest that melt passes through are those of [Lind2016], without its kernels of fourth
order.

What crosses a plane comes back. v along a wall and h at a wall of given temperature have a bend
there: their gradients see the value of the wall between a particle and its image. Pairs across it
pass on h along the way from source to source, and the mean of both v, which is the middle of that
profile. The gradient of a mirror would be none, and the melt beside a wall would take its speed on
to the next row: as much more viscosity as the speed of the wall times some tenths of a spacing.

Beyond a surface that bends the ghosts of i and j are not each other's mirror images. Pairs across
it pass on the part of the flux along r and that between both distances from the surface, which is
the flux of a plane and the same from both sides; a_ij is the value of the particle itself there.
"""

from __future__ import annotations

from lasersph.compute.array_types import Array, Constants
from lasersph.compute.graph import graph
from lasersph.compute.kept_array import KeptArray
from lasersph.compute.vectors import dot, matmul, matvec, outer, transpose
from lasersph.particles.particles import Particles
from lasersph.solvers.melt_pool.flow import Flow
from lasersph.solvers.melt_pool.particle_kinds import ParticleKinds
from lasersph.solvers.melt_pool.particle_shifting import clip_to_range
from lasersph.solvers.melt_pool.passing_block import PassingBlock
from lasersph.solvers.melt_pool.pressure_equation import PressureEquation
from lasersph.solvers.melt_pool.projection import unknowns_of
from lasersph.surface.riding_surface import Ride

TOLERANCE = 1e-6
"""Residual of the equation of phi over its right-hand side. Accuracy: what a uniform field changes
by in a step is that share of the divergence that the projection has left."""
LARGEST_RESIDUAL = 1e-3
"""The same with which a step is still taken. Guard: single precision ends at some 1e-6; fluxes that
are off by more bring new extremes, and the step is halved."""


def passing_velocity(v, w):
    """Velocity of the melt over that of its particle [m/s]."""
    return v - w


def pair_flux(v_i, v_j, pool_i, pool_j, g_ij, x_ij):
    """Volume that flows from i to j [m^3/s] within a pool.

    Args:
        v: of the melt over the particles, as ghosts mirror it [m/s].
    """
    same = 0.5 if pool_i == pool_j else 0.0
    return -(same if pool_i > 0 else 0.0) * g_ij * dot(v_i + v_j, x_ij)


def flux_across(flux_ij, pool_i, pool_j, g_ij, source_i, source_j, crossing_j, u, place, distance):
    """Flux of a pair across a surface that moves [m^3/s], the same from both sides; of all others
    as it is.

    Args:
        crossing: see `PassingBlock`. u, place, distance: tables of the velocity of the melt over
            the particles, of places and of distances from the surface.
    """
    if crossing_j <= 0.0:
        return 1.0 * flux_ij
    if pool_i == 0 or pool_i != pool_j or crossing_j > 1.0:
        return 0.0 * g_ij
    # what the tangent at one of both turns, mirrored
    u_i, u_j = u[source_i], u[source_j]
    along = (u_i[0] + u_j[0]) * (place[source_j][0] - place[source_i][0])
    across = (u_i[1] - u_j[1]) * (distance[source_i] + distance[source_j])
    return 0.5 * g_ij * (along + across)


def flux_and_slope_terms(flux_ij, h_i, h_j, v_i, v_j, pool_i, pool_j, G_ij):
    """Terms of what flows out, and of grad h among what flows and of grad v, uncorrected."""
    change = h_j - h_i if pool_i == pool_j else 0.0 * h_i
    return flux_ij, change * G_ij, outer(v_j - v_i, G_ij)


def gathering_and_slopes(total_0, total_1, total_2, growth, measure, C):
    """Volume that gathers in a particle beyond its growth and the loss of its surface [m^3/s];
    grad h [J/(kg m)] and (grad v)_ab = d v_a/d x_b [1/s], exact on linear fields."""
    return total_0 + growth * measure, matvec(C, total_1), matmul(total_2, transpose(C))


def extrapolated(phi, phi_old):
    """phi along a straight line through the last two steps, and that of the last one [m^2/s]."""
    return 2.0 * phi - phi_old, phi


def closed_flux(flux_ij, g_ij, pool_i, pool_j, phi_i, phi_j):
    """The flux without what would gather in a particle [m^3/s]; phi is 0 where nothing flows."""
    return flux_ij - (g_ij if pool_i == pool_j else 0.0) * (phi_j - phi_i)


def middle_values(h, h_old, v, v_carried, u, grad_h, grad_v, share, half_step):
    """h in the middle of the step, by what conduction changed in the one before; h and v there by
    what the flow carries to the particle, too.

    Args:
        h_old, v_carried: after the transport of that step. u: of the melt over the particle [m/s].
            share: half this step over that one.
    """
    h_middle, displacement = h + share * (h - h_old), -half_step * u
    v_middle = v + share * (v - v_carried)
    h_carried = h_middle + dot(grad_h, displacement)
    return h_middle, h_carried, v_middle + matvec(grad_v, displacement)


def upstream(share, a_i, a_j):
    """The value of the particle that gives: of i where `share` is 1, of j where it is 0."""
    return share * a_i + (1.0 - share) * a_j


def value_beyond(h, dirichlet, wall_enthalpy):
    """Enthalpy of a ghost [J/kg] with which that of the wall lies in the middle, where it is
    given."""
    return h + 2.0 * dirichlet * (wall_enthalpy - h)


def exchanged_enthalpy(gives, goes_on, h_i, h_j, low, high, grad_h_i, grad_h_j, y_ij):
    """h that a pair exchanges [J/kg]: that of the giver, carried on to the middle of the pair where
    `goes_on` is 1, within a range.

    Args:
        y_ij: place of i less that of j [m], of images those of the sources, since melt that crosses
            a plane comes back.
    """
    rise = dot(upstream(gives, grad_h_i, grad_h_j), (0.5 - gives) * y_ij)
    return clip_to_range(upstream(gives, h_i, h_j) + goes_on * rise, low, high, high)


def exchanged_velocity(gives, goes_on, v_i, v_j, grad_v_i, grad_v_j, x_ij):
    """v that a pair exchanges [m/s]: that of the giver, carried on to the middle of the pair by the
    slope on its far side where `goes_on` is 1; the mean of both where half of each gives."""
    far = 2.0 * matvec(upstream(gives, grad_v_i, grad_v_j), x_ij) - (v_i - v_j)
    return upstream(gives, v_i, v_j) + (0.5 - gives) * goes_on * far


def exchange_terms(
    flux_ij,
    g_ij,
    pool_i,
    pool_j,
    phi_i,
    phi_j,
    middle_h_i,
    middle_h_j,
    carried_h_i,
    carried_h_j,
    carried_v_i,
    carried_v_j,
    grad_h_i,
    grad_h_j,
    grad_v_i,
    grad_v_j,
    x_ij,
    y_i,
    y_j,
    crossing_j,
):
    """h and v of the middle of the step that a pair exchanges, times its closed flux."""
    h_i, h_j, v_i, v_j = carried_h_i, carried_h_j, carried_v_i, carried_v_j
    F_ij = closed_flux(flux_ij, g_ij, pool_i, pool_j, phi_i, phi_j)
    gives = 1.0 if F_ij > 0.0 else 0.0
    # beyond a surface that bends the value of the giver itself
    goes_on = 0.0 if crossing_j > 0.0 else 1.0
    low, high, y_ij = middle_h_i, middle_h_j, y_i - y_j
    h = exchanged_enthalpy(gives, goes_on, h_i, h_j, low, high, grad_h_i, grad_h_j, y_ij)
    # across a plane v of the middle of its profile, which bends there
    share = 0.5 if crossing_j < 0.0 else gives
    v = exchanged_velocity(share, goes_on, v_i, v_j, grad_v_i, grad_v_j, x_ij)
    return F_ij * h, F_ij * v


def after_transport(total_0, total_1, h, v, h_old, h_older, volume, growth, measure, step):
    """h [J/kg] and v [m/s] after a step in which a particle has grown to its volume.

    h of the steps before changes alike: what is left between them is what the particle has
    conducted, and that goes on.
    """
    share, grown = step / volume, growth * measure
    change = share * (total_0 + grown * h)
    return h - change, v - share * (total_1 + grown * v), h_old - change, h_older - change


class Transport:
    """Fluxes of the melt between particles that keep their columns, and the step that follows.

    Args:
        volume: (n,) of the bodies that they stand for, rings [m^3].

    Attributes:
        flux: (pairs,) F* of the last step, which phi closes where pairs exchange [m^3/s].
    """

    def __init__(self, particles: Particles, volume: Array) -> None:
        self.backend, self.volume = particles.backend, volume
        particles.add("flux_potential", "flux_potential_before", "velocity_carried")
        self.h, self.v = particles["enthalpy"], particles["velocity"]
        self._potentials = particles["flux_potential"], particles["flux_potential_before"]
        self._h_before = particles["enthalpy_before"], particles["enthalpy_two_before"]
        self._kept = KeptArray(self.backend)
        self.flux = self._kept.of(0)
        self._block: PassingBlock | None = None
        self._passing = self.backend.zeros(self.v.shape)
        self._carried, self._settled = particles["velocity_carried"], particles["settled_jump"]
        count, vectors = volume.shape[0], self.v.shape
        self._no_jump = self.backend.zeros(count)
        self._middle = tuple(self.backend.zeros(shape) for shape in (count, count, vectors))

    def carry(
        self, flow: Flow, kinds: ParticleKinds, ride: Ride, step: float, last_step: float
    ) -> None:
        """Enthalpy and velocity after the melt has flowed for a step [s] between particles that
        have ridden with the surface.

        Args:
            last_step: the one before [s], 0 for none.

        Raises:
            NotConverged: phi is not found.
        """
        block = flow.block
        assert isinstance(block, PassingBlock)
        self._work_on(flow, block, is_box=kinds.is_box)
        fields = {"v": self.v, "w": ride.velocity}
        self.backend.pointwise(passing_velocity, fields, self._passing)
        # pools: melt that nothing separates
        flows = self.backend.head(kinds.fluid, block.count)
        self._equation.set_operator(
            *(block.without_ghosts(), block.weights, flows, self._V),
            version=(block.placings, kinds.changes),
        )
        # F*, what it leaves in each particle, and the slopes of h and v
        self.find_flux(block)
        self.find_balance(block, kinds, ride.growth)
        # phi that closes the balance, from where the last two steps lead
        outcome = self._equation.solve(self._gathered, self._phi)
        outcome.refuse_above(LARGEST_RESIDUAL, "the balance of the fluxes")
        # F, and what pairs exchange by it; a longer step goes on as far as the last one went
        share = 0.5 * min(step / last_step, 1.0) if last_step > 0.0 else 0.0
        self.exchange(block, kinds, ride.growth, step, 0.5 * step, share)
        self.backend.copy(self.v, self._carried)

    def _work_on(self, flow: Flow, block: PassingBlock, *, is_box: bool) -> None:
        """Work vectors for a block and its pairs; in a box both equations have one set of
        unknowns."""
        backend, count, d = self.backend, block.count, self.v.shape[0]
        if block is not self._block:
            self._block, self._V = block, backend.head(self.volume, count)
            unknowns = flow.projection.unknowns if is_box else unknowns_of(block)
            self._equation = PressureEquation(backend, unknowns, tolerance=TOLERANCE, is_even=False)
            self._gathered = backend.zeros(count)
            self._phi, self._phi_old = (backend.head(phi, count) for phi in self._potentials)
            self._grad_h, self._grad_v = backend.zeros((d, count)), backend.zeros((d, d, count))
        self.flux = self._kept.of(block.weights.shape[0])

    def _pools(self, block: PassingBlock) -> dict[str, Array]:
        """Numbers of the pools of particles and their images."""
        return {"pool": block.gather(self._equation.components.number)}

    def _mirror(self, block: PassingBlock, v: Array) -> Array:
        """(d, M) a velocity of particles and their images [m/s]."""
        return block.ghosts.mirror_velocity(v, self._no_jump)

    def _beyond_walls(self, block: PassingBlock) -> dict[str, Array]:
        """v and h of particles and their images as their gradients see them."""
        h = block.gather(self.h)
        if block.walls.exchange_heat:
            self.backend.pointwise(value_beyond, {"h": h} | block.walls.rules, h)
        return {"v": block.ghosts.extend_velocity(self.v, self._settled), "h": h}

    @graph
    def find_flux(self, block: PassingBlock) -> None:
        """F* of the pairs."""
        pools, flux = self._pools(block), self.flux
        fields = pools | {"v": self._mirror(block, self._passing), "g_ij": block.weights}
        self.backend.pair_values(pair_flux, block.pairs, fields, flux, rows=block.rows)
        if block.rows_across is None:
            return
        fields = pools | {"g_ij": block.weights, "flux_ij": flux, "source": block.ghosts.source}
        fields |= {"crossing": block.crossing}
        tables: Constants = {"u": self._passing, "place": block.ghosts.place}
        tables |= {"distance": block.ghosts.surface.distance}
        rows = block.rows_across
        self.backend.pair_values(flux_across, block.pairs, fields, flux, rows=rows, **tables)

    @graph
    def find_balance(self, block: PassingBlock, kinds: ParticleKinds, growth: Array) -> None:
        """Volume that would gather in each particle, the slopes of h and v there, and the first
        guess of phi."""
        fields = self._pools(block) | self._beyond_walls(block)
        fields |= {"flux_ij": self.flux, "G_ij": block.gradient, "C": block.correction}
        fields |= {"growth": growth, "measure": block.measure}
        fields |= {"phi": self._phi, "phi_old": self._phi_old}
        self.backend.pointwise(extrapolated, fields, (self._phi, self._phi_old))
        self.backend.pair_sum(
            flux_and_slope_terms,
            block.pairs,
            fields,
            (self._gathered, self._grad_h, self._grad_v),
            finish=gathering_and_slopes,
            rows=kinds.fluid_rows,
        )

    @graph
    def exchange(
        self,
        block: PassingBlock,
        kinds: ParticleKinds,
        growth: Array,
        step: float,
        half_step: float,
        share: float,
    ) -> None:
        """h and v after the exchange of the pairs by the fluxes without divergence."""
        ghosts, rows, head = block.ghosts, kinds.fluid_rows, self.backend.head
        # the melt in the middle of the step
        whole = {"h": self.h, "v": self.v, "v_carried": self._carried, "u": self._passing}
        before = dict(zip(("h_old", "h_older"), self._h_before, strict=True))
        fields = {name: head(values, block.count) for name, values in (whole | before).items()}
        fields |= {"grad_h": self._grad_h, "grad_v": self._grad_v}
        constants = {"share": share, "half_step": half_step}
        out = tuple(head(values, block.count) for values in self._middle)
        self.backend.pointwise(middle_values, fields, out, rows=rows, **constants)
        # what pairs exchange of it
        middle, h, v = self._middle
        fields |= before | self._pools(block) | {"h": self.h, "v": self.v}
        fields |= {"middle_h": block.gather(middle), "carried_h": block.gather(h)}
        fields |= {"carried_v": self._mirror(block, v)}
        fields |= {"grad_h": block.gather(self._grad_h), "y": block.unfolded}
        fields |= {"grad_v": ghosts.extend_tensor(self._grad_v)}
        fields |= {"flux_ij": self.flux, "g_ij": block.weights, "phi": block.gather(self._phi)}
        fields |= {"crossing": block.crossing, "volume": self.volume}
        fields |= {"growth": growth, "measure": block.measure}
        self.backend.pair_sum(
            exchange_terms,
            block.pairs,
            fields,
            (self.h, self.v, *self._h_before),
            finish=after_transport,
            rows=rows,
            step=step,
        )
