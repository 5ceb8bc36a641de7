"""Names that other programs give to the keys of a material, so that a message can say ours.

See `input.findings.Misplaced`: keys in full, or beginning with a dot inside their own table; what
stands behind a semicolon is what to do where none of them fits.
"""

SLOPE = '; write [surface_tension_slope] with value = "-0.4 mN/(m K)", source = "where it is from"'
LAW = (
    '; write table = [["300 K", "first value"], ["2000 K", "last value"]], which is linear between '
    "its rows"
)
INDEX = (
    "; write refractive_index and extinction_coefficient, with their source, into "
    '[optics.by_wavelength."1064 nm"]'
)
SLOPES = tuple(
    f"surface_tension.{word}"
    for word in ("slope", "gradient", "temperature_coefficient", "dgamma_dt")
)
"""Names that a change of the surface tension with temperature has in its table."""
INDICES = ("n", "k", "refractive_index", "extinction_coefficient")
"""Names of both parts of the complex refractive index, which belong to a wavelength."""
MATERIAL_WORDS = dict.fromkeys(SLOPES, SLOPE) | {
    "specific_heat": ".heat_capacity",
    "specific_heat_capacity": ".heat_capacity",
    "cp": ".heat_capacity",
    "c_p": ".heat_capacity",
    "rho": ".density",
    "k": ".conductivity",
    "thermal_conductivity": ".conductivity",
    "thermal_diffusivity": ".diffusivity",
    "dynamic_viscosity": ".viscosity",
    "thermal_expansion": ".expansion",
    "melting.temperature": ".solidus",
    "melting_temperature": "material.melting.solidus .solidus",
    "melting_point": "material.melting.solidus .solidus",
    "latent_heat_of_fusion": "material.melting.latent_heat .latent_heat",
    "latent_heat_melting": "material.melting.latent_heat .latent_heat",
    "heat_of_fusion": "material.melting.latent_heat .latent_heat",
    "boiling_temperature": "material.vaporization.temperature .temperature",
    "boiling_point": "material.vaporization.temperature .temperature",
    "vaporization_temperature": "material.vaporization.temperature .temperature",
    "latent_heat_of_vaporization": "material.vaporization.latent_heat .latent_heat",
    "latent_heat_vaporization": "material.vaporization.latent_heat .latent_heat",
    "surface_tension_gradient": ".surface_tension_slope",
    "surface_tension_coefficient": ".surface_tension_slope",
    "surface_tension_temperature_coefficient": ".surface_tension_slope",
    "dgamma_dt": ".surface_tension_slope",
    "dsigma_dt": ".surface_tension_slope",
    "slope": LAW,
    "temperature_coefficient": LAW,
    **dict.fromkeys((f"optics.{word}" for word in INDICES), INDEX),
    "emissivity": ".optics.emissivity",
    "absorptivity": "; write reflectivity = 1 - absorptivity",
    "absorptance": "; write reflectivity = 1 - absorptance",
}
