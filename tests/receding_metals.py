"""Shipped metals that evaporate under a steady flux, with the exact solution for them."""

from lasersph.analytic.steady_recession import SteadyRecession
from lasersph.materials import load_material
from lasersph.physics import evaporation as e

METALS = {
    "steel-304-demuth": (7262.0, 704.0, 26.7892, 251000.0, 1727.0),
    "aluminium-demuth": (2228.0, 1077.0, 137.974, 397000.0, 933.35),
}


def recession_of(metal, flux, *, conductivity_share=1.0):
    """Steady recession of a shipped metal from 298.15 K into vacuum."""
    rho, c, k, melting, T_l = METALS[metal]
    vapor = e.vapor_constants(load_material(metal).vaporization)
    heat = {name: vapor[name] for name in ("T_b", "L_b", "T_c")}
    return SteadyRecession(
        flux=flux,
        density=rho,
        heat_capacity=c,
        conductivity=k * conductivity_share,
        melting=melting,
        melting_temperature=T_l,
        initial_temperature=298.15,
        mass_flux=lambda T: e.mass_flux(T, e.saturation_pressure(T, **vapor), vapor["R_s"]),
        latent_heat=lambda T: e.latent_heat(T, **heat),
        hottest=vapor["T_c"],
    )
