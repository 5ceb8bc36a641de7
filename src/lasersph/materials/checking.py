"""Plausibility of a material: what a reader should know before trusting a run with it.

Rules of thumb with their origin: Dulong-Petit (c_p near 3 R per mole and above it when hot),
Richards (entropy of fusion about R), Trouton (entropy of boiling 8-17 R), checks of
consistency (D = k / (rho c_p), liquid lighter than solid, surface tension falling with T), and
where the range of a source ends short of the temperatures that melting and boiling need.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Literal

from lasersph.materials.material import Material
from lasersph.materials.property import Law
from lasersph.materials.sections import GAS_CONSTANT

Level = Literal["ok", "note", "warning"]
WANTED = {
    "viscosity": "melt flow",
    "surface_tension": "capillary forces",
    "expansion": "buoyancy",
    "reflectivity": "absorbing light",
}
LIQUID_ONLY = (
    "viscosity",
    "kinematic_viscosity",
    "surface_tension",
    "surface_tension_slope",
    "expansion",
)
UNITS = {
    "density": "kg/m^3",
    "heat_capacity": "J/(kg K)",
    "conductivity": "W/(m K)",
    "conductivity_printed": "W/(m K)",
    "diffusivity": "m^2/s",
    "viscosity": "Pa s",
    "kinematic_viscosity": "m^2/s",
    "surface_tension": "N/m",
    "surface_tension_slope": "N/(m K)",
    "expansion": "1/K",
}
"""Of every property, as shown to a user; shares of light have none."""
FROM_MEMORY = "[M]"
"""Mark of a source whose text was not at hand when its numbers were written down."""
ROUNDING = 0.02
"""Relative difference that rounding of printed numbers explains."""


@dataclass(frozen=True)
class Finding:
    """One line of the check: level, what it is about, and the sentence."""

    level: Level
    subject: str
    text: str

    def __str__(self) -> str:
        """The finding as one line."""
        return f"{self.level}: {self.subject}: {self.text}"


def check_material(material: Material) -> list[Finding]:
    """All findings about a material, warnings first."""
    found = [
        *_sources(material),
        *_completeness(material),
        *_ranges(material),
        *_consistency(material),
        *_phase_change(material),
        *_liquid(material),
    ]
    order = {"warning": 0, "note": 1, "ok": 2}
    return sorted(found, key=lambda finding: order[finding.level])


def _sources(material: Material) -> list[Finding]:
    """How many sources nobody has compared with their text."""
    laws = (
        law for property_ in material.properties().values() for law in property_.laws().values()
    )
    # sources of laws, then of single numbers, one text or one for each
    sources = [law.source for law in laws]
    for section in (material.melting, material.vaporization, material.electrons):
        given = section.source if section else ""
        sources += given.values() if isinstance(given, dict) else [given]
    count = sum(FROM_MEMORY in source for source in sources)
    text = f"{count} marked {FROM_MEMORY}: from memory, not checked against the text of the source"
    return [Finding("note", "sources", text)] if count else []


def _completeness(material: Material) -> list[Finding]:
    found = []
    # properties that some solver asks for, and for what
    spectral = material.optics.by_wavelength if material.optics else {}
    for name, purpose in WANTED.items():
        if name not in material.properties() and not (name == "reflectivity" and spectral):
            found.append(Finding("note", name, f"not given; needed for {purpose}"))
    if material.surface_tension is None and material.surface_tension_slope is None:
        found.append(
            Finding("note", "surface_tension_slope", "not given; needed for Marangoni flow")
        )

    # phase changes and optics, likewise
    if material.melting is None:
        found.append(Finding("note", "melting", "not given; the material never melts"))
    if material.vaporization is None:
        found.append(Finding("note", "vaporization", "not given; nothing boils or ablates"))
    elif material.vaporization.molar_mass is None:
        found.append(Finding("note", "molar_mass", "not given; needed for evaporation"))
    if material.vaporization is not None and material.vaporization.critical_temperature is None:
        purpose = "vapor that leaves as a flux, and for where a pulse explodes metal"
        found.append(Finding("note", "critical_temperature", f"not given; needed for {purpose}"))
    if not spectral and (material.optics is None or material.optics.absorption_coefficient is None):
        found.append(
            Finding("note", "absorption_coefficient", "not given; needed for Beer-Lambert")
        )
    return found


def _ranges(material: Material) -> list[Finding]:
    """Where the source of a law ends before the temperatures that its phase can reach."""
    found = []
    for name, property_ in material.properties().items():
        for phase, law in property_.laws().items():
            # a source that ends short of what a run asks for, or suffices
            needed = _needed(material, name, phase)
            where = name if phase == "all" else f"{name}.{phase}"
            if needed is None:
                continue
            gaps = _gaps(law, *needed, UNITS.get(name, ""))
            if gaps:
                found.append(Finding("note", where, "; ".join(gaps)))
            else:
                span = f"{needed[0]:g} to {needed[1]:g} K"
                given = "given for" if law.range or law.table else "taken as valid for"
                found.append(Finding("ok", where, f"{given} {span}"))
    return found


def _needed(material: Material, name: str, phase: str) -> tuple[float, float] | None:
    """Temperatures [K] between which a law is evaluated; None where that is not known."""
    # solid: up to the solidus; liquid: from the liquidus to boiling; one law: all of it
    top = material.vaporization.temperature if material.vaporization else None
    if phase == "solid":
        end = material.solidus or top
        return (material.reference_temperature, end) if end else None
    if phase == "liquid" or name in LIQUID_ONLY:
        return (material.liquidus, top) if material.liquidus and top else None
    end = top or material.solidus
    return (material.reference_temperature, end) if end else None


def _gaps(law: Law[Any], lower: float, upper: float, unit: str) -> list[str]:
    gaps = []
    # 2 K: a law that begins at 300 K serves from 298.15 K on
    if law.lower > lower + 2.0:
        value = f"{float(law.at(law.lower)):.4g} {unit}".strip()
        gaps.append(f"below {law.lower:g} K the value there ({value}) is held")
    if law.upper < upper - 2.0:
        value = f"{float(law.at(law.upper)):.4g} {unit}".strip()
        gaps.append(f"above {law.upper:g} K the value there ({value}) is held")
    return gaps


def _consistency(material: Material) -> list[Finding]:
    found = []
    T = material.reference_temperature
    # a printed diffusivity has to be k / (rho c_p)
    if material.diffusivity is not None:
        printed, own = float(material.at("diffusivity", T)), material.diffusivity_reference
        found.append(_compare("diffusivity", "k / (rho c_p)", own, "m^2/s", printed))
    # a conductivity for computing beside that of the paper
    if material.conductivity_printed is not None:
        printed, own = (
            float(material.at("conductivity_printed", T)),
            float(material.conductivity_at(T)),
        )
        found.append(_compare("conductivity", "used", own, "W/(m K)", printed))
    # Dulong-Petit: 3 R per mole
    mass = material.vaporization.molar_mass if material.vaporization else None
    if mass is not None:
        moles = float(material.heat_capacity_at(T)) * mass / GAS_CONSTANT
        level: Level = "ok" if 2.5 <= moles <= 6.0 else "warning"
        text = f"{moles:.2f} R per mole at {T:g} K (Dulong-Petit: 3 R, above it when hot)"
        found.append(Finding(level, "heat_capacity", text))
    return found


def _compare(subject: str, words: str, own: float, unit: str, printed: float) -> Finding:
    off = own / printed - 1.0
    level: Level = "ok" if abs(off) <= ROUNDING else "warning"
    text = f"{words} = {own:.5g} {unit}, printed {printed:.5g} ({off:+.2%})"
    return Finding(level, subject, text)


def _phase_change(material: Material) -> list[Finding]:
    found = []
    vapor, melt = material.vaporization, material.melting
    # Trouton's rule for boiling, Richards' for melting
    if vapor is not None and vapor.molar_mass is not None:
        trouton = vapor.latent_heat / (vapor.specific_gas_constant * vapor.temperature)
        level: Level = "ok" if 8.0 <= trouton <= 17.0 else "warning"
        text = f"L_v / (R_s T_v) = {trouton:.1f} (Trouton: 8 to 17 for metals)"
        found.append(Finding(level, "vaporization.latent_heat", text))
        if melt is not None:
            richards = melt.latent_heat / (vapor.specific_gas_constant * melt.liquidus)
            level = "ok" if 0.7 <= richards <= 2.0 else "warning"
            text = f"L_f / (R_s T_l) = {richards:.2f} (Richards: about 1 for metals)"
            found.append(Finding(level, "melting.latent_heat", text))

    # critical temperature over boiling temperature
    if vapor is not None and vapor.critical_temperature is not None:
        ratio = vapor.critical_temperature / vapor.temperature
        level = "ok" if 1.8 <= ratio <= 4.0 else "warning"
        text = f"{ratio:.2f} times the boiling temperature (metals: 1.8 to 4)"
        found.append(Finding(level, "critical_temperature", text))
    return found


def _liquid(material: Material) -> list[Finding]:
    if material.solidus is None or material.liquidus is None:
        return []
    found = []
    # most metals expand on melting
    if material.density.liquid is not None:
        solid = float(material.density.solid_law.at(material.solidus))
        liquid = float(material.density.liquid_law.at(material.liquidus))
        level: Level = "ok" if 0.85 <= liquid / solid < 1.0 else "warning"
        step = liquid / solid - 1.0
        text = f"liquid {liquid:.0f}, solid {solid:.0f} kg/m^3 at melting ({step:+.1%})"
        found.append(Finding(level, "density", text))
    # liquid metals: some mPa s
    if material.viscosity is not None:
        eta = float(material.viscosity_at(material.liquidus))
        nu = float(material.kinematic_viscosity_at(material.liquidus))
        level = "ok" if 2e-4 <= eta <= 2e-2 else "warning"
        text = (
            f"eta = {eta:.3g} Pa s, nu = {nu:.3g} m^2/s at the liquidus "
            f"(rho = {eta / nu:.0f} kg/m^3)"
        )
        found.append(Finding(level, "viscosity", text))
    # gamma falls with temperature, but with sulfur or oxygen
    if material.surface_tension is not None or material.surface_tension_slope is not None:
        slope = float(material.surface_tension_slope_at(material.liquidus + 1.0))
        # which the key sulfur says
        level = "ok" if slope < 0.0 or material.sulfur > 0.0 else "warning"
        text = f"{slope:.3g} N/(m K); negative for a metal without surface-active elements"
        if material.sulfur > 0.0:
            text = (
                f"{slope:.3g} N/(m K) at the liquidus, with {1e6 * material.sulfur:.3g} ppm sulfur"
            )
        found.append(Finding(level, "surface_tension_slope", text))
    return found
