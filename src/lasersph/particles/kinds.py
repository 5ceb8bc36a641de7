"""Kinds of particles: what part a particle takes, one number each.

interior    of the body; in a melt pool solid beyond the support radius of the melt
leaving     on its way from the surface            ejected    has left, flies on
gone        beyond the edge of the domain          wall       of a wall
fluid       completely molten, or in a box that is all fluid: it moves
edge        solid next to fluid: v = 0, its pressure is an unknown
dummy       solid within the support radius of fluid, beyond the edge: v = 0, its pressure is
            that of the edge                                    [Demuth2020, Section 4.3]
"""

from __future__ import annotations

# numbers are stored in files: new kinds come last
INTERIOR, LEAVING, EJECTED, GONE, WALL, FLUID, EDGE, DUMMY = range(8)
NAMES = ("interior", "leaving", "ejected", "gone", "wall", "fluid", "edge", "dummy")
