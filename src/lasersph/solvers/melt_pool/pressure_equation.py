"""Pressure equation of the projection, solved by conjugate gradients with a grid's correction.

    sum_j g_ij (p_j - p_i) + a_i (p_b_i - p_i) + f_i = b_i

for the particles with mask 1, with weights g_ij = g_ji >= 0 [m^(d-2)] that discretize V_i times
the Laplacian, and

    a_i = cross-section / distance of a boundary with the given pressure p_b_i,
    f_i = sum of cross-section * dp/dn over boundaries with a given flux (n outward),
    b_i = rho / dt V_i (D_i - d_i),

D_i the divergence of the predicted velocity and d_i the prescribed one [Demuth2020, eq. (77) times
V_i]. A pair with a particle whose mask is 0 contributes nothing: dp/dn = 0 there.

Pools and remnants that do not touch are components of their own (`linear_solvers.components`);
pairs between them contribute nothing. Where no boundary gives a component its pressure the operator
is singular: there the mean of the right-hand side is removed, which makes it solvable, of rings by
their volumes, and the pressure has mean 0. Other components are left alone. Too few particles for a
component have p = 0.

The preconditioner (`linear_solvers.grid_correction`) is made from the present particles in every
step and has no memory, so that only the pressure itself, the first guess, survives a step. The
published matrix is in `published.pressure_equation`. Boxes of one, two and three dimensions.
Reference: [Saad2003], Algorithm 9.1.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial

from lasersph.compute.array_types import Array
from lasersph.compute.backend import Backend
from lasersph.compute.graph import graph
from lasersph.compute.kept_array import KeptArray
from lasersph.linear_solvers.grid_correction import GridCorrection
from lasersph.linear_solvers.iteration import conjugate_gradients
from lasersph.linear_solvers.unknowns import Unknowns, Version
from lasersph.particles.neighbor_lists import NeighborList
from lasersph.solvers.step_control import NotConverged

MAX_ITERATIONS = 200
"""Iterations of a solution at most. Guard: 7 to 30 are usual at any size."""


@dataclass(frozen=True)
class Outcome:
    """How a solution went.

    Attributes:
        iterations: of the solver. residual: its 2-norm over that of the right-hand side.
    """

    iterations: int
    residual: float

    def refuse_above(self, largest: float, equation: str) -> None:
        """Let the step be halved where the residual of an equation is larger.

        Raises:
            NotConverged: it is.
        """
        if not self.residual <= largest:
            raise NotConverged(
                f"{equation} is left with a residual of {self.residual:.1e} of its right-hand side "
                f"after {self.iterations} iterations"
            )


def inner(g_ij, component_i, component_j):
    """Weight of a pair within a component, 0 of others."""
    if component_i == component_j:
        return g_ij
    return 0.0 * g_ij


def total_weight(total, component, a):
    """Diagonal of A; 1 where there is no equation, or none with a weight."""
    d = total + a
    if component > 0 and d > 0.0:
        return d
    return 1.0 + 0.0 * d


def right_side(mask, a, p_b, f, b):
    """a p_b + f - b, so that A is positive."""
    return mask * (a * p_b + f - b)


def neighbor_value(g_ij, p_j):
    """Term of A p beside the diagonal; p = 0 where the mask is 0."""
    return g_ij * p_j


def residual(total, d, mask, p, b):
    """b - A p, and its square."""
    r = b - mask * (d * p - total)
    return r, r * r


def multiply(total, d, mask, s):
    """A s, and s A s."""
    q = mask * (d * s - total)
    return q, s * q


def advance(p, r, s, q, alpha):
    """p += alpha s, r -= alpha q; reduces r r, in the place of r z, which comes later, too."""
    new = r - alpha * q
    return p + alpha * s, new, new * new, new * new


def new_direction(z, s, beta):
    """New direction z + beta s."""
    return z + beta * s


def masked_value(p, mask):
    """First guess, where there is an equation."""
    return mask * p


class PressureEquation:
    """Operator of the present particles, and the solver with its work vectors.

    Args:
        unknowns: among the particles of the block. tolerance: residual over right-hand side that
            ends the iteration (2-norms). max_iterations: where it ends anyhow. is_even: whether all
            particles have one volume.

    Attributes:
        components: pools, `components.count` of them, see `linear_solvers.components`.
    """

    def __init__(
        self,
        backend: Backend,
        unknowns: Unknowns,
        *,
        tolerance: float,
        max_iterations: int = MAX_ITERATIONS,
        is_even: bool = True,
    ) -> None:
        self.backend, self.tolerance, self.max_iterations = backend, tolerance, max_iterations
        self._unknowns, self.components = unknowns, unknowns.components
        self._correction = GridCorrection(backend, unknowns.cells)
        count = self.components.number.shape[0]
        self._nothing, self._inner = backend.zeros(count), KeptArray(backend)
        self._is_even, self._volume = is_even, self._nothing
        # diagonal and right-hand side, residual r, z = M^-1 r, direction s and A s
        self._d, self._b = backend.zeros(count), backend.zeros(count)
        self._r, self._z = backend.zeros(count), backend.zeros(count)
        self._s, self._q = backend.zeros(count), backend.zeros(count)
        # pairs, weights and boundary coefficient of the operator, none yet
        self._neighbors = NeighborList(
            backend.zeros(count + 1, "offset"), backend.zeros(0, "index")
        )
        self._weights, self._coefficient = self._inner.of(0), self._nothing

    def set_operator(
        self,
        neighbors: NeighborList,
        weights: Array,
        mask: Array,
        volume: Array,
        coefficient: Array | None = None,
        version: Version | None = None,
    ) -> None:
        """Take the operator of the present particles; call it whenever one of these has changed.

        Args:
            neighbors: folded list of pairs with position (d, n) [m]. weights: (pairs,) g_ij.
            mask: (n,) 1 for unknown pressures, else 0. volume: (n,) V_i [m^2].
            coefficient: (n,) a_i >= 0; None for no boundary with a given pressure.
            version: of positions and mask, see `Unknowns.find`.
        """
        components = self.components
        self._neighbors, self._weights, self._volume = neighbors, weights, volume
        self._coefficient = self._nothing if coefficient is None else coefficient
        position = neighbors.position
        assert position is not None
        # pools that do not touch have a pressure each: weights between them count for nothing
        self._unknowns.find(position, mask, version)
        components.find_floating(self._coefficient)
        if components.count > 1:
            self._weights = self._inner.of(weights.shape[0])
        # diagonal, and the preconditioner of the present particles
        self.sum_weights(weights)
        self._correction.prepare(volume, self._coefficient)

    def solve(
        self, b: Array, pressure: Array, *, value: Array | None = None, flux: Array | None = None
    ) -> Outcome:
        """Solve for the pressure, from what it holds as the first guess.

        Args:
            b: (n,) right-hand side b_i. pressure: (n,) p [Pa], read and written; 0 where the mask
                is. value: (n,) p_b [Pa], None for 0. flux: (n,) f_i, None for 0.

        Returns:
            The outcome; with a residual above the tolerance where the iteration ended without.
        """
        nothing = self._nothing
        given = nothing if value is None else value, nothing if flux is None else flux
        # residual of the first guess, and the norm that the tolerance refers to
        square, r_r = self.find_first_residual(b, pressure, *given)
        scale = square**0.5
        vectors = self._r, self._d, self.components.mask, self._z
        wanted, iterations = (self.tolerance * scale) ** 2, 0.0

        # [Saad2003, Algorithm 9.1] with z = M^-1 r by the correction on a grid
        if r_r > wanted:
            (r_z,) = self._correction.correct(*vectors)
            iterations, _, r_r = self.backend.iterate(
                conjugate_gradients,
                (
                    self.set_direction,
                    partial(self.approach, pressure),
                    partial(self._correction.correct, *vectors),
                ),
                1.0,
                r_z,
                r_r,
                wanted,
                self.max_iterations,
            )[:3]

        # a pressure that nothing fixes is that of mean 0
        self.remove_means(pressure)
        return Outcome(int(iterations), r_r**0.5 / scale if scale > 0.0 else 0.0)

    @graph
    def sum_weights(self, weights: Array) -> None:
        """Diagonal of the operator, and its weights where there are several components."""
        backend, neighbors = self.backend, self._neighbors
        # d_i = sum_j g_ij + a_i within a component
        fields = {"g_ij": weights, "component": self.components.number, "a": self._coefficient}
        backend.pair_sum(inner, neighbors, fields, self._d, finish=total_weight)
        # the weights themselves, only where components have to be kept apart
        if self._weights is not weights:
            backend.pair_values(inner, neighbors, fields, self._weights)

    @graph
    def find_first_residual(self, b: Array, p: Array, p_b: Array, f: Array) -> None:
        """Residual of the first guess; reduces the squares of the right-hand side and of it."""
        backend, components = self.backend, self.components
        fields = {"p": p, "d": self._d, "mask": components.mask, "g_ij": self._weights}
        fields |= {"b": b, "a": self._coefficient, "f": f, "p_b": p_b}
        # the first guess is 0 where there is no equation
        backend.pointwise(masked_value, fields, p)

        # a p_b + f - b, without its mean where nothing fixes the pressure
        backend.pointwise(right_side, fields, self._b)
        if self._is_even:
            components.remove_means(self._b)
        else:
            components.remove_shares(self._b, self._volume)

        # r = b - A p
        backend.pair_sum(
            neighbor_value,
            self._neighbors,
            fields | {"b": self._b},
            (self._r, None),
            finish=residual,
            reduce=(None, "sum"),
        )

    @graph
    def set_direction(self, beta: float) -> None:
        """Direction s = z + beta s, and q = A s; reduces s q."""
        s, q = self._s, self._q
        # s = z + beta s, conjugate to the directions before
        self.backend.pointwise(new_direction, {"z": self._z, "s": s}, s, beta=beta)
        fields = {"p": s, "s": s, "d": self._d, "mask": self.components.mask}
        # q = A s by one sum over the pairs, with s q for the length of the step
        fields["g_ij"] = self._weights
        self.backend.pair_sum(
            neighbor_value,
            self._neighbors,
            fields,
            (q, None),
            finish=multiply,
            reduce=(None, "sum"),
        )

    @graph
    def approach(self, p: Array, alpha: float) -> None:
        """p += alpha s, r -= alpha q; reduces r r twice, see `advance`."""
        fields = {"p": p, "r": self._r, "s": self._s, "q": self._q}
        out, reduce = (p, self._r, None, None), (None, None, "sum", "sum")
        self.backend.pointwise(advance, fields, out, reduce=reduce, alpha=alpha)

    @graph
    def remove_means(self, p: Array) -> None:
        """Subtract from the pressure of each component that nothing fixes its mean."""
        self.components.remove_means(p)
