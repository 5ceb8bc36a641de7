"""Draw conductivity, heat capacity by volume and enthalpy of the shipped metals into
docs/images/metals.png: `python docs/draw_metals.py`.

Solid lines lie in the range of their source, dashed ones outside it, where the value at its end is
held; dots stand at solidus and liquidus.
"""

from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes

from lasersph.materials import Material, load_material
from lasersph.plots import style

TARGET = Path(__file__).parent / "images" / "metals.png"
COLUMNS = (
    ("silver", "copper", "gold", "aluminium", "tungsten"),
    ("nickel", "iron", "inconel-718", "steel-304", "steel-316l", "titanium", "ti-6al-4v"),
)
"""Metals that conduct well, and those that do not."""
TOP = 3700.0
"""Hottest temperature drawn [K]: the melting point of tungsten is the last that is shown."""


def main() -> None:
    """Write the picture."""
    figure, grid = plt.subplots(3, 2, figsize=(11.0, 11.5), sharex=True, layout="constrained")
    for axes, names in zip(grid.T, COLUMNS, strict=True):
        for k, name in enumerate(names):
            metal, color = load_material(name), style.COLORS[k % 8]
            assert metal.vaporization and metal.solidus and metal.liquidus
            end = min(metal.vaporization.temperature, TOP)
            T = np.unique([*np.linspace(300.0, end, 1700), metal.solidus, metal.liquidus])
            k_T = metal.conductivity_at(T)
            draw_phases(axes[0], metal, T, k_T, color, ("conductivity",))
            capacity = metal.density_at(T) * metal.heat_capacity_at(T) / 1e6
            draw_phases(axes[1], metal, T, capacity, color, ("density", "heat_capacity"))
            curve = metal.caloric_curve(298.15)
            h = curve.enthalpy[curve.enthalpy <= (curve.enthalpy_vaporizing or np.inf)]
            axes[2].plot(np.interp(h, curve.enthalpy, curve.temperature), h / 1e6, color=color)
            axes[0].plot([], [], color=color, label=name)
        axes[0].legend(fontsize=9)
        axes[1].set_ylim(1.5, 7.0)
        axes[2].set_xlim(250.0, TOP)
        axes[2].set_ylim(0.0, 3.3)
        style.label(axes[2], "temperature [K]", "enthalpy above 298.15 K [MJ/kg]")
        style.label(axes[0], "", "conductivity [W/(m K)]")
        style.label(axes[1], "", r"$\rho\,c_p$ [MJ/(m$^3$ K)]")
    figure.savefig(TARGET, dpi=110)
    print(f"drew {TARGET}")


def draw_phases(
    axes: Axes, metal: Material, T: np.ndarray, values: np.ndarray, color: str, of: tuple[str, ...]
) -> None:
    """Values (n,) over temperatures T (n,) [K]: solid and melt apart, dashed where held."""
    for phase, inside in (("solid", metal.solidus > T), ("liquid", metal.liquidus <= T)):
        laws = [getattr(getattr(metal, name), f"{phase}_law") for name in of]
        sourced = np.all([(law.lower <= T + 5.0) & (law.upper >= T - 5.0) for law in laws], axis=0)
        axes.plot(T[inside], values[inside], color=color, lw=1.0, ls="--", alpha=0.7)
        axes.plot(T, np.where(inside & sourced, values, np.nan), color=color, lw=1.8)
        if inside.any():
            end = np.flatnonzero(inside)[-1 if phase == "solid" else 0]
            axes.plot(T[end], values[end], "o", color=color, ms=4)


if __name__ == "__main__":
    main()
