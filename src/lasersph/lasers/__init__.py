"""Lasers: beam shape x pulse shape x absorption (x path), pure data and closed forms.

beams, shaped_beams,
interference          where the light falls: exact means over surface cells
pulses                when it comes: exact shares between two times
absorption            how deep it is left: exact shares of depth cells
reflectivity          what does not enter, as a function of the surface temperature
spot                  the envelope under which a pattern lies, and its local fluence
fluence_map           the fluence of a pulse as maps
path                  where a moving spot is
rings                 exact means over rings about the axis
laser                 all of them together, and the energy that sets the scale
"""

from lasersph.lasers.absorption import Absorption, BeerLambertAbsorption, SurfaceAbsorption
from lasersph.lasers.beams import GaussianBeam, TopHatBeam, UniformBeam
from lasersph.lasers.interference import InterferenceBeam
from lasersph.lasers.laser import Laser
from lasersph.lasers.laser_keys import Beam
from lasersph.lasers.path import LinearPath, Path, TabulatedPath
from lasersph.lasers.pulses import GaussianPulse, Pulse, SquarePulse, TabulatedPulse
from lasersph.lasers.reflectivity import ReflectivityTable
from lasersph.lasers.shaped_beams import RingBeam, SuperGaussianBeam
from lasersph.lasers.spot import Spot, SpotFluence
from lasersph.lasers.wave import Wave

__all__ = [
    "Absorption",
    "Beam",
    "BeerLambertAbsorption",
    "GaussianBeam",
    "GaussianPulse",
    "InterferenceBeam",
    "Laser",
    "LinearPath",
    "Path",
    "Pulse",
    "ReflectivityTable",
    "RingBeam",
    "Spot",
    "SpotFluence",
    "SquarePulse",
    "SuperGaussianBeam",
    "SurfaceAbsorption",
    "TabulatedPath",
    "TabulatedPulse",
    "TopHatBeam",
    "UniformBeam",
    "Wave",
]
