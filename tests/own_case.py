"""A small case as a user writes one: a second of computing, without a warning."""

OWN_CASE = """\
title = "mine"
material = "steel-304-demuth"

[laser]
fluence = "0.3 J/cm^2"
absorption = { kind = "surface" }
pulse = { kind = "gaussian", fwhm = "10 ns", center = "30 ns" }
beam = { kind = "uniform" }

[domain]
depth = "2 um"

[particles]
spacing = "40 nm"

[solver]
kind = "conduction"
dimensions = 1

[time]
end = "1 ns"
"""
