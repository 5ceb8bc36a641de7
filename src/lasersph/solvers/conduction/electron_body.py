"""A body at rest with two temperatures: electrons, and the lattice that holds the rest.

`enthalpy` is that of both, so that it stays as it is where a run goes on with one temperature, or
comes back to two; `electron_energy` is the part of the electrons. Temperature, potential and the
fractions are those of the lattice.
"""

from __future__ import annotations

from dataclasses import dataclass, field, fields

from lasersph.compute.array_types import Array
from lasersph.materials.electron_tables import ElectronTables, electron_tables
from lasersph.physics.two_temperature import equal_state, two_states
from lasersph.solvers.conduction.body import DERIVED, Body
from lasersph.solvers.conduction.state import HeatState

ELECTRONS = ("electron_energy", "electron_temperature")


@dataclass
class ElectronState(HeatState):
    """Numbers that survive a step.

    Attributes:
        has_two: 1 where the last step had two temperatures, else 0. difference: largest
            |T_e - T_l| / T_l after it. allowed_step: length of the next one by the error of the
            last [s], 0 where nothing is known of it.
    """

    has_two: float = 0.0
    difference: float = 0.0
    allowed_step: float = 0.0

    def begin_again(self, time: float) -> None:
        """Go on from `time` [s] as from the start of a run, with one temperature."""
        super().begin_again(time)
        self.has_two = self.difference = self.allowed_step = 0.0


@dataclass(frozen=True)
class ElectronBody(Body):
    """The particles of a run with two temperatures.

    Attributes:
        state: says how many temperatures there are. nodes: host tables. electron_tables: of
            C_e(T_e). lattice_tables: of the lattice's curve.
    """

    state: ElectronState = field(default_factory=ElectronState)
    nodes: ElectronTables | None = None
    electron_tables: dict[str, Array] = field(default_factory=dict)
    lattice_tables: dict[str, Array] = field(default_factory=dict)

    def update_temperature(self) -> None:
        """Set temperatures, potential and fractions from the energies."""
        particles, backend = self.particles, self.backend
        e, T_e = (particles[name] for name in ELECTRONS)
        if not self.state.has_two:
            super().update_temperature()
            given = {"T": particles["temperature"]}
            backend.pointwise(equal_state, given, (e, T_e), **self.electron_tables)
            return
        self.update_both()

    def update_both(self) -> None:
        """Set both temperatures, the lattice's potential and fractions, from both energies."""
        particles, backend = self.particles, self.backend
        e, T_e = (particles[name] for name in ELECTRONS)
        # T, P, f_m, f_v of the lattice and T_e
        out = (*(particles[name] for name in DERIVED), T_e)
        order = (out[0], out[1], out[2], out[3], out[4])
        given = {"e": e, "h": particles["enthalpy"]}
        tables = self.electron_tables | self.lattice_tables
        backend.pointwise(two_states, given, order, **tables)


def with_electrons(body: Body) -> ElectronBody:
    """The same body, its particles with electrons as warm as the lattice.

    Raises:
        ValueError: the metal has no electrons.
    """
    nodes, backend = electron_tables(body.material, body.curve), body.backend
    body.particles.add(*ELECTRONS)
    electrons = {"e_nodes": nodes.energy, "Te_nodes": nodes.temperature, "C_nodes": nodes.capacity}
    lattice = {
        "h_nodes": nodes.enthalpy,
        "T_nodes": nodes.lattice_temperature,
        "P_nodes": nodes.potential,
        "m_nodes": nodes.melt_fraction,
        "v_nodes": nodes.vapor_fraction,
    }
    found = ElectronBody(
        **{one.name: getattr(body, one.name) for one in fields(Body)},
        nodes=nodes,
        electron_tables={name: backend.asarray(values) for name, values in electrons.items()},
        lattice_tables={name: backend.asarray(values) for name, values in lattice.items()},
    )
    found.update_temperature()
    return found
