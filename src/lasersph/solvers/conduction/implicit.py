"""Implicit enthalpy step [Demuth2020, eqs. (64)-(66)], solved to a stated residual.

    m (h - h^n) = s [ sum_j g_ij (P_j - P_i) + A_i (P_w - P_i) - q_i ] + E_i,    P = P(h)

s is the time step, q the loss of the surface, E the absorbed light at the new surface temperature.
The paper eliminates T through h and freezes the fractions (66); its equation multiplied by V_i is
this one. One iteration is

    1  Newton: (C + s G) dP = r on the particles off the plateaus, C = m dh/dP + s dq/dP
    2  these take dh = dP dh/dP, so that one that reaches a plateau stores the rest as latent heat
    3  those on a plateau are balanced with their neighbors held (65), which lets them leave it
    4  residual r; the Newton step is halved until the sum of |r| falls

and ends at sum |r| <= tolerance times the absorbed energy. Whatever is left of r is added to the
enthalpies, so that energy balances to rounding.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from lasersph.compute.vectors import interpolation_slope
from lasersph.linear_solvers.conjugate_gradient import ConjugateGradient
from lasersph.physics.phase_change import balanced_enthalpy, potential_slope, thermal_state
from lasersph.solvers.conduction.body import Body
from lasersph.solvers.conduction.state import HeatState, NotConverged
from lasersph.solvers.conduction.surface_exchange import SurfaceExchange
from lasersph.sph.laplacian import flow

FORCING = 0.02
"""Residual of the linear solver over that of the Newton iteration."""
HALVINGS = 4
MAX_NEWTON = 60
ROUNDING = 4.0
"""Smallest residual asked for, in units of the rounding of its terms."""
MAX_LINEAR = 400


def foresee(h, h_old, ratio, h_nodes, T_nodes, P_nodes):
    """Enthalpy extrapolated from the last step, and T and P there."""
    guess = h + ratio * (h - h_old)
    T, P = thermal_state(guess, h_nodes, T_nodes, P_nodes)
    return guess, T, P


def balance(total, h0, P, E, q, m, S, a, B, s, h_nodes, T_nodes, P_nodes):
    """Enthalpy, T and P of a particle that balances with its neighbors held.

    Args:
        total: sum of g_ij (P_j - P_i). h0: enthalpy before the step. S, a: sums of weights.
        B: sum of A_i P_w. s: time step.
    """
    energy = m * h0 + E + s * (total + S * P + B - q)
    h = balanced_enthalpy(energy, m, s * (S + a), h_nodes, P_nodes)
    T, P_new = thermal_state(h, h_nodes, T_nodes, P_nodes)
    return h, T, P_new


def residual(total, h, h0, P, E, q, m, S, a, B, s):
    """Energy r [J] missing in the balance of a particle, |r|, heat from walls [W], and the size
    of the terms [J], whose rounding r cannot fall below."""
    walls = B - a * P
    r = m * (h0 - h) + E + s * (total + walls - q)
    return r, abs(r), walls, m * abs(h) + s * (S + a) * abs(P)


def linearize(h, m, dq, s, h_nodes, T_nodes, P_nodes):
    """Diagonal C [J m/W] and mask: 0 on plateaus, where P does not answer to h."""
    slope = potential_slope(h, h_nodes, P_nodes)
    if slope <= 0.0:
        return 1.0 + 0.0 * h, 0.0 * h
    return (m + s * dq * interpolation_slope(h, h_nodes, T_nodes)) / slope, 1.0 + 0.0 * h


def move(h, dP, damping, h_nodes, T_nodes, P_nodes):
    """Enthalpy, T and P after a damped Newton step; on plateaus dP = 0 and nothing moves."""
    slope = potential_slope(h, h_nodes, P_nodes)
    new = h
    if slope > 0.0:
        new = h + damping * dP / slope
    T, P = thermal_state(new, h_nodes, T_nodes, P_nodes)
    return new, T, P


def settle(h, r, m, h0):
    """Enthalpy with the last residual added, and the energy stored by the particle [J]."""
    new = h + r / m
    return new, m * (new - h0)


class ImplicitStep:
    """Newton iteration with its work vectors.

    Attributes:
        newton, linear: iterations of the last step.
    """

    max_iterations = MAX_NEWTON

    def __init__(self, body: Body, exchange: SurfaceExchange, tolerance: float) -> None:
        backend, count = body.backend, body.count
        self.body, self.exchange, self.tolerance = body, exchange, tolerance
        self.solver = ConjugateGradient(backend, body.pairs, count)
        self.h, self.T, self.P, self.spare, self.start, self.r, self.C, self.mask = (
            backend.zeros(count) for _ in range(8)
        )
        tables = body.tables
        self.curve = {key: tables[key] for key in ("h_nodes", "T_nodes", "P_nodes")}
        self.rounding = ROUNDING * float(np.finfo(backend.real).eps)
        self.size = 0.0
        self.newton = self.linear = 0

    def advance(self, state: HeatState, step: float, exchanged: float) -> dict[str, float]:
        """Enthalpies after `step` [s] into `state.enthalpy`; returns the energies of the step.

        Args:
            exchanged: energy that the tolerance refers to, beside that of this step [J].

        Raises:
            NotConverged: the residual does not fall to the tolerance.
        """
        backend = self.body.backend
        self.newton = self.linear = 0
        ratio = step / state.time_step if state.time_step > 0.0 else 0.0
        fields = {"h": state.enthalpy, "h_old": state.previous}
        backend.pointwise(foresee, fields, (self.h, self.T, self.P), ratio=ratio, **self.curve)
        error, energy = self._residual(state, step)
        allowed = self.tolerance * max(exchanged, energy["absorbed"] + abs(energy["lost"]), error)
        allowed = max(allowed, self.rounding * self.size)
        while error > allowed:
            if self.newton == self.max_iterations:
                raise NotConverged(
                    f"the heat balance is off by {error:.2e} J after {self.newton} iterations, "
                    f"allowed are {allowed:.2e} J"
                )
            error, energy = self._improve(state, step, error, max(FORCING * error, 0.3 * allowed))
            self.newton += 1
        fields = {"h": self.h, "r": self.r, "m": self.body.mass, "h0": state.enthalpy}
        backend.copy(state.enthalpy, state.previous)
        (stored,) = backend.pointwise(settle, fields, (state.enthalpy, None), reduce=(None, "sum"))
        return energy | {"stored": stored}

    def _improve(
        self, state: HeatState, step: float, error: float, linear_residual: float
    ) -> tuple[float, dict[str, float]]:
        """One Newton step, halved until the residual falls; then whatever the last one gives."""
        body, backend = self.body, self.body.backend
        fields = {"h": self.h, "m": body.mass, "dq": self.exchange.slope}
        backend.pointwise(linearize, fields, (self.C, self.mask), s=step, **self.curve)
        plateau = backend.rows_where(self.mask, 0.0)
        self.linear += self.solver.solve(
            self.r, self.C, self.mask, step, residual=linear_residual, max_iterations=MAX_LINEAR
        )
        backend.copy(self.h, self.start)
        damping = 1.0
        for _ in range(HALVINGS):
            fields = {"h": self.start, "dP": self.solver.solution}
            backend.pointwise(move, fields, (self.h, self.T, self.P), damping=damping, **self.curve)
            self._balance(state, step, plateau)
            found, energy = self._residual(state, step)
            if found < error:
                return found, energy
            damping *= 0.5
        return found, energy

    def _fields(self, state: HeatState) -> dict[str, Any]:
        body = self.body
        return {
            "h": self.h, "h0": state.enthalpy, "P": self.P, "E": body.irradiation.energy,
            "q": self.exchange.power, "m": body.mass, "S": body.pairs.total,
            "a": body.pairs.pull, "B": body.wall_flow, "g_ij": body.pairs.weights,
        }  # fmt: skip

    def _balance(self, state: HeatState, step: float, rows: Any) -> None:
        """Balance the particles `rows` with their neighbors held."""
        backend = self.body.backend
        backend.copy(self.P, self.spare)
        backend.pair_sum(
            flow, self.body.pairs.neighbors, self._fields(state), (self.h, self.T, self.spare),
            rows=rows, finish=balance, s=step, **self.curve,
        )  # fmt: skip
        self.P, self.spare = self.spare, self.P

    def _residual(self, state: HeatState, step: float) -> tuple[float, dict[str, float]]:
        """Residual into `r`; returns the sum of |r| and the energies of the step [J]."""
        body, backend = self.body, self.body.backend
        absorbed = body.irradiation.absorb(self.T)
        lost, removed = self.exchange.evaluate(self.T)
        error, walls, self.size = backend.pair_sum(
            flow, body.pairs.neighbors, self._fields(state), (self.r, None, None, None),
            finish=residual, reduce=(None, "sum", "sum", "sum"), s=step,
        )  # fmt: skip
        return error, {
            "absorbed": absorbed, "lost": lost * step, "removed": removed * step,
            "walls": walls * step,
        }  # fmt: skip
