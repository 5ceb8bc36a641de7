"""Studies: many runs of one case, for an answer that a single run cannot give.

uncertainty          how sure the numbers of one run are: discretization, uncertain inputs
spacing_study        what the numbers of a case tend to as the particles get finer, and how surely
fluence_threshold    the fluence at which melting, boiling or ablation begins
calibration_run      unknowns of a case from measured values, with honest bands
find_settings        settings of a sweep that reach wanted values; find_runs: with runs of its own
emulator             a Gaussian process through some runs: a number at keys that none of them has
sensitivity          which keys of a sweep a number depends on: Sobol indices, Morris screening
maps                 a number of a sweep over its keys, and where metal melts, boils or is ablated
spot_threshold       the same of a Gaussian spot from its craters, and how much they remove
"""

from lasersph.studies.calibration import Calibration, NoCalibration, calibrate_with
from lasersph.studies.calibration_plan import CalibrationPlan
from lasersph.studies.calibration_reading import read_calibration_plan
from lasersph.studies.calibration_run import calibrate
from lasersph.studies.companions import Input, inputs_of, read_input
from lasersph.studies.emulator import Box, Emulator, box_of, fit_emulator
from lasersph.studies.find_runs import find
from lasersph.studies.find_settings import FoundSettings, Target, find_settings, parse_target
from lasersph.studies.fluence_threshold import Threshold, Trial, show_energy, threshold
from lasersph.studies.maps import process_map
from lasersph.studies.sensitivity import Sensitivity, assess_sensitivity
from lasersph.studies.spacing_study import SpacingStudy, StudyRow, converge
from lasersph.studies.spot_threshold import SpotCrater, SpotThreshold, no_spot, spot_threshold
from lasersph.studies.uncertainty import assess_uncertainty
from lasersph.studies.variation import changed

__all__ = [
    "Box",
    "Calibration",
    "CalibrationPlan",
    "Emulator",
    "FoundSettings",
    "Input",
    "NoCalibration",
    "Sensitivity",
    "SpacingStudy",
    "SpotCrater",
    "SpotThreshold",
    "StudyRow",
    "Target",
    "Threshold",
    "Trial",
    "assess_sensitivity",
    "assess_uncertainty",
    "box_of",
    "calibrate",
    "calibrate_with",
    "changed",
    "converge",
    "find",
    "find_settings",
    "fit_emulator",
    "inputs_of",
    "no_spot",
    "parse_target",
    "process_map",
    "read_calibration_plan",
    "read_input",
    "show_energy",
    "spot_threshold",
    "threshold",
]
