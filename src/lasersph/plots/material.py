"""Figure of one material: every property against temperature, phases shaded, sources below.

Lines are dashed where the source ends and the value at the end of its range is held.
"""

from __future__ import annotations

import textwrap
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from lasersph.input import format_quantity
from lasersph.materials import Law, Material
from lasersph.materials.hot_optics import HotOptics, hot_optics
from lasersph.materials.optics import in_nanometers

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


class Panel(NamedTuple):
    """Property, its label, the factor from SI to the unit of the label, the phases it exists in."""

    name: str
    label: str
    factor: float
    liquid_only: bool = False


PANELS = (
    Panel("density", r"density $\rho$ [kg/m$^3$]", 1.0),
    Panel("heat_capacity", r"heat capacity $c_p$ [J/(kg K)]", 1.0),
    Panel("conductivity", r"conductivity $k$ [W/(m K)]", 1.0),
    Panel("viscosity", r"viscosity $\eta$ [mPa s]", 1e3, True),
    Panel("surface_tension", r"surface tension $\gamma$ [N/m]", 1.0, True),
    Panel("surface_tension_slope", r"$d\gamma/dT$ [mN/(m K)]", 1e3, True),
    Panel("reflectivity", r"reflectivity $R$ [1]", 1.0),
)
HOT_PANELS = (
    Panel("heat_capacity", r"electrons: $C_e$ [MJ/(m$^3$ K)]", 1e-6),
    Panel("coupling", r"electrons: $G$ [10$^{17}$ W/(m$^3$ K)]", 1e-17),
)
"""Laws of the temperature of the electrons."""
HOTTEST = 3e4
"""End of their panels [K]. Display: that of the shipped tables."""
SLOPE = "surface_tension_slope"
STYLES = ("-", "--", "-.", ":")
PHASES = {"solid": "#e9ecef", "melting": "#ffe3b3", "liquid": "#fdeedd"}
LINE = "#1f4e79"
COLUMNS = 3
SLOPE_MARGIN = 0.12
"""Room above and below the slope over its range. Display: for the word at its zero."""


def material_figure(material: Material) -> Figure:
    """Figure of all properties of a material that depend on temperature, and of its enthalpy."""
    from lasersph.plots.notebook_figure import NotebookFigure

    # Panels for what depends on temperature, one for the enthalpy, one for the numbers.
    properties = material.properties()
    has_slope = material.surface_tension is not None
    panels = [
        panel for panel in PANELS if panel.name in properties or (panel.name == SLOPE and has_slope)
    ]
    lights = _hot_lights(material)
    count = len(panels) + 2 + (0 if material.electrons is None else len(HOT_PANELS)) + bool(lights)
    rows = -(-count // COLUMNS)
    notes = _source_lines(material, panels)
    height = 2.9 * rows + 0.15 * len(notes) + 1.0
    figure = NotebookFigure(figsize=(11.0, height), layout=None)
    bottom = (0.15 * len(notes) + 0.8) / height
    margins = {"left": 0.075, "right": 0.985, "top": 1.0 - 0.75 / height, "bottom": bottom}
    grid = figure.add_gridspec(rows, COLUMNS, **margins, wspace=0.3, hspace=0.42)
    span = _span(material)
    # Each panel has the number of its source below the figure.
    for number, panel in enumerate(panels):
        axes = figure.add_subplot(grid[divmod(number, COLUMNS)])
        if panel.name == SLOPE:
            _draw_slope(axes, material, panel, span)
        else:
            _draw_property(axes, material, panel, span)
        options = {"ha": "right", "fontsize": 8, "color": "0.4"}
        axes.text(-0.03, 1.02, f"[{number + 1}]", transform=axes.transAxes, **options)
    _draw_enthalpy(figure.add_subplot(grid[divmod(len(panels), COLUMNS)]), material, span)
    _write_numbers(figure.add_subplot(grid[divmod(len(panels) + 1, COLUMNS)]), material)
    if material.electrons is not None:
        for number, panel in enumerate(HOT_PANELS, start=len(panels) + 2):
            _draw_electrons(figure.add_subplot(grid[divmod(number, COLUMNS)]), material, panel)
    if lights:
        _draw_hot_light(figure.add_subplot(grid[divmod(count - 1, COLUMNS)]), material, lights)
    figure.suptitle(material.title or material.name, x=0.075, y=1.0 - 0.2 / height, ha="left")
    options = {"fontsize": 7.5, "va": "top", "color": "0.25", "linespacing": 1.25}
    figure.text(0.075, (0.15 * len(notes) + 0.2) / height, "\n".join(notes), **options)
    return figure


def plot_material(material: Material, file: str | Path) -> Path:
    """Write the figure of a material to a file (.png, .svg or .pdf); returns its path."""
    path = Path(file)
    material_figure(material).savefig(path, dpi=150)
    return path


def _span(material: Material) -> tuple[float, float]:
    """Temperatures of all panels [K]: reference temperature to 5 % above the boiling point."""
    # Up to the boiling point, at least beyond melting.
    top = material.vaporization.temperature if material.vaporization else 0.0
    top = max(top, 1.2 * (material.liquidus or 0.0), material.reference_temperature + 1000.0)
    return material.reference_temperature, 1.05 * top


def _draw_property(axes: Axes, material: Material, panel: Panel, span: tuple[float, float]) -> None:
    found = material.properties()[panel.name]
    solidus, liquidus = material.solidus, material.liquidus

    # Solid, a dotted line through the melting range, liquid; a property without phases in one.
    _shade(axes, material, span)
    if solidus is None or liquidus is None or (found.is_constant and not panel.liquid_only):
        _draw_law(axes, found.solid_law, span, panel.factor)
    else:
        if not panel.liquid_only:
            _draw_law(axes, found.solid_law, (span[0], solidus), panel.factor)
            values = np.array([found.solid_law.at(solidus), found.liquid_law.at(liquidus)])
            axes.plot([solidus, liquidus], values * panel.factor, color=LINE, lw=1.0, ls=":")
        _draw_law(axes, found.liquid_law, (liquidus, span[1]), panel.factor)
    # A constant would fill its panel by rounding alone.
    if all(law.is_constant for law in found.laws().values()) and len(found.laws()) == 1:
        value = float(found.at(span[0])) * panel.factor
        axes.set_ylim(*sorted((0.0, 1.6 * value)))
    axes.set_ylabel(panel.label, fontsize=9)
    axes.ticklabel_format(axis="y", useOffset=False)


def _draw_electrons(axes: Axes, material: Material, panel: Panel) -> None:
    """One law of the temperature of the electrons."""
    law: Law[Any] = getattr(material.electrons, panel.name)
    _draw_law(axes, law, (material.reference_temperature, HOTTEST), panel.factor)
    axes.set_ylim(bottom=0.0)
    _label_electrons(axes, panel.label)


def _hot_lights(material: Material) -> dict[str, HotOptics]:
    """Optics of hot electrons by the name of their light, longest wave first."""
    known = () if material.optics is None else material.optics.wavelengths()
    found = {in_nanometers(light): hot_optics(material, light) for light in known}
    return {name: optics for name, optics in found.items() if optics is not None}


def _draw_hot_light(axes: Axes, material: Material, lights: dict[str, HotOptics]) -> None:
    """Reflectivity over the temperature of the electrons, the lattice cold, of each light."""
    cold = material.reference_temperature
    T = np.linspace(cold, HOTTEST, 400)
    for (name, optics), style in zip(lights.items(), STYLES * len(lights), strict=False):
        axes.plot(T, optics.at(T, cold)[0], color=LINE, lw=1.6, ls=style, label=name)
    axes.set_ylim(0.0, 1.0)
    axes.legend(fontsize=8, frameon=False)
    _label_electrons(axes, "reflectivity $R$ [1], cold lattice")


def _label_electrons(axes: Axes, label: str) -> None:
    """Axes over the temperature of the electrons."""
    axes.set_xlabel("temperature of the electrons [K]", fontsize=9)
    axes.set_ylabel(label, fontsize=9)
    axes.tick_params(labelsize=8)
    for side in ("top", "right"):
        axes.spines[side].set_visible(False)


def _draw_slope(axes: Axes, material: Material, panel: Panel, span: tuple[float, float]) -> None:
    """Slope of surface tension of the liquid, as given or that of gamma(T), and where it is 0."""
    _shade(axes, material, span)
    lower = span[0] if material.liquidus is None else material.liquidus
    T = np.linspace(lower, span[1], 400)
    slope = material.surface_tension_slope_at(T) * panel.factor
    axes.plot(T, slope, color=LINE, lw=1.6)
    low, high = min(0.0, float(slope.min())), max(0.0, float(slope.max()))
    margin = SLOPE_MARGIN * (high - low)
    axes.set_ylim(low - margin, high + margin)
    axes.axhline(0.0, color="0.55", lw=0.8)
    axes.set_ylabel(panel.label, fontsize=9)

    # Below the change of sign melt flows to where it is hot, above it to where it is cold.
    if (reversal := material.slope_reversal(span[1])) is not None:
        axes.plot([reversal], [0.0], "o", color=LINE, ms=4.5)
        text = f"changes sign at {reversal:.0f} K"
        options = {"ha": "left", "va": "bottom", "fontsize": 7.5, "color": "0.25"}
        place = (reversal, 0.0)
        axes.annotate(text, place, xytext=(6, 4), textcoords="offset points", **options)


def _draw_law(axes: Axes, law: Law[Any], span: tuple[float, float], factor: float) -> None:
    """One law: solid line inside the range of its source, dashed where a value is held."""
    # Dots of the source, a full line in its range, a dashed one outside.
    low, high = max(span[0], law.lower), min(span[1], law.upper)
    if law.table:
        rows = np.array([row for row in law.table if span[0] <= row[0] <= span[1]])
        if rows.size:
            axes.plot(rows[:, 0], rows[:, 1] * factor, "o", color=LINE, ms=3.5)
    parts = (((span[0], min(low, span[1])), "--"), ((low, high), "-"), ((high, span[1]), "--"))
    for (start, end), style in parts:
        if end > start:
            T = np.linspace(start, end, 200)
            axes.plot(T, law.at(T) * factor, color=LINE, lw=1.6, ls=style)


def _write_numbers(axes: Axes, material: Material) -> None:
    """Single numbers of the material as a small table."""
    axes.axis("off")

    # Melting, boiling, expansion and optics, as far as the metal has them.
    rows: list[tuple[str, str]] = []
    if material.melting is not None:
        melt = material.melting
        same = melt.solidus == melt.liquidus
        span = f"{melt.solidus:g} K" if same else f"{melt.solidus:g} to {melt.liquidus:g} K"
        rows.append(("melting point" if same else "melting range", span))
        rows.append(("latent heat of fusion", f"{melt.latent_heat / 1e3:g} kJ/kg"))
    if material.vaporization is not None:
        vapor = material.vaporization
        rows.append(("boiling point", f"{vapor.temperature:g} K"))
        rows.append(("latent heat of vaporization", f"{vapor.latent_heat / 1e6:g} MJ/kg"))
        if vapor.critical_temperature is not None:
            rows.append(("critical temperature", f"{vapor.critical_temperature:g} K"))
        if vapor.molar_mass is not None:
            rows.append(("molar mass", f"{vapor.molar_mass * 1e3:g} g/mol"))
    if material.expansion is not None:
        beta = float(material.at("expansion", material.liquidus or 0.0))
        rows.append(("expansion of the liquid", f"{beta:.3g} 1/K"))
    if material.optics is not None:
        optics = material.optics
        if optics.absorption_coefficient is not None:
            rows.append(("absorption coefficient", f"{optics.absorption_coefficient:g} 1/m"))
        if optics.wavelength is not None:
            rows.append(("optics hold at", format_quantity(optics.wavelength, "m", 6)))
        if optics.emissivity is not None:
            rows.append(("emissivity", f"{optics.emissivity:g}"))
        # Optics by wavelength: reflectivity when cold, and depth of the light.
        for wavelength in optics.wavelengths() if optics.by_wavelength else ():
            light = optics.at(wavelength)
            R, alpha = light.reflectivity, light.absorption_coefficient
            value = f"{float(R.at(material.reference_temperature)):.3f}" if R is not None else "–"
            depth = f", {1e9 / alpha:.1f} nm" if alpha is not None else ""
            rows.append((f"R, depth at {in_nanometers(wavelength)}", value + depth))
    for number, (name, value) in enumerate(rows):
        y = 0.97 - 0.098 * number
        axes.text(0.0, y, name, fontsize=9, color="0.35", va="top", transform=axes.transAxes)
        axes.text(0.98, y, value, fontsize=9, ha="right", va="top", transform=axes.transAxes)


def _draw_enthalpy(axes: Axes, material: Material, span: tuple[float, float]) -> None:
    """Enthalpy above the reference temperature, with the jumps of melting and boiling."""
    _shade(axes, material, span)
    boils = material.vaporization is not None
    # Up to the full heat of vaporization, where the plateau ends.
    curve = material.caloric_curve(span[0], "hold" if boils else "evaporate")
    if curve.enthalpy_vaporizing is not None:
        high = 1.25 * curve.enthalpy_vaporizing
    else:
        high = float(curve.enthalpy_at(span[1]))
    h = np.union1d(np.linspace(0.0, high, 400), curve.enthalpy[curve.enthalpy < high])
    axes.plot(curve.temperature_at(h), h / 1e6, color=LINE, lw=1.6)
    if boils and material.vaporization is not None:
        text = f"boiling: + {material.vaporization.latent_heat / 1e6:.4g} MJ/kg"
        place = (material.vaporization.temperature, high / 1e6)
        options = {"ha": "right", "va": "top", "fontsize": 7.5, "color": "0.25"}
        axes.annotate(text, place, xytext=(-6, -4), textcoords="offset points", **options)
    axes.set_ylim(0.0, high / 1e6)
    axes.set_ylabel(f"enthalpy above {span[0]:g} K [MJ/kg]", fontsize=9)


def _shade(axes: Axes, material: Material, span: tuple[float, float]) -> None:
    """Background by phase, a line at the boiling point, common axis."""
    axes.set_xlim(*span)
    axes.set_xlabel("temperature [K]", fontsize=9)
    axes.tick_params(labelsize=8)
    for side in ("top", "right"):
        axes.spines[side].set_visible(False)

    # Backgrounds of the phases, where the metal melts.
    if material.solidus is None or material.liquidus is None:
        return
    axes.axvspan(span[0], material.solidus, color=PHASES["solid"], lw=0)
    axes.axvspan(material.solidus, material.liquidus, color=PHASES["melting"], lw=0)
    axes.axvspan(material.liquidus, span[1], color=PHASES["liquid"], lw=0)
    transform = axes.get_xaxis_transform()
    style: dict[str, Any] = {"transform": transform, "fontsize": 7.5, "color": "0.45"}
    axes.text(0.5 * (span[0] + material.solidus), 1.02, "solid", ha="center", **style)
    axes.text(material.liquidus + 0.02 * (span[1] - span[0]), 1.02, "liquid", **style)
    if material.vaporization is not None:
        T = material.vaporization.temperature
        axes.axvline(T, color="0.55", lw=0.8, ls=":")
        axes.text(T, 1.02, r"$T_v$", ha="center", **style)


def _source_lines(material: Material, panels: list[Panel]) -> list[str]:
    """Numbered sources of the panels, wrapped; the last lines explain the drawing."""
    lines = []
    # Sources by the number of their panel, wrapped to the width of the page.
    for number, panel in enumerate(panels):
        found = material.properties().get(panel.name)
        if found is None:
            sulfur = f", with {1e6 * material.sulfur:.3g} ppm sulfur" if material.sulfur else ""
            parts = [f"slope of the surface tension{sulfur}"]
        else:
            parts = [
                law.source if phase == "all" else f"{phase}: {law.source}"
                for phase, law in found.laws().items()
            ]
        text = f"[{number + 1}] " + "; ".join(parts)
        lines += textwrap.wrap(text, 165, subsequent_indent="      ")
    if material.electrons is not None:
        laws = material.electrons.heat_capacity, material.electrons.coupling
        sources = [law.source for law in laws]
        if _hot_lights(material):
            frequency = material.electrons.source_of("plasma_frequency")
            sources.append("reflectivity from n and k by the plasma frequency of " + frequency)
        text = "Electrons: " + "; ".join(" ".join(source.split()) for source in sources)
        lines += textwrap.wrap(text, 165, subsequent_indent="      ")
    lines.append("")
    lines.append(
        "Dashed: outside the range of the source, the value at its end is held. Dotted between "
        "solid and liquid: mixed linearly in the melting range."
    )
    return lines
