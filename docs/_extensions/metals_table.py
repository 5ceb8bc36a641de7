"""Tables of the metals that are shipped, made from their files: numbers, optics, extrapolation."""

import io
import re
from collections.abc import Iterator
from contextlib import redirect_stdout

from lasersph.materials import Material, load_material
from lasersph.materials.checking import FROM_MEMORY, check_material

METALS = (
    *("aluminium", "copper", "silver", "gold", "nickel", "iron", "titanium", "tungsten"),
    *("steel-304", "steel-316l", "ti-6al-4v", "inconel-718"),
)
WORDS = re.compile("the value there | is held")
LIGHTS = (1064e-9, 532e-9, 355e-9)
HEAT = (
    *("metal", "melts [K]", "$L_f$ [kJ/kg]", "boils [K]", "$L_v$ [MJ/kg]"),
    *("$k$ at 300 K [W/(m K)]", "$k$ of the melt [W/(m K)]"),
)
MELT = (
    *("metal", "$\\rho$ [kg/m³]", "$\\eta$ [mPa s]", "$\\gamma$ [N/m]"),
    *("$\\mathrm d\\gamma/\\mathrm dT$ [mN/(m K)]", f"{FROM_MEMORY}"),
)


def metals_page() -> str:
    """The tables, what is extrapolated and what `material show` prints for one of them."""
    metals = [load_material(name) for name in METALS]
    optics = ("metal", *(f"R, depth at {1e9 * light:.0f} nm" for light in LIGHTS))
    parts = [
        "## Heat",
        _table(HEAT, (_heat(metal) for metal in metals)),
        "## Melt\n\nAt the liquidus.",
        _table(MELT, (_melt(metal) for metal in metals)),
        "## Optics\n\nReflectivity of a clean cold surface at normal incidence and the depth in "
        "which light falls to 1/e.",
        _table(optics, (_optics(metal) for metal in metals)),
        "## What is extrapolated\n\nWhere the value at the end of a range is held, up to the "
        "melting point in the solid and the boiling point in the melt; n and k are those of the "
        "cold metal everywhere.",
        "\n".join(f"- **{metal.name}**: {_extrapolated_ranges(metal)}" for metal in metals),
        "## All numbers of one metal",
        "```{code-block} text\n:class: printed\n\n"
        f"$ lasersph material show copper\n{_show_output('copper')}```",
    ]
    return "\n\n".join(parts) + "\n"


def _heat(metal: Material) -> Iterator[str]:
    assert metal.melting and metal.vaporization and metal.liquidus
    T, span = metal.liquidus, f"{metal.solidus:g}"
    yield metal.name
    yield span if metal.solidus == T else f"{span} to {T:g}"
    yield f"{metal.melting.latent_heat / 1e3:.0f}"
    yield f"{metal.vaporization.temperature:.0f}"
    yield f"{metal.vaporization.latent_heat / 1e6:.2f}"
    yield f"{float(metal.conductivity_at(300.0)):.3g}"
    yield f"{float(metal.conductivity_at(T)):.3g}"


def _melt(metal: Material) -> Iterator[str]:
    assert metal.liquidus
    T = metal.liquidus
    yield metal.name
    yield f"{metal.density_liquid:.0f}"
    yield f"{1e3 * float(metal.viscosity_at(T)):.2f}"
    yield f"{float(metal.surface_tension_at(T)):.2f}"
    yield f"{1e3 * float(metal.surface_tension_slope_at(T + 1.0)):.2f}"
    counted = [f.text.split()[0] for f in check_material(metal) if f.subject == "sources"]
    yield counted[0] if counted else "0"


def _optics(metal: Material) -> Iterator[str]:
    assert metal.optics
    yield metal.name
    for light in LIGHTS:
        if not any(abs(one / light - 1.0) < 0.01 for one in metal.optics.wavelengths()):
            yield "–"
            continue
        lit = metal.in_light(light)
        assert lit.optics and lit.optics.absorption_coefficient
        depth = 1e9 / lit.optics.absorption_coefficient
        yield f"{float(lit.reflectivity_at(300.0)):.3f}, {depth:.1f} nm"


def _extrapolated_ranges(metal: Material) -> str:
    """Where values at the ends of ranges are held, as `material check` says it."""
    held = [f for f in check_material(metal) if f.level == "note" and f.text.endswith("is held")]
    return "; ".join(f"`{f.subject}` {WORDS.sub('', f.text)}" for f in held)


def _show_output(name: str) -> str:
    from lasersph.cli.material import show

    text = io.StringIO()
    with redirect_stdout(text):
        show(name)
    return text.getvalue()


def _table(head: tuple[str, ...], rows: Iterator[Iterator[str]]) -> str:
    lines = [head, ("---",) * len(head), *rows]
    return "\n".join(f"| {' | '.join(line)} |" for line in lines)
