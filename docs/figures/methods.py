"""Figures of the pages on methods that need no run: what the formulas give, by the code itself."""

from itertools import pairwise
from pathlib import Path

import numpy as np

from figures.stored import StoredFigure, store_figure
from lasersph.analytic.half_space import pulse_train_temperature
from lasersph.analytic.stefan import Melting, PhaseProperties
from lasersph.lasers import Laser
from lasersph.materials import Material, load_material
from lasersph.physics.dimensionless import thermal_diffusion_length
from lasersph.physics.evaporation import (
    latent_heat,
    mass_flux,
    saturation_pressure,
    vapor_constants,
)
from lasersph.physics.recoil import recoil_pressure
from lasersph.validation.drawing import Panel, draw, line

METALS = ("aluminium", "copper", "steel-304", "titanium", "tungsten")


def draw_heating(target: Path) -> None:
    """The fluence over the surface of three beams, and the power of three pulses."""
    x = np.linspace(-7.5e-6, 7.5e-6, 601)
    beams: dict[str, dict[str, object]] = {
        "interference, 5 µm": {"kind": "interference", "period": "5 um"},
        "Gaussian, 4 µm": {"kind": "gaussian", "radius_1e2": "4 um"},
        "top-hat, 4 µm": {"kind": "top-hat", "radius": "4 um"},
    }
    pulses = {
        "Gaussian": {"kind": "gaussian", "fwhm": "10 ns", "center": "25 ns"},
        "square": {"kind": "square", "duration": "10 ns"},
        "train": {"kind": "square", "duration": "5 ns", "count": 3, "period": "20 ns"},
    }
    half = 0.5 * (x[1] - x[0])
    over_place = []
    for k, (name, beam) in enumerate(beams.items()):
        laser = _laser(beam, pulses["square"])
        sides = ((x - half)[None, :], (x + half)[None, :])
        fluence = laser.energy_density(*sides, 0.0, 1e-7)
        over_place.append(line(x * 1e6, fluence / 1e4, name, k))
    over_time = []
    t = np.linspace(0.0, 60e-9, 601)
    for k, (name, pulse) in enumerate(pulses.items()):
        laser, point = _laser({"kind": "uniform"}, pulse), np.zeros((1, 1))
        steps = pairwise(t)
        energy = [laser.energy_density(point, point + 1e-9, a, b)[0] for a, b in steps]
        over_time.append(
            line(0.5e9 * (t[1:] + t[:-1]), np.array(energy) / np.diff(t) / 1e13, name, k)
        )
    panels = (
        Panel("x [µm]", "fluence [J/cm²]", over_place, low=0.0, high=1.55),
        Panel("time [ns]", "intensity [GW/cm²]", over_time, low=0.0, high=0.31),
    )
    store_figure(draw(panels, height=3.0), target)


def _laser(beam: dict[str, object], pulse: dict[str, object]) -> Laser:
    """A laser with 1 J/cm2 at the maximum of its beam."""
    return Laser.model_validate(
        {
            "fluence": "1 J/cm^2",
            "fluence_kind": "peak",
            "beam": beam,
            "pulse": pulse,
            "absorption": {"kind": "surface"},
            "reflectivity": 0.0,
        }
    )


def draw_phase_change(target: Path) -> None:
    """Temperature and melt fraction over the enthalpy of three metals."""
    over_h, melted = [], []
    for k, name in enumerate(("aluminium", "steel-304", "titanium")):
        curve = load_material(name).caloric_curve(298.15)
        h = np.linspace(0.0, 3.5e6, 1400)
        over_h.append(line(h / 1e6, curve.temperature_at(h), name, k))
        zoom = h[h < 1.6e6]
        melted.append(line(zoom / 1e6, curve.melt_fraction_at(zoom), name, k))
    panels = (
        Panel("enthalpy [MJ/kg]", "temperature [K]", over_h, low=0.0),
        Panel("enthalpy [MJ/kg]", "melt fraction [1]", melted),
    )
    store_figure(draw(panels, height=3.0), target)


def draw_evaporation(target: Path) -> None:
    """Recoil pressure, mass flux and heat loss over temperature."""
    recoil, flux, heat = [], [], []
    for k, name in enumerate(METALS):
        metal = load_material(name).vaporization
        assert metal is not None
        c = vapor_constants(metal)
        T = np.linspace(0.6 * c["T_b"], min(1.5 * c["T_b"], c["T_c"]), 150)
        p = np.array([saturation_pressure(one, **c) for one in T])
        m = np.array([mass_flux(a, b, c["R_s"]) for a, b in zip(T, p, strict=True)])
        L_v = np.array([latent_heat(one, c["T_b"], c["L_b"], c["T_c"]) for one in T])
        recoil.append(line(T, recoil_pressure(p), name, k))
        flux.append(line(T, m, name, k))
        heat.append(line(T, L_v * m / 1e13, name, k))
    log = ("linear", "log")
    panels = (
        Panel("temperature [K]", "recoil into vacuum [Pa]", recoil, scales=log),
        Panel("temperature [K]", "mass flux [kg/(m²s)]", flux, scales=log),
        Panel("temperature [K]", "heat loss [GW/cm²]", heat, scales=log),
    )
    store_figure(draw(panels, height=3.2, legend=5), target)


def draw_lengths(target: Path) -> None:
    """How far heat diffuses during a pulse."""
    tau = np.geomspace(1e-12, 1e-6, 60)
    curves = []
    for k, name in enumerate(METALS):
        a = load_material(name).diffusivity_reference
        length = [thermal_diffusion_length(a, one) * 1e9 for one in tau]
        curves.append(line(tau * 1e9, length, name, k))
    panel = Panel("pulse duration [ns]", r"$L=2\sqrt{a\tau_p}$ [nm]", curves, scales=("log", "log"))
    store_figure(draw((panel,), height=3.2), target)


def draw_exact(target: Path) -> None:
    """A train of pulses on a half-space, and melting from a hot surface."""
    t = np.linspace(1e-9, 400e-9, 800)
    train = {
        "flux": 8.75e10, "conductivity": 167.0, "diffusivity": 6.89e-5, "pulse_duration": 20e-9,
        "off_time": 80e-9, "count": 4, "initial_temperature": 300.0,
    }  # fmt: skip
    pulses = [
        line(t * 1e9, pulse_train_temperature(z, t, **train), f"{z * 1e6:g} µm deep", k)
        for k, z in enumerate((0.0, 2e-6, 5e-6))
    ]
    metal: Material = load_material("aluminium-aa6014")
    T_m = metal.solidus
    assert T_m is not None
    phase = PhaseProperties(float(metal.conductivity_at(T_m)), float(metal.heat_capacity_at(T_m)))
    melting = Melting(T_m + 400.0, T_m, 300.0, 397e3, metal.density_reference, phase)
    z = np.linspace(0.0, 20e-6, 300)
    fronts = [
        line(z * 1e6, melting.temperature(z, time), f"{time * 1e6:g} µs", k)
        for k, time in enumerate((0.25e-6, 1e-6, 2e-6))
    ]
    panels = (
        Panel("time [ns]", "temperature [K]", pulses, high=1900.0, title="four pulses on aluminum"),
        Panel("depth [µm]", "temperature [K]", fronts, title="melting from a hot surface",
              level=(T_m, "$T_m$")),
    )  # fmt: skip
    store_figure(draw(panels, height=3.2), target)


METHODS = (
    StoredFigure(
        "methods-heating",
        draw_heating,
        ("docs/figures/methods.py", "lasersph.lasers.laser"),
    ),
    StoredFigure(
        "methods-phase-change",
        draw_phase_change,
        ("docs/figures/methods.py", "lasersph.materials.caloric_curve"),
    ),
    StoredFigure(
        "methods-evaporation",
        draw_evaporation,
        ("docs/figures/methods.py", "lasersph.physics.evaporation"),
    ),
    StoredFigure(
        "methods-lengths",
        draw_lengths,
        ("docs/figures/methods.py", "lasersph.physics.dimensionless"),
    ),
    StoredFigure(
        "methods-exact",
        draw_exact,
        (
            "docs/figures/methods.py",
            "lasersph.analytic.half_space",
            "lasersph.analytic.stefan",
        ),
    ),
)
