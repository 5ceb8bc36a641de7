"""Closed-form and reference solutions of heat conduction and flow, NumPy and SciPy only.

half_space      surface heated by pulses of constant flux [Alshaer2017, A.1-A.4]
pulsed_source   Gaussian pulse absorbed in the volume under an interference pattern
slab            the same in a layer of finite depth with an insulated bottom
stefan          melting of a half-space held hot at its surface (Neumann's solution)
melt_depth      estimate of the melted depth under a pulse, for laying out fine particles
taylor_green    decaying vortices in a periodic box
thermocapillary_layer  slow flow of a layer whose surface is warm and cold in turns
liquid_film     small waves and drives of a film whose surface is free, exact in time
plane_flows     between parallel planes, from rest: Couette, Poiseuille, a sheared surface
convergence     observed order, Richardson value, grid convergence index

Everything takes plain numbers and arrays in SI; in conduction depth is counted downward from the
surface, in flows z upward.
"""
