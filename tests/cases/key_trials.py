"""What each key of a case is tried with: values that matter, beside settings that they need.

The keys of [time] and the plain ones of [solver] are tried in `test_every_key`.
"""

from __future__ import annotations

LIT = """
material = "steel-304"
initial_temperature = "1650 K"
laser = { fluence = "0.3 J/cm^2", pulse = { kind = "square", duration = "0.2 ns" }, \
absorption = { kind = "surface" } }
domain = { depth = "2 um", width = "2.4 um" }
particles = { spacing = "0.2 um" }
time = { end = "0.1 ns", step = "0.05 ns" }
"""
"""A case file of warm metal under light."""
LINES = "laser.beam={ kind = 'interference', period = '2.4 um' }"
MOVING = ("solver.kind=ablation", "solver.sound_speed=1000 m/s")
BASES: dict[str, tuple[str, ...]] = {
    "column": ("solver.dimensions=1",),
    "section": ("solver.dimensions=2", LINES),
    "pool": ("solver.kind=melt-pool", "solver.flow={ surface = 'moving' }", LINES),
    "matter": (*MOVING, "solver.dimensions=2", LINES),
    "column of matter": (*MOVING, "solver.dimensions=1"),
}
"""Small cases of every solver; "box" is one without light."""
FILM = ("particles.spacing=60 nm", "domain.depth=480 nm", "time.end=2 ns")
"""A film of liquid below a surface that moves; settings of the shipped case."""
BOX = ("particles.spacing=100 mm", "time.end=0.4 s")

Trial = tuple[str, tuple[str, ...]]
"""A value, and settings beside it."""
NONE: tuple[str, ...] = ()
DARK = ("laser=",)


def alone(*values: str, beside: tuple[str, ...] = NONE) -> list[Trial]:
    """Trials of values beside the same settings."""
    return [(value, beside) for value in values]


def faces() -> dict[str, list[Trial]]:
    """Trials of the kinds of faces, of their temperatures and fluxes."""
    found: dict[str, list[Trial]] = {}
    for face in ("bottom", "sides", "left", "right", "front", "back"):
        key, stem = f"boundaries.{face}", "side" if face == "sides" else face
        # faces normal to y are those of a body
        space = SOLID if face in ("front", "back") else NONE
        held = [(*space, f"{key}={kind}") for kind in ("fixed-temperature", "wall")]
        flowing = (*space, f"{key}=prescribed-flux", f"boundaries.{stem}_flux=1e10 W/m^2")
        found[key] = alone("fixed-temperature", "wall", beside=space or (WARM,))
        found[f"boundaries.{stem}_temperature"] = [("1300 K", one) for one in held]
        found[f"boundaries.{stem}_flux"] = alone("5e10 W/m^2", beside=flowing)
    return found


WARM = "domain.depth=1 um"
"""So that heat of the light reaches the bottom."""
HELD = (*DARK, "boundaries.surface=fixed-temperature", "boundaries.surface_temperature=1900 K")
FLOWING = ("boundaries.surface=prescribed-flux", "boundaries.surface_flux=1e10 W/m^2")
BOILING = ("laser.fluence=3 J/cm^2", "solver.vaporization=flux")
ROUND = ("laser.fluence_kind=peak",)
SHORT = "laser.pulse={ kind = 'gaussian', fwhm = '0.02 ns', center = '0.05 ns' }"
TABLE = "laser.pulse={ kind = 'tabulated', table = [['0 ns', 1.0], ['0.1 ns', 2.0]] }"
DEEP = ("laser.absorption={ kind = 'beer-lambert' }",)
SPOT = "laser.beam={ kind = 'top-hat', radius = '1 um' }"
RING = "laser.beam={ kind = 'ring', radius = '1 um', inner_radius = '0.5 um' }"
SOFT = "laser.beam={ kind = 'super-gaussian', radius_1e2 = '1 um' }"
PATH = ("laser.path={ kind = 'linear', speed = '2e4 m/s' }",)
LIGHT = ("laser.beam={ kind = 'interference', period = '2.4 um', wavelength = '532 nm' }",)
ENERGY = ("laser.fluence=", "laser.pulse_energy=0.5 uJ")
TRAIN = "laser.pulse={ kind = 'square', duration = '0.01 ns', count = 2, period = '0.02 ns' }"
RATE = TRAIN.replace("period = '0.02 ns'", "repetition_rate = '50 GHz'")
ANGLE = "laser.beam={ kind = 'interference', wavelength = '532 nm', angle = '12.726711602457 deg' }"
WAVES = "laser.beam={ kind = 'interference', wavelength = '532 nm', waves = [%s, %s] }"
RIGHT, LEFT = (
    f"{{ polar = '6.3633558012287 deg', azimuth = '{degrees} deg' }}" for degrees in (0, 180)
)
TWO_WAVES = (WAVES % (RIGHT, LEFT),)
SOLID = ("solver.dimensions=3", "particles.spacing=0.5 um")
CELL = (*ENERGY, "laser.spot={ diameter = '50 um', definition = '1/e^2' }")

BOUNDARIES = (
    faces()
    | {
        "boundaries.surface": alone("wall", beside=HELD),
        "boundaries.surface_temperature": alone("1800 K", beside=HELD),
        "boundaries.surface_flux": alone("5e10 W/m^2", beside=FLOWING),
    }
    | {
        "boundaries.convection": alone("1e6 W/(m^2 K)") + alone("1e6 W/(m^2 K)", beside=HELD),
        "boundaries.emissivity": alone("0.9") + alone("0.9", beside=HELD),
        "boundaries.ambient_temperature": alone(
            "100 K", beside=("boundaries.convection=1e6 W/(m^2 K)",)
        ),
        "boundaries.ambient_pressure": alone("0 Pa", beside=BOILING) + alone("0 Pa"),
    }
)
GRADED = ("particles.arrangement=graded", "domain.depth=4 um", "solver.flow=")
BLOCK = {
    "initial_temperature": alone("1300 K"),
    "domain.depth": alone("3 um"),
    "domain.width": alone("4.8 um"),
    "domain.breadth": alone("4.8 um", beside=("solver.dimensions=3", "particles.spacing=0.5 um")),
    "domain.extent": alone("half"),
    "particles.spacing": alone("0.1 um"),
    "particles.arrangement": alone("graded", beside=("solver.flow=", "domain.depth=4 um")),
    "particles.fine_depth": alone("1.4 um") + alone("1.2 um", beside=GRADED),
    "particles.fine_width": alone("1.4 um")
    + alone("1.4 um", beside=(*GRADED, "domain.width=9.6 um", "particles.coarsest=0.3 um")),
    "particles.kernel": alone("wendland-c2"),
    "particles.support_ratio": alone("3.2"),
} | {
    f"particles.{key}": alone(value)
    + alone(value, beside=("particles.arrangement=graded", "domain.depth=9 um", "solver.flow="))
    for key, value in (("coarsest", "0.3 um"), ("ratio", "0.6"))
}
LASER = {
    "laser.fluence": alone("0.2 J/cm^2"),
    "laser.fluence_kind": alone("peak", beside=(LINES,)),
    "laser.intensity": alone("2e12 W/m^2", beside=("laser.fluence=", "laser.intensity=1e12 W/m^2")),
    "laser.pulse_energy": alone("2 uJ", beside=CELL),
    "laser.power": alone(
        "2 kW", beside=(CELL[-1], "laser.fluence=", "laser.power=1 kW")
    ),
    "laser.reflectivity": alone("0.1"),
    "laser.reflectivity.table": alone(
        "[['300 K', 0.2], ['3000 K', 0.2]]",
        beside=("laser.reflectivity={ table = [['300 K', 0.5], ['3000 K', 0.5]] }",),
    ),
    "laser.absorptivity": alone("0.1"),
    "laser.absorptivity.table": alone(
        "[['300 K', 0.2], ['3000 K', 0.2]]",
        beside=("laser.absorptivity={ table = [['300 K', 0.5], ['3000 K', 0.5]] }",),
    ),
    "laser.absorptivity.over_time": alone(
        "[['0 ns', 0.2], ['1 ns', 0.2]]",
        beside=("laser.absorptivity={ over_time = [['0 ns', 0.2], ['1 ns', 0.9]] }",),
    ),
    "laser.wavelength": alone("532 nm"),
    "laser.position": alone("['0.4 um', '0 um']")
    + alone("['0.4 um', '0 um']", beside=(SPOT,))
    + alone("['0 um', '0.4 um']", beside=(LINES,)),
    "laser.path": alone("{ kind = 'linear', speed = '2e4 m/s' }"),
    "laser.path.speed": alone("1e4 m/s", beside=PATH),
    "laser.path.direction": alone("60 deg", beside=PATH),
    "laser.path.table": alone(
        "[['0 ns', '0 um', '0 um'], ['0.1 ns', '2 um', '0 um']]",
        beside=("laser.path={ kind = 'tabulated', table = [['0 ns', '0 um', '0 um'], ['0.1 ns', "
                "'1 um', '0 um']] }",),
    ),
    "laser.pulse.duration": alone("0.3 ns"),
    "laser.pulse.start": alone("0.03 ns"),
    "laser.pulse.count": alone("1", beside=(TRAIN,)),
    "laser.pulse.period": alone("0.03 ns", beside=(TRAIN,)),
    "laser.pulse.repetition_rate": alone("40 GHz", beside=(RATE,)),
    "laser.pulse.fwhm": alone("0.01 ns", beside=(SHORT,)),
    "laser.pulse.center": alone("0.06 ns", beside=(SHORT,)),
    "laser.pulse.table": alone("[['0 ns', 1.0], ['0.1 ns', 1.0]]", beside=(TABLE,)),
    "laser.absorption": alone("{ kind = 'beer-lambert' }"),
    "laser.absorption.absorption_coefficient": alone("1e6 1/m") + alone("1e6 1/m", beside=DEEP),
    "laser.beam": alone("{ kind = 'interference', period = '1.2 um' }"),
    "laser.beam.radius": alone("0.7 um", beside=(SPOT,)),
    "laser.beam.inner_radius": alone("0.7 um", beside=(RING,)),
    "laser.beam.order": alone("8", beside=(SOFT, *ROUND)),
    **{
        f"laser.beam.{key}": alone(
            "0.7 um", beside=(f"laser.beam={{ kind = 'gaussian', {key} = '1 um' }}", *ROUND)
        )
        for key in ("radius_1e2", "diameter_1e2", "diameter_fwhm")
    },
    "laser.beam.period": alone("1.2 um"),
    "laser.beam.angle": alone("25.613886449014 deg", beside=(ANGLE,)),
    "laser.beam.waves[].amplitude": alone("0.5", beside=TWO_WAVES),
    "laser.beam.waves[].azimuth": alone("180 deg", "60 deg", beside=TWO_WAVES),
    "laser.beam.waves[].phase": alone("180 deg", beside=TWO_WAVES),
    "laser.beam.waves[].polar": alone(
        "12.806943224507 deg", beside=(*TWO_WAVES, "domain.width=4.8 um")
    ),
    "laser.beam.waves[].polarization": alone(
        "30 deg", beside=(TWO_WAVES[0].replace("polar =", "polarization = 's', polar ="),)
    ),
    "laser.beam.beams": alone("4") + alone("4", beside=(*SOLID, LINES)),
    "laser.beam.shift": alone("1.2 um") + alone("1.2 um", beside=(LINES, TRAIN)),
    "laser.beam.wavelength": alone("266 nm", beside=(ANGLE,)),
    "laser.beam.polarization": alone("'p'", beside=LIGHT),
    "laser.beam.energy_shares": alone("[0.2, 0.8]"),
    "laser.beam.phases": alone("['0 deg', '180 deg']"),
    "laser.spot": alone("{ diameter = '50 um', definition = 'fwhm', place = ['9 um', '0 um'] }"),
    "laser.spot.diameter": alone("60 um", beside=CELL),
    "laser.spot.definition": alone("fwhm", beside=CELL),
    "laser.spot.extent": alone("whole", beside=(*ENERGY, CELL[-1].replace("50 um", "2.4 um"))),
    "laser.spot.place": alone("['9 um', '0 um']", beside=CELL),
}  # fmt: skip
WALLS = dict.fromkeys(("left", "right", "bottom", "surface"), NONE) | dict.fromkeys(
    ("front", "back", "sides"), ("solver.dimensions=3", "particles.spacing=200 mm")
)
"""Walls of a box, those of a body beside what makes it one."""
SOLVER = {
    **{
        f"solver.flow.{side}": alone("{ kind = 'moving-wall', velocity = '1 m/s' }", beside=space)
        for side, space in WALLS.items()
    },
    **{
        f"solver.flow.{side}.velocity": alone(
            "2 m/s",
            beside=(*space, f"solver.flow.{side}={{ kind = 'moving-wall', velocity = '1 m/s' }}"),
        )
        for side, space in WALLS.items()
    },
    "solver.flow.initial": alone("{ kind = 'taylor-green', speed = '1 m/s' }"),
    "solver.flow.initial.speed": alone(
        "2 m/s", beside=("solver.flow.initial={ kind = 'taylor-green', speed = '1 m/s' }",)
    ),
    "solver.flow.initial.period": alone(
        "0.5 m", beside=("solver.flow.initial={ kind = 'taylor-green', speed = '1 m/s' }",)
    ),
    "solver.vessel.left": alone("1 um"),
    "solver.vessel.right": alone("1 um"),
    "solver.vessel.above": alone("1 um") + alone("1 um", beside=("boundaries.sides=periodic",)),
    **{
        f"solver.motion.{axis}": alone("1 m/s", beside=("solver.motion={ kind = 'uniform' }",))
        for axis in "xz"
    },
}


CAP_NAMES = (
    "amplitude = '10 nm', period = '5.05 um'",
    "cap_height = '10 nm', cap_radius = '2 um'",
)
"""A wave, and a cap instead of it."""


IN_SPACE = (
    *("solver.dimensions=3", "domain.breadth=2.4 um", "particles.spacing=100 nm"),
    *("solver.flow.front=symmetry", "solver.flow.back=symmetry"),
)
"""The film in three dimensions."""


def waves() -> dict[str, list[Trial]]:
    """Trials of what is imposed on a surface along x."""
    given = {"temperature": "50 K", "pressure": "1 kPa", "mass_flux": "10 kg/(m^2 s)"}
    found: dict[str, list[Trial]] = {}
    for name, amplitude in given.items():
        key = f"boundaries.surface_{name}_wave"
        wave = f"{key}={{ amplitude = '{amplitude}', period = '5.05 um', end = '20 ns' }}"
        found[key] = alone(wave.partition("=")[2].replace("'5", "'7").replace("'1", "'3"))
        changes = {"amplitude": amplitude.replace(" ", "0 ", 1), "period": "2.525 um"}
        changes |= {"start": "0.4 ns", "end": "0.4 ns"}
        for part, value in changes.items():
            found[f"{key}.{part}"] = alone(value, beside=(wave,))
        found[f"{key}.period_y"] = alone("2.4 um", beside=(*IN_SPACE, wave))
    found |= bumps(given)
    start = "solver.flow.initial_surface={ amplitude = '10 nm', period = '5.05 um' }"
    found["solver.flow.initial_surface"] = alone(start.partition("=")[2])
    found["solver.flow.initial_surface.amplitude"] = alone("15 nm", beside=(start,))
    found["solver.flow.initial_surface.period"] = alone("2.525 um", beside=(start,))
    found["solver.flow.initial_surface.period_y"] = alone("2.4 um", beside=(*IN_SPACE, start))
    bump, cap = (start.replace(*names) for names in (("period = '5", "radius = '2"), CAP_NAMES))
    found["solver.flow.initial_surface.radius"] = alone("1 um", beside=(bump,))
    found["solver.flow.initial_surface.cap_height"] = alone("5 nm", beside=(cap,))
    found["solver.flow.initial_surface.cap_radius"] = alone("1 um", beside=(cap,))
    return found


def bumps(given: dict[str, str]) -> dict[str, list[Trial]]:
    """Trials of what is imposed on a surface around x = 0, instead of the film's wave."""
    found: dict[str, list[Trial]] = {}
    dark = "boundaries.surface_temperature_wave="
    for name in ("temperature", "pressure"):
        key = f"boundaries.surface_{name}_bump"
        bump = f"{key}={{ amplitude = '{given[name]}', radius = '1 um', end = '20 ns' }}"
        found[key] = alone(bump.partition("=")[2], beside=(dark,))
        changes = {"amplitude": given[name].replace(" ", "0 ", 1), "radius": "2 um"}
        changes |= {"start": "0.4 ns", "end": "0.4 ns"}
        for part, value in changes.items():
            found[f"{key}.{part}"] = alone(value, beside=(dark, bump))
    return found


EJECTION = {
    "model": ("model = 'enthalpy'", "model = 'published'"),
    "velocity": ("velocity = 'effusion'", "velocity = 'mean-normal'"),
    "preset": ("preset = 'timeline'", "preset = 'depth'"),
    "leave": ("leave = 'layer-below'", "leave = 'distance', leave_distance = 0.5"),
    "leave_distance": (
        "leave = 'distance', leave_distance = 0.5",
        "leave = 'distance', leave_distance = 3",
    ),
}
"""Two values of each key of [solver.ejection], of the published model but for its own."""

Property = tuple[str, str, tuple[str, ...]]
"""A small case, a value in it, and settings beside it."""
MELT = (*BOILING, "material={ base = 'steel-304' }")
SULFUR = (
    "material.surface_tension_slope=",
    "material.surface_tension={ polynomial = [2.72087, -4.3e-4], scale = '1 N/m', adsorption = "
    "{ saturation = '1.3e-5 mol/m^2', segregation = 3.18e-3, enthalpy = '-166 kJ/mol', "
    "source = '[Sahoo1988]' } }",
)


GIVEN_ELECTRONS = (
    "material.electrons={ heat_capacity = '3e5 J/(m^3 K)', coupling = '1e18 W/(m^3 K)', "
    "conductivity = '80 W/(m K)' }"
)
COLLIDING = "{ collision_rate = '1e11 1/(K s)', plasma_frequency = '1e16 rad/s' }"


def properties() -> dict[str, Property]:
    """Trials of a metal's properties, each in a case that needs it."""
    found: dict[str, Property] = {
        "reference_temperature": ("column", "400 K", MELT),
        "optics.absorption_coefficient": ("column", "1e6 1/m", (*MELT, *DEEP)),
        "optics.reflectivity": ("pool", "0.3", MELT),
        "optics.emissivity": ("pool", "0.9", MELT),
        "melting.solidus": ("pool", "1660 K", MELT),
        "melting.liquidus": ("pool", "1800 K", MELT),
        "melting.latent_heat": ("pool", "200 kJ/kg", MELT),
        "vaporization.temperature": ("pool", "2800 K", MELT),
        "vaporization.latent_heat": ("pool", "5 MJ/kg", MELT),
        "vaporization.molar_mass": ("pool", "50 g/mol", MELT),
        "vaporization.critical_temperature": ("pool", "9000 K", MELT),
        "expansion": ("box", "1e-4 1/K", NONE),
        "kinematic_viscosity": ("box", "1e-6 m^2/s", NONE),
        "sulfur": ("film", "0.01 %", SULFUR),
    }
    electrons = {
        "heat_capacity": "2e5 J/(m^3 K)",
        "coupling": "1e18 W/(m^3 K)",
        "conductivity": "40 W/(m K)",
        "scattering": "6e-5 1/K",
        "lattice_share": "0.5",
        "ballistic_range": "0.5 um",
    }
    # what hot electrons take up of the light of a wavelength, n and k of which are known
    hot = (f"material={{ base = 'steel-304', electrons = {COLLIDING} }}", "laser.reflectivity=")
    hot += ("laser.wavelength=1064 nm", *DEEP, "solver.heat=two-temperature", "time.step=10 ps")
    colliding = {
        "collision_rate": "1e13 1/(K s)",
        "plasma_frequency": "3e16 rad/s",
        "highest_collision_rate": "1e14 1/s",
    }
    beside = (*MELT, *DEEP, "solver.heat=two-temperature", "time.step=10 ps")
    found |= {f"electrons.{key}": ("column", value, beside) for key, value in electrons.items()}
    found |= {f"electrons.{key}": ("column", value, hot) for key, value in colliding.items()}
    # given as a law, instead of by what scatters them, for a metal without electrons of its own
    law = tuple(one for one in beside if not one.startswith("material="))
    law += ("material={ base = 'steel-316l' }", "laser.wavelength=1064 nm", GIVEN_ELECTRONS)
    found["electrons.conductivity"] = ("column", "40 W/(m K)", law)
    in_film = {
        "density": "7000 kg/m^3",
        "conductivity": "20 W/(m K)",
        "heat_capacity": "600 J/(kg K)",
        "viscosity": "8 mPa s",
        "surface_tension": "1.5 N/m",
        "surface_tension_slope": "-0.2 mN/(m K)",
    }
    return found | {key: ("film", value, NONE) for key, value in in_film.items()}


PROPERTIES = properties()
WORDS = (
    *("base", "name", "title", "note", "source", "composition", "uncertainty"),
    *("conductivity_printed", "diffusivity", "wavelength", "by_wavelength"),
)
"""What a metal's file says beside its properties: where a number is from, what a paper prints
beside it, and at which light it holds (`laser.wavelength` chooses)."""

TRIALS = BOUNDARIES | BLOCK | LASER | SOLVER | waves()
