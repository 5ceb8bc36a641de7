"""Heat that the surface loses in a step, by losses to the surroundings and by evaporation."""

from __future__ import annotations

from lasersph.compute.array_types import Array, Rows
from lasersph.physics.evaporation import vapor_constants
from lasersph.physics.losses import evaporation_loss, surface_loss
from lasersph.solvers.conduction.body import Body


def surface_power(T, area, T_a, h_c, eps):
    """Power lost by a surface particle [W] and its slope in T [W/K]."""
    loss, slope = surface_loss(T, T_a, h_c, eps)
    return area * loss, area * slope, area * loss


def evaporating_power(T, area, T_a, h_c, eps, p_b, T_b, L_b, T_c, R_s):
    """As `surface_power` with evaporation; also its power [W] and the mass flux [kg/(m^2 s)]."""
    loss, slope = surface_loss(T, T_a, h_c, eps)
    heat, heat_slope, mass = evaporation_loss(T, p_b, T_b, L_b, T_c, R_s)
    return area * (loss + heat), area * (slope + heat_slope), area * loss, area * heat, mass


class SurfaceExchange:
    """Losses of the particles at the surface, as power and slope in T.

    Attributes:
        rows: numbers of these particles. area: (n,) of the surface that each of them stands for
            [m^(d-1)].
        power: (n,) [W]. slope: (n,) d power/dT [W/K]. mass_flux: (n,) evaporating [kg/(m^2 s)].
        is_idle: no loss of any kind.
    """

    def __init__(self, body: Body, *, evaporates: bool) -> None:
        backend, count = body.backend, body.count
        self.body, self.evaporates = body, evaporates
        self.power, self.slope, self.mass_flux = (backend.zeros(count) for _ in range(3))
        self._lattice = backend.asarray(body.filling.surface, "index"), body.area
        self.rows, self.area = self._lattice
        self.is_idle = not evaporates and not body.ambient["h_c"] and not body.ambient["eps"]
        self.constants: dict[str, float] = dict(body.ambient)
        vapor = body.material.vaporization
        if evaporates and vapor is not None:
            self.constants |= vapor_constants(vapor)

    def rest(self) -> None:
        """Let the surface be that of the particles on their lattice, as at the start."""
        self.follow(*self._lattice)

    def follow(self, rows: Rows, area: Array) -> None:
        """Let the surface be that of the particles `rows`, with areas (n,) [m^(d-1)]."""
        backend, nothing = self.body.backend, self.body.backend.zeros(self.rows.shape[0])
        for quantity in (self.power, self.slope, self.mass_flux):
            backend.scatter(nothing, self.rows, quantity)
        self.rows, self.area = rows, area

    def evaluate(self, temperature: Array) -> tuple[float, float]:
        """Set power and slope; returns the power lost and the power removed by vapor [W]."""
        if self.is_idle:
            return 0.0, 0.0
        fields = {"T": temperature, "area": self.area}
        if not self.evaporates:
            function, out = surface_power, (self.power, self.slope, None)
            reduce = (None, None, "sum")
        else:
            function, out = evaporating_power, (self.power, self.slope, None, None, self.mass_flux)
            reduce = (None, None, "sum", "sum", None)
        lost, *removed = self.body.backend.pointwise(
            function, fields, out, rows=self.rows, reduce=reduce, **self.constants
        )
        return lost, sum(removed)
