"""Words of other programs for the keys of a case, so that `check` can say ours.

A key in full, or beginning with a dot inside its own table; several are tried in turn. What stands
behind a semicolon is what to do where none of them fits. Words may name their table first.
"""

from lasersph.materials.other_words import MATERIAL_WORDS, SLOPES

HALF = "; write half of it as radius, of a super-gaussian as radius_1e2; a pattern has laser.spot"
SLOPE = '; write surface_tension_slope = "-0.4 mN/(m K)" in [material]'

OTHER_WORDS = MATERIAL_WORDS | {
    # material
    "emissivity": "material.optics.emissivity boundaries.emissivity",
    "absorptivity": "laser.absorptivity",
    "absorptance": "laser.absorptivity",
    **dict.fromkeys(SLOPES, SLOPE),
    # laser
    "wavelength": "laser.wavelength",
    "energy": "laser.pulse_energy",
    "energy_per_pulse": "laser.pulse_energy",
    "repetition_rate": "laser.pulse.repetition_rate",
    "rep_rate": "laser.pulse.repetition_rate",
    "rate": "laser.pulse.repetition_rate",
    "frequency": "laser.pulse.repetition_rate",
    "scan_velocity": "laser.spot.scan_speed",
    "number_of_beams": "laser.beam.beams",
    "pulse_duration": "laser.pulse.duration laser.pulse.fwhm",
    "pulse_length": "laser.pulse.duration laser.pulse.fwhm",
    "duration": "laser.pulse.duration laser.pulse.fwhm time.end",
    "pulse_width": "laser.pulse.fwhm laser.pulse.duration",
    "spot_radius": "laser.beam.radius_1e2 laser.beam.radius",
    "beam_radius": "laser.beam.radius_1e2 laser.beam.radius",
    "radius": "laser.beam.radius_1e2 laser.beam.radius",
    "waist": "laser.beam.radius_1e2 laser.beam.radius",
    "w0": "laser.beam.radius_1e2 laser.beam.radius",
    "spot_diameter": "laser.beam.diameter_1e2",
    "beam_diameter": "laser.beam.diameter_1e2",
    "spot_size": "laser.beam.diameter_1e2",
    "beam.diameter": "laser.beam.diameter_1e2" + HALF,
    "diameter": "laser.beam.diameter_1e2",
    "beam.width": "; write its radius, and inner_radius of a ring, each half of a diameter",
    "profile": "laser.beam.kind",
    "speed": "laser.path.velocity",
    # block and time
    "height": "domain.depth",
    "thickness": "domain.depth",
    "length": "domain.width",
    "size": "; write depth and width in [domain]",
    "dx": "particles.spacing",
    "resolution": "particles.spacing",
    "particle_spacing": "particles.spacing",
    "temperature": "initial_temperature",
    "t0": "initial_temperature",
    "ambient": "boundaries.ambient_temperature",
    "type": ".kind",
    "dim": "solver.dimensions",
    "dimension": "solver.dimensions",
    "end_time": "time.end",
    "t_end": "time.end",
    "dt": "time.step",
    "time_step": "time.step",
    "timestep": "time.step",
    "boundary": "boundaries",
    "geometry": "domain",
    "mesh": "particles",
    "probe": "probes",
}
