"""A part of a step of two temperatures, all of it or a half: see `electron_step`.

Few particles take less time than the calls of their loops, so the loops between two linear solves
are graphs. They read and write the energies `e` and `h` of the part, which whoever advances puts
there and takes from there.
"""

from __future__ import annotations

from lasersph.compute.array_types import Array
from lasersph.compute.graph import graph
from lasersph.irradiation.light import energies
from lasersph.linear_solvers.conjugate_gradient import ConjugateGradient, PairOperator
from lasersph.physics import two_temperature as terms
from lasersph.solvers.conduction.electron_body import ElectronBody
from lasersph.solvers.conduction.surface_exchange import SurfaceExchange
from lasersph.sph.laplacian import flow

LINEAR = 1e-9
"""Residual of a linear solve over the energies that it distributes. Accuracy: no energy is lost
with it, and temperatures are off by a billionth."""
MAX_LINEAR = 400
"""Linear iterations of a solve at most. Guard: some 15 are usual; energies are kept anyhow."""
WORK = (
    *("T", "T_l", "Q", "share", "C", "T_e", "k", "S", "sum", "gained", "P", "D", "a", "taken"),
    "nu",
)
"""Work vectors by symbol."""


class ElectronPart:
    """Loops and linear solves of a part of a step, with their work vectors.

    Attributes:
        e, h: (n,) energies of the electrons, and of both [J/kg], which `advance` changes. linear:
            linear iterations since it was set to 0.
    """

    def __init__(self, body: ElectronBody, exchange: SurfaceExchange) -> None:
        backend, count = body.backend, body.count
        self.body, self.exchange, self.backend = body, exchange, backend
        self.linear = 0
        assert body.nodes is not None and body.material.electrons is not None
        electrons, nodes = body.material.electrons, body.nodes
        self.v = {name: backend.zeros(count) for name in (*WORK, "mask", "ones")}
        self.e, self.h, self.new_e = (backend.zeros(count) for _ in range(3))
        backend.fill(self.v["ones"], 1.0)
        # matrices: pairs with their mean k_e, and those of the metal with the lattice's share
        self.metal = body.pairs
        self.pairs = PairOperator(
            self.metal.neighbors,
            backend.zeros(self.metal.weights.shape[0]),
            self.v["a"],
            self.v["sum"],
        )
        self.electrons = ConjugateGradient(backend, self.pairs, count)
        self.lattice: ConjugateGradient | None = None
        if nodes.potential.max() > 0.0:
            self.lattice = ConjugateGradient(backend, self.metal, count, rests=True)
        share = electrons.lattice_share or 0.0
        at_rest = backend.to_host(body.wall_flow) - backend.to_host(body.wall_power)
        self.lattice_wall = backend.asarray(share * at_rest + backend.to_host(body.wall_power))
        self.wall_heat = body.wall_heat
        # tables and constants of the loops
        self.tables = {key: body.lattice_tables[key] for key in ("h_nodes", "T_nodes")}
        self.potential = {key: body.lattice_tables[key] for key in ("h_nodes", "P_nodes")}
        self.electron_tables = body.electron_tables
        self.coupling = {
            "G_T": backend.asarray(nodes.coupling_temperature),
            "G_nodes": backend.asarray(nodes.coupling),
        }
        self.collisions = body.light.collisions
        self.k_nodes = backend.asarray(nodes.conductivity)
        self.is_constant = electrons.conductivity is not None
        self.ratio = electrons.scattering or 0.0
        if self.is_constant:
            backend.fill(self.v["k"], float(nodes.conductivity[0]))
        self.density = body.material.density_reference

    def advance(self, start: float, end: float) -> dict[str, float]:
        """Advance e and h from `start` to `end` [s]; returns what is exchanged [J]."""
        s, body, v = end - start, self.body, self.v
        mass, light = body.particles["mass"], body.light
        self._take_pairs()
        self.prepare(mass, s)
        # light by the collisions of the electrons, or like losses by the lattice's temperature
        light.shine(start, end)
        absorbed = light.absorb(v["T_l"] if self.collisions is None else v["nu"])
        lost, removed = self.exchange.evaluate(v["T_l"])
        power = self.exchange.power

        # electrons: T_e and what each particle takes; then what the lattice gains from them
        size, _ = self.find_S(light.deposit, s)
        self._solve(self.electrons, v["S"], v["C"], v["ones"], s, size)
        _, walls, size, from_faces = self.correct(light.deposit, power, mass, s)
        # lattice: its potential, and what each particle takes
        if self.lattice is not None:
            self._solve(self.lattice, v["taken"], v["D"], v["mask"], s, size)
            _, from_faces = self.settle(power, mass, s)
        lit = energies(light, absorbed)
        names = ("incident", "reflected", "transmitted", "absorbed")
        return {name: lit[name] for name in names} | {
            "lost": lost * s,
            "removed": removed * s,
            "walls": walls + from_faces,
        }

    def _take_pairs(self) -> None:
        """Use the pairs of particles that have moved since."""
        pairs = self.pairs
        if pairs.neighbors is not self.metal.neighbors:
            pairs.neighbors = self.metal.neighbors
            pairs.weights = self.backend.zeros(self.metal.weights.shape[0])

    @graph
    def prepare(self, mass: Array, s: float) -> None:
        """Exchange of each particle in `s` [s], and the matrix of the electrons."""
        backend, v, pairs = self.backend, self.v, self.pairs
        both = {"e": self.e, "h": self.h}
        out = tuple([v[name] for name in WORK[:6]])
        tables = self.tables | self.electron_tables | self.coupling
        backend.pointwise(
            terms.prepare_exchange, both | {"m": mass}, out, **tables, density=self.density, s=s
        )
        if self.collisions is not None:
            both_T = {"T_e": v["T_e"], "T_l": v["T_l"]}
            backend.pointwise(terms.collision_rate, both_T, v["nu"], **self.collisions)
        if not self.is_constant:
            backend.pointwise(
                terms.conductivity_with_scattering,
                both | {"T_e": v["T_e"], "T_l": v["T_l"]},
                v["k"],
                h_nodes=self.tables["h_nodes"],
                k_nodes=self.k_nodes,
                ratio=self.ratio,
            )
        # w_ij = g_ij (k_i + k_j)/2, their sums, and k A toward faces
        fields = {"g_ij": self.metal.weights, "k": v["k"]}
        backend.pair_values(terms.mean_weight, pairs.neighbors, fields, pairs.weights)
        fields = {"w_ij": pairs.weights, "a": self.metal.boundary_coefficient, "k": v["k"]}
        out = (pairs.total, pairs.boundary_coefficient)
        backend.pair_sum(
            terms.row_weight, pairs.neighbors, fields, out, finish=terms.scaled_boundary
        )

    @graph
    def find_S(self, deposit: Array, s: float) -> None:
        """S at the temperatures T; reduces |S| and the heat from faces [J].

        Args:
            deposit: (n,) light that each particle absorbs [J].
        """
        v = self.v
        fields = {"g_ij": self.pairs.weights, "P": v["T"], "T": v["T"], "E": deposit}
        fields |= {"a": v["a"], "k": v["k"], "wall": self.wall_heat}
        self.backend.pair_sum(
            flow,
            self.pairs.neighbors,
            fields,
            (v["S"], None, None),
            finish=terms.electron_energy_taken,
            reduce=(None, "sum", "sum"),
            s=s,
        )

    @graph
    def correct(self, deposit: Array, power: Array, mass: Array, s: float) -> None:
        """T_e with the solution added, and S there; energy of the electrons, and what the lattice
        takes at the potential before the part; reduces as `find_S`, then the sum of sizes of what
        is taken and the heat from faces [J].

        Args:
            power: (n,) lost by the surface [W]. mass: (n,) [kg].
        """
        v, backend, both = self.v, self.backend, {"e": self.e, "m": mass}
        backend.pointwise(terms.add, {"x": v["T"], "y": self.electrons.solution}, v["T"])
        self.find_S(deposit, s)
        # e, and the energy Q + r (1 - f) S that the lattice gains
        fields = both | {"S": v["S"], "Q": v["Q"], "share": v["share"]}
        backend.pointwise(terms.give, fields, (self.new_e, v["gained"]))
        # row of the lattice
        fields, out = both | {"h": self.h}, (v["D"], v["mask"], v["P"])
        backend.pointwise(terms.lattice_row, fields, out, **self.potential)
        self._find_taken(power, s)
        if self.lattice is None:
            self._accept(mass)

    @graph
    def settle(self, power: Array, mass: Array, s: float) -> None:
        """Potential of the lattice with the solution added, and energies with what it takes there;
        reduces the sum of sizes of that and the heat from faces [J]."""
        v, lattice = self.v, self.lattice
        assert lattice is not None
        self.backend.pointwise(terms.add, {"x": v["P"], "y": lattice.solution}, v["P"])
        self._find_taken(power, s)
        self._accept(mass)

    def _find_taken(self, power: Array, s: float) -> None:
        """Energy taken at the potentials P; reduces the sum of sizes and the heat from faces."""
        v, pairs = self.v, self.metal
        fields = {"g_ij": pairs.weights, "P": v["P"], "gained": v["gained"]}
        fields |= {"q": power, "a": pairs.boundary_coefficient, "b": self.lattice_wall}
        self.backend.pair_sum(
            flow,
            pairs.neighbors,
            fields,
            (v["taken"], None, None),
            finish=terms.lattice_energy_taken,
            reduce=(None, "sum", "sum"),
            s=s,
        )

    def _accept(self, mass: Array) -> None:
        """Set e and h to those after the part."""
        fields = {"h": self.h, "e": self.e, "new_e": self.new_e, "taken": self.v["taken"]}
        fields |= {"m": mass}
        self.backend.pointwise(terms.taken_energies, fields, (self.h, self.e))

    def _solve(
        self, solver: ConjugateGradient, b: Array, C: Array, mask: Array, s: float, size: float
    ) -> None:
        """Solve a matrix of the part for the energies b, whose sizes sum to `size`."""
        if size == 0.0:
            self.backend.fill(solver.solution, 0.0)
            return
        limits = {"residual": LINEAR * size, "max_iterations": MAX_LINEAR}
        self.linear += solver.solve(b, C, mask, s, **limits)
