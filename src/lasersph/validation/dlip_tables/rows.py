"""Tables 1 to 5 of [Demuth2020], its particles, and the numbers that its text derives from them."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from decimal import Decimal
from math import sin
from typing import Any

import numpy as np

from lasersph.case import Case, load_case
from lasersph.materials import Material
from lasersph.particles.extended_lattice import MIRROR
from lasersph.particles.filling import fill
from lasersph.physics import dimensionless as number
from lasersph.plots.particle_map import arrangement
from lasersph.simulation import forecast
from lasersph.simulation.layers import lay_out
from lasersph.sph.kernels import kernel
from lasersph.validation.comparison import Words
from lasersph.validation.dlip_tables import pressure_matrix
from lasersph.validation.lattices import all_pairs, cubic_lattice
from lasersph.validation.study import Study

GRAVITY, PULSE = 9.81, 10e-9
FLUENCE = 6000.0
"""Mean fluence of Table 4 [J/m2], 2 x 0.3 J/cm2."""
AGREEMENT = 1e-4
NAMES = ("L", "La", "Ph_s/l", "Ph_l/v", "Pr", "Ra", "|Ma|")
Numbers = dict[str, float]
"""Table 3 by name, SI."""


def compare(study: Study) -> None:
    """All tables; nothing is run."""
    add_matrix(study)
    add_parameters(study)
    for label, metal in study.plan.metals.items():
        add_properties(study, label, metal)
        add_tables(study, label, metal)
        add_estimates(study, label, metal)
    add_optics(study)
    add_particles(study)
    draw_particles(study)


def add_matrix(study: Study) -> None:
    """Table 1 for a small pool."""
    # Difference from the printed matrix, sums of rows, signs, asymmetry.
    found, wanted = pressure_matrix.assembled(study.backend), pressure_matrix.printed()
    largest = np.abs(np.diag(wanted)).max()
    study.add("matrix", float(np.abs(found - wanted).max() / largest))
    study.add("row_sum", float(np.abs(found.sum(axis=1)).max() / largest))
    rows = np.diag(wanted) != 0.0
    beside = found - np.diag(np.diag(found))
    study.add("signs", bool(np.all(np.diag(found)[rows] < 0.0) and np.all(beside >= 0.0)))
    share = float(np.abs(found - found.T).max() / largest)
    study.add("asymmetric", share > 1e-3, asymmetry=share)


def add_parameters(study: Study) -> None:
    """Table 2 of the shipped cases, the period of eq. (2) and the Fourier number of eq. (22)."""
    # Parameters by their keys in the shipped cases.
    plan = study.plan
    for label, metal in plan.metals.items():
        case = load_case(metal["case"])
        for what, entry in plan.table_2.items():
            if entry.get("only", label) == label:
                given: Words = {"published": entry["value"], "what": what, "unit": entry["unit"]}
                found = value_at(case, entry["path"])
                study.add("parameter", found, entry["value"], label=label, **given)
    # Period of eq. (2), lambda / (2 sin(theta/2)).
    study.add("period", plan.wavelength / (2.0 * sin(0.5 * float(plan.angle))))
    case = load_case(plan.metals["steel"]["case"])
    study.add("fourier", number.fourier_number(case.time.end, PULSE))


def value_at(case: Case, path: str) -> float:
    """A number of a case by its key, "laser.pulse.fwhm"."""
    found: Any = case
    for key in path.split("."):
        found = getattr(found, key)
    return float(found)


def add_properties(study: Study, label: str, metal: dict[str, Any]) -> None:
    """Table 3 of the shipped metals."""
    case = load_case(metal["case"])
    shipped = properties(case)
    # Properties as printed; conductivity is D rho c_p.
    for name, printed in metal["table_3"].items():
        value = float(printed)
        study.add("property", shipped[name], value, published=printed, label=label, name=name)
    table = printed_values(metal)
    found = table["diffusivity"] * table["density"] * table["heat_capacity"]
    study.add("conductivity", found, published=float(metal["conductivity"]), label=label)


def properties(case: Case) -> Numbers:
    """Numbers of Table 3, as a shipped case has them."""
    material, T0 = case.material, case.initial_temperature
    melting, vaporization = material.melting, material.vaporization
    assert melting is not None
    assert vaporization is not None
    assert case.laser is not None
    Tl = melting.liquidus
    return {
        "solidus": melting.solidus,
        "liquidus": Tl,
        "vaporization": vaporization.temperature,
        "latent_heat": melting.latent_heat,
        "vaporization_heat": vaporization.latent_heat,
        "density": material.density_reference,
        "heat_capacity": float(material.heat_capacity_at(T0)),
        "diffusivity": float(material.at("diffusivity", T0)),
        "viscosity": float(material.viscosity_at(Tl)),
        "kinematic_viscosity": float(material.kinematic_viscosity_at(Tl)),
        "expansion": float(material.at("expansion", Tl)),
        "surface_tension_slope": float(material.at("surface_tension_slope", Tl)),
        "absorption": case.laser.absorption_coefficient(material),
        "initial": T0,
    }


def printed_values(metal: Mapping[str, Any]) -> Numbers:
    """Table 3 as printed, and the temperature of Table 2."""
    return {name: float(text) for name, text in metal["table_3"].items()} | {"initial": 298.15}


def half_digit(printed: str) -> float:
    """Half a unit of the last printed digit."""
    return 0.5 * 10.0 ** int(Decimal(printed).as_tuple().exponent)


def rounding(metal: Mapping[str, Any], of: Callable[[Numbers], float]) -> float:
    """Change of a number by half a unit in the last digit of every entry of Table 3, added up."""
    # Each entry moved by half a unit of its last digit.
    table = printed_values(metal)
    value = of(table)
    return sum(
        abs(of(table | {name: table[name] + half_digit(text)}) - value)
        for name, text in metal["table_3"].items()
    )


def laser_number(table: Numbers, fluence: float) -> float:
    """La of a mean fluence [J/m2]."""
    rise = table["vaporization"] - table["initial"]
    heat = table["density"], table["heat_capacity"]
    return number.laser_number(fluence, table["absorption"], *heat, rise)


def table_4(table: Numbers) -> tuple[float, ...]:
    """The numbers of `NAMES`, eqs. (16)-(25)."""
    # Eqs. (16)-(25) with the rounded numbers.
    rise = table["vaporization"] - table["initial"]
    hot = table["vaporization"] - table["liquidus"]
    a = table["diffusivity"]
    nu = table["kinematic_viscosity"]
    c = table["heat_capacity"]
    L = number.thermal_diffusion_length(a, PULSE)
    slope = table["surface_tension_slope"]
    return (
        L,
        laser_number(table, FLUENCE),
        number.phase_change_number(table["latent_heat"], c, rise),
        number.phase_change_number(table["vaporization_heat"], c, rise),
        number.prandtl_number(nu, a),
        number.rayleigh_number(table["expansion"], hot, GRAVITY, L, nu, a),
        abs(number.marangoni_number(slope, hot, L, table["viscosity"], a)),
    )


def add_tables(study: Study, label: str, metal: dict[str, Any]) -> None:
    """Tables 4 and 5 from Table 3 as printed; with fitted values as our own; fine zones shown."""
    # Values that fit Table 4 beside the rounded ones of Table 3.
    for name, value in metal["unrounded"].items():
        printed = metal["table_3"][name]
        study.add("unrounded", value, float(printed), published=printed, label=label, name=name)
    # Table 4, then the laser numbers of Table 5.
    for k, (name, printed) in enumerate(zip(NAMES, metal["table_4"], strict=True)):
        words: Words = {"name": f"{name} of Table 4", "table": "Table 4, eqs. (16)-(25)"}
        words["unit"] = "m" if name == "L" else "1"
        add_number(study, label, metal, printed, lambda t, k=k: table_4(t)[k], words)
    for fluence, printed in zip(metal["fluences"], metal["laser_numbers"], strict=True):
        words = {"name": f"La at {fluence} J/cm2, Table 5", "unit": "1", "table": "Table 5"}
        add_number(
            study, label, metal, printed, lambda t, f=fluence: laser_number(t, 1e4 * f), words
        )
    if study.quick:
        return
    # Depths of the fine layers at the published spacing.
    for fluence, printed in zip(metal["fluences"], metal["fine_zones"], strict=True):
        settings = [f"laser.fluence={fluence} J/cm^2", "particles.spacing=3.97 nm"]
        depth = 1e9 * forecast(load_case(metal["case"], settings)).fine_depth
        study.add("fine_zone", depth, published=printed, label=label, fluence=fluence)


def add_number(
    study: Study,
    label: str,
    metal: dict[str, Any],
    printed: str,
    of: Callable[[Numbers], float],
    words: Words,
) -> None:
    """A printed number beside that of Table 3 as printed, and of the fitted values."""
    # A number of rounded entries may differ by their rounding.
    table, value = printed_values(metal), float(printed)
    given: Words = {"published": printed, "label": label, **words}
    if metal["unrounded"]:
        share = rounding(metal, of) + half_digit(printed)
        study.add("table_rounded", of(table), value, share=share, **given)
        study.add("fitted", of(table | metal["unrounded"]), value, **given)
    else:
        share = max(AGREEMENT * value, half_digit(printed))
        study.add("table", of(table), value, share=share, **given)


def add_estimates(study: Study, label: str, metal: dict[str, Any]) -> None:
    """Eqs. (79) and (80) from the printed gradient and layer."""
    # u = delta/eta |dgamma/dT dT/dx|, and the time over half a period.
    printed = metal["estimate"]
    table = dict(metal["table_3"]) | {name: printed[name] for name in ("gradient", "layer")}
    inputs = {"table_3": table}

    def speed(values: Numbers) -> float:
        slope = abs(values["surface_tension_slope"])
        return values["layer"] / values["viscosity"] * slope * values["gradient"]

    def time(values: Numbers) -> float:
        return 2.5e-6 / speed(values)

    for row, of, key in (("estimate", speed, "speed"), ("estimate_time", time, "time")):
        share = rounding(inputs, of) + half_digit(printed[key])
        given: Words = {"published": float(printed[key]), "share": share, "label": label}
        study.add(row, of(printed_values(inputs)), float(printed[key]), **given)


def add_optics(study: Study) -> None:
    """Eq. (78) at both ends, and the viscosity of aluminium over that of steel."""
    # Reflectivity cold and at the liquidus; viscosities at the liquidus.
    metals = {label: load_case(metal["case"]) for label, metal in study.plan.metals.items()}
    aluminium: Material = metals["aluminium"].material
    melting = aluminium.melting
    assert melting is not None
    study.add("reflectivity", float(aluminium.reflectivity_at(298.15)))
    study.add("reflectivity_melt", float(aluminium.reflectivity_at(melting.liquidus)))
    viscosity = {label: properties(case)["viscosity"] for label, case in metals.items()}
    study.add("fifth", viscosity["aluminium"] / viscosity["steel"])


def add_particles(study: Study) -> None:
    """Neighbors on a lattice, the finest spacing and the height of the graded rows."""
    # Neighbors of the middle particle of a lattice, itself included.
    side, shape = 9, kernel("quintic-spline", 2)
    pairs = all_pairs(study.backend, cubic_lattice(2, side), pressure_matrix.SUPPORT, shape)
    start = study.backend.to_host(pairs.row_start).astype(np.int64)
    study.add("neighbors", float(np.diff(start)[side * side // 2] + 1))
    # Rows that grow by 9/7: their finest height, and the sum of all but it.
    rows = (7.0 / 9.0) ** np.arange(23)
    study.add("finest", float(1e3 * rows[-1]))
    study.add("graded", float(rows[:-1].sum()))


def draw_particles(study: Study) -> None:
    """Fig. 2: full period of steel with the published grading, dummies lighter; 440 nm of it."""
    # The graded lattice with its dummies.
    spacing = f"particles.spacing={study.plan.spacing} nm"
    case = load_case("dlip-steel", [spacing, "domain.extent=full", f"particles.ratio={7 / 9}"])
    filling = fill(lay_out(case), surface=MIRROR, bottom=MIRROR, sides=MIRROR)
    count = filling.count
    body = {"position": filling.position[:, :count], "width": filling.width[:, :count]}
    figure = arrangement(body, dummies=filling.position[:, count:], detail=440e-9)
    study.save("fig2-particles", figure)
