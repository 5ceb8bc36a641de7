"""Explicit predictor-corrector step [Alshaer2017, eqs. (29), (30)], rates of eq. (27).

    h^(n+1/2) = h^n + dt/2 f(h^n),    h^(n+1) = 2 h' - h^n,   h' = h^n + dt/2 f(h^(n+1/2))

that is the midpoint rule; the paper's printed corrector does not re-evaluate the rate. The flow
between two particles takes the harmonic mean of their conductivities.
"""

from __future__ import annotations

from lasersph.compute.array_types import Array
from lasersph.compute.vectors import interpolate
from lasersph.physics.conduction import enthalpy_rate
from lasersph.physics.phase_change import thermal_state
from lasersph.solvers.conduction.body import Body
from lasersph.solvers.conduction.state import HeatState
from lasersph.solvers.conduction.surface_exchange import SurfaceExchange
from lasersph.sph.laplacian import harmonic_flow


def properties(h, h_nodes, T_nodes, P_nodes, k_T, k_nodes):
    """Temperature [K] and conductivity [W/(m K)] at enthalpy h [J/kg]."""
    T, _P = thermal_state(h, h_nodes, T_nodes, P_nodes)
    return T, interpolate(T, k_T, k_nodes)


def step_from(h0, rate, dt):
    """Enthalpy after dt at a constant rate [J/kg]."""
    return h0 + dt * rate


def relaxation_rate(S, a, m, heaviest):
    """Largest k/c_p times the sum of weights over the mass [1/s]: bounds half the eigenvalue."""
    return heaviest * (S + a) / m


class ExplicitStep:
    """Predictor-corrector with its work vectors."""

    def __init__(self, body: Body, exchange: SurfaceExchange) -> None:
        backend, count = body.backend, body.count
        self.body, self.exchange = body, exchange
        self.h, self.T, self.k, self.rate = (backend.zeros(count) for _ in range(4))
        # k(T) as a table up to the end of the caloric curve
        material, curve = body.material, body.curve
        lowest, highest = float(curve.temperature.min()), float(max(curve.temperature.max(), 5e4))
        T, k = material.table("conductivity", max(lowest, 1.0), highest)
        self.tables = {key: body.tables[key] for key in ("h_nodes", "T_nodes", "P_nodes")}
        self.tables |= {"k_T": backend.asarray(T), "k_nodes": backend.asarray(k)}
        self.linear = self.newton = 0

    def stable_step(self) -> float:
        """Largest stable step [s]: the midpoint rule needs dt lambda <= 2, and by Gershgorin
        lambda <= 2 max k/(rho c_p V) sum_j g_ij; sharp within some 20 % on lattices."""
        curve = self.body.curve
        slopes = (curve.potential[1:] - curve.potential[:-1]) / (
            curve.enthalpy[1:] - curve.enthalpy[:-1]
        )
        body = self.body
        # dt lambda/2 <= 1 for the fastest row
        fields = {
            "S": body.pairs.total,
            "a": body.pairs.boundary_coefficient,
            "m": body.particles["mass"],
        }
        (largest,) = body.backend.pointwise(
            relaxation_rate, fields, (None,), reduce=("max",), heaviest=float(slopes.max())
        )
        return 1.0 / largest

    def advance(self, state: HeatState, step: float, exchanged: float) -> dict[str, float]:
        """Enthalpies after `step` [s] into the particles; returns the energies of the step."""
        backend, particles = self.body.backend, self.body.particles
        # h' = h^n + dt/2 f(h^n)
        h, h_0 = particles["enthalpy"], particles["enthalpy_before"]
        backend.copy(h, h_0)
        self._evaluate(h, step)
        fields = {"h0": h_0, "rate": self.rate}
        backend.pointwise(step_from, fields, self.h, dt=0.5 * step)
        # h^(n+1) = h^n + dt f(h')
        energy = self._evaluate(self.h, step)
        backend.pointwise(step_from, fields, h, dt=step)
        return energy

    def _evaluate(self, enthalpy: Array, step: float) -> dict[str, float]:
        """Rate of heating at given enthalpies; returns the energies of a whole step at it [J]."""
        body, backend = self.body, self.body.backend
        backend.pointwise(properties, {"h": enthalpy}, (self.T, self.k), **self.tables)
        # light and losses at the temperature of the surface
        absorbed = body.light.absorb(self.T)
        lost, removed = self.exchange.evaluate(self.T)
        fields = {"T": self.T, "k": self.k, "m": body.particles["mass"]}
        fields |= {"E": body.light.deposit, "q": self.exchange.power, "w": body.wall_power}
        fields |= {
            "a": body.pairs.boundary_coefficient,
            "b": body.wall_heat,
            "g_ij": body.pairs.weights,
        }
        # dh/dt = (sum of flows + E/dt - q + walls) / m (27)
        (walls,) = backend.pair_sum(
            harmonic_flow,
            body.pairs.neighbors,
            fields,
            (self.rate, None),
            finish=enthalpy_rate,
            reduce=(None, "sum"),
            step=step,
        )
        surface = {"absorbed": absorbed, "lost": lost * step, "removed": removed * step}
        return surface | {"walls": walls * step}
