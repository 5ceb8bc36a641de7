"""Builds the caloric curve: integrates c_p(T) and k(T) once and adds the latent heats.

    solid   h = int_{T_0}^{T} c_p dT
    melting T rises linearly in h from solidus to liquidus while f_m goes from 0 to 1: the sensible
            heat of the range (mean of both ends' c_p) plus L_f     [Demuth2020, eqs. (26), (28)]
    liquid  h goes on with the liquid's c_p
    boiling T stays at T_v while f_v goes from 0 to 1, and after it  [Demuth2020, eqs. (27), (28)];
            without a boiling point the liquid goes on

Each smooth piece is cut so that a straight line in h stays within TEMPERATURE_TOLERANCE of the
integral (in K, for T and for the potential), and more coarsely where that took more than
NODE_LIMIT nodes; pieces with constant c_p and k are exact without interior nodes.
Left out: heat of solid transformations, superheating.
Reference: [Demuth2020] Computation 8(1), 9.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from functools import lru_cache
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lasersph.materials.caloric_curve import CaloricCurve
from lasersph.materials.property import Law, Property
from lasersph.materials.sections import Melting, Vaporization

TEMPERATURE_TOLERANCE = 1e-3
"""Wanted distance between polyline and integral [K]."""
NODE_LIMIT = 480
"""Cuts of all smooth pieces together, so that a curve stays below 512 nodes."""

KEPT_CURVES = 32
"""Curves that a process keeps. Format: those of some cases, each read, forecast and run; each is
some kB."""

Array = NDArray[np.float64]
Function = Callable[[Array], Array]
_POINTS, _WEIGHTS = np.polynomial.legendre.leggauss(6)


class Piece:
    """A stretch of temperature with smooth c_p(T) and k(T), in one phase or in the mush."""

    def __init__(
        self,
        lower: float,
        upper: float,
        heat_capacity: Function,
        conductivity: Function,
        melt_fraction: float,
    ) -> None:
        self.lower, self.upper = lower, upper
        self.heat_capacity, self.conductivity = heat_capacity, conductivity
        self.melt_fraction = melt_fraction
        # a segment of the width dT misses the curve by about bend dT^2 / 8 [K]
        samples = np.linspace(lower, upper, 65)
        if upper == lower:
            self._samples, self._count = samples, np.zeros_like(samples)
            return
        c, k = heat_capacity(samples), conductivity(samples)
        bend = np.abs(np.gradient(c, samples)) / c + np.abs(np.gradient(k, samples)) / k
        flat = float(np.ptp(c)) == 0.0 and float(np.ptp(k)) == 0.0
        density = np.zeros_like(samples) if flat else np.sqrt(bend / 8.0)
        # integral of the density of cuts up to each sample
        steps = 0.5 * (density[1:] + density[:-1]) * np.diff(samples)
        self._samples, self._count = samples, np.concatenate(([0.0], np.cumsum(steps)))

    def demand(self) -> float:
        """Number of cuts times the root of the tolerance [K^0.5]."""
        return float(self._count[-1])

    def nodes(self, tolerance: float) -> Array:
        """Temperatures [K] that cut the piece, ends included."""
        # cuts at equal parts of that integral: short segments where the curve bends
        cuts = max(1, int(np.ceil(self.demand() / np.sqrt(tolerance))))
        inner = np.interp(
            np.linspace(0.0, self.demand(), cuts + 1)[1:-1], self._count, self._samples
        )
        return np.concatenate(([self.lower], inner, [self.upper]))


def integral(function: Function, temperatures: Array) -> Array:
    """Integrals of function over each interval of temperatures; six Gauss points each."""
    half = 0.5 * np.diff(temperatures)
    middle = 0.5 * (temperatures[1:] + temperatures[:-1])
    points = middle[:, None] + half[:, None] * _POINTS[None, :]
    return half * (function(points) @ _WEIGHTS)


class CurveBuilder:
    """Collects nodes from T_0 upward; every method continues where the last one ended."""

    def __init__(self, initial_temperature: float, pieces: list[Piece]) -> None:
        # tolerance for which all pieces together take NODE_LIMIT cuts, if that is the larger one
        needed = sum(piece.demand() for piece in pieces)
        self.tolerance = max(TEMPERATURE_TOLERANCE, (needed / NODE_LIMIT) ** 2)
        self.rows: list[Array] = [np.array([[0.0, initial_temperature, 0.0, 0.0, 0.0]])]
        self.error = 0.0

    def enthalpy_at_temperature(self, temperature: float) -> float:
        """Enthalpy [J/kg] at a temperature [K] that the last phase has reached."""
        nodes = np.concatenate(self.rows)
        return float(np.interp(temperature, nodes[:, 1], nodes[:, 0]))

    def sensible(self, piece: Piece) -> None:
        """Add a piece with heat h = int c_p dT and constant phase."""
        T = piece.nodes(self.tolerance)
        heat = integral(piece.heat_capacity, T)
        flow = integral(piece.conductivity, T)
        self._measure(piece, T, heat, flow)
        self._append(T, heat, flow, np.full(T.size - 1, piece.melt_fraction))

    def melting(self, piece: Piece, heat_capacity: float, latent_heat: float) -> None:
        """Add the melting range (T linear in h) or, with lower == upper, the melting point.

        heat_capacity is the mean over the range [J/(kg K)].
        """
        width = piece.upper - piece.lower
        if width == 0.0:
            T = np.array([piece.lower, piece.upper])
            self._append(T, np.array([latent_heat]), np.zeros(1), np.ones(1))
            return
        T = piece.nodes(self.tolerance)
        # sensible and latent heat, both linear in T over the range
        heat = (heat_capacity * width + latent_heat) * np.diff(T) / width
        flow = integral(piece.conductivity, T)
        self._measure(piece, T, np.diff(T), flow)
        self._append(T, heat, flow, (T[1:] - piece.lower) / width)

    def boiling(self, latent_heat: float) -> None:
        """Add the plateau at T_v and a last flat segment, so that T stays there for any h."""
        # up to full vaporization, and once more as much for enthalpies beyond
        h, T, P, melt, _ = self.rows[-1][-1]
        for vapor, heat in ((1.0, latent_heat), (1.0, 2.0 * latent_heat)):
            self.rows.append(np.array([[h + heat, T, P, melt, vapor]]))

    def _append(self, T: Array, heat: Array, flow: Array, melt: Array) -> None:
        # continue from the last node
        h, _, P, _, vapor = self.rows[-1][-1]
        columns = (h + np.cumsum(heat), T[1:], P + np.cumsum(flow), melt, np.full(melt.size, vapor))
        self.rows.append(np.column_stack(columns))

    def _measure(self, piece: Piece, T: Array, heat: Array, flow: Array) -> None:
        """Distance of the polyline from the integrals at the middle of every segment [K]."""
        middle = 0.5 * (T[1:] + T[:-1])
        # heat and potential up to the middle of every segment
        halves = np.column_stack((T[:-1], middle)).ravel()
        halves = np.append(halves, T[-1])
        first_heat = integral(piece.heat_capacity, halves)[::2]
        first_flow = integral(piece.conductivity, halves)[::2]
        # temperature that the polyline gives at the enthalpy of the middle
        line = T[:-1] + first_heat / heat * np.diff(T)
        off = np.abs(line - middle)
        flow_off = np.abs(first_heat / heat * flow - first_flow) / piece.conductivity(middle)
        self.error = max(self.error, float(off.max()), float(flow_off.max()))

    def curve(self, **facts: float | str | tuple[float, float] | None) -> CaloricCurve:
        """The curve of all nodes; facts are the remaining fields of CaloricCurve."""
        h, T, P, melt, vapor = np.ascontiguousarray(np.concatenate(self.rows).T)
        return CaloricCurve(
            enthalpy=h.copy(),
            temperature=T.copy(),
            potential=P.copy(),
            melt_fraction=melt.copy(),
            vapor_fraction=vapor.copy(),
            temperature_error=self.error,
            **facts,  # pyright: ignore[reportArgumentType]
        )


@dataclass(frozen=True)
class _Asked:
    """Parts of a metal that a curve is made from, told apart by their numbers as text."""

    numbers: tuple[str | None, ...]
    initial_temperature: float
    plateau: str
    name: str
    heat_capacity: Property[Any] = field(compare=False)
    conductivity: Property[Any] = field(compare=False)
    melting: Melting | None = field(compare=False)
    vaporization: Vaporization | None = field(compare=False)


def build_curve(
    *,
    heat_capacity: Property[Any],
    conductivity: Property[Any],
    melting: Melting | None,
    vaporization: Vaporization | None,
    initial_temperature: float,
    plateau: str,
    name: str,
) -> CaloricCurve:
    """The caloric curve of a material, made once in a process; see `Material.caloric_curve` for
    arguments and errors."""
    parts = heat_capacity, conductivity, melting, vaporization
    numbers = tuple(None if part is None else part.model_dump_json() for part in parts)
    return _built(_Asked(numbers, float(initial_temperature), plateau, name, *parts))


@lru_cache(maxsize=KEPT_CURVES)
def _built(asked: _Asked) -> CaloricCurve:
    """See `build_curve`."""
    melting, vaporization = asked.melting, asked.vaporization
    initial_temperature, plateau = asked.initial_temperature, asked.plateau
    holds = plateau in ("hold", "clip") and vaporization is not None
    _refuse(asked, boiling=vaporization.temperature if vaporization and holds else None)

    # pieces of the solid, of the melting range, of the liquid
    c, k = asked.heat_capacity, asked.conductivity
    end = _end_of_curve(c, k, initial_temperature, melting, vaporization, holds)
    solid_end = melting.solidus if melting else end
    solid = _sensible(c.solid_law, k.solid_law, initial_temperature, solid_end, 0.0)
    mush = _mush(k, melting) if melting else None
    liquid = _sensible(c.liquid_law, k.liquid_law, melting.liquidus, end, 1.0) if melting else []

    # nodes from T_0 upward, phase by phase
    builder = CurveBuilder(initial_temperature, [*solid, *([mush] if mush else []), *liquid])
    for piece in solid:
        builder.sensible(piece)
    if mush is not None and melting is not None:
        ends = (c.solid_law.at(melting.solidus), c.liquid_law.at(melting.liquidus))
        builder.melting(mush, 0.5 * float(ends[0] + ends[1]), melting.latent_heat)
    for piece in liquid:
        builder.sensible(piece)

    # boiling begins there, whether or not the curve holds it
    start = builder.enthalpy_at_temperature(vaporization.temperature) if vaporization else None
    if holds and vaporization is not None:
        builder.boiling(vaporization.latent_heat)
    return builder.curve(
        initial_temperature=initial_temperature,
        plateau=plateau,
        solidus=melting.solidus if melting else None,
        liquidus=melting.liquidus if melting else None,
        vaporization=vaporization.temperature if vaporization else None,
        enthalpy_vaporizing=start,
        enthalpy_vaporized=start + vaporization.latent_heat if start and vaporization else None,
        latent_heats=(
            melting.latent_heat if melting else 0.0,
            vaporization.latent_heat if holds and vaporization else 0.0,
        ),
    )


def _refuse(asked: _Asked, boiling: float | None) -> None:
    """Raise ValueError for a plateau that is none, and for a curve that would begin at or above its
    first phase change, melting or boiling [K]."""
    start, melting = asked.initial_temperature, asked.melting
    if asked.plateau not in ("hold", "clip", "evaporate"):
        raise ValueError(f'plateau must be "hold", "clip" or "evaporate", got {asked.plateau!r}')
    if start <= 0.0:
        raise ValueError(f"the initial temperature must be positive, got {start} K")
    top = melting.solidus if melting else boiling
    if top is not None and start >= top:
        raise ValueError(
            f"the initial temperature {start:g} K is not below {top:g} K, "
            f"where {'melting' if melting else 'boiling'} of {asked.name!r} begins"
        )


def _end_of_curve(
    c: Property[Any],
    k: Property[Any],
    initial_temperature: float,
    melting: Melting | None,
    vaporization: Vaporization | None,
    holds: bool,
) -> float:
    """Temperature of the last node [K]: T_v, or where c_p and k do not change any more."""
    if holds and vaporization is not None:
        return vaporization.temperature
    laws = (c.liquid_law, k.liquid_law) if melting else (c.solid_law, k.solid_law)
    # where the laws end; formulas without an end go on to 2e4 K
    uppers = [law.upper for law in laws if not law.is_constant and np.isfinite(law.upper)]
    open_ended = any(not law.is_constant and not np.isfinite(law.upper) for law in laws)
    floors = [initial_temperature + 1.0, *uppers, 2.0e4 if open_ended else 0.0]
    floors += [melting.liquidus] if melting else []
    floors += [vaporization.temperature] if vaporization else []
    return max(floors) + 1.0


def _sensible(c: Law[Any], k: Law[Any], lower: float, upper: float, melt: float) -> list[Piece]:
    """Pieces of one phase, cut at the kinks of its laws."""
    kinks = set(c.breakpoints(lower, upper)) | set(k.breakpoints(lower, upper))
    ends = [lower, *sorted(kinks), upper]
    return [Piece(a, b, c.at, k.at, melt) for a, b in pairwise(ends)]


def _mush(k: Property[Any], melting: Melting) -> Piece:
    """The melting range: T linear in h, k linear in T from the solid's to the liquid's."""
    low, high = melting.solidus, melting.liquidus
    return Piece(low, high, np.ones_like, lambda T: k.at(T, low, high), 1.0)
