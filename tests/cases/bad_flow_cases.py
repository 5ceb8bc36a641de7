# ruff: noqa: E501
"""Bad case files about flow: as in `bad_cases`, replaced in good-flow.toml."""

SIDE = 'bottom = "no-slip"'
LID = 'surface = "no-slip"'
RIGHT = 'right = "fixed-temperature"\nright_temperature = "299.5 K"'
SIDES = 'left = "fixed-temperature"\nleft_temperature = "300.5 K"\n' + RIGHT
KIND = 'kind = "melt-pool"'
GRAVITY = 'gravity = "10 m/s^2"'
VISCOSITY = 'kinematic_viscosity = "0.0071 m^2/s"'
SPACING = 'spacing = "25 mm"'
STEADY = "steady = 1e-3"

BAD_FLOW_CASES = {
    # solver
    "flow under conduction": (KIND + "\n" + GRAVITY, 'kind = "conduction"\nphase_change = false', ':32: solver.flow: unknown key; belongs to kind = "melt-pool"'),
    "steady under conduction": (KIND + "\n" + GRAVITY, 'kind = "conduction"\nphase_change = false', ':30: solver.steady: unknown key; belongs to kind = "melt-pool"'),
    "flow in 1-D": (KIND, KIND + "\ndimensions = 1", ':29: solver.dimensions: must be 2 or 3, got 1: a column of liquid has nowhere to flow; write dimensions = 2, or kind = "conduction" for heat and melting alone'),
    "key of the other solver": (KIND, KIND + '\nscheme = "explicit"', ':29: solver.scheme: unknown key; belongs to kind = "conduction"'),
    "key of this solver under conduction": (KIND, 'kind = "conduction"', ':29: solver.gravity: unknown key; belongs to kind = "melt-pool" or kind = "ablation"'),
    "gravity as a velocity": (GRAVITY, 'gravity = "10 m/s"', ':29: solver.gravity: "10 m/s" is a velocity, not an acceleration; write e.g. "9.81 m/s^2"'),
    "gravity upward": (GRAVITY, 'gravity = "-10 m/s^2"', ':29: solver.gravity: must be at least 0, got "-10 m/s^2"'),
    "unknown pressure solver": (KIND, KIND + '\npressure = "publishd"', ':29: solver.pressure: must be "multigrid" or "published", got "publishd"; do you mean "published"?'),
    "pressure solved to nothing": (KIND, KIND + "\npressure_tolerance = 0", ":29: solver.pressure_tolerance: must be greater than 0, got 0"),
    "unknown frame": (KIND, KIND + '\nframe = "euler"', ':29: solver.frame: must be "lagrangian" or "eulerian", got "euler"; do you mean "eulerian"?'),
    "particles at rest that are shifted": (KIND, KIND + '\nframe = "eulerian"\nshifting = 0.02', ":30: solver.shifting: particles that rest are not shifted; leave it out"),
    "published pressure of particles at rest": (KIND, KIND + '\nframe = "eulerian"\npressure = "published"', ':30: solver.pressure: "published" is the matrix of particles that move; leave it out'),
    "too much shifting": (KIND, KIND + "\nshifting = 3", ":29: solver.shifting: must be at most 0.5, got 3"),
    "a box that melts": ("[material]\n", '[material]\nbase = "steel-304-demuth"\n', ':28: solver.phase_change: a box of [solver.flow] is all fluid, but "steel-304-demuth" melts; write phase_change = false'),
    # sides
    "unknown side": (SIDE, 'top = "no-slip"', ":35: solver.flow.top: unknown key; known here: left, right, front, back, sides, bottom, surface, initial, initial_surface"),
    "unknown kind of side": (SIDE, 'bottom = "noslip"', ':35: solver.flow.bottom: must be "no-slip" or "moving-wall" or "free-slip" or "symmetry" or "periodic" or "free-surface" or "flat" or "moving", got "noslip"; do you mean "no-slip"?'),
    "side as a number": (SIDE, "bottom = 0", ':35: solver.flow.bottom: must be a word or a table; write e.g. "no-slip"'),
    "periodic on one side": (SIDE, 'bottom = "periodic"', ':35: solver.flow.bottom: periodic on one side only; write surface = "periodic" too, or another kind here'),
    "heat periodic on one side": (RIGHT, 'right = "periodic"', ':24: boundaries.right: periodic on one side only; write left = "periodic" too, or another kind here'),
    "periodic for heat only": (SIDES, 'sides = "periodic"', ':30: solver.flow.left: "no-slip", but left is periodic in [boundaries]; write "periodic" in both or in neither'),
    "periodic for flow only": ('left = "no-slip"\nright = "no-slip"', 'left = "periodic"\nright = "periodic"', ':22: boundaries.left: "fixed-temperature", but left is periodic in [solver.flow]; write "periodic" in both or in neither'),
    "moving wall at rest": (LID, 'surface = "moving-wall"', ':36: solver.flow.surface.velocity: a moving wall needs its velocity; write velocity = "1 m/s"'),
    "resting wall that moves": (LID, 'surface = { kind = "no-slip", velocity = "1 m/s" }', ':36: solver.flow.surface.velocity: says nothing where kind = "no-slip"; leave it out or write kind = "moving-wall"'),
    "velocity in m": (LID, 'surface = { kind = "moving-wall", velocity = "1 m" }', ':36: solver.flow.surface.velocity: "1 m" is a length, not a velocity; write e.g. "10 m/s"'),
    "absurd velocity": (LID, 'surface = { kind = "moving-wall", velocity = "1e12 m/s" }', ":36: solver.flow.surface.velocity: 1e+12 m/s needs 4.8e+15 steps to the end, more than 1e+09; take a lower speed, a coarser spacing or an earlier end"),
    "free surface below": (SIDE, 'bottom = "free-surface"', ':35: solver.flow.bottom: a free surface lies at the top; write surface = "free-surface"'),
    "support cut off": (RIGHT, 'right = "free"', ':24: boundaries.right: "free" cuts supports off, which flow needs whole; write "adiabatic", through which no heat passes either'),
    "half a box with walls": ('depth = "1 m"', 'depth = "1 m"\nextent = "half"', ':23: boundaries.left: half a block is symmetric at x = 0, "fixed-temperature" does not fit; write extent = "full" in [domain] or left = "adiabatic"'),
    "graded box": (SPACING, 'spacing = "25 mm"\ncoarsest = "1 m"\narrangement = "graded"', ':21: particles.arrangement: particles that flow through the whole box need one size; write "uniform"'),
    # heat
    "flux missing": (RIGHT, 'right = "prescribed-flux"', ':21: boundaries.right_flux: is missing; write e.g. right_flux = "1e6 W/m^2", positive into the body'),
    "flux in K": (RIGHT, 'right = "prescribed-flux"\nright_flux = "3 K"', ':25: boundaries.right_flux: "3 K" is a temperature, not a heat flux; write e.g. "1e6 W/m^2"'),
    "flux through a face of given temperature": ('right_temperature = "299.5 K"', 'right_flux = "3 W/m^2"', ':25: boundaries.right_flux: says nothing where right = "fixed-temperature"; leave it out, or set right to "prescribed-flux"'),
    "wave of an adiabatic surface": (RIGHT, RIGHT + '\nsurface_temperature_wave = { amplitude = "1 K", period = "1 m" }', ':26: boundaries.surface_temperature_wave: says nothing where surface = "adiabatic"; write surface = "fixed-temperature"'),
    "wave and bump": (RIGHT, RIGHT + '\nsurface = "fixed-temperature"\nsurface_temperature = "300 K"\nsurface_temperature_wave = { amplitude = "1 K", period = "1 m" }\nsurface_temperature_bump = { amplitude = "1 K", radius = "0.1 m" }', ":29: boundaries.surface_temperature_bump: contradicts surface_temperature_wave; leave one of them out"),
    "bump of an adiabatic surface": (RIGHT, RIGHT + '\nsurface_temperature_bump = { amplitude = "1 K", radius = "0.1 m" }', ':26: boundaries.surface_temperature_bump: says nothing where surface = "adiabatic"; write surface = "fixed-temperature"'),
    "bump that pushes a flat surface": (RIGHT, RIGHT + '\nsurface_pressure_bump = { amplitude = "1 Pa", radius = "0.1 m" }', ':26: boundaries.surface_pressure_bump: says nothing where the surface is flat; write surface = "moving" in [solver.flow], or leave it out'),
    # start and end
    "unknown start": (LID, LID + '\ninitial = { kind = "vortex" }', ':37: solver.flow.initial.kind: must be "rest" or "taylor-green" or "table", got "vortex"'),
    "start without a file": (LID, LID + '\ninitial = { kind = "table" }', ":37: solver.flow.initial.path: missing; name a CSV file with columns x, z, u, w"),
    "start from a missing file": (LID, LID + '\ninitial = { kind = "table", path = "none.csv" }', ":37: solver.flow.initial: {folder}/none.csv: cannot be read: No such file or directory"),
    "vortices that do not fit": (LID, LID + '\ninitial = { kind = "taylor-green", speed = "1 m/s", period = "0.7 m" }', ':15: domain.width: 1 m is no whole number of vortices of 350 mm; write e.g. width = "1.05 m", or another period in solver.flow.initial'),
    "vortices without speed": (LID, LID + '\ninitial = { kind = "taylor-green" }', ':37: solver.flow.initial.speed: missing; write speed = "10 m/s"'),
    "steady as a time": (STEADY, 'steady = "1 s"', ':30: solver.steady: must be a number, got "1 s"'),
    "steady at once": (STEADY, "steady = 2", ":30: solver.steady: must be less than 1, got 2"),
    # material
    "no viscosity": (VISCOSITY + "\n", "", ':7: material: "of the case" has no viscosity, which flow needs; write e.g. viscosity = "5 mPa s" in [material], or kind = "conduction" in [solver]'),
    "no surface tension": (LID, 'surface = "free-surface"', ':7: material: "of the case" has no surface_tension_slope, which drives the surface; write e.g. surface_tension_slope = "-0.4 mN/(m K)" in [material], or marangoni = false in [solver]'),
    "viscosity of another kind": (VISCOSITY, 'viscosity = "0.0071 m^2/s"', ':11: material.viscosity: "0.0071 m^2/s" is a diffusivity, not a viscosity; write e.g. "1.3 mPa s"'),
    "two viscosities": (VISCOSITY, VISCOSITY + '\nviscosity = "0.0032 Pa s"', ':11: material.kinematic_viscosity: with viscosity makes the density of the liquid 0.4507 kg/m^3 at 298.15 K, but density is 1 kg/m^3; write kinematic_viscosity = "0.0032 m^2/s", or leave one of the two viscosities out'),
    "no viscosity at all": (VISCOSITY, 'kinematic_viscosity = "0 m^2/s"', ":7: material: kinematic_viscosity must be positive everywhere in its range"),
    "no conductivity": ('diffusivity = "0.01 m^2/s"\n', "", ':7: material.conductivity: missing; write conductivity = "167 W/(m K)"'),
}  # fmt: skip
"""Name -> (replaced, replacement, message after the file name)."""
