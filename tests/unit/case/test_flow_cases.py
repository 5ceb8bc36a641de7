"""Cases of pools that contradict themselves, and materials written into a case."""

import pytest

from lasersph.case import Case, load_case
from lasersph.input import CaseError
from lasersph.solvers.conduction.settings import ConductionSettings
from lasersph.solvers.melt_pool.settings import MeltPoolSettings

POOL = "solver.kind=melt-pool"
BARE = ("laser=", "probes=")
SPACE = ("solver.dimensions=3",)
ONE_SPOT = ("laser.beam.kind=gaussian", "laser.beam.radius_1e2=2 um", "laser.beam.beams=")
QUARTER_OF_DOTS = ("domain.extent=quarter", "laser.beam.beams=4")


def refused(*settings, case="dlip-steel"):
    """What a case with settings is refused with."""
    with pytest.raises(CaseError) as error:
        load_case(case, [POOL, *settings])
    return str(error.value)


def test_sides_of_a_box():
    """`sides` hold for all four but those that have a key of their own; y is there in 3-D alone."""
    box = load_case("lid-driven-cube", ["solver.flow.front=symmetry"]).flow
    assert box is not None
    kinds = {face: side.kind for face, side in box.faces.items()}
    assert kinds["front"] == "symmetry"
    assert {kinds[face] for face in ("left", "right", "back")} == {"no-slip"}
    message = refused("solver.flow.front=no-slip", case="lid-driven-cavity")
    assert "solver.flow.front: says nothing in 2-D, which has no y" in message
    message = refused("domain.extent=quarter", case="lid-driven-cube")
    assert 'solver.flow.sides: a quarter of a box is symmetric at x = 0, "no-slip"' in message
    message = refused("solver.flow.back=periodic", case="lid-driven-cube")
    assert "solver.flow.back: periodic on one side only" in message


def rests(*settings, case="lid-driven-cavity"):
    """Frame of a shipped case that does not say it, and how far its particles see [spacings]."""
    found = load_case(case, ["solver.frame=", *settings])
    return found.solver.frame, found.particles.support_over_spacing


@pytest.mark.parametrize(
    "setting",
    ["solver.shifting=0.01", "solver.pressure=published", "solver.viscosity=explicit",
     "solver.step_limits=published"],
)  # fmt: skip
def test_particles_of_a_box_rest_unless_it_asks_for_moving_ones(setting):
    """They see 2.6 spacings far, or as far as the case says; those that move 3.75."""
    assert rests() == ("eulerian", 2.6)
    assert rests("particles.support_ratio=3.1") == ("eulerian", 3.1)
    assert rests("particles.kernel=cubic-spline") == ("eulerian", 3.0)
    assert rests(setting) == (None, 3.75)


def test_particles_of_pools_and_below_moving_surfaces_move():
    """And those of sections are not asked."""
    assert rests(case="moving-film") == (None, 3.75)
    assert rests(POOL, case="dlip-steel") == (None, 3.75)
    assert rests("solver.flow.surface=flat", case="spot-film") == (None, 3.75)


def test_a_pool_takes_the_case_of_heat():
    """The shipped cases of interference become pools by one setting."""
    for name in ("dlip-steel", "dlip-aluminium"):
        solver = load_case(name, [POOL, "solver.shifting=0"]).solver
        assert isinstance(solver, MeltPoolSettings)
        assert (solver.plateau, solver.pressure, solver.shifting) == ("hold", "multigrid", 0.0)


def test_kind_may_be_left_out():
    """Without kind it is conduction."""
    case = load_case("stefan", ["solver.kind="])
    assert isinstance(case.solver, ConductionSettings) and case.solver.dimensions == 1


@pytest.mark.parametrize(
    ("settings", "message"),
    [
        (
            BARE,
            "laser: missing: nothing would melt; give [laser] or a face of given temperature",
        ),
        (("solver.phase_change=false",), "solver.phase_change: nothing melts, so nothing flows"),
        (("material=aluminium-aa6014",), '"aluminium-aa6014" has no viscosity, which flow needs'),
        (
            ("material=aluminium-aa6014",),
            'write e.g. surface_tension_slope = "-0.4 mN/(m K)" beside base = "aluminium-aa6014"',
        ),
        (("boundaries.bottom=free",), 'boundaries.bottom: "free" cuts supports off'),
        (("boundaries.surface=wall", "boundaries.surface_temperature=3000 K"), "a laser heats"),
        (("solver.dimensions=1",), "solver.dimensions: must be 2 or 3, got 1: a column of liquid"),
        (("domain.extent=quarter",), "domain.extent: a quarter is symmetric about y = 0, too"),
        (
            (*SPACE, "domain.extent=quarter", "laser.position=['0 m', '1 um']", *ONE_SPOT),
            'this beam is not symmetric about y = 0; write extent = "full" or "half"',
        ),
        (
            (*SPACE, *QUARTER_OF_DOTS, 'laser.beam.phases=["0 deg", "90 deg", "0 deg", "0 deg"]'),
            'domain.extent: this beam is not symmetric about x = 0; write extent = "full"',
        ),
        (
            (*SPACE, *QUARTER_OF_DOTS, "boundaries.front=periodic", "boundaries.back=periodic"),
            'boundaries.front: a quarter of a block is symmetric at y = 0, "periodic" does not fit',
        ),
        (
            (*SPACE, *QUARTER_OF_DOTS, "domain.breadth=6 um"),
            "domain.breadth: 6 um is no whole number of the pattern's periods of",
        ),
        (("domain.breadth=5 um",), "domain.breadth: says nothing in 2-D, which has no y"),
        (("boundaries.front=adiabatic",), "boundaries.front: says nothing in 2-D, which has no y"),
        ((*SPACE, "solver.pressure=published"), 'solver.pressure: "published" is the matrix of'),
        (
            ("solver.frame=eulerian", "solver.flow.surface=moving"),
            "solver.frame: below a surface that moves particles move with it; leave it out",
        ),
        (("solver.viscosity=explicit", "time.end=1 s"), "solver.viscosity: 1.02e-06 m^2/s needs"),
        (("solver.viscosities=explicit",), 'solver.viscosities: unknown key; do you mean "visc'),
        (("solver.steady=0",), "solver.steady: must be greater than 0"),
        (
            ('flow={bottom="no-slip"}',),
            'a box of [solver.flow] is all fluid, but "steel-304-demuth" melts',
        ),
    ],
)
def test_refused(settings, message):
    """Each contradiction has its line."""
    assert message in refused(*settings)


def test_a_liquid_needs_a_box():
    """What is liquid everywhere says what holds at its sides."""
    assert "fluid everywhere; say in [solver.flow]" in refused("flow=", case="natural-convection")


def test_a_neumann_face_melts_as_well():
    """A pool under a face that is hot or takes up a flux needs no laser."""
    for face in (
        ["boundaries.surface=fixed-temperature", "boundaries.surface_temperature=2000 K"],
        ["boundaries.surface=prescribed-flux", "boundaries.surface_flux=1e11 W/m^2"],
    ):
        assert load_case("dlip-steel", [POOL, *BARE, *face]).laser is None


def test_marangoni_needs_its_slope_only_where_it_pulls():
    """A box under a lid, or without Marangoni stress, does not ask for surface tension."""
    surface = 'solver.flow.surface="free-surface"'
    assert "has no surface_tension_slope" in refused(surface, case="natural-convection")
    assert load_case("natural-convection", [surface, "solver.marangoni=false"]).flow is not None


def test_half_a_box():
    """Symmetric at x = 0 for heat and for flow."""
    settings = ["domain.extent=half"]
    assert "flow.left: half a box is symmetric" in refused(*settings, case="lid-driven-cavity")
    assert load_case("marangoni-layer").domain.extent == "half"


def test_material_written_into_a_case():
    """Constant numbers in short, a diffusivity instead of the conductivity, sources of sections."""
    case = load_case("natural-convection")
    data = case.resolved()
    data["material"] = {
        "density": "2 kg/m^3", "heat_capacity": "3 J/(kg K)", "diffusivity": "5 m^2/s",
        "kinematic_viscosity": "7 m^2/s", "optics": {"emissivity": 0.3},
    }  # fmt: skip
    material = Case.model_validate(data).material
    assert float(material.conductivity_at(300.0)) == 30.0
    assert material.conductivity.source == "D rho c_p, D set in the case"
    assert float(material.viscosity_at(300.0)) == 14.0
    assert material.optics is not None
    assert material.optics.source_of("emissivity") == "set in the case"
    assert material.name == "of the case"
    assert case.material.name == "unit-gas"


def test_a_start_from_a_file_is_kept_with_the_case(tmp_path):
    """The table's numbers are part of the resolved case and of its hash."""
    (tmp_path / "field.csv").write_text("x,z,u,w\n0,0,1,2\n", encoding="utf-8")
    text = load_case("natural-convection").text.replace(
        "[solver.flow]\n", '[solver.flow]\ninitial = { kind = "table", path = "field.csv" }\n'
    )
    (tmp_path / "case.toml").write_text(text, encoding="utf-8")
    case = load_case(tmp_path / "case.toml")
    assert case.resolved()["solver"]["flow"]["initial"]["rows"] == [[0.0, 0.0, 1.0, 2.0]]
    assert Case.model_validate(case.resolved()).hash() == case.hash()
    (tmp_path / "field.csv").write_text("x,z,u,w\n0,0,1,3\n", encoding="utf-8")
    assert load_case(tmp_path / "case.toml").hash() != case.hash()


def test_another_kind_of_solver_by_a_setting():
    """The message says how to leave out what the file gives the other kind; both ways are right."""
    other = ["solver.kind=conduction"]
    with pytest.raises(
        CaseError, match=r"leave it out with --set solver\.flow= or, in a plan, "
    ) as error:
        load_case("texture-steel", other)
    assert str(error.value).endswith('"solver.flow" = ""')
    for settings in ([*other, "solver.flow="], ['solver={ kind = "conduction" }']):
        assert load_case("texture-steel", settings).solver.kind == "conduction"
    with pytest.raises(CaseError) as error:  # its own fault, told as before
        load_case("texture-steel", [*other, "solver.flow.surface=flat"])
    assert "leave it out with" not in str(error.value)
