# ruff: noqa: E501
"""Bad case files about ejection: replaced in good-ablation.toml."""

TIME = "[time]"
LASER = 'absorption = { kind = "surface" }'
RULE = "[ejection]\n"
PUBLISHED = RULE + 'model = "published"\n'
END = "\n\n[time]"

BAD_EJECTION_CASES = {
    "unknown model": (TIME, RULE + 'model = "publishd"' + END, ':32: solver.ejection.model: must be "enthalpy" or "published", got "publishd"; do you mean "published"?'),
    "unknown key of ejection": (TIME, RULE + 'modell = "published"' + END, ':32: solver.ejection.modell: unknown key; do you mean "model"?'),
    "preset of the other model": (TIME, RULE + 'preset = "depth"' + END, ':32: solver.ejection.preset: says nothing where model = "enthalpy"; leave it out or write model = "published"'),
    "unknown preset": (TIME, PUBLISHED + 'preset = "depths"' + END, ':33: solver.ejection.preset: must be "timeline" or "depth", got "depths"; do you mean "depth"?'),
    "preset and its parts": (TIME, PUBLISHED + 'preset = "depth"\nleave = "layer-below"' + END, ':34: solver.ejection.leave: preset = "depth" says that already; leave one of them out'),
    "distance without its length": (TIME, PUBLISHED + 'leave = "distance"' + END, ':31: solver.ejection.leave_distance: missing for leave = "distance"; write e.g. 0.677, in spacings'),
    "length without distance": (TIME, PUBLISHED + "leave_distance = 0.677" + END, ':31: solver.ejection.leave: a leave_distance needs leave = "distance"; write both'),
    "distance with a unit": (TIME, PUBLISHED + 'leave = "distance"\nleave_distance = "0.1 um"' + END, ':34: solver.ejection.leave_distance: must be a number, got "0.1 um"'),
    "distance backward": (TIME, PUBLISHED + 'leave = "distance"\nleave_distance = -1' + END, ":34: solver.ejection.leave_distance: must be greater than 0, got -1"),
    "unknown velocity of vapor": (TIME, RULE + 'velocity = "sonic"' + END, ':32: solver.ejection.velocity: must be "effusion" or "mean-normal", got "sonic"'),
    "two reflectivities": (LASER, LASER + "\nreflectivity = 0.75\n\n" + PUBLISHED + 'preset = "timeline"', ':15: solver.ejection.preset: "timeline" means a reflectivity of 0.8, but [laser] has another; leave one of them out, or write leave and leave_distance instead of the preset'),
    "ejection without light": ('[laser]\nfluence = "10 J/cm^2"\nbeam = { kind = "uniform" }\npulse = { kind = "square", duration = "10 ns" }\n' + LASER, '[ejection]\nmodel = "enthalpy"', ":6: solver.ejection: nothing leaves without a [laser]; add one or leave it out"),
}  # fmt: skip
"""Name -> (replaced, replacement, message after the file name)."""
