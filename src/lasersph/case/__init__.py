"""Case: the whole problem as one frozen model made of the rooms' own models.

contents         the model of all keys
case             the same, checked together, as plain data, its hash
material_choice  a material by name, by path, or changed in the case
checks           what contradicts between rooms
size             how large a case is before anything is allocated, and how much of it is active
conversion       keys of older files at their present places
overrides        --set key=value
loading          files, shipped cases, new case files
"""

from lasersph.case.case import Case
from lasersph.case.checks import refuse_if_too_large
from lasersph.case.contents import SCHEMA_VERSION
from lasersph.case.loading import CaseFile, available_cases, case_file, load_case, write_new_case
from lasersph.case.size import estimate_count

__all__ = [
    "SCHEMA_VERSION",
    "Case",
    "CaseFile",
    "available_cases",
    "case_file",
    "estimate_count",
    "load_case",
    "refuse_if_too_large",
    "write_new_case",
]
