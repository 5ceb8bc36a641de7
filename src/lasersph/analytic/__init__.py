"""Closed-form and reference solutions of heat conduction, NumPy and SciPy only.

half_space      surface heated by pulses of constant flux [Alshaer2017, A.1-A.4]
pulsed_source   Gaussian pulse absorbed in the volume under an interference pattern
slab            the same in a layer of finite depth with an insulated bottom
stefan          melting of a half-space held hot at its surface (Neumann's solution)
melt_depth      estimate of the melted depth under a pulse, for laying out fine particles
convergence     observed order, Richardson value, grid convergence index

Everything takes plain numbers and arrays in SI; depth is counted downward from the surface.
"""
