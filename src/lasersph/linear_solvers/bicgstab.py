"""BiCGStab with right preconditioning, for matrices on pairs that are not symmetric.

Fit for the pressure matrix of edge and dummy particles and for corrected operators, whose entries
a_ij and a_ji differ. Products and dot products are fused into the backend's loops. Where the method
nearly breaks down (r^ . r, r^ . A p or the step omega vanish against their factors) it restarts
from the true residual r with r^ = r; where that made no step, with r^ = r + A r |r| / |A r|, which
is orthogonal to neither r nor A r. Before it returns it looks at the true residual.

References: [vanderVorst1992]; [Saad2003], Algorithm 7.7.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from lasersph.compute.array_types import Array
from lasersph.compute.backend import Backend
from lasersph.linear_solvers.jacobi import Jacobi
from lasersph.linear_solvers.matrix import PairMatrix, entry_times, residual

BREAKDOWN = 1e-10
"""Cosine below which two vectors count as orthogonal, so that the method restarts."""


@dataclass(frozen=True)
class Outcome:
    """How a solution went: iterations of two products each, 2-norm of b - A x, restarts."""

    iterations: int
    residual: float
    restarts: int


def direction(r, p, v, beta, omega):
    """p = r + beta (p - omega v)."""
    return r + beta * (p - omega * v)


def shadowed(total, d, p, shadow):
    """v = A p; reduces r^ . v and v . v."""
    v = d * p + total
    return v, shadow * v, v * v


def half_step(r, v, alpha):
    """s = r - alpha v; reduces s . s."""
    s = r - alpha * v
    return s, s * s


def stabilized(total, d, p, s):
    """t = A p; reduces t . s and t . t."""
    t = d * p + total
    return t, t * s, t * t


def tilted(r, v, share):
    """r^ = r + share v; reduces r^ . r^ and r^ . r."""
    shadow = r + share * v
    return shadow, shadow * shadow, shadow * r


def whole_step(x, y, z, s, t, shadow, alpha, omega):
    """x += alpha y + omega z, r = s - omega t; reduces r . r and r^ . r."""
    r = s - omega * t
    return x + alpha * y + omega * z, r, r * r, shadow * r


class BiCGStab:
    """Solver with its work vectors.

    Args:
        preconditioner: None for one Jacobi sweep (the diagonal).

    Attributes:
        solution: (n,) x; what it holds before `solve` is the first guess.
    """

    def __init__(
        self, backend: Backend, matrix: PairMatrix, *, preconditioner: Jacobi | None = None
    ) -> None:
        count = matrix.diagonal.shape[0]
        self.backend, self.matrix = backend, matrix
        self.preconditioner = preconditioner or Jacobi(backend, matrix)
        self.solution = backend.zeros(count)
        names = ("r", "shadow", "p", "v", "s", "t", "y", "z")
        self._fields: dict[str, Array] = {name: backend.zeros(count) for name in names}
        self._fields |= {"x": self.solution, "a_ij": matrix.entries, "d": matrix.diagonal}

    def solve(self, b: Array, *, residual: float, max_iterations: int) -> Outcome:
        """Solve A x = b until the 2-norm of b - A x is at most `residual`.

        Stops at `max_iterations`, or where restarts no longer help, with the x reached: the
        caller judges by the outcome.
        """
        iterations, restarts = 0, 0
        error, is_tilted = self._true_residual(b), False
        while error > residual and iterations < max_iterations:
            done = self._cycle(error, residual, max_iterations - iterations, is_tilted)
            iterations += done
            before, error = error, self._true_residual(b)
            is_stuck = done == 0 or not error < before
            if error <= residual or (is_stuck and is_tilted):
                break
            is_tilted = is_stuck
            restarts += 1
        return Outcome(iterations, error, restarts)

    def _true_residual(self, b: Array) -> float:
        return residual(self.backend, self.matrix, self.solution, b, self._fields["r"])

    def _cycle(self, error: float, wanted: float, most: int, is_tilted: bool) -> int:
        """Iterate from the residual r until it is small or the method breaks down."""
        backend, f = self.backend, self._fields
        backend.copy(f["r"], f["shadow"])
        backend.copy(f["r"], f["p"])
        shadow_norm, rho = error, error * error
        if is_tilted:
            shadow_norm, rho = self._tilt(error)
        iterations = 0
        while error > wanted and iterations < most:
            # y = K p, v = A y, alpha = rho / (r^ . v)
            self.preconditioner.apply(f["p"], f["y"])
            shadow_v, v_v = self._product("y", f["v"], shadowed)
            if abs(shadow_v) <= BREAKDOWN * shadow_norm * v_v**0.5:
                break
            alpha = rho / shadow_v

            # s = r - alpha v; z = K s, t = A z, omega = (t . s) / (t . t)
            (s_s,) = backend.pointwise(
                half_step, f, (f["s"], None), reduce=(None, "sum"), alpha=alpha
            )
            self.preconditioner.apply(f["s"], f["z"])
            t_s, t_t = self._product("z", f["t"], stabilized)
            omega = t_s / t_t if t_t > 0.0 else 0.0

            # x += alpha y + omega z, r = s - omega t
            out, reduce = (f["x"], f["r"], None, None), (None, None, "sum", "sum")
            r_r, rho_new = backend.pointwise(
                whole_step, f, out, reduce=reduce, alpha=alpha, omega=omega
            )
            error, iterations = r_r**0.5, iterations + 1
            is_stuck = abs(t_s) <= BREAKDOWN * (t_t * s_s) ** 0.5
            if is_stuck or abs(rho_new) <= BREAKDOWN * shadow_norm * error:
                break

            # p = r + beta (p - omega v)
            beta = rho_new / rho * alpha / omega
            backend.pointwise(direction, f, f["p"], beta=beta, omega=omega)
            rho = rho_new
        return iterations

    def _tilt(self, error: float) -> tuple[float, float]:
        """Turn r^ from r toward A K r; returns its norm and r^ . r."""
        f = self._fields
        self.preconditioner.apply(f["r"], f["y"])
        _, v_v = self._product("y", f["v"], shadowed)
        share = error / v_v**0.5 if v_v > 0.0 else 0.0
        square, rho = self.backend.pointwise(
            tilted, f, (f["shadow"], None, None), reduce=(None, "sum", "sum"), share=share
        )
        return square**0.5, rho

    def _product(self, name: str, out: Array, finish: Callable) -> tuple[float, ...]:
        """Write A times a vector into `out`, with the two reductions of `finish`."""
        fields, pairs = dict(self._fields, p=self._fields[name]), self.matrix.neighbors
        outs, reduce = (out, None, None), (None, "sum", "sum")
        return self.backend.pair_sum(entry_times, pairs, fields, outs, finish=finish, reduce=reduce)
