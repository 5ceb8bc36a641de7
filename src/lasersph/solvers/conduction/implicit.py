"""Implicit enthalpy step [Demuth2020, eqs. (64)-(66)], solved to a stated residual.

    m (h - h^n) = s [ sum_j g_ij (P_j - P_i) + A_i (P_w - P_i) - q_i ] + E_i,    P = P(h)

s is the time step, q the loss of the surface, E the absorbed light at the new surface temperature.
The paper eliminates T through h and freezes the fractions (66); its equation multiplied by V_i is
this one. A step is

    predict    P extrapolated in time, which stays smooth where a particle begins to melt and its
               enthalpy does not
    assemble   C = m dh/dP + s dq/dP of the particles off the plateaus
    solve      Newton: (C + s G) dP = r on these, by conjugate gradients, as exactly as the last
               iteration has made it worth
    correct    these take the enthalpy that dP leads to; one that reaches a plateau stores the rest
               as latent heat; those on a plateau are balanced, their neighbors fixed (65), which
               lets them leave it; dP is halved until the sum of |r| falls

the last three again until sum |r| <= tolerance times the absorbed energy. What is left of r is
added to the enthalpies, so that no energy is lost with it, and its sum is booked.
"""

from __future__ import annotations

import numpy as np

from lasersph.compute.array_types import Array, Rows
from lasersph.compute.graph import graph
from lasersph.compute.vectors import (
    interpolate,
    interpolation_slope,
    same,
    segment_near,
    value_in,
)
from lasersph.linear_solvers.conjugate_gradient import ConjugateGradient
from lasersph.physics.phase_change import balanced_enthalpy, follow_potential, potential_slope
from lasersph.solvers.conduction.body import HISTORY, Body
from lasersph.solvers.conduction.state import HeatState
from lasersph.solvers.conduction.surface_exchange import SurfaceExchange
from lasersph.solvers.step_control import NotConverged
from lasersph.sph.laplacian import flow

FIRST_FORCING = 0.05
"""Residual of the linear solver over that of the Newton iteration, in the first of a step; after
that, what the last iteration has left beside that of its linear solver, over what it began with:
nothing where the balance is linear, which is then solved at once [Eisenstat1996, eq. (2.1)]. Cost:
the residual that ends the step is `tolerance`."""
FORCING = (1e-6, 0.2)
"""Range of that. Cost: the forcing term of [Eisenstat1996]; below, the weights are rounded."""
SMOOTH_RATIO = 2.0
"""Steps that differ by less than this are followed by a parabola, others by a straight line. Cost:
only the first guess differs."""
HALVINGS = 4
"""Halvings of the line search. Guard: after a 16th the step in time is halved and taken again."""
MAX_NEWTON = 60
"""Newton iterations of a step at most. Guard: `dlip-steel --quick` takes 2.4 a step; a step that
takes 60 is halved."""
ROUNDING = 4.0
"""Smallest residual asked for, in units of the rounding of its terms. Rounding: four units in the
last place cannot be made smaller."""
MAX_LINEAR = 400
"""Linear iterations of a Newton iteration at most. Guard: `dlip-steel --quick` takes 2.3."""


def initial_guess(h, excess, h_old, h_older, guess, ratio, near, far, h_nodes, P_nodes):
    """Enthalpy, P and dP/dh extrapolated from three steps of P; on plateaus from two of h.

    Args:
        guess: segment of the curve in which they are looked for. ratio: step over the last one.
        near, far: weights of the last changes of the potential.
    """
    start = h - excess
    P_old = potential_near(h_old, guess, h_nodes, P_nodes)
    change = potential_near(start, guess, h_nodes, P_nodes) - P_old
    before = P_old - potential_near(h_older, guess, h_nodes, P_nodes)
    dP, dh = near * change + far * before, ratio * (start - h_old)
    return follow_potential(start, dP, dh, guess, h_nodes, P_nodes)


def potential_near(h, guess, h_nodes, P_nodes):
    """Heat potential at enthalpy h, which is looked for in the segment number `guess`."""
    return value_in(segment_near(h, guess, h_nodes), h, h_nodes, P_nodes)


def balance(total, h0, P, E, q, m, S, a, B, s, h_nodes, P_nodes):
    """Enthalpy, P and dP/dh of a particle that balances with its neighbors fixed.

    Args:
        total: sum of g_ij (P_j - P_i). h0: enthalpy before the step. S, a: sums of weights.
        B: sum of A_i P_w. s: time step.
    """
    energy = m * h0 + E + s * (total + S * P + B - q)
    h = balanced_enthalpy(energy, m, s * (S + a), h_nodes, P_nodes)
    return h, interpolate(h, h_nodes, P_nodes), potential_slope(h, h_nodes, P_nodes)


def residual(total, h, h0, P, E, q, m, S, a, B, s):
    """Energy r [J] missing in the balance of a particle, |r|, heat from walls [W], and the size
    of the terms [J], whose rounding r cannot fall below."""
    walls = B - a * P
    r = m * (h0 - h) + E + s * (total + walls - q)
    return r, abs(r), walls, m * abs(h) + s * (S + a) * abs(P)


def linearize(h, slope, m, dq, s, h_nodes, T_nodes):
    """Diagonal C [J m/W] and mask: 0 on plateaus, where P does not answer to h."""
    if slope <= 0.0:
        return 1.0 + 0.0 * h, 0.0 * h
    C = m
    if dq != 0.0:
        C = m + s * dq * interpolation_slope(h, h_nodes, T_nodes)
    return C / slope, 1.0 + 0.0 * h


def move(h, dP, guess, damping, h_nodes, P_nodes):
    """Enthalpy, P and dP/dh after a damped Newton step; on plateaus nothing moves."""
    return follow_potential(h, damping * dP, 0.0, guess, h_nodes, P_nodes)


def close_balance(h, r, m, h0, excess, previous):
    """Enthalpy with the last residual added, what was added, and the enthalpies of one and two
    steps ago without that."""
    more = r / m
    return h + more, more, h0 - excess, previous


class ImplicitStep:
    """Newton iteration with its work vectors.

    Attributes:
        newton, linear: iterations of the last step. forcing: residual of the next linear solve
            over that of Newton's iteration.
    """

    max_iterations = MAX_NEWTON

    def __init__(self, body: Body, exchange: SurfaceExchange, tolerance: float) -> None:
        backend, count = body.backend, body.count
        self.body, self.exchange, self.tolerance = body, exchange, tolerance
        self.backend = backend
        self.solver = ConjugateGradient(backend, body.pairs, count, rounds=True, rests=True)
        self.h, self.T, self.P, self.slope, self.spare, self.start, self.r, self.C, self.mask = (
            backend.zeros(count) for _ in range(9)
        )
        self.curve = {key: body.tables[key] for key in ("h_nodes", "P_nodes")}
        self.T_curve = {key: body.tables[key] for key in ("h_nodes", "T_nodes")}
        self.nodes = {"nodes": body.tables["h_nodes"], "values": body.tables["T_nodes"]}
        self.history = body.particles.by_symbol(*HISTORY)
        self.mass, self.h_0 = body.particles["mass"], body.particles["enthalpy"]
        self.rounding = ROUNDING * float(np.finfo(backend.real).eps)
        self.size = 0.0
        self.newton = self.linear = 0
        self.forcing = FIRST_FORCING

    def advance(self, state: HeatState, step: float, exchanged: float) -> dict[str, float]:
        """Enthalpies after `step` [s] into the particles; returns the energies of the step.

        Args:
            exchanged: energy that the tolerance refers to, beside that of this step [J].

        Raises:
            NotConverged: the residual does not fall to the tolerance.
        """
        # predict, and the energy that is missing then
        self.newton, self.linear, self.forcing = 0, 0, FIRST_FORCING
        self.predict(state, step)
        error, energy = self.find_residual(step)
        allowed = self.tolerance * max(exchanged, energy["absorbed"] + abs(energy["lost"]), error)
        allowed = max(allowed, self.rounding * self.size)

        # assemble, solve, correct until sum |r| is small enough
        while error > allowed:
            if self.newton == self.max_iterations:
                raise NotConverged(
                    f"the heat balance is off by {error:.2e} J after {self.newton} iterations, "
                    f"allowed are {allowed:.2e} J"
                )
            plateau = self.assemble(step)
            self.solve(step, max(self.forcing * error, 0.3 * allowed))
            found, energy = self.correct(step, error, plateau)
            # how much of the residual is that of the linearization [Eisenstat1996, eq. (2.1)]
            nonlinear = abs(found - self.solver.residual) / error
            self.forcing = min(max(nonlinear, FORCING[0]), FORCING[1])
            self.newton, error = self.newton + 1, found

        # what is left of r is added to the enthalpies
        self.accept()
        return energy | {"newton_residual": error}

    def predict(self, state: HeatState, step: float) -> None:
        """Set the first guess of enthalpy and potential, from those of the last steps."""
        # P along a straight line through the last two steps
        last, before = state.time_step, state.time_step_before
        ratio = near = step / last if last > 0.0 else 0.0
        far = 0.0
        # a parabola through three, where steps are about as long
        if 0.0 < step <= SMOOTH_RATIO * last and last <= SMOOTH_RATIO * before:
            bend = step * (step + last) / (last + before)
            near, far = ratio + bend / last, -bend / before
        # h on plateaus, P elsewhere, and dP/dh there
        weights = {"ratio": ratio, "near": near, "far": far}
        fields, out = self.history | {"guess": self.body.segment}, (self.h, self.P, self.slope)
        self.body.backend.pointwise(initial_guess, fields, out, **weights, **self.curve)

    def assemble(self, step: float) -> Rows | None:
        """Diagonal C and mask of Newton's matrix; returns the particles on plateaus, if any."""
        (freest,) = self.linearize(step)
        return self.body.backend.rows_where(self.mask, 0.0) if freest == 0.0 else None

    def solve(self, step: float, wanted: float) -> None:
        """Newton's change of the potential, (C + s G) dP = r, to the residual wanted [J]."""
        arguments, limits = (self.r, self.C, self.mask, step), {"max_iterations": MAX_LINEAR}
        self.linear += self.solver.solve(
            *arguments, residual=wanted, renews=self.newton <= 1, **limits
        )

    def correct(
        self, step: float, error: float, plateau: Rows | None
    ) -> tuple[float, dict[str, float]]:
        """Apply the change, halved until the residual falls; then whatever the last one gives."""
        backend, damping = self.body.backend, 1.0
        # h + damping dP, then the particles on plateaus with their neighbors fixed (65)
        backend.copy(self.h, self.start)
        for _ in range(HALVINGS):
            self.move(damping)
            if plateau is not None:
                self._balance(step, plateau)
            found, energy = self.find_residual(step)
            if found < error:
                break
            damping *= 0.5
        return found, energy

    def accept(self) -> None:
        """Take the enthalpies with what is left of r."""
        # h = h' + r/m, kept apart from h' for the next prediction
        h_0, excess, h_old, h_older = self.history.values()
        fields = {"h": self.h, "r": self.r, "m": self.mass, "h0": h_0}
        fields |= {"excess": excess, "previous": h_old}
        self.body.backend.pointwise(close_balance, fields, (h_0, excess, h_old, h_older))

    def find_residual(self, step: float) -> tuple[float, dict[str, float]]:
        """Residual into `r`; returns the sum of |r| and the energies of the step [J]."""
        body, backend = self.body, self.body.backend
        # light and losses follow the temperature of the surface
        if body.light.incident > 0.0 or not self.exchange.is_idle:
            rows = self.exchange.rows
            backend.pointwise(interpolate, {"x": self.h}, self.T, rows=rows, **self.nodes)
        absorbed = body.light.absorb(self.T)
        lost, removed = self.exchange.evaluate(self.T)
        # r = m (h0 - h) + E + s (sum g (P_j - P) + B - a P - q)
        error, walls, self.size = self.balance(step)
        surface = {"absorbed": absorbed, "lost": lost * step, "removed": removed * step}
        return error, surface | {"walls": walls * step}

    @graph
    def balance(self, s: float) -> None:
        """Residual into `r`; reduces its size, what walls give, and the size of its terms."""
        self.backend.pair_sum(
            flow,
            self.body.pairs.neighbors,
            self._fields(),
            (self.r, None, None, None),
            finish=residual,
            reduce=(None, "sum", "sum", "sum"),
            s=s,
        )

    @graph
    def move(self, damping: float) -> None:
        """Enthalpy, potential and dP/dh after a damped step of Newton's iteration."""
        fields = {"h": self.start, "dP": self.solver.solution, "guess": self.body.segment}
        out = (self.h, self.P, self.slope)
        self.body.backend.pointwise(move, fields, out, damping=damping, **self.curve)

    @graph
    def linearize(self, s: float) -> None:
        """Diagonal C and mask of Newton's matrix; reduces the smallest mask."""
        fields = {"h": self.h, "slope": self.slope, "m": self.mass, "dq": self.exchange.slope}
        out, reduce = (self.C, self.mask), (None, "min")
        self.body.backend.pointwise(linearize, fields, out, reduce=reduce, s=s, **self.T_curve)

    def _balance(self, step: float, rows: Rows) -> None:
        """Balance the particles `rows` with their neighbors fixed."""
        backend, out = self.body.backend, (self.h, self.spare, self.slope)
        pairs, fields = self.body.pairs.neighbors, self._fields()
        backend.pair_sum(flow, pairs, fields, out, rows=rows, finish=balance, s=step, **self.curve)
        backend.pointwise(same, {"value": self.spare}, self.P, rows=rows)

    def _fields(self) -> dict[str, Array]:
        body = self.body
        fields = {"h": self.h, "h0": self.h_0, "P": self.P, "m": self.mass}
        fields |= {"E": body.light.deposit, "q": self.exchange.power, "B": body.wall_flow}
        fields |= {
            "S": body.pairs.total,
            "a": body.pairs.boundary_coefficient,
            "g_ij": body.pairs.weights,
        }
        return fields
