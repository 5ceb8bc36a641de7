"""Speeds and temperatures of surfaces that recede, beside Landau's steady state."""

from __future__ import annotations

from typing import Any

import numpy as np

from lasersph.analytic.steady_recession import SteadyRecession
from lasersph.materials import Material, load_material
from lasersph.output import Run
from lasersph.physics import evaporation
from lasersph.validation.drawing import Curve, Panel, exact, marks
from lasersph.validation.study import Study


def compare(study: Study) -> None:
    """Judge each metal under each light."""
    times = np.linspace(0.0, study.plan.end, 23)
    speeds: list[Curve] = [exact(times, np.ones(times.size))]
    # Every metal under every light.
    for metal, fluxes in study.plan.light.items():
        for flux in fluxes:
            one, steady = lit(study, metal, flux)
            judge(study, one, steady, metal=metal, flux=flux)
            history = one.history
            # Speed between equal times, over that of the steady state.
            gone = np.interp(times * steady.time, history["time_s"], history["evaporated_max_m"])
            speed = np.diff(gone) / np.diff(times * steady.time)
            k, label = len(speeds) - 1, f"{metal.split('-')[0]} {flux:.0e} W/m²"
            speeds.append(marks(0.5 * (times[1:] + times[:-1]), speed / steady.speed, label, k))
    study.draw("moving-recession", Panel("t v²/D [1]", "speed / exact [1]", speeds))


def lit(study: Study, metal: str, flux: float) -> tuple[Run, SteadyRecession]:
    """A run of a metal under light [W/m^2], and its steady state."""
    plan = study.plan
    material = load_material(metal)
    # A conductivity that makes the thermal length a whole number of rows.
    steady, length = steady_state(material, flux, 1.0), 1e-9 * plan.length
    conductivity = length / steady.thermal_length
    steady, spacing = steady_state(material, flux, conductivity), length / plan.rows
    liquid = "surface_tension = '0.01 N/m', kinematic_viscosity = '1e-8 m^2/s'"
    one = study.run(
        f"{metal}-{flux:.0e}",
        f"material={{ base = '{metal}', conductivity = '{conductivity!r} W/(m K)', {liquid} }}",
        *plan.settings,
        f"laser.intensity={flux!r} W/m^2",
        f"particles.spacing={spacing!r} m",
        f"domain.width={plan.columns * spacing!r} m",
        f"domain.depth={plan.depth * length!r} m",
        f"time.end={plan.end * steady.time!r} s",
        f"time.step={steady.time / 40.0!r} s",
    )
    return one, steady


def steady_state(material: Material, flux: float, conductivity: float) -> SteadyRecession:
    """Landau's solution for a metal of constant properties that is cold at first."""
    melting = material.melting
    vaporization = material.vaporization
    cold = 298.15
    assert melting is not None and vaporization is not None
    # The flux of vapor at a temperature, as the solver has it.
    vapor = evaporation.vapor_constants(vaporization)
    heat = {name: vapor[name] for name in ("T_b", "L_b", "T_c")}

    def mass_flux(T: float) -> float:
        return evaporation.mass_flux(T, evaporation.saturation_pressure(T, **vapor), vapor["R_s"])

    return SteadyRecession(
        flux=flux,
        density=material.density_reference,
        heat_capacity=float(material.heat_capacity_at(cold)),
        conductivity=conductivity,
        melting=melting.latent_heat,
        melting_temperature=melting.liquidus,
        initial_temperature=cold,
        mass_flux=mass_flux,
        latent_heat=lambda T: evaporation.latent_heat(T, **heat),
        hottest=vapor["T_c"],
    )


def judge(study: Study, one: Run, steady: SteadyRecession, **words: Any) -> None:
    """Rows of a run: means over its last part, and the energy."""
    history = one.history
    time, gone, T = (history[name] for name in ("time_s", "evaporated_max_m", "temperature_max_K"))
    # Means over the last part, when the state is steady.
    first = int(np.searchsorted(time, study.plan.begin * steady.time))
    duration = time[-1] - time[first]
    study.add("speed", (gone[-1] - gone[first]) / duration, steady.speed, **words)
    mean = float(np.sum(np.diff(time[first:]) * T[first + 1 :])) / duration
    study.add("temperature", mean, steady.surface_temperature, **words)
    study.add("energy", float(np.max(history["energy_imbalance_relative"])), **words)
