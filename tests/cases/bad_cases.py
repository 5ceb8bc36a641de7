# ruff: noqa: E501
"""Bad case files: what is replaced in good.toml, by what, and the message that must come.

Each entry: (replaced text, replacement, message after the file name). An empty replaced text means
that the replacement is appended. Bytes stand for files that are no text.
"""

FLUENCE = 'fluence = "0.6 J/cm^2"'
SPACING = 'spacing = "100 nm"'
BEAM = 'beam = { kind = "interference", period = "5 um" }'
PULSE = 'pulse = { kind = "gaussian", fwhm = "10 ns", center = "50 ns" }'
ABSORPTION = 'absorption = { kind = "beer-lambert" }'
MATERIAL = 'material = "steel-304-demuth"'
END = 'end = "200 ns"'
STEP = 'step = "1 ns"'
SPOT = 'spot = { diameter = "50 um", definition = "1/e^2" }'
DULL = (
    'material = { name = "dull", density = { value = "1 g/cm^3", source = "x" }, '
    'heat_capacity = { value = "1 J/(g K)", source = "x" }, '
    'conductivity = { value = "1 W/(m K)", source = "x" }, '
    'vaporization = { temperature = "2000 K", latent_heat = "1 MJ/kg", source = "x" } }'
)
BOTTOM = 'bottom = "adiabatic"'

BAD_CASES = {
    # quantities
    "no unit": (FLUENCE, "fluence = 0.6", ':6: laser.fluence: 0.6 has no unit; write e.g. "0.6 J/cm^2"'),
    "no unit in text": (FLUENCE, 'fluence = "0.6"', ':6: laser.fluence: "0.6" has no unit; write e.g. "0.6 J/cm^2"'),
    "fluence as N/m": (FLUENCE, 'fluence = "600 N/m"', ':6: laser.fluence: "600 N/m" is a surface tension, not a fluence; write e.g. "0.6 J/cm^2"'),
    "fluence as energy": (FLUENCE, 'fluence = "1 mJ"', ':6: laser.fluence: "1 mJ" is an energy, not a fluence; write e.g. "0.6 J/cm^2"'),
    "negative fluence": (FLUENCE, 'fluence = "-1 J/cm^2"', ':6: laser.fluence: must be greater than 0, got "-1 J/cm^2"'),
    "zero fluence": (FLUENCE, 'fluence = "0 J/cm^2"', ':6: laser.fluence: must be greater than 0, got "0 J/cm^2"'),
    "comma": (FLUENCE, 'fluence = "0,6 J/cm^2"', ':6: laser.fluence: the number in "0,6 J/cm^2" cannot be read; write e.g. "0.6 J/cm^2"'),
    "unquoted": (FLUENCE, "fluence = 0.6 J/cm^2", ':6: fluence: a number with a unit is text in TOML; write fluence = "0.6 J/cm^2"'),
    "NaN": (FLUENCE, "fluence = nan", ':6: laser.fluence: nan is not a finite number; write e.g. "0.6 J/cm^2"'),
    "NaN in text": (FLUENCE, 'fluence = "nan J/cm^2"', ':6: laser.fluence: "nan J/cm^2" does not start with a number; write e.g. "0.6 J/cm^2"'),
    "infinite": (END, "end = inf", ':29: time.end: inf is not a finite number; write e.g. "10 ns"'),
    "too large a number": (END, 'end = "1e999 s"', ':29: time.end: "1e999 s" is outside the range of floating-point numbers'),
    "boolean": (FLUENCE, "fluence = true", ':6: laser.fluence: true is not a fluence; write e.g. "0.6 J/cm^2"'),
    "table for a number": (FLUENCE, "fluence = {}", ':6: laser.fluence: is not a fluence; write e.g. "0.6 J/cm^2"'),
    "negative spacing": (SPACING, 'spacing = "-8 nm"', ':18: particles.spacing: must be greater than 0, got "-8 nm"'),
    "spacing in kg": (SPACING, 'spacing = "8 kg"', ':18: particles.spacing: "8 kg" has another dimension, not a length; write e.g. "8 nm"'),
    "unknown unit": (SPACING, 'spacing = "8 nanomts"', ':18: particles.spacing: unknown unit "nanomts" in "8 nanomts"; write e.g. "8 nm"'),
    "case of a unit": (SPACING, 'spacing = "8 NM"', ':18: particles.spacing: unknown unit "NM" (do you mean "nm"?) in "8 NM"; write e.g. "8 nm"'),
    "arithmetic": (SPACING, 'spacing = "9**9**9 m"', ':18: particles.spacing: the unit "**9**9 m" cannot be read in "9**9**9 m"; write e.g. "8 nm"'),
    "below absolute zero": ('"20 degC"', '"-300 degC"', ':3: initial_temperature: "-300 degC" is below absolute zero'),
    "temperature in coulomb": ('"20 degC"', '"20 C"', ':3: initial_temperature: unknown unit "C" (do you mean "degC"?) in "20 C"; write e.g. "298.15 K"'),
    "degC as a difference": (STEP, 'step = "1 ns"\ntemperature_change = "5 degC"', ':31: time.temperature_change: "5 degC" is a temperature, not a difference; write it in K'),
    # keys
    "unknown key": (FLUENCE, 'fluense = "0.6 J/cm^2"', ':6: laser.fluense: unknown key; do you mean "fluence"?'),
    "unknown table": ("[domain]", "[domian]", ':12: domian: unknown key; do you mean "domain"?'),
    "key of another table": ("[domain]", '[domain]\nspacing = "8 nm"', ':13: domain.spacing: unknown key; leave it out: particles.spacing is given'),
    "kind of a table without kinds": (BEAM, BEAM + '\nspot = { kind = "gaussian", diameter = "60 um", definition = "1/e^2" }', ":9: laser.spot.kind: unknown key; known here: diameter, definition, image, pixel_size, image_digest, extent, place, shift, scan_speed"),
    "key without a table": ("title", 'fluence = "1 J/cm^2"\ntitle', ':1: fluence: unknown key; leave it out: laser.fluence is given'),
    "duplicate key": (FLUENCE, FLUENCE + "\n" + FLUENCE, ":7: fluence: given twice; remove one"),
    "duplicate table": ("", "\n[laser]\n", ":41: [laser]: given twice; remove one"),
    "missing key": (SPACING, "", ":17: particles.spacing: missing; write spacing = \"100 nm\""),
    "missing table": ("[time]\nend = \"200 ns\"\nstep = \"1 ns\"\n", "", ": time: missing; write [time] with end = \"100 ns\""),
    "table as text": ("[time]\nend = \"200 ns\"\nstep = \"1 ns\"\n", "[solver.time]\n", ": time: missing; write [time] with end = \"100 ns\""),
    "future format": ("title", "schema_version = 3\ntitle", ":1: schema_version: must be 2, got 3"),
    "text for a table": ("[boundaries]\n" + BOTTOM, "boundaries = 3", ":20: particles.boundaries: unknown key; known here: spacing, arrangement, fine_depth, fine_width, coarsest, ratio, kernel, support_ratio"),
    # choices
    "unknown beam": ('kind = "interference"', 'kind = "interferance"', ':8: laser.beam.kind: must be "uniform" or "top-hat" or "gaussian" or "super-gaussian" or "ring" or "interference", got "interferance"; do you mean "interference"?'),
    "beam without kind": (BEAM, "beam = {}", ':8: laser.beam.kind: missing; write kind = "uniform"'),
    "unknown solver": ('kind = "conduction"', 'kind = "meltpool"', ':24: solver.kind: must be "conduction" or "melt-pool" or "ablation", got "meltpool"; do you mean "melt-pool"?'),
    "four dimensions": ("dimensions = 2", "dimensions = 4", ":25: solver.dimensions: must be 1 or 2 or 3, got 4"),
    "unknown plateau": ('plateau = "hold"', 'plateau = "held"', ':26: solver.plateau: must be "hold" or "clip" or "evaporate", got "held"; do you mean "hold"?'),
    "plateau beside a flux": ('plateau = "hold"', 'plateau = "clip"\nvaporization = "flux"', ':26: solver.plateau: "clip" says nothing where vaporization = "flux"; leave it out'),
    "pressure without a flux": ("[boundaries]\n", '[boundaries]\nambient_pressure = "0 Pa"\n', ':21: boundaries.ambient_pressure: says nothing but beside vaporization = "flux" in [solver]; leave it out or write that'),
    "fluence kind": ('"mean"', '"average"', ':7: laser.fluence_kind: must be "mean" or "peak", got "average"'),
    # laser
    "zero pulses": (PULSE, PULSE.replace(" }", ", count = 0 }"), ":9: laser.pulse.count: must be at least 1, got 0"),
    "half a pulse": (PULSE, PULSE.replace(" }", ", count = 1.5 }"), ":9: laser.pulse.count: must be a whole number, got 1.5"),
    "two pulses without period": (PULSE, PULSE.replace(" }", ", count = 2 }"), ':9: laser.pulse: 2 pulses need the time between them; write e.g. period = "1 us"'),
    "zero duration": (PULSE, PULSE.replace('"10 ns"', '"0 ns"'), ':9: laser.pulse.fwhm: must be greater than 0, got "0 ns"'),
    "pulse before the run": (PULSE, PULSE.replace('"50 ns"', '"5 ns"'), ":9: laser.pulse: a pulse of fwhm 10 ns centered at 5 ns begins before the run does; give a center of at least two fwhm, 20 ns"),
    "two energies": (FLUENCE, FLUENCE + '\nintensity = "1e9 W/m^2"', ":5: laser: a laser needs one statement of its energy, got fluence and intensity; leave all but one of fluence and intensity out"),
    "no energy": (FLUENCE, "", ':5: laser: a laser needs one statement of its energy, got none; write e.g. fluence = "1 J/cm^2" (one of fluence, intensity, pulse_energy, power)'),
    "intensity of a gaussian pulse": (FLUENCE, 'intensity = "1e9 W/m^2"', ':5: laser: intensity does not fix the energy of a gaussian pulse; write instead fluence = "1 J/cm^2"'),
    "reflectivity above one": (FLUENCE, FLUENCE + '\nreflectivity = "120 %"', ':7: laser.reflectivity: must be at most 1, got "120 %"'),
    "no optics anywhere": (MATERIAL, DULL, ":5: laser.reflectivity: material 'dull' has no reflectivity; write e.g. reflectivity = 0.9 in [laser]"),
    "energy of an endless pattern": (FLUENCE, 'pulse_energy = "10 uJ"', ':5: laser: pulse_energy has no meaning for the unbounded interference beam; write e.g. spot = { diameter = "50 um", definition = "1/e^2" }, or fluence'),
    "fluence and energy": (FLUENCE, FLUENCE + '\npulse_energy = "10 uJ"\n' + SPOT, ":5: laser: a laser needs one statement of its energy, got fluence and pulse_energy; leave all but one of fluence and pulse_energy out"),
    "no pulse energy": (FLUENCE, 'pulse_energy = "0 J"\n' + SPOT, ':6: laser.pulse_energy: must be greater than 0, got "0 J"'),
    "spot of any diameter": (FLUENCE, 'pulse_energy = "1 uJ"\nspot = { diameter = "50 um" }', ':7: laser.spot: the diameter of a spot may be that where 1/e^2 or half of the peak is left, or of a top hat; write definition = "1/e^2", "fwhm" or "top-hat"'),
    "spot smaller than a period": (FLUENCE, FLUENCE + '\n' + SPOT.replace("50 um", "4 um"), ":7: laser.spot.diameter: 4 um is smaller than a period of the pattern, 5 um; write a spot of several periods"),
    "spot of a spot": (BEAM, 'fluence_kind = "peak"\nbeam = { kind = "gaussian", radius_1e2 = "9 um" }\n' + SPOT, ":10: laser.spot: a gaussian beam is a spot by itself; leave spot out"),
    "image without a pixel size": (FLUENCE, 'pulse_energy = "1 uJ"\nspot = { image = "beam.png" }', ':7: laser.spot.pixel_size: missing; write e.g. pixel_size = "1.2 um"'),
    "scan without a rate": (FLUENCE, FLUENCE + '\nspot = { diameter = "50 um", definition = "fwhm", scan_speed = "1 m/s" }', ':7: laser.spot.scan_speed: needs the time between pulses; write e.g. repetition_rate = "10 kHz" in [laser.pulse]'),
    "period that does not fit": (BEAM, BEAM.replace("}", ', wavelength = "355 nm", angle = "5 deg" }'), ":8: laser.beam.period: 5 um does not fit the wavelength and the angle, which give 4.06929 um; leave it out"),
    "period below half a wavelength": (BEAM, BEAM.replace("5 um", "100 nm").replace("}", ', wavelength = "355 nm" }'), ":8: laser.beam.period: 100 nm is no period that 2 beams of 355 nm can make; give one above 177.5 nm"),
    "diameter of a top hat": (BEAM, 'beam = { kind = "top-hat", diameter = "9 um" }', ":8: laser.beam.diameter: unknown key; write half of it as radius, of a super-gaussian as radius_1e2; a pattern has laser.spot"),
    "width of a ring": (BEAM, 'beam = { kind = "ring", radius = "9 um", inner_radius = "4 um", width = "5 um" }', ":8: laser.beam.width: unknown key; write its radius, and inner_radius of a ring, each half of a diameter"),
    "five beams": (BEAM, BEAM.replace("}", ", beams = 5 }"), ":8: laser.beam.beams: must be 2 or 3 or 4, got 5"),
    "shares of one beam more": (BEAM, BEAM.replace("}", ", energy_shares = [0.2, 0.3, 0.5] }"), ":8: laser.beam.energy_shares: has 3 values for 2 beams; give each one"),
    "shares above one": (BEAM, BEAM.replace("}", ", energy_shares = [0.5, 0.6] }"), ":8: laser.beam.energy_shares: sum to 1.1; give shares that sum to 1"),
    "p without a wavelength": (BEAM, BEAM.replace("}", ', polarization = "p" }'), ':8: laser.beam.polarization: decides with the angle how far the beams interfere; write e.g. wavelength = "1064 nm" beside it'),
    "period and rate": (PULSE, PULSE.replace("}", ', period = "1 us", repetition_rate = "10 kHz" }'), ":9: laser.pulse: period and repetition_rate say the same (period = 1 / repetition_rate); leave one of them out"),
    "interference in 1-D": ("dimensions = 2", "dimensions = 1", ':15: domain.extent: half of a 1-D column means nothing; write extent = "full"'),
    "uneven beam in half a domain": (FLUENCE, FLUENCE + '\nposition = ["1 um", "0 um"]', ':16: domain.extent: this beam is not symmetric about x = 0; write extent = "full"'),
    # material
    "unknown material": (MATERIAL, 'material = "steal-304"', ':2: material: no material "steal-304"; do you mean "steel-304"?'),
    "missing material file": (MATERIAL, 'material = "none.toml"', ":2: material: {folder}/none.toml: no such file"),
    "unknown property": (MATERIAL, 'material = { base = "steel-304", colour = "3 m" }', ":2: material.colour: unknown key; leave it out"),
    "wrong property": (MATERIAL, 'material = { base = "steel-304", density = "3 m" }', ':2: material.density: "3 m" is a length, not a density; write e.g. "2700 kg/m^3"'),
    "hotter than melting": ('"20 degC"', '"2000 K"', ":3: initial_temperature: the initial temperature 2000 K is not below 1673 K, where melting of 'steel-304-demuth' begins"),
    # tables of a law
    "rows of a reflectivity": (FLUENCE, FLUENCE + '\nreflectivity = { rows = [["300 K", 0.3], ["2000 K", 0.2]] }', ':7: laser.reflectivity.rows: unknown key; do you mean "table"?'),
    "rows of an absorptivity": (FLUENCE, FLUENCE + '\nabsorptivity = { lines = [["300 K", 0.3], ["2000 K", 0.2]], table = [["300 K", 0.3], ["2000 K", 0.2]] }', ":7: laser.absorptivity.lines: unknown key; known here: table, over_time, path"),
    "a share above one in a table": (FLUENCE, FLUENCE + '\nreflectivity = { table = [["300 K", 0.3], ["2000 K", 1.2]] }', ":7: laser.reflectivity.table[2][2]: must be at most 1, got 1.2"),
    "one row of a table": (FLUENCE, FLUENCE + '\nreflectivity = { table = [["300 K", 0.3]] }', ":7: laser.reflectivity.table: must have at least 2 entries, got 1"),
    "half a row of a table": (FLUENCE, FLUENCE + '\nreflectivity = { table = [["300 K", 0.3], ["2000 K"]] }', ":7: laser.reflectivity.table[2][2]: missing; the row needs this entry, such as 1"),
    "rows of particles": (SPACING, SPACING + "\nrows = 3", ":19: particles.rows: unknown key; known here: spacing, arrangement, fine_depth, fine_width, coarsest, ratio, kernel, support_ratio"),
    # domain, particles, time
    "no width": ('width = "5 um"\n', "", ':12: domain.width: missing for 2-D; write e.g. width = "5 um", a period of the light'),
    "width against period": ('width = "5 um"', 'width = "6 um"', ':14: domain.width: 6 um is no whole number of the pattern\'s periods of 5 um; write width = "5 um"'),
    "thinner than particles": ('depth = "2 um"', 'depth = "200 nm"', ":13: domain.depth: 200 nm holds fewer than 4 particles of 100 nm; give a larger domain or a finer spacing"),
    "absurd number of particles": (SPACING, 'spacing = "1e-15 m"', ":18: particles.spacing: about 5e+18 particles, 8.84e+06 PiB of memory, more than lasersph can number; take a coarser spacing or a smaller domain"),
    "absurd number of steps": (STEP, 'step = "1e-30 s"', ":30: time.step: 2e+23 steps to the end at least, more than 1e+09; take longer steps or an earlier end"),
    "absurd number of snapshots": ("", '\n[output.snapshots]\ninterval = "1e-20 s"', ":42: output.snapshots.interval: 20000000000000 snapshots are too many: give an interval of at least 2 ps"),
    "zero end": (END, 'end = "0 ns"', ':29: time.end: must be greater than 0, got "0 ns"'),
    "periodic half": (BOTTOM, 'sides = "periodic"', ':21: boundaries.sides: half a block is symmetric at x = 0, "periodic" does not fit; write extent = "full" in [domain] or sides = "adiabatic"'),
    "temperature of an adiabatic face": (BOTTOM, 'bottom = "adiabatic"\nbottom_temperature = "300 K"', ':22: boundaries.bottom_temperature: says nothing where bottom = "adiabatic"; leave it out, or set bottom to "fixed-temperature" or "wall"'),
    "laser on a held surface": (BOTTOM, 'surface = "wall"\nsurface_temperature = "300 K"', ':21: boundaries.surface: a laser heats the surface, "wall" holds its temperature; remove one of the two'),
    "ambient without loss": (BOTTOM, 'ambient_temperature = "300 K"', ":21: boundaries.ambient_temperature: says nothing without convection or emissivity; give one of them or leave it out"),
    # keys that would change nothing
    "ratio of uniform particles": (SPACING, SPACING + "\nratio = 0.8", ':19: particles.ratio: belongs to graded particles; leave it out or write arrangement = "graded"'),
    "coarsest of uniform particles": (SPACING, SPACING + '\ncoarsest = "2 um"', ':19: particles.coarsest: belongs to graded particles; leave it out or write arrangement = "graded"'),
    "fine width of uniform particles": (SPACING, SPACING + '\nfine_width = "1 um"', ':19: particles.fine_width: belongs to graded particles; leave it out or write arrangement = "graded"'),
    "fine width of a column": ('width = "5 um"\nextent = "half"\n\n[particles]\nspacing = "100 nm"\n\n[boundaries]\nbottom = "adiabatic"\n\n[solver]\nkind = "conduction"\ndimensions = 2', '\n[particles]\nspacing = "100 nm"\narrangement = "graded"\nfine_width = "1 um"\n\n[solver]\ndimensions = 1', ":18: particles.fine_width: says nothing in 1-D, which has no x; leave it out or write dimensions = 2 in [solver]"),
    "fine width of a period": ('extent = "half"\n\n[particles]\nspacing = "100 nm"\n\n[boundaries]\nbottom = "adiabatic"', '\n[particles]\nspacing = "100 nm"\narrangement = "graded"\nfine_width = "1 um"\n\n[boundaries]\nsides = "periodic"', ':19: particles.fine_width: columns beside the middle of a period would be coarse where it repeats; leave it out, or write sides = "adiabatic" in [boundaries]'),
    "fine width in seconds": (SPACING, SPACING + '\narrangement = "graded"\nfine_width = "1 s"', ':20: particles.fine_width: "1 s" is a time, not a length; write e.g. "8 nm"'),
    "warm sides of a column": ('width = "5 um"\nextent = "half"\n\n[particles]\nspacing = "100 nm"\n\n[boundaries]\nbottom = "adiabatic"\n\n[solver]\nkind = "conduction"\ndimensions = 2', '\n[particles]\nspacing = "100 nm"\n\n[boundaries]\nsides = "wall"\n\n[solver]\ndimensions = 1', ":19: boundaries.sides: says nothing in 1-D, which has no x; leave it out or write dimensions = 2 in [solver]"),
    "sides beside left and right": (BOTTOM, BOTTOM + '\nleft = "adiabatic"\nright = "wall"\nsides = "free"', ":24: boundaries.sides: says nothing where left and right are given; leave it out"),
    "position of uniform light": (BEAM, 'beam = { kind = "uniform" }\nposition = ["1 um", "0 um"]', ":9: laser.position: says nothing of light that is the same everywhere; leave it out"),
    "position along lines": (BEAM, BEAM + '\nposition = ["0 um", "1 um"]', ':9: laser.position: its y says nothing where the light is the same at all y; write position = ["0 m", "0 m"]'),
    "snapshot after the end": ("[domain]", '[output.snapshots]\ntimes = ["1 us"]\n\n[domain]', ":13: output.snapshots.times: 1 us is after the end, 200 ns; leave it out or give a later end"),
    # probes
    "probe below the domain": ('depth = "1 um"', 'depth = "3 um"', ":38: probes[2].depth: 3 um lies below the domain of 2 um; place the probe inside"),
    "probe outside": ('x = "1 um"', 'x = "-1 um"', ":39: probes[2].x: -1 um lies outside the domain, which runs from 0 m to 2.5 um; place the probe inside"),
    "probes of one name": ('name = "deep"', 'name = "top"', ':32: probes: 2 probes are named "top"; give each its own name'),
    "probe without a name": ('name = "deep"\n', "", ':36: probes[2].name: missing; write name = "name"'),
    # files
    "empty file": (None, b"", ': material: missing; write material = "steel-304"'),
    "not UTF-8": (None, b'title = "\xe9"\n', ":1: byte 0xe9 is not UTF-8 text; save the file as UTF-8"),
    "UTF-16": (None, "title = 'a'".encode("utf-16"), ":1: byte 0xff is not UTF-8 text; save the file as UTF-8"),
    "unclosed text": (None, b'title = "a', ':1: title: text without its closing quotation mark; write title = "a"'),
    "text without its end": (FLUENCE, 'fluence = "0.6 J/cm^2', ':6: fluence: text without its closing quotation mark; write fluence = "0.6 J/cm^2"'),
    "no value": (None, b"title =\n", ":1: not valid TOML: invalid value"),
    "no TOML": (None, b"<xml>\n", ":1: not valid TOML: invalid statement"),
    "nested brackets": (None, b"a = " + b"[" * 10_000, ": brackets nested too deeply"),
    "huge integer": (None, b"a = " + b"9" * 10_000, ": not valid TOML: an integer of thousands of digits"),
    "zero bytes": (None, b"\x00\x01\x02", ":1: not valid TOML: invalid statement"),
}  # fmt: skip
"""Name -> (replaced, replacement or whole file, message after the file name)."""
