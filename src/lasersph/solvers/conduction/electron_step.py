"""Step of two temperatures: linearly implicit, extrapolated to the second order [Deuflhard1985].

A step of length s, with all coefficients as they are at its start:

    exchange   T_e after G alone, Q and the capacity C with which T_e answers to energy: exact for
               constant C_e, C_l and G (`physics.two_temperature`)
    electrons  (C + s K_e) x = E + s div(k_e grad T_e): T_e + x, and the energy S of each particle
    give       e and Q + r (1 - f) S, what the lattice gains
    lattice    (m dh/dP + s K_l) dP = gained + s (div(grad P) - q), plateaus held; h follows from
               the flows, so that what enters a plateau is latent heat

Both matrices are those of the pairs of one temperature, with other weights, and positive, so that
any step is stable. Energies follow from flows between particles: their sum is kept to rounding,
however well the equations are solved. Twice the result of two halves less that of one whole is of
second order; their difference is the error by which the step is chosen, or taken again.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import sqrt

import numpy as np

from lasersph.compute.array_types import Array
from lasersph.irradiation.light import energies
from lasersph.linear_solvers.conjugate_gradient import ConjugateGradient, PairOperator
from lasersph.physics import two_temperature as terms
from lasersph.solvers.conduction.electron_body import ElectronBody
from lasersph.solvers.conduction.state import HeatState
from lasersph.solvers.conduction.surface_exchange import SurfaceExchange
from lasersph.solvers.step_control import NotConverged, StepFailed
from lasersph.sph.laplacian import flow

LINEAR = 1e-9
"""Residual of a linear solve over the energies that it distributes. Accuracy: no energy is lost
with it, and temperatures are off by a billionth."""
MAX_LINEAR = 400
"""Linear iterations of a solve at most. Guard: some 15 are usual; energies are kept anyhow."""
REJECTED = 4.0
"""Error over the wanted one from which a step is taken again, half as long. Cost: errors of the
next step are expected within 20 % of the wanted one."""
SAFETY = 0.9
"""Length of the next step over the one that would just have the wanted error. Cost: fewer steps
are taken twice."""
COLDEST_RISE = 1.0
"""Rise of the temperature to which errors are related at least [K]. Accuracy: a hundredth of a
degree is no error."""


class HotElectrons(StepFailed):
    """The electrons are hotter than the metal's tables know."""


@dataclass
class SubStep:
    """Energies after a part of a step, and what it exchanged.

    Attributes:
        e, h: (n,) of the electrons, and of both [J/kg]. energy: by name [J].
    """

    e: Array
    h: Array
    energy: dict[str, float]


class ElectronStep:
    """Electrons and lattice with their work vectors.

    Attributes:
        newton, linear: iterations of the last step. error: of the last step, over the wanted one.
    """

    def __init__(self, body: ElectronBody, exchange: SurfaceExchange, wanted: float) -> None:
        """`wanted`: error of a step over the rise of the temperature."""
        backend, count = body.backend, body.count
        self.body, self.exchange, self.backend, self.wanted = body, exchange, backend, wanted
        self.newton = self.linear = 0
        self.error = 0.0
        assert body.nodes is not None and body.material.electrons is not None
        electrons, nodes = body.material.electrons, body.nodes
        names = ("T", "T_l", "Q", "share", "C", "T_e", "k", "S", "sum", "gained", "P", "mask")
        self.v = {name: backend.zeros(count) for name in (*names, "D", "a", "b", "taken", "e")}
        self.parts = [SubStep(backend.zeros(count), backend.zeros(count), {}) for _ in range(3)]
        # matrices: pairs with their mean k_e, and those of the metal with the lattice's share
        operator = body.pairs
        self.pairs = PairOperator(
            operator.neighbors, backend.zeros(operator.weights.shape[0]), self.v["a"], self.v["sum"]
        )
        self.electrons = ConjugateGradient(backend, self.pairs, count)
        self.lattice: ConjugateGradient | None = None
        if nodes.potential.max() > 0.0:
            self.lattice = ConjugateGradient(backend, operator, count, rests=True)
        share = electrons.lattice_share or 0.0
        at_rest = backend.to_host(body.wall_flow) - backend.to_host(body.wall_power)
        self.lattice_wall = backend.asarray(share * at_rest + backend.to_host(body.wall_power))
        # tables and constants of the loops
        self.tables = {key: body.lattice_tables[key] for key in ("h_nodes", "T_nodes")}
        self.potential = {key: body.lattice_tables[key] for key in ("h_nodes", "P_nodes")}
        self.coupling = {
            "G_T": backend.asarray(nodes.coupling_temperature),
            "G_nodes": backend.asarray(nodes.coupling),
        }
        self.k_nodes = backend.asarray(nodes.conductivity)
        self.is_constant = electrons.conductivity is not None
        self.ratio = electrons.scattering or 0.0
        if self.is_constant:
            backend.fill(self.v["k"], float(nodes.conductivity[0]))
        material = body.material
        self.c = float(material.heat_capacity_at(material.reference_temperature))
        self.cold = body.curve.initial_temperature

    def advance(self, state: HeatState, step: float, exchanged: float) -> dict[str, float]:
        """Energies after `step` [s] into the particles; returns those of the step [J].

        Raises:
            NotConverged: its error is too large. HotElectrons: they leave the tables.
        """
        self.linear, now, half = 0, state.time, state.time + 0.5 * step
        e, h = self.body.particles["electron_energy"], self.body.particles["enthalpy"]
        once, first, second = self.parts
        # one whole step, and two halves of it
        light = self._advance(once, e, h, now, now + step)
        parts = [self._advance(first, e, h, now, half)]
        parts.append(self._advance(second, first.e, first.h, half, now + step))
        self._extrapolate(once, second)
        booked = {
            name: parts[0][name] + parts[1][name] + (parts[0][name] + parts[1][name] - value)
            for name, value in light.items()
        }
        # the energies of light that the solver books
        found = self.body.light
        found.incident = booked.pop("incident")
        found.reflected, found.transmitted = booked.pop("reflected"), booked.pop("transmitted")
        self.backend.copy(second.h, h)
        self.backend.copy(second.e, e)
        return booked

    def next_step(self, step: float) -> float:
        """Length of a step that would have the wanted error, from that of the last [s]."""
        return step * SAFETY / sqrt(max(self.error, 1e-6))

    def _advance(
        self, part: SubStep, e: Array, h: Array, start: float, end: float
    ) -> dict[str, float]:
        """A part of a step, from energies e and h; returns what it exchanges [J]."""
        s, body, backend, v = end - start, self.body, self.backend, self.v
        self._prepare(e, h, s)
        # light and losses at the temperature of the lattice
        body.light.shine(start, end)
        absorbed = body.light.absorb(v["T_l"])
        lost, removed = self.exchange.evaluate(v["T_l"])
        walls = self._heat_electrons(s)
        fields = {"S": v["S"], "e": e, "m": body.particles["mass"]}
        fields |= {"Q": v["Q"], "share": v["share"]}
        backend.pointwise(terms.give, fields, (part.e, v["gained"]))
        walls += self._heat_lattice(e, h, s)
        fields = {"h": h, "e": e, "new_e": part.e, "taken": v["taken"]}
        backend.pointwise(terms.total_enthalpy, fields | {"m": body.particles["mass"]}, part.h)
        lit = energies(body.light, absorbed)
        names = ("incident", "reflected", "transmitted", "absorbed")
        return {name: lit[name] for name in names} | {
            "lost": lost * s,
            "removed": removed * s,
            "walls": walls,
        }

    def _prepare(self, e: Array, h: Array, s: float) -> None:
        """Exchange of each particle, and the matrix of the electrons."""
        body, backend, v, pairs = self.body, self.backend, self.v, self.pairs
        # pairs of particles that have moved since
        if pairs.neighbors is not body.pairs.neighbors:
            pairs.neighbors = body.pairs.neighbors
            pairs.weights = backend.zeros(body.pairs.weights.shape[0])
        fields = {"e": e, "h": h, "m": body.particles["mass"]}
        out = tuple(v[name] for name in ("T", "T_l", "Q", "share", "C", "T_e"))
        backend.pointwise(
            terms.prepare_exchange,
            fields,
            out,
            **self.tables,
            **body.electron_tables,
            **self.coupling,
            density=body.material.density_reference,
            s=s,
        )
        if not self.is_constant:
            fields = {"e": e, "h": h, "T_e": v["T_e"], "T_l": v["T_l"]}
            backend.pointwise(
                terms.conductivity_with_scattering,
                fields,
                v["k"],
                h_nodes=self.tables["h_nodes"],
                k_nodes=self.k_nodes,
                ratio=self.ratio,
            )
        # w_ij = g_ij (k_i + k_j)/2, their sums, and k A toward faces
        fields = {"g_ij": body.pairs.weights, "k": v["k"]}
        backend.pair_values(terms.mean_weight, pairs.neighbors, fields, pairs.weights)
        fields = {"w_ij": pairs.weights, "a": body.pairs.boundary_coefficient, "k": v["k"]}
        out = (pairs.total, pairs.boundary_coefficient)
        backend.pair_sum(
            terms.row_weight, pairs.neighbors, fields, out, finish=terms.scaled_boundary
        )

    def _heat_electrons(self, s: float) -> float:
        """S of each particle from light and neighbors; returns the heat from faces [J]."""
        v, backend = self.v, self.backend
        size, _ = self._find_S(s)
        if size == 0.0:
            return 0.0
        self._solve(self.electrons, v["S"], v["C"], self._ones(), s, size)
        backend.pointwise(terms.add, {"x": v["T"], "y": self.electrons.solution}, v["T"])
        return self._find_S(s)[1]

    def _find_S(self, s: float) -> tuple[float, float]:
        """S at the temperatures T; returns the sum of |S| and the heat from faces [J]."""
        v, body = self.v, self.body
        fields = {"g_ij": self.pairs.weights, "P": v["T"], "T": v["T"], "E": body.light.deposit}
        fields |= {"a": v["a"], "k": v["k"], "wall": body.wall_heat}
        size, walls = self.backend.pair_sum(
            flow,
            self.pairs.neighbors,
            fields,
            (v["S"], None, None),
            finish=terms.electron_energy_taken,
            reduce=(None, "sum", "sum"),
            s=s,
        )
        return size, walls

    def _heat_lattice(self, e: Array, h: Array, s: float) -> float:
        """Energy that the lattice takes; returns the heat from faces [J]."""
        v, body = self.v, self.body
        fields = {"h": h, "e": e, "m": body.particles["mass"]}
        out = (v["D"], v["mask"], v["P"])
        self.backend.pointwise(terms.lattice_row, fields, out, **self.potential)
        size, walls = self._find_taken(s)
        if self.lattice is None or size == 0.0:
            return walls
        self._solve(self.lattice, v["taken"], v["D"], v["mask"], s, size)
        self.backend.pointwise(terms.add, {"x": v["P"], "y": self.lattice.solution}, v["P"])
        return self._find_taken(s)[1]

    def _find_taken(self, s: float) -> tuple[float, float]:
        """Energy taken at the potentials P; returns the sum of sizes and the heat from faces."""
        v, pairs = self.v, self.body.pairs
        fields = {"g_ij": pairs.weights, "P": v["P"], "gained": v["gained"]}
        fields |= {"q": self.exchange.power, "a": pairs.boundary_coefficient}
        fields |= {"b": self.lattice_wall}
        size, walls = self.backend.pair_sum(
            flow,
            pairs.neighbors,
            fields,
            (v["taken"], None, None),
            finish=terms.lattice_energy_taken,
            reduce=(None, "sum", "sum"),
            s=s,
        )
        return size, walls

    def _solve(
        self, solver: ConjugateGradient, b: Array, C: Array, mask: Array, s: float, size: float
    ) -> None:
        """Solve a matrix of the step for the energies b, whose sizes sum to `size`."""
        limits = {"residual": LINEAR * size, "max_iterations": MAX_LINEAR}
        self.linear += solver.solve(b, C, mask, s, **limits)

    def _ones(self) -> Array:
        """Mask of the electrons: all of them are free."""
        mask = self.v["mask"]
        self.backend.fill(mask, 1.0)
        return mask

    def _extrapolate(self, once: SubStep, twice: SubStep) -> None:
        """Energies of second order into `twice`.

        Raises:
            NotConverged: the two ways differ too much. HotElectrons: T_e leaves the tables.
        """
        fields = {"e": twice.e, "h": twice.h, "e_once": once.e, "h_once": once.h}
        found = self.backend.pointwise(
            terms.extrapolate,
            fields,
            (twice.e, twice.h, None, None, None, None, None),
            reduce=(None, None, "max", "max", "max", "min", "max"),
            c=self.c,
            **self.tables,
            **self.body.electron_tables,
        )
        electrons, lattice, hottest, least, heat = found
        rise = max(hottest - self.cold, COLDEST_RISE)
        errors = electrons / rise, lattice / max(heat, COLDEST_RISE)
        self.error = max(errors) / self.wanted
        nodes = self.body.nodes
        assert nodes is not None
        if not np.isfinite(self.error) or self.error > REJECTED or least <= nodes.energy[0]:
            raise NotConverged(
                f"temperatures of electrons and lattice change by {self.error * self.wanted:.2g} "
                f"of their rise where the step is halved, allowed are {self.wanted:.2g}"
            )
        if hottest > nodes.hottest:
            raise HotElectrons(
                f"electrons are at {hottest:.0f} K, beyond the table of the metal, which ends at "
                f"{nodes.hottest:.0f} K; give less light (laser.fluence), or a table "
                "in material.electrons.heat_capacity that goes on"
            )
