"""Bad cases with two temperatures, each refused in one line that names the key."""

import pytest

from lasersph.case import load_case
from lasersph.input import CaseError


@pytest.mark.parametrize(
    ("settings", "words"),
    [
        (
            ("time.step=20 fs", "laser.pulse.fwhm=15 fs"),
            r"time\.step: 20 fs is too long for the pulse of .*, whose light it would jump over; "
            r'leave it out, or write step = ".*" or less',
        ),
        (
            ("solver.kind=melt-pool", "solver.dimensions=2", "material=steel-304-demuth",
             "laser.reflectivity=0.5", "domain.width=1 um", "solver.flow.surface=flat"),
            r"material\.electrons: missing, and heat = \"two-temperature\" needs it; write in "
            r"\[material\.electrons\] e\.g\. heat_capacity = .* and coupling = ",
        ),
        (("solver.scheme=explicit",), r'solver\.scheme: "explicit" does not go with heat = '),
        (("solver.equal_within=0.7",), r"solver\.equal_within: must be less than 0\.5"),
    ],
)  # fmt: skip
def test_refused(settings, words):
    """One problem in a case that is right without it."""
    with pytest.raises(CaseError, match=words):
        load_case("short-pulse-gold", settings)
