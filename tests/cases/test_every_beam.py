"""Every kind of beam with every solver: built, checked, stepped and observed, or refused."""

import pytest
from test_every_material import case_of

from lasersph.input import CaseError
from lasersph.simulation import forecast, run

BEAMS = {
    "uniform": ("laser.beam={ kind = 'uniform' }",),
    "top-hat": ("laser.beam={ kind = 'top-hat', radius = '1 um' }",),
    "gaussian": (
        "laser.beam={ kind = 'gaussian', radius_1e2 = '1 um' }",
        "laser.fluence_kind=peak",
    ),
    "super-gaussian": (
        "laser.beam={ kind = 'super-gaussian', radius_1e2 = '1 um' }",
        "laser.fluence_kind=peak",
    ),
    "ring": ("laser.beam={ kind = 'ring', radius = '1 um', inner_radius = '0.5 um' }",),
    "two beams": ("laser.beam={ kind = 'interference', period = '2 um' }",),
    "whole spot": (
        "laser.spot={ diameter = '1 um', definition = '1/e^2', extent = 'whole' }",
        "boundaries.sides=adiabatic",
    ),
    "cell of a spot": ("laser.spot={ diameter = '50 um', definition = 'top-hat' }",),
    "four beams": ("laser.beam={ kind = 'interference', period = '2 um', beams = 4 }",),
}


@pytest.mark.parametrize("solver", ["conduction", "melt-pool", "ablation"])
@pytest.mark.parametrize("beam", BEAMS)
def test_every_beam(beam, solver, tmp_path):
    """Light is absorbed in the first steps; `check` says how hot it makes the surface."""
    if beam == "four beams":
        with pytest.raises(CaseError, match="varies along y"):
            case_of(tmp_path, "steel-304", solver, BEAMS[beam])
        return
    case = case_of(tmp_path, "steel-304", solver, BEAMS[beam])
    heating = forecast(case).heating
    assert heating is not None and heating.temperature > case.initial_temperature
    summary = run(case, tmp_path / "run", threads=1).summary
    assert summary["steps"] >= 2 and summary["energy"]["absorbed_J"] > 0.0
