"""`lasersph material list|show|check`."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from lasersph.cli.app import HELP
from lasersph.cli.arguments import completion_of
from lasersph.cli.failures import WrongCommand
from lasersph.input.text_table import text_table

if TYPE_CHECKING:
    from lasersph.materials import Law, Material

app = typer.Typer(
    help="List, show and check materials.", add_completion=False, context_settings=HELP
)


Name = Annotated[
    str,
    typer.Argument(
        metavar="NAME",
        help="A material, or the path of a file.",
        autocompletion=completion_of("materials", "available_materials"),
    ),
]
Word = Annotated[
    str,
    typer.Argument(metavar="[WORD]", help="Of a name, symbol, standard or composition."),
]
Plot = Annotated[
    Path | None,
    typer.Option("--plot", metavar="FILE", help="Draw all properties, e.g. into steel.png."),
]


@app.command("list")
def list_materials(word: Word = "") -> None:
    """List the materials that a case can name, all or those that a word finds."""
    from lasersph.materials import available_materials
    from lasersph.materials.loading import materials_like

    # All materials, or those that the word finds.
    found = materials_like(word)
    if not found:
        known = ", ".join(available_materials())
        raise WrongCommand(f'no material has "{word}" in its name or composition; known: {known}')
    print(text_table([(name, one.title) for name, one in found.items()]))


@app.command()
def show(name: Name, plot: Plot = None) -> None:
    """Show a material: every number with its source."""
    from lasersph.materials import load_material

    material = load_material(name)
    if plot is not None:
        _draw(material, plot)
    # Title, note, numbers with sources, and uncertainties where they are stated.
    print(material.title or material.name)
    if material.note:
        print(" ".join(material.note.split()))
    print()
    print(text_table(_rows(material), ("quantity", "value", "range", "source")))
    if stated := material.uncertainties():
        rows = [(key, f"{100 * u:.3g} %", source) for key, (u, source) in stated.items()]
        print("\n" + text_table(rows, ("quantity", "standard uncertainty", "source")))


@app.command()
def check(name: Name, plot: Plot = None) -> None:
    """Check a material: what is missing, what is implausible, what contradicts."""
    from lasersph.materials import check_material, load_material

    material = load_material(name)
    if plot is not None:
        _draw(material, plot)
    # Findings have a level; only warnings count against the material.
    findings = check_material(material)
    rows = [(found.level, found.subject, found.text) for found in findings]
    print(text_table(rows, ("level", "subject", "what")))
    warnings = sum(found.level == "warning" for found in findings)
    number = f"{warnings or 'no'} warning{'' if warnings == 1 else 's'}"
    print(f"{material.name}: {number}")


def _draw(material: Material, file: Path) -> None:
    from lasersph.plots.material import plot_material

    print(f"drew {plot_material(material, file)}")


HOT_ELECTRONS = 3e4
"""Temperature up to which laws of electrons without an end are shown [K]. Display: that at which
the shipped tables end."""
SHOWN_HOT = (5e3, 1e4, 2e4)
"""Temperatures of electrons whose reflectivity is shown [K]. Display: under light of some fs."""


def _values(material: Material, name: str, law: Law[Any]) -> str:
    """Value, or the values at both ends of the range in which the material needs the law."""
    from lasersph.materials.checking import LIQUID_ONLY, UNITS

    unit = UNITS.get(name, "")
    # A property of the liquid begins at the liquidus, any other at the reference temperature.
    bottom = material.liquidus if name in LIQUID_ONLY else None
    top = material.vaporization.temperature if material.vaporization else 3000.0
    ends = max(law.lower, bottom or material.reference_temperature), min(law.upper, top)
    values = [f"{float(law.at(T)):.5g}" for T in ends]
    return f"{values[0] if law.is_constant else ' ... '.join(values)} {unit}".strip()


def _span(law: Law[Any]) -> str:
    """Temperatures for which the source gives the law."""
    if law.lower <= 0.0 and law.upper == float("inf"):
        return "not given"
    return f"{law.lower:g} ... {law.upper:g} K"


def _rows(material: Material) -> list[tuple[str, str, str, str]]:
    """Quantity, value, range, source of every number."""
    # Laws by property and phase, then the single numbers of each section.
    rows = []
    for name, property_ in material.properties().items():
        for phase, law in property_.laws().items():
            where = name if phase == "all" else f"{name}, {phase}"
            rows.append((where, _values(material, name, law), _span(law), law.source))
    # Sulfur, and where it turns the slope of surface tension.
    if material.sulfur > 0.0:
        rows.append(
            ("sulfur", f"{1e6 * material.sulfur:.3g} ppm", "", "note of the surface tension")
        )
        boiling = material.vaporization.temperature if material.vaporization else 3000.0
        reversal = material.slope_reversal(boiling)
        if reversal is not None:
            what = "positive below, computed from surface tension and sulfur"
            rows.append(("surface_tension_slope is 0", f"{reversal:.0f} K", "", what))
    for group, units in (
        ("melting", {"solidus": "K", "liquidus": "K", "latent_heat": "J/kg"}),
        (
            "vaporization",
            {
                "temperature": "K",
                "latent_heat": "J/kg",
                "molar_mass": "kg/mol",
                "critical_temperature": "K",
            },
        ),
        ("optics", {"absorption_coefficient": "1/m", "wavelength": "m", "emissivity": ""}),
        (
            "electrons",
            {
                "scattering": "1/K",
                "collision_rate": "1/(K s)",
                "plasma_frequency": "rad/s",
                "highest_collision_rate": "1/s",
                "lattice_share": "",
                "ballistic_range": "m",
            },
        ),
    ):
        section = getattr(material, group)
        for name, unit in units.items():
            number = getattr(section, name, None)
            if isinstance(number, float):
                source = section.source_of(name)
                rows.append((f"{group}, {name}", f"{number:.5g} {unit}".strip(), "", source))
    # Laws of the electrons, optics by wavelength; text in a cell stays on one line.
    rows += _electron_rows(material)
    rows += _spectral_rows(material)
    return [tuple(" ".join(cell.split()) for cell in row) for row in rows]  # pyright: ignore[reportReturnType]


def _electron_rows(material: Material) -> list[tuple[str, str, str, str]]:
    """Laws of the electrons over their temperature."""
    if material.electrons is None:
        return []
    rows = []
    for name, unit in {"heat_capacity": "J/(m^3 K)", "coupling": "W/(m^3 K)"}.items():
        law: Law[Any] = getattr(material.electrons, name)
        ends = max(law.lower, material.reference_temperature), min(law.upper, HOT_ELECTRONS)
        values = [f"{float(law.at(T)):.4g}" for T in ends]
        text = values[0] if law.is_constant else " ... ".join(values)
        rows.append((f"electrons, {name}", f"{text} {unit}", _span(law), law.source))
    return rows + _hot_light_rows(material)


def _hot_light_rows(material: Material) -> list[tuple[str, str, str, str]]:
    """Reflectivity that hot electrons have in a cold lattice, at each wavelength."""
    from lasersph.materials.hot_optics import hot_optics
    from lasersph.materials.optics import in_nanometers

    rows, cold = [], material.reference_temperature
    for wavelength in material.optics.wavelengths() if material.optics else ():
        if (optics := hot_optics(material, wavelength)) is not None:
            values = [f"{float(optics.at(T, cold)[0]):.3g}" for T in (cold, *SHOWN_HOT)]
            name = f"electrons, reflectivity at {in_nanometers(wavelength)}"
            span = f"{cold:g} ... {SHOWN_HOT[-1]:g} K"
            rows.append((name, " ... ".join(values), span, "n and k, with plasma_frequency"))
    return rows


def _spectral_rows(material: Material) -> list[tuple[str, str, str, str]]:
    """Values that follow from n and k at each wavelength; the sources of R begin with them."""
    from lasersph.input import format_quantity
    from lasersph.materials.optics import in_nanometers

    rows = []
    for wavelength in material.optics.wavelengths() if material.optics else ():
        optics = material.optics.at(wavelength) if material.optics else None
        # Without n and k there is nothing beyond the numbers above.
        if optics is None or optics is material.optics or optics.reflectivity is None:
            continue
        where = f"optics at {in_nanometers(wavelength)}"
        cold = float(optics.reflectivity.at(material.reference_temperature))
        rows.append((f"{where}, reflectivity", f"{cold:.4g}", "", optics.reflectivity.source))
        if (alpha := optics.absorption_coefficient) is not None:
            depth = f"{alpha:.4g} 1/m, depth {format_quantity(1.0 / alpha, 'm', 3)}"
            rows.append((f"{where}, absorption", depth, "", optics.source_of("wavelength")))
    return rows
