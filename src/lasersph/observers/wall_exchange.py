"""Heat and force that the walls of a closed box exchange with its liquid, as the steps book them.

With the heat Q that has entered through a side since the start, its area A per length (of the
whole box where half is computed), and the
distance L and the temperatures of the two opposite sides that drive the flow,

    Nu = |dQ/dt| / A  L / (k |T_side - T_opposite|)

and the domain-averaged Nusselt number is the mean over the volume of conduction and convection from
the warm side to the cold one, n their direction,

    Nu = 1 + rho <u_n (h - <h>)> L / (k |T_side - T_opposite|)

At a steady state all three are equal. The sides that drive the flow are those that both have a
given temperature, else those that heat crosses both; of two such pairs, those that differ most.
Without such sides there is no Nusselt number. The force with which the liquid presses on a wall is
that of the dynamic pressure, whose mean in a closed box is 0, and of the viscous stress across the
wall. The history has the means of each step, the summary
those of the last quarter of the time, so that no single particle moves them.
"""

from __future__ import annotations

from collections.abc import Mapping
from math import prod

import numpy as np

from lasersph.input.key_units import suffix
from lasersph.observers.box_sections import Box, wall_temperature
from lasersph.observers.flow_speed import flow_of
from lasersph.observers.flow_view import side_images
from lasersph.observers.observer import Observer, Row
from lasersph.observers.quantity import Quantity
from lasersph.observers.view import View
from lasersph.particles.faces import AXES, ENDS, PLANE, face_pairs

EVERY = 50
"""Steps between two looks at temperatures of sides that are not given, and two marks."""
NODES = 41
"""Places along a side at which its temperature is extrapolated."""
SMALLEST_DIFFERENCE = 1e-9
"""Part of the temperature below which differences between sides are rounding."""
LAST = 0.25
"""Share of the time over which the summary takes means."""
MEAN = "mean"
SIDES = tuple(ENDS)
"""Of a block; a section has those of `PLANE`."""
DRAG, PRESSING = "drag of the wall on the liquid", "force of the liquid onto the wall"
SECTION_FORCES = {
    f"{force}_{side}": f"{words}, {side}"
    for force, words in (("drag", DRAG), ("pressing", PRESSING))
    for side in PLANE
}
"""Forces of a section by the ends of their keys [N/m]."""
BLOCK_FORCES = {
    f"drag_{side}_{axis}": f"{DRAG} along {axis}, {side}"
    for side in SIDES
    for axis in AXES
    if AXES.index(axis) != ENDS[side][0] % 3
} | {f"pressing_{side}": f"{PRESSING}, {side}" for side in SIDES}
"""Forces of a block likewise [N]."""


class WallExchange(Observer):
    """Observes heat through the walls of a box, its Nusselt numbers, and forces at the walls."""

    title = "walls of the box, mean over the last quarter of the time"
    note = (
        "Heat and force as the implicit steps exchange them with each side; the domain-averaged"
        " Nusselt number is the volume mean of conduction and convection, 1 + <u T>. Of half a box,"
        " heat through bottom and surface is that of the whole, forces are those of the half."
    )
    columns = (
        *(Quantity(f"box_heat_{side}_J", "J", f"heat that has entered, {side}") for side in SIDES),
        *(Quantity(f"box_nusselt_{side}", "", f"Nusselt number, {side}") for side in SIDES),
        Quantity(f"box_nusselt_{MEAN}", "", "domain-averaged Nusselt number"),
        *(Quantity(f"box_{name}_N_m", "N/m", words) for name, words in SECTION_FORCES.items()),
        *(Quantity(f"box_{name}_N", "N", words) for name, words in BLOCK_FORCES.items()),
    )
    results = (
        *(
            one
            for side in SIDES
            for one in (
                Quantity(f"box.heat.temperature_{side}_K", "K", f"mean temperature, {side}"),
                Quantity(
                    f"box.heat.flux_{side}_W_m2", "W/m^2", f"mean heat flux into the box, {side}"
                ),
                Quantity(f"box.heat.nusselt_{side}", "", f"Nusselt number, {side}"),
            )
        ),
        *(
            Quantity(f"box.walls.{name}_N_m", "N/m", words)
            for name, words in SECTION_FORCES.items()
        ),
        *(Quantity(f"box.walls.{name}_N", "N", words) for name, words in BLOCK_FORCES.items()),
        Quantity(f"box.heat.nusselt_{MEAN}", "", "domain-averaged Nusselt number"),
        Quantity("box.heat.between", "", "sides that drive the flow"),
        Quantity("box.heat.difference_K", "K", "difference of their temperatures"),
        Quantity("box.walls.from_s", "s", "begin of the time over which these are means"),
    )
    kept = (
        "size",
        "images",
        "conductivity",
        "temperature",
        "between",
        "sums",
        "marks",
        "known_forces",
    )

    def __init__(self, dimension: int = 2) -> None:
        """
        Args:
            dimension: 2 or 3; a block has six sides, and drag in two directions along each.
        """
        self.sides = SIDES if dimension == 3 else PLANE
        self.forces = tuple(BLOCK_FORCES if dimension == 3 else SECTION_FORCES)
        self.unit_of_force = suffix("N" if dimension == 3 else "N/m")
        # of the columns of all boxes, those that this one has
        measured = {f"box_{force}{self.unit_of_force}" for force in self.forces}
        measured |= {f"box_nusselt_{MEAN}"}
        for side in self.sides:
            measured |= {f"box_heat_{side}_J", f"box_nusselt_{side}"}
        self.columns = tuple(one for one in self.columns if one.key in measured)
        super().__init__()
        self.size = [0.0, 0.0]
        self.images = 1
        self.conductivity = 0.0
        self.temperature: dict[str, float] = {}
        self.between: list[str] = []
        self.known_forces: list[str] = []
        self.sums = {"time": 0.0, MEAN: 0.0} | {
            name: 0.0 for name in (*(f"heat_{side}" for side in self.sides), *self.forces)
        }
        self.marks: list[dict[str, float]] = []

    def observe(self, view: View) -> Row:
        """Heat [J], Nusselt numbers and forces [N/m], in 3-D [N], of the step; 0 where there are
        none."""
        flow, before = flow_of(view), self.sums
        # sides are extrapolated from particles, which takes longer than a step
        if view.step % EVERY == 0:
            self._look_at_sides(view)
        mean = self._averaged(view)

        # sums since the start; their differences are means over any span of time
        self.sums = {"time": view.time, MEAN: before[MEAN] + view.time_step * mean}
        self.sums |= {f"heat_{side}": flow.wall_heat.get(side, 0.0) for side in self.sides}
        booked = {f"drag_{name}": value for name, value in flow.wall_impulse.items()}
        booked |= {f"pressing_{side}": value for side, value in flow.wall_pressing.items()}
        self.sums |= {force: booked.get(force, 0.0) for force in self.forces}
        # below a surface that moves, and between mirrors, no force onto a face is known
        known = ("drag", "pressing") if flow.wall_pressing else ("drag",)
        self.known_forces = [force for force in self.forces if force.startswith(known)]
        # marks of the sums, for the mean over the last quarter
        if view.step % EVERY == 0:
            self.marks.append(self.sums)
        rate = rates(before, self.sums)
        numbers = self._nusselt(rate)
        values = (
            *(self.sums[f"heat_{side}"] for side in self.sides),
            *(numbers.get(side, 0.0) for side in self.sides),
            mean,
            *(rate[force] for force in self.forces),
        )
        return self.record(view.time, values)

    def values(self) -> dict[str, object]:
        """Means over the last quarter of the time."""
        # latest mark before the last quarter
        start = max(
            (one for one in self.marks if one["time"] <= (1.0 - LAST) * self.sums["time"]),
            key=lambda one: one["time"],
            default=self.sums,
        )
        rate = rates(start, self.sums)
        found: dict[str, object] = {"box.walls.from_s": start["time"]}
        for force in self.known_forces:
            found[f"box.walls.{force}{self.unit_of_force}"] = rate[force]
        # temperatures and fluxes of the sides, Nusselt numbers of those that drive the flow
        for side, temperature in self.temperature.items():
            found[f"box.heat.temperature_{side}_K"] = temperature
            found[f"box.heat.flux_{side}_W_m2"] = rate[f"heat_{side}"] / self._area(side)
        if self.between:
            found["box.heat.between"] = " and ".join(self.between)
            found["box.heat.difference_K"] = self._difference(*self.between)
            numbers = self._nusselt(rate)
            if numbers and self.sums["time"] > start["time"]:
                numbers |= {MEAN: rate[MEAN]}
                found |= {f"box.heat.nusselt_{name}": number for name, number in numbers.items()}
        return found

    def _look_at_sides(self, view: View) -> None:
        """Size of the box, temperatures of its sides, and which two of them drive the flow."""
        flow = flow_of(view)
        self.conductivity, self.images = flow.conductivity, view.mirror_images
        # bounds once: walls stay where they are
        if not any(self.size):
            box = Box.around(view.position, view.width)
            self.size = box.edges
        box = Box(*self.size)
        # one temperature everywhere: no side drives a flow
        known = np.append(view.temperature, list(flow.wall_temperature.values()))
        if float(np.ptp(known)) <= SMALLEST_DIFFERENCE * float(np.max(known)):
            self.temperature, self.between = {}, []
            return

        # given temperatures, else those that particles have at the side
        self.temperature = {
            side: flow.wall_temperature[side]
            if side in flow.wall_temperature
            else wall_temperature(view.position, view.temperature, box, side, NODES)
            for side in self.sides
        }

        # pairs of sides of given temperatures first, else pairs that let heat through
        given, crossed = (
            [pair for pair in face_pairs(view.dimension) if all(side in sides for side in pair)]
            for sides in (flow.wall_temperature, flow.conducting_sides)
        )
        # the pair that differs most drives the flow
        differences = {pair: self._difference(*pair) for pair in given or crossed}
        self.between = list(max(differences, key=lambda one: differences[one], default=()))

    def _difference(self, one: str, other: str) -> float:
        """Difference of the temperatures of two sides [K], 0 where it is rounding."""
        T = self.temperature[one], self.temperature[other]
        return abs(T[0] - T[1]) if abs(T[0] - T[1]) > SMALLEST_DIFFERENCE * max(T) else 0.0

    def _conduction(self) -> float:
        """k |T_side - T_opposite| / L between the sides that drive the flow [W/m^2], or 0."""
        if not self.between:
            return 0.0
        box = Box(*self.size)
        # k dT/L between the sides that drive the flow, across the box between them
        length = (box.width, box.breadth, box.height)[ENDS[self.between[0]][0]]
        return self.conductivity * self._difference(*self.between) / length

    def _nusselt(self, rate: Mapping[str, float]) -> dict[str, float]:
        """Nusselt numbers of these sides from the heat that enters through them [W/m]."""
        conduction = self._conduction()
        sides = self.between if conduction > 0.0 else ()
        return {s: abs(rate[f"heat_{s}"]) / self._area(s) / conduction for s in sides}

    def _averaged(self, view: View) -> float:
        """Domain-averaged Nusselt number of a state; 0 where nothing drives the flow."""
        flow, conduction = flow_of(view), self._conduction()
        if conduction == 0.0:
            return 0.0

        # 1 + <u T>, of enthalpies so that melting counts
        axis = ENDS[self.between[0]][0]
        lower, upper = (self.temperature[side] for side in self.between)
        weight = view.volume / np.sum(view.volume)
        h = view.enthalpy - weight @ view.enthalpy
        convection = flow.density * float(weight @ (flow.velocity[axis] * h))
        return 1.0 + (convection if lower > upper else -convection) / conduction

    def _area(self, side: str) -> float:
        """Length of a side [m], in 3-D its area [m^2], of the whole box where half is computed."""
        box = Box(*self.size)
        edges = [box.width, box.breadth or 1.0, box.height]
        # the edges along the other axes
        edges[ENDS[side][0]] = 1.0
        return side_images(side, self.images) * prod(edges)


def rates(start: Mapping[str, float], end: Mapping[str, float]) -> dict[str, float]:
    """Mean rates of sums between two times; 0 between equal ones."""
    time = end["time"] - start["time"]
    return {name: (end[name] - start[name]) / time if time > 0.0 else 0.0 for name in end}
