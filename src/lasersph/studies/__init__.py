"""Studies: many runs of one case, for an answer that a single run cannot give.

spacing_study        what the numbers of a case tend to as the particles get finer, and how surely
fluence_threshold    the fluence at which melting or boiling begins
"""

from lasersph.studies.fluence_threshold import Threshold, Trial, show_energy, threshold
from lasersph.studies.spacing_study import SpacingStudy, StudyRow, converge
from lasersph.studies.variation import changed

__all__ = [
    "SpacingStudy",
    "StudyRow",
    "Threshold",
    "Trial",
    "changed",
    "converge",
    "show_energy",
    "threshold",
]
