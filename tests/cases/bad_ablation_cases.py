# ruff: noqa: E501
"""Bad case files about matter that moves and ablates: replaced in good-ablation.toml."""

KIND = 'kind = "ablation"\n'
SOUND = 'sound_speed = "1000 m/s"'
SIDES = 'sides = "periodic"'
SURFACE = 'surface = "free"'
TIME = "[time]"
WAVE = '[motion]\nkind = "sound-wave"\namplitude = "1 m/s"\n\n[time]'

BAD_ABLATION_CASES = {
    "no speed of sound": (SOUND + "\n", "", ':26: solver.sound_speed: missing; write sound_speed = "1000 m/s"'),
    "speed of sound as a time": (SOUND, 'sound_speed = "1000 s"', ':29: solver.sound_speed: "1000 s" is a time, not a velocity; write e.g. "10 m/s"'),
    "sound that stands": (SOUND, 'sound_speed = "0 m/s"', ':29: solver.sound_speed: must be greater than 0, got "0 m/s"'),
    "motion under conduction": (KIND + "dimensions = 2\n" + SOUND + "\n\n" + TIME, 'dimensions = 2\n\n[motion]\nkind = "uniform"\nx = "1 m/s"\n\n[time]', ':29: solver.motion: unknown key; belongs to kind = "ablation"'),
    "ejection under conduction": (KIND + "dimensions = 2\n" + SOUND + "\n\n" + TIME, 'dimensions = 2\n\n[ejection]\nmodel = "enthalpy"\n\n[time]', ':29: solver.ejection: unknown key; belongs to kind = "ablation"'),
    "graded particles": ('spacing = "0.2 um"', 'spacing = "0.2 um"\narrangement = "graded"', ':18: particles.arrangement: particles that move need one size; write "uniform"'),
    "face of given temperature": (SIDES, 'sides = "fixed-temperature"', ':24: boundaries.sides: "fixed-temperature" holds the face itself; write "wall" for particles of that temperature'),
    "flux": ('bottom = "wall"', 'bottom = "prescribed-flux"\nbottom_flux = "1 W/m^2"', ':23: boundaries.bottom: "prescribed-flux" is for bodies at rest; write "adiabatic" or "wall"'),
    "narrow period": ('width = "3 um"', 'width = "1 um"', ":14: domain.width: 1 um must be more than twice the support and its skin, 1.32 um; take a wider domain or a finer spacing"),
    "room beside a period": (TIME, '[vessel]\nright = "1 um"\n\n[time]', ":32: solver.vessel.right: no wall stands on a periodic side; leave it out"),
    "wave without period": (TIME, WAVE, ':32: solver.motion.kind: a sound wave runs through a block that is periodic in z; write surface = "periodic" and bottom = "periodic" in [boundaries]'),
    "large wave": (TIME, WAVE.replace("1 m/s", "200 m/s"), ":33: solver.motion.amplitude: 200 m/s is no small wave where sound runs at 1000 m/s; take less than a tenth"),
    "weightless water": (TIME, "[motion]\nhydrostatic = true\nkind = 'rest'\n\n[time]", ":32: solver.motion.hydrostatic: nothing weighs anything without gravity in [solver]"),
    "walled surface in light": (SURFACE, 'surface = "wall"\nsurface_temperature = "300 K"', ':22: boundaries.surface: a laser heats the surface, "wall" holds its temperature; remove one of the two'),
    "no latent heat": (SOUND, SOUND + "\nphase_change = false", ':30: solver.phase_change: the enthalpy model of ejection is about latent heats; leave it out, or write model = "published" in [solver.ejection]'),
    "light that goes deep": ('kind = "surface"', 'kind = "beer-lambert"', ':10: laser.absorption.kind: matter that moves takes all light in at what it meets first; write absorption = { kind = "surface" }'),
    "losses of a walled surface": (SURFACE, 'surface = "wall"\nsurface_temperature = "300 K"\nconvection = "10 W/(m^2 K)"', ':24: boundaries.convection: says nothing where surface = "wall", as no surface lies open; leave it out or write surface = "free"'),
    "height of walls that are not there": (TIME, '[vessel]\nabove = "1 um"\n\n[time]', ":32: solver.vessel.above: there are no side walls that could be higher; leave it out"),
    "velocity along y in a section": (TIME, '[motion]\nkind = "uniform"\ny = "1 m/s"\n\n[time]', ":33: solver.motion.y: says nothing in 2-D, which has no y; leave it out or write dimensions = 3 in [solver]"),
    "trace outside": (TIME, '[[traces]]\nname = "deep"\ndepth = "30 um"\n\n[time]', ":33: traces[1].depth: 30 um lies below the domain of 20 um; place the trace inside"),
    "traces of one name": (TIME, '[[traces]]\nname = "a"\n\n[[traces]]\nname = "a"\n\n[time]', ':31: traces: 2 traces are named "a"; give each its own name'),
    "box of a melt pool": (TIME, '[flow]\nleft = "no-slip"\n\n[time]', ":31: flow: unknown key; leave it out"),
}  # fmt: skip
