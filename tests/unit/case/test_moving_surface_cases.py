"""What is refused of cases whose surface moves, and where their keys are read."""

import pytest

from lasersph.case import Case, load_case
from lasersph.input import CaseError


def changed(table, **values):
    """The shipped film with other values in one of its tables."""
    data = load_case("moving-film").resolved()
    data[table] = data[table] | values
    return Case.model_validate(data)


@pytest.mark.parametrize(
    ("table", "values", "words"),
    [
        ("material", {"surface_tension": None}, 'surface_tension = "1.6 N/m"'),
        ("domain", {"width": 4e-7}, "needs 12 columns"),
        ("solver", {"pressure": "published"}, '"multigrid"'),
    ],
)
def test_refused(table, values, words):
    """With what to write instead."""
    with pytest.raises(ValueError, match=words):
        changed(table, **values)


@pytest.mark.parametrize(
    ("flow", "words"),
    [
        ({"initial_surface": {"amplitude": 2.7e-7, "period": 5e-6}}, "of liquid, less than"),
        ({"initial_surface": {"amplitude": 1e-7, "period": 1e-7}}, "slope of 6.28"),
        ({"right": {"kind": "moving-wall", "velocity": 1.0}}, "no place to which"),
        ({"surface": "flat", "initial_surface": {"amplitude": 1e-9, "period": 1e-7}}, "nothing"),
    ],
)
def test_refused_flow(flow, words):
    """Starts and sides that do not fit."""
    given = load_case("moving-film").resolved()["solver"]["flow"]
    with pytest.raises(ValueError, match=words):
        changed("solver", flow=given | flow)


@pytest.mark.parametrize("name", ["surface_pressure_wave", "surface_mass_flux_wave"])
def test_drives_need_a_surface_that_moves(name):
    """A flat one takes neither pressure nor mass flux."""
    data = load_case("marangoni-layer").resolved()
    data["boundaries"][name] = {"amplitude": 1.0, "period": 1e-6}
    with pytest.raises(ValueError, match="where the surface is flat"):
        Case.model_validate(data)


def test_times_of_a_wave():
    """It ends after it starts, and only a flow knows when."""
    wave = {"amplitude": 1.0, "period": 1e-6, "start": 2e-9, "end": 1e-9}
    with pytest.raises(ValueError, match="not after start"):
        changed("boundaries", surface_temperature_wave=wave)
    faces = changed("boundaries").boundaries
    assert faces.surface_temperature_wave.share_of(1.9e-8, 2.1e-8) == pytest.approx(0.5)
    assert faces.surface_temperature_wave.share_of(0.0, 1e-9) == 1.0
    assert faces.surface_temperature_wave.share_of(2e-8, 2e-8) == 0.0


def test_a_pool_whose_surface_is_flat_by_name():
    """`surface = "flat"` alone leaves a pool a pool, and so does "moving"."""
    pool = load_case("dlip-steel", ("solver.kind=melt-pool", "solver.flow.surface=flat"))
    assert pool.flow is None and not pool.surface_moves
    moving = (
        "solver.kind=melt-pool",
        "solver.flow.surface=moving",
        "material.base=steel-304-demuth",
    )
    found = load_case("dlip-steel", (*moving, "material.surface_tension=1.6 N/m"))
    assert found.flow is None and found.surface_moves
    with pytest.raises(CaseError, match='beside base = "steel-304-demuth" in'):
        load_case("dlip-steel", moving)


def test_files_of_version_1(tmp_path):
    """`[flow]` beside `[solver]`, with all that came later."""
    text = load_case("moving-film").text.replace("schema_version = 2", "schema_version = 1")
    file = tmp_path / "old.toml"
    wave = 'surface = "moving"\ninitial_surface = { amplitude = "1 nm", period = "5.05 um" }'
    file.write_text(text.replace("[solver.flow]", "[flow]").replace('surface = "moving"', wave))
    case = load_case(file)
    assert case.surface_moves and case.flow.initial_surface.amplitude == 1e-9
