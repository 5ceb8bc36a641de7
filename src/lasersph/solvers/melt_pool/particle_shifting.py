"""Shifting of the particles and adjustment of what they carry [Demuth2020, eqs. (73)-(75)].

    x~ = x + C a R,    v~ = v + grad v . (x~ - x),    h~ = h + grad h . (x~ - x)

Deviations from the paper: in the first row at a wall no particle is moved along the normal
(`sph.shifting`). No value leaves the range of the neighbors and the particle's own. h is exchanged
between pairs, d = x~ - x,

    h~_i = h_i + sum_j V_j (h_j - h_i) (d_i - d_j) . grad W_ij

which is grad h . d where the shifts of neighbors differ, conserves heat pair by pair, and is 0
where they are the same: a common shift moves particles with their heat, as the flow does. (75)
itself adds the heat -h div d; a scaling of all gains and losses that takes it back carries heat
across the whole body, 5 % of that through a box at Ra 1e5, 24 particles a side. Pairs exchange
between particles of one phase (both melt, or both on the vaporization plateau), since at a front
the gradient is the latent heat over a spacing, and as much as their particles may take and give
[Zalesak1979]. A shift is at most a tenth of a spacing, and no particle comes closer to a face than
three tenths.
"""

from __future__ import annotations

from lasersph.compute.array_types import Array
from lasersph.compute.backend import Backend
from lasersph.compute.graph import graph
from lasersph.compute.vectors import dot, matvec, outer, vector
from lasersph.particles.particles import Particles
from lasersph.solvers.melt_pool.block import Block
from lasersph.solvers.melt_pool.domain import PoolDomain
from lasersph.solvers.melt_pool.flow import Flow
from lasersph.solvers.melt_pool.particle_kinds import ParticleKinds
from lasersph.sph.shifting import repulsion_terms, shift

MAX_SHIFT = 0.1
"""Largest shift over the spacing. Guard: a step shifts by at most 0.04 times 0.06 times 3.75, 0.009
spacings, times the size of R, to which a neighbor at r spacings adds (2.5 / r)^2: 0.1 is one at
0.75 spacings with none opposite."""
MIN_FACE_DISTANCE = 0.3
"""Least distance from a face over the spacing. Guard: the first row of a lattice is 0.5 spacings
from a face; closer than 0.3 a particle and its own ghost would be one."""

CLOSE_AT_WALL = 0.6
"""Distance over the spacing: a particle at a wall is moved along its normal when it is pushed as
hard as one neighbor at this distance would push it. Guard: without it two particles came as close
as 0.22 spacings in the cavity at Re 400 with 50 a side, with it 0.40, shifted off walls 0.46."""


def velocity_terms(v_i, v_j, G_ij):
    """Terms of grad v, and the neighbors' velocity for its range."""
    return outer(v_j - v_i, G_ij), 1.0 * v_j, 1.0 * v_j


def adjust_velocity(total_0, total_1, total_2, v, C, displacement):
    """v + grad v . shift, within the range of the neighbors [m/s] (74)."""
    # grad v . d by the corrected gradient, then clipped so that no new extreme appears
    new = v + matvec(total_0, matvec(C, displacement))
    return vector(*(clip_to_range(new[k], v[k], total_1[k], total_2[k]) for k in range(len(new))))


def clip_to_range(new, old, low, high):
    """`new` within the range of low, high and `old`."""
    return min(max(new, min(low, old)), max(high, old))


def phase_of(fluid, f_v):
    """0 at rest, 1 melt, 2 melt on the vaporization plateau."""
    if f_v > 0.0:
        return 2.0 * fluid
    return 1.0 * fluid


def range_enthalpy(h, dirichlet, wall_enthalpy):
    """Enthalpy of a ghost [J/kg]: that of its source, or of a Dirichlet face."""
    return h + dirichlet * (wall_enthalpy - h)


def what_is_exchanged(source, h, fluid, f_v):
    """Enthalpy [J/kg] and phase of a ghost."""
    return h[source], phase_of(fluid[source], f_v[source])


def shares_of(source, up, down):
    """Shares of the source."""
    return up[source], down[source]


def exchange(h_i, h_j, phase_i, phase_j, dirichlet_j, G_ij, shift_i, shift_j):
    """V_j (h_j - h_i) (shift_i - shift_j) . grad W between particles of one phase [J/kg].

    Nothing beyond a Dirichlet face: no heat crosses a face because particles are shifted.
    """
    # the gradient across a front is the latent heat over a spacing: nothing is exchanged there
    if phase_i != phase_j or dirichlet_j > 0.0:
        return 0.0 * h_i
    return (h_j - h_i) * dot(shift_i - shift_j, G_ij)


def exchange_terms(h_i, h_j, phase_i, phase_j, dirichlet_j, G_ij, shift_i, shift_j):
    """Gains and losses of h by exchange, and the range of neighbors of the same phase [J/kg]."""
    # the range comes from neighbors of the same phase alone, each other one counts as oneself
    q = exchange(h_i, h_j, phase_i, phase_j, dirichlet_j, G_ij, shift_i, shift_j)
    h = h_j if phase_i == phase_j else h_i
    return max(q, 0.0), max(-q, 0.0), h, h


def allowed_shares(total_0, total_1, total_2, total_3, h):
    """Shares of its gains and of its losses that keep h within the neighbors' range."""
    # how far h may rise and fall, over what all pairs together would bring [Zalesak1979]
    gain, loss = max(total_3 - h, 0.0), max(h - total_2, 0.0)
    up = gain / total_0 if total_0 > gain else 1.0
    down = loss / total_1 if total_1 > loss else 1.0
    return up, down


def limited_exchange(
    h_i, h_j, phase_i, phase_j, dirichlet_j, G_ij, shift_i, shift_j, up_i, up_j, down_i, down_j
):
    """Exchange of a pair, by the smaller of the shares that its two particles allow [J/kg]."""
    # the giver's share of losses and the taker's share of gains: the same q for both, heat is kept
    q = exchange(h_i, h_j, phase_i, phase_j, dirichlet_j, G_ij, shift_i, shift_j)
    return q * (min(up_i, down_j) if q > 0.0 else min(down_i, up_j))


def add_exchange(total, h, m):
    """h after the exchange [J/kg], and the heat that the particle has gained by it [J]."""
    new = h + total
    return new, m * (new - h)


def shifted_position(x, displacement, fluid, low, high, width, gap):
    """x~ = x + shift [m], for fluid at least `gap` inside the faces; one period back where
    a width is given."""
    new = x + displacement
    if fluid <= 0.0:
        return new
    return vector(*(confine(new[k], low[k], high[k], width[k], gap) for k in range(len(new))))


def confine(x, low, high, width, gap):
    """One coordinate between its faces, or within its period."""
    # along a period particles come back at the other end, else faces hold them off
    if width > 0.0:
        if x < low:
            return x + width
        if x >= high:
            return x - width
        return x
    return min(max(x, low + gap), high - gap)


class ParticleShifting:
    """Shift and adjustment with their work vectors.

    Args:
        factor: C of (73). domain: in which the particles move.
    """

    def __init__(self, backend: Backend, count: int, factor: float, domain: PoolDomain) -> None:
        self.backend, self.factor, self.spacing = backend, factor, domain.spacing
        self.box, self.periods = domain.bounds, domain.conditions.periods
        self._away_from_walls = domain.conditions.away_from_walls(domain.spacing)
        vectors = (len(self.box), count)
        self.displacement, self._v = backend.zeros(vectors), backend.zeros(vectors)
        self._up, self._down = backend.zeros(count), backend.zeros(count)

    @graph
    def rearrange(
        self,
        flow: Flow,
        kinds: ParticleKinds,
        particles: Particles,
        at_surface: Array,
        scale: float,
    ) -> None:
        """Shift the particles; reduces the heat added by it [J], if there is any shift.

        Args:
            scale: C times largest speed times step [m].
        """
        # d by (73), then v, h and x in this order: v and h read the pairs at x
        self.shift(flow.block, kinds, particles["position"], at_surface, scale)
        self.adjust(flow, kinds, particles)

    def adjust(self, flow: Flow, kinds: ParticleKinds, particles: Particles) -> None:
        """Move the particles by their displacements, with what they carry there."""
        block, jump = flow.block, flow.surface.velocity_jump
        # velocity (74), enthalpy (75), then the positions that both refer to
        self.adjust_velocity(block, kinds, flow.velocity, jump, block.correction)
        h, vapor, m = (particles[name] for name in ("enthalpy", "vapor_fraction", "mass"))
        self.adjust_enthalpy(block, kinds, h, vapor, m)
        self.move(particles["position"], kinds)

    def shift(
        self, block: Block, kinds: ParticleKinds, position: Array, at_surface: Array, scale: float
    ) -> None:
        """Find the displacement of each fluid particle (73), 0 of the others.

        Args:
            position: (d, n) [m]. at_surface: (n,) 1 at a flat surface. scale: C times largest
                speed times step [m].
        """
        backend = self.backend
        backend.fill(self.displacement, 0.0)
        if self.factor == 0.0:
            return
        # C a R_i from the distances of neighbors, kept along faces and below the largest shift (73)
        fields = {"is_fluid": kinds.fluid, "at_surface": at_surface, "G_ij": block.gradient}
        low, high = self._away_from_walls
        backend.pair_sum(
            repulsion_terms,
            block.pairs,
            fields | {"position": position},
            self.displacement,
            finish=shift,
            rows=kinds.fluid_rows,
            low=low,
            high=high,
            close_push=1.0 / (CLOSE_AT_WALL * self.spacing) ** 2,
            scale=scale,
            limit=MAX_SHIFT * self.spacing,
        )

    def adjust_velocity(
        self, block: Block, kinds: ParticleKinds, v: Array, jump: Array, C: Array
    ) -> None:
        """v at the shifted positions (74)."""
        if self.factor == 0.0:
            return
        backend = self.backend
        # all rows read the velocities before the adjustment, hence the copy
        backend.copy(v, self._v)
        fields = {"v": block.ghosts.extend_velocity(v, jump), "G_ij": block.gradient, "C": C}
        fields["displacement"] = self.displacement
        backend.pair_sum(
            velocity_terms,
            block.pairs,
            fields,
            self._v,
            finish=adjust_velocity,
            rows=kinds.fluid_rows,
            combine=("sum", "min", "max"),
        )
        backend.copy(self._v, v)

    def adjust_enthalpy(
        self, block: Block, kinds: ParticleKinds, h: Array, f_v: Array, m: Array
    ) -> float:
        """h at the shifted positions (75), by exchange between pairs; the heat added by it [J]."""
        if self.factor == 0.0:
            return 0.0
        backend, pairs, rows = self.backend, block.pairs, kinds.fluid_rows
        # h, phase and shift of ghosts; beyond a Dirichlet face the enthalpy of its temperature
        heat, phase, up, down = (backend.zeros(block.ghosts.size) for _ in range(4))
        shift = block.ghosts.mirror(self.displacement)
        tables, sources = (
            {"h": h, "fluid": kinds.fluid, "f_v": f_v},
            {"source": block.ghosts.source},
        )
        backend.pointwise(what_is_exchanged, sources, (heat, phase), **tables)
        if block.walls.exchange_heat:
            backend.pointwise(range_enthalpy, {"h": heat} | block.walls.rules, heat)
        # gains and losses that (75) asks for, and the share of them that keeps h in range
        fields = {"h": heat, "phase": phase, "shift": shift, "G_ij": block.gradient}
        fields["dirichlet"] = block.walls.rules["dirichlet"]
        backend.pair_sum(
            exchange_terms,
            pairs,
            fields,
            (self._up, self._down),
            finish=allowed_shares,
            rows=rows,
            combine=("sum", "sum", "min", "max"),
        )
        # exchange by the smaller share of both particles; what gains and losses sum to is booked
        shares = {"up": self._up, "down": self._down}
        backend.pointwise(shares_of, block.ghosts.sources, (up, down), **shares)
        fields |= {"up": up, "down": down, "m": m}
        (added,) = backend.pair_sum(
            limited_exchange,
            pairs,
            fields,
            (h, None),
            finish=add_exchange,
            reduce=(None, "sum"),
            rows=rows,
        )
        return added

    def move(self, position: Array, kinds: ParticleKinds) -> None:
        """Move the particles to their shifted positions, inside the faces."""
        low, high = zip(*self.box, strict=True)
        fields = {"x": position, "displacement": self.displacement, "fluid": kinds.fluid}
        self.backend.pointwise(
            shifted_position,
            fields,
            position,
            low=low,
            high=high,
            width=self.periods,
            gap=MIN_FACE_DISTANCE * self.spacing,
        )
