"""Particles: fields, filling of a domain, neighbor lists; knows no conditions."""

from lasersph.particles.domain import Domain
from lasersph.particles.geometry import Geometry
from lasersph.particles.lattice import Lattice

__all__ = ["Domain", "Geometry", "Lattice"]
