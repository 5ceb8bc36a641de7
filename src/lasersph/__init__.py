"""lasersph simulates what a laser pulse does to metal, with smoothed particle hydrodynamics."""

__version__ = "0.1.0"
