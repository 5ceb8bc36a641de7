# ruff: noqa: E501
"""Bad sections (r, z): what is replaced in good-spot.toml, by what, and the message that must come."""

BEAM = 'beam = { kind = "gaussian", radius_1e2 = "2 um" }'
PULSE = 'pulse = { kind = "gaussian", fwhm = "10 ns", center = "30 ns" }'
ENERGY = 'pulse_energy = "100 nJ"'
BOTTOM = 'bottom = "adiabatic"'
WIDTH = 'width = "6 um"'
HELD = '\nsurface = "fixed-temperature"\nsurface_temperature = "400 K"'

BAD_GEOMETRY_CASES = {
    "unknown geometry": (
        '"axisymmetric"',
        '"cylindrical"',
        ':23: solver.geometry: must be "planar" or "axisymmetric", got "cylindrical"',
    ),
    "section in 1-D": (
        "dimensions = 2",
        "dimensions = 1",
        ':23: solver.geometry: "axisymmetric" is a section (r, z), not 1-D; write dimensions = 2',
    ),
    "section in 3-D": (
        "dimensions = 2",
        "dimensions = 3",
        ':23: solver.geometry: "axisymmetric" is a section (r, z), not 3-D; write dimensions = 2',
    ),
    "published pressure of a section": (
        'kind = "conduction"\ndimensions = 2\ngeometry = "axisymmetric"',
        'kind = "melt-pool"\ngeometry = "axisymmetric"\npressure = "published"',
        ':23: solver.pressure: "published" is the matrix of a plane; leave it out in a section (r, z)',
    ),
    "particles that leave their rings": (
        'kind = "conduction"\ndimensions = 2\ngeometry = "axisymmetric"',
        'kind = "melt-pool"\ngeometry = "axisymmetric"\nframe = "lagrangian"',
        ":23: solver.frame: particles of a section (r, z) keep their distances from the axis; leave it out",
    ),
    "wall on the axis of a box": (
        'kind = "conduction"\ndimensions = 2\ngeometry = "axisymmetric"',
        'kind = "melt-pool"\nphase_change = false\ngeometry = "axisymmetric"\nflow = { left = "free-slip" }',
        ":24: solver.flow.left: the left side of a section (r, z) is its axis; leave it out",
    ),
    "flow of a plane around an axis": (
        'kind = "conduction"\ndimensions = 2\ngeometry = "axisymmetric"',
        'kind = "melt-pool"\nphase_change = false\ngeometry = "axisymmetric"\nflow = { initial = { kind = "taylor-green", speed = "1 m/s" } }',
        ":24: solver.flow.initial: is the flow of a plane; leave it out in a section (r, z), which starts at rest",
    ),
    "section of ablation": (
        'kind = "conduction"\ndimensions = 2',
        'kind = "ablation"\nsound_speed = "1 km/s"\ndimensions = 2',
        ':24: solver.geometry: matter that moves is computed in "planar" blocks; leave it out, or write kind = "melt-pool" or "conduction"',
    ),
    "half a section": (
        WIDTH,
        WIDTH + '\nextent = "half"',
        ":13: domain.extent: a section (r, z) begins at its axis, and its width is the radius of the block; leave it out",
    ),
    "face on the axis": (
        BOTTOM,
        BOTTOM + '\nleft = "wall"',
        ":19: boundaries.left: the left side of a section (r, z) is its axis; leave it out",
    ),
    "period in r": (
        BOTTOM,
        BOTTOM + '\nsides = "periodic"',
        ':19: boundaries.sides: nothing repeats along r; write sides = "adiabatic"',
    ),
    "period on the right": (
        BOTTOM,
        BOTTOM + '\nright = "periodic"',
        ':19: boundaries.right: nothing repeats along r; write right = "adiabatic"',
    ),
    "wave along r": (
        BOTTOM,
        BOTTOM + HELD + '\nsurface_temperature_wave = { amplitude = "1 K", period = "2 um" }',
        ":21: boundaries.surface_temperature_wave: has a period along x, and nothing repeats along r; write surface_temperature_bump instead",
    ),
    "wave of vapor along r": (
        BOTTOM,
        BOTTOM + '\nsurface_mass_flux_wave = { amplitude = "1 kg/(m^2 s)", period = "2 um" }',
        ":19: boundaries.surface_mass_flux_wave: has a period along x, and nothing repeats along r; leave it out",
    ),
    "bump wider than the block": (
        BOTTOM,
        BOTTOM + HELD + '\nsurface_temperature_bump = { amplitude = "1 K", radius = "7 um" }',
        ":21: boundaries.surface_temperature_bump.radius: 7 um reaches beyond the block, which ends at 6 um; write a smaller one, or a larger domain.width",
    ),
    "bump of a negative radius": (
        BOTTOM,
        BOTTOM + HELD + '\nsurface_temperature_bump = { amplitude = "1 K", radius = "-1 um" }',
        ':21: boundaries.surface_temperature_bump.radius: must be greater than 0, got "-1 um"',
    ),
    "bump of heat alone that ends": (
        BOTTOM,
        BOTTOM
        + HELD
        + '\nsurface_temperature_bump = { amplitude = "1 K", radius = "1 um", end = "1 ns" }',
        ':21: boundaries.surface_temperature_bump: start and end need [solver] kind = "melt-pool"; leave them out',
    ),
    "beam off the axis": (
        BEAM,
        BEAM + '\nposition = ["1 um", "0 um"]',
        ":7: laser.position: (1 um, 0 m) is beside the axis of a section (r, z), on which its beam lies; leave it out",
    ),
    "beam on a path": (
        BEAM,
        BEAM + '\npath = { kind = "linear", speed = "1 m/s" }',
        ':7: laser.path: takes the beam off the axis of a section (r, z); write geometry = "planar" and dimensions = 3 in [solver]',
    ),
    "pattern around an axis": (
        BEAM,
        'beam = { kind = "interference", period = "2 um" }\nspot = { diameter = "10 um", definition = "1/e^2" }',
        ':6: laser.beam.kind: waves that interfere make no light that is the same around an axis; write geometry = "planar" in [solver]',
    ),
    "spot wider than the block": (
        WIDTH,
        'width = "1.5 um"',
        ':12: domain.width: 1.5 um is the radius of the block, less than that of the spot, 2 um; write e.g. width = "4 um"',
    ),
    "negative r": (
        'depth = "0 nm"',
        'depth = "0 nm"\nx = "-1 um"',
        ":31: probes[1].x: -1 um lies outside the domain, which runs from 0 m to 6 um; place the probe inside",
    ),
    "negative radius of the block": (
        WIDTH,
        'width = "-6 um"',
        ':12: domain.width: must be greater than 0, got "-6 um"',
    ),
    "pulse whose times go back": (
        PULSE,
        'pulse = { kind = "tabulated", table = [["0 ns", 0.0], ["20 ns", 1.0], ["10 ns", 0.0]] }',
        ":7: laser.pulse: the times of a pulse table must rise from row to row; two rows at one time make a jump, three are too many",
    ),
    "absorptivity whose times go back": (
        PULSE,
        PULSE + '\nabsorptivity = { over_time = [["0 ns", 0.5], ["20 ns", 0.4], ["10 ns", 0.3]] }',
        ":8: laser.absorptivity.over_time: has times that go back; they must rise from row to row, two rows at one make a jump, three are too many",
    ),
    "ring inside out": (
        BEAM,
        'beam = { kind = "ring", radius = "2 um", inner_radius = "3 um" }',
        ":6: laser.beam.inner_radius: lies outside of radius, 2 um; give a smaller one",
    ),
    "order below one": (
        BEAM,
        'beam = { kind = "super-gaussian", radius_1e2 = "2 um", order = 0.5 }',
        ":6: laser.beam.order: must be at least 1, got 0.5",
    ),
}
