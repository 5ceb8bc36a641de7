"""The paper's iteration for the implicit step [Demuth2020, Section 4.2].

One preconditioned conjugate-gradient step on the linear system (66), in which the fractions of the
last iterate are frozen, then new fractions, and again. A CG method restarted after each step is
steepest descent: the new enthalpy is h + alpha z, z = r / diag, alpha = (r z) / (z A z), with

    A = m + s (dP/dh) G,    dP/dh = k / c_p of the sensible heat.

The paper states no stopping rule; here it is the residual of `implicit`.
"""

from __future__ import annotations

import numpy as np

from lasersph.compute.array_types import Constants, Rows
from lasersph.compute.vectors import interpolate
from lasersph.solvers.conduction.implicit import ImplicitStep

MAX_ITERATIONS = 20_000
"""Iterations of a step at most. Guard: of the published solver; no study."""


def difference(g_ij, p_i, p_j):
    """Term of (G p)_i."""
    return g_ij * (p_i - p_j)


def descend(r, m, S, a, s, slope):
    """Preconditioned direction z and r z."""
    z = r / (m + s * slope * (S + a))
    return z, r * z


def curvature(total, z, m, a, s, slope):
    """z A z."""
    return z * (m * z + s * slope * (total + a * z))


def next_enthalpy(h, z, alpha, h_nodes, P_nodes):
    """New enthalpy with its potential."""
    new = h + alpha * z
    return new, interpolate(new, h_nodes, P_nodes)


class PublishedStep(ImplicitStep):
    """The implicit step with the published iteration instead of Newton's."""

    max_iterations = MAX_ITERATIONS
    alpha = 0.0
    """Length of the last step. Derived: there is none yet."""

    def assemble(self, step: float) -> None:
        """There is no matrix: A is applied pair by pair, with the steepest dP/dh."""
        curve = self.body.curve
        slope = float(np.max(np.diff(curve.potential) / np.diff(curve.enthalpy)))
        self.constants: Constants = {"s": step, "slope": slope}

    def solve(self, step: float, wanted: float) -> None:
        """Direction z and length alpha of one preconditioned step of steepest descent."""
        body, backend = self.body, self.body.backend
        # z = r / diag, and r z
        fields = {"r": self.r, "z": self.spare, "m": self.mass, "p": self.spare}
        fields |= {
            "S": body.pairs.total,
            "a": body.pairs.boundary_coefficient,
            "g_ij": body.pairs.weights,
        }
        out, reduce = (self.spare, None), (None, "sum")
        (rz,) = backend.pointwise(descend, fields, out, reduce=reduce, **self.constants)
        # alpha = r z / z A z
        pairs, constants = body.pairs.neighbors, self.constants
        (zAz,) = backend.pair_sum(
            difference, pairs, fields, (None,), finish=curvature, reduce=("sum",), **constants
        )
        self.alpha = rz / zAz
        self.linear += 1

    def correct(
        self, step: float, error: float, plateau: Rows | None
    ) -> tuple[float, dict[str, float]]:
        """Enthalpies h + alpha z, and their residual."""
        fields, out = {"h": self.h, "z": self.spare}, (self.h, self.P)
        self.body.backend.pointwise(next_enthalpy, fields, out, alpha=self.alpha, **self.curve)
        return self.find_residual(step)
