# ruff: noqa: E501
"""Bad cases with two temperatures: see `bad_cases`."""

KIND = 'kind = "conduction"'
HEAT = KIND + '\nheat = "two-temperature"'
METAL = 'material = "steel-304-demuth"'
IRON = ", electrons = { heat_capacity = %s, coupling = %s } }"
COLLIDING = ', electrons = { heat_capacity = "2e4 J/(m^3 K)", coupling = "2e16 W/(m^3 K)", %s } }'
RATES = 'collision_rate = "1e11 1/(K s)", plasma_frequency = "1e16 rad/s", highest_collision_rate = "%s"'
CHANGED = 'material = { base = "steel-304-demuth"'

BAD_ELECTRON_CASES = {
    "metal without electrons": (
        KIND,
        HEAT,
        ':2: material.electrons: missing, and heat = "two-temperature" needs it; write in [material.electrons] e.g. heat_capacity = { coefficient = "70 J/(m^3 K^2)" } and coupling = "2e16 W/(m^3 K)" of "steel-304-demuth", or choose a metal that has them: lasersph material list',
    ),
    "keys of two temperatures": (
        KIND,
        KIND + "\nstep_error = 0.02",
        ':25: solver.step_error: belongs to heat = "two-temperature"; leave it out or write that',
    ),
    "no share to be equal within": (
        KIND,
        KIND + "\nequal_within = 0",
        ":25: solver.equal_within: must be greater than 0, got 0",
    ),
    "electrons without coupling": (
        METAL,
        CHANGED + ', electrons = { heat_capacity = "2e4 J/(m^3 K)" } }',
        ':2: material.electrons.coupling: missing; write coupling = "2.1e16 W/(m^3 K)"',
    ),
    "heat of electrons per mass": (
        METAL,
        CHANGED + IRON % ('"20 J/(kg K)"', '"2e16 W/(m^3 K)"'),
        ':2: material.electrons.heat_capacity: "20 J/(kg K)" is a specific heat, not a volumetric heat; write e.g. "2.1e4 J/(m^3 K)"',
    ),
    "collisions without a plasma": (
        METAL,
        CHANGED + COLLIDING % 'collision_rate = "1e11 1/(K s)"',
        ":2: material.electrons: collision_rate and plasma_frequency go together; give both",
    ),
    "a limit of no collisions": (
        METAL,
        CHANGED + COLLIDING % 'highest_collision_rate = "1e16 1/s"',
        ":2: material.electrons.highest_collision_rate: says nothing without collision_rate and plasma_frequency; leave it out",
    ),
    "fewer collisions than in cold metal": (
        METAL,
        CHANGED + COLLIDING % RATES % "1e13 1/s",
        ":2: material.electrons.highest_collision_rate: must lie above the 3e+13 1/s of the metal at 300 K",
    ),
    "a collision rate of two units": (
        METAL,
        CHANGED + COLLIDING % 'collision_rate = "1e14 1/s", plasma_frequency = "1e16 rad/s"',
        ':2: material.electrons.collision_rate: "1e14 1/s" is a frequency, not a collision rate; write e.g. "1.23e11 1/(K s)"',
    ),
    "a plasma of no angle": (
        METAL,
        CHANGED + COLLIDING % 'collision_rate = "1e11 1/(K s)", plasma_frequency = "-1e16 rad/s"',
        ':2: material.electrons.plasma_frequency: must be greater than 0, got "-1e16 rad/s"',
    ),
    "electrons that cool as they heat": (
        METAL,
        CHANGED + IRON % ('"-2e4 J/(m^3 K)"', '"2e16 W/(m^3 K)"'),
        ":2: material.electrons.heat_capacity: must be positive at every temperature",
    ),
}
