"""Conjugate gradients with incomplete factors, at the price of one product with the matrix.

    M = (K - E) K^-1 (K - E^T),    A = D - E - E^T

E holds the weights s g_ij toward the particles before i in the order of the sweeps, D the diagonal
of A, and K is diagonal: chosen so that M and A agree on what is constant in space [Gustafsson1978],

    K_i = D_i - sum_{j before i} s g_ij F_j / K_j,    F_j = s sum_{k after j} g_jk.

M has no entries beside those of A, since stencils as wide as particles' make the others small. It
is positive, as K_i >= C_i + F_i by induction. The iteration runs in r' = (K - E)^-1 r on

    (K - E)^-1 A (K - E^T)^-1 p = t + w,    t = (K - E^T)^-1 p,    w = (K - E)^-1 (p + (D - 2 K) t),

one sweep backward and one forward, each over half of the pairs [Eisenstat1981]. With the mask,
held particles have neither rows nor columns. The residual itself is not formed: it is at most

    sum |r_i| <= sum (K_i + F_i) |r'_i|.
"""

from __future__ import annotations

from functools import partial

from lasersph.compute.array_types import Array
from lasersph.compute.backend import Backend
from lasersph.compute.graph import graph
from lasersph.compute.sweeps import OrderedPairs, Sweep
from lasersph.linear_solvers.iteration import conjugate_gradients


def factor(total, C, S, F, a, mask, s):
    """s F / K, which later rows sum, K, 1 / K and D - 2 K; 0 where held.

    Args:
        S, F: sums of all weights and of those after.
    """
    if mask <= 0.0:
        return 0.0 * s, 0.0 * s, 0.0 * s, 0.0 * s
    D = C + s * (S + a)
    K = D - s * total
    return s * F / K, K, 1.0 / K, D - 2.0 * K


def backward(total, r, p, K, inverse, beta, s):
    """t = (K - E^T)^-1 p, and the direction p = K r' + beta p."""
    new = K * r + beta * p
    return inverse * (new + s * total), new


def forward(total, p, t, middle, inverse, s):
    """w = (K - E)^-1 (p + (D - 2 K) t), and p (t + w)."""
    w = inverse * (p + middle * t + s * total)
    return w, p * (t + w)


def advance(x, r, t, w, K, F, s, alpha):
    """x += alpha t, r' -= alpha (t + w); reduces r' K r' and the bound of the residual."""
    new_r = r - alpha * (t + w)
    return x + alpha * t, new_r, K * new_r * new_r, (K + s * F) * abs(new_r)


class IncompleteFactors:
    """Factors for one list of pairs, and the iteration with them.

    Args:
        vectors: x, r and p as they are at the start, and two for work, z and q.

    Attributes:
        sweeps: backward and forward, those of an iteration.
    """

    def __init__(
        self, backend: Backend, pairs: OrderedPairs, vectors: dict[str, Array], count: int
    ) -> None:
        self.backend, self.pairs = backend, pairs
        self._K, self._inverse, self._middle = (backend.zeros(count) for _ in range(3))
        self._t = vectors["z"]
        self._of: tuple | None = None
        v = self._v = {
            "x": vectors["x"],
            "r": vectors["r"],
            "p": vectors["p"],
            "t": self._t,
            "w": vectors["q"],
            "K": self._K,
            "inverse": self._inverse,
            "middle": self._middle,
            "F": pairs.after,
        }
        self._eliminate = Sweep(pairs, forward, v | {"p": v["r"]}, [v["r"]], reduces=1, s=0.0)
        self.sweeps = (
            Sweep(pairs, backward, v, [v["t"], v["p"]], backward=True, beta=0.0, s=0.0),
            Sweep(pairs, forward, v, [v["w"]], reduces=1, s=0.0),
        )

    def solve(
        self, C: Array, a: Array, mask: Array, s: float, *, residual: float, max_iterations: int
    ) -> tuple[int, float]:
        """Iterate from x = 0, r the right-hand side and p = 0; returns the iterations and the bound
        of the residual."""
        # the factors K, then r' = (K - E)^-1 r
        self._factor_of(C, a, mask)(s=s)
        self.backend.fill(self._t, 0.0)
        self._eliminate(s=s)

        # a sweep backward and one forward, until the bound of the residual is small
        rz, error = self.approach(s, 0.0)
        for sweep in self.sweeps:
            sweep.set({"s": s})
        iterations, _, error = self.backend.iterate(
            conjugate_gradients,
            (self.set_direction, partial(self.approach, s), None),
            0.0,
            rz,
            error,
            residual,
            max_iterations,
        )[:3]
        return int(iterations), error

    def set_direction(self, beta: float) -> tuple[float, ...]:
        """Direction p = K r' + beta p with t, and then w; returns p (t + w)."""
        backward, forward = self.sweeps
        backward(beta=beta)
        return forward()

    @graph
    def approach(self, s: float, alpha: float) -> None:
        """x += alpha t, r' -= alpha (t + w); reduces r' K r' and the bound of the residual."""
        v = self._v
        out, reduce = (v["x"], v["r"], None, None), (None, None, "sum", "sum")
        self.backend.pointwise(advance, v, out, reduce=reduce, alpha=alpha, s=s)

    def _factor_of(self, C: Array, a: Array, mask: Array) -> Sweep:
        """Sweep that sets the factors from these arrays, bound when they are new."""
        if self._of is None or any(x is not y for x, y in zip((C, a, mask), self._of, strict=True)):
            self._of = (C, a, mask)
            fields = {"C": C, "S": self.pairs.total, "F": self.pairs.after, "a": a, "mask": mask}
            out = [self._t, self._K, self._inverse, self._middle]
            self._factor = Sweep(self.pairs, factor, fields, out, s=0.0)
        return self._factor
