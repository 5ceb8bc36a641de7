"""Materials: metals as TOML files, each number with unit, source and range; their heat curves."""

from lasersph.materials.caloric_curve import CaloricCurve
from lasersph.materials.checking import Finding, check_material
from lasersph.materials.loading import available_materials, load_material, material_file
from lasersph.materials.material import Material
from lasersph.materials.optics import NoOptics, Optics
from lasersph.materials.property import Law, Property
from lasersph.materials.sections import Melting, Vaporization

__all__ = [
    "CaloricCurve",
    "Finding",
    "Law",
    "Material",
    "Melting",
    "NoOptics",
    "Optics",
    "Property",
    "Vaporization",
    "available_materials",
    "check_material",
    "load_material",
    "material_file",
]
