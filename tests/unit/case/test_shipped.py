"""The shipped cases say what their papers say."""

import pytest

from lasersph.analytic.thermocapillary_layer import ThermocapillaryLayer
from lasersph.case import available_cases, estimate_count, load_case
from lasersph.lasers import GaussianPulse, InterferenceBeam, SquarePulse
from lasersph.particles.faces import PLANE
from lasersph.solvers.ablation.settings import AblationSettings
from lasersph.solvers.melt_pool.settings import MeltPoolSettings

NAMES = (
    "ablation-aluminium", "ablation-depth", "dam-break", "dlip-aluminium", "dlip-steel",
    "dots-steel", "heated-cube", "hydrostatic-column", "lid-driven-cavity", "lid-driven-cube",
    "marangoni-layer", "moving-film", "natural-convection", "pulsed-heating", "short-pulse-gold",
    "sound-wave", "spot-film", "spot-steel",
    "spot-weld", "stefan", "taylor-green", "texture-aluminium",
    "texture-dots-steel", "texture-hexagons-steel", "texture-steel-10ps", "texture-steel",
)  # fmt: skip


def test_names():
    """Exactly the promised cases are shipped."""
    assert tuple(available_cases()) == NAMES


@pytest.mark.parametrize("name", NAMES)
def test_round_trip_through_plain_data(name):
    """The resolved case read back is the same case."""
    case = load_case(name)
    again = type(case).model_validate(case.resolved())
    assert again.hash() == case.hash()
    assert case.name == name
    assert case.title


@pytest.mark.parametrize(
    ("name", "fluence", "depth"), [("dlip-steel", 6000, 4.6e-6), ("dlip-aluminium", 10000, 1.5e-5)]
)
def test_dlip(name, fluence, depth):
    """Mean fluence, half a period of 5 um, 10 diffusion lengths, the published pulse."""
    case = load_case(name)
    laser = case.laser
    assert laser is not None and laser.mean_fluence == fluence
    assert laser.peak_fluence == 2 * fluence
    assert isinstance(laser.beam, InterferenceBeam) and laser.beam.lateral_period == 5e-6
    assert isinstance(laser.pulse, GaussianPulse)
    assert (laser.pulse.fwhm, laser.pulse.center) == (1e-8, 5e-8)
    assert (case.domain.depth, case.domain.width, case.domain.extent) == (depth, 5e-6, "half")
    assert case.domain.lateral(case.geometry) == ((0.0, 2.5e-6),)
    assert (case.particles.spacing, case.time.end) == (8e-9, 2e-7)
    assert case.initial_temperature == 298.15
    assert abs(depth / (10 * 2 * (case.material.diffusivity_reference * 1e-8) ** 0.5) - 1) < 0.25


def test_dots():
    """Four beams on a square lattice of 5 um, in 3-D, one dot in the middle of the cell."""
    case = load_case("dots-steel")
    beam = case.laser.beam if case.laser else None
    assert isinstance(beam, InterferenceBeam) and beam.count == 4
    assert (beam.lateral_period, beam.lateral_period_y) == pytest.approx((5e-6, 5e-6))
    assert case.domain.lateral(case.geometry) == ((0.0, 2.5e-6), (-2.5e-6, 2.5e-6))
    assert case.solver.dimensions == 3


def test_pulsed_heating():
    """9.6 J/cm2 in 100 ns are 9.6e11 W/m2; 800 particles; also 3-D by one setting."""
    case = load_case("pulsed-heating")
    assert case.laser is not None and isinstance(case.laser.pulse, SquarePulse)
    assert case.laser.mean_fluence / case.laser.pulse.duration == 9.6e11
    assert (case.laser.reflectivity, case.laser.pulse.count) == (0.75, 3)
    assert round(estimate_count(case.domain, case.particles, case.geometry)) == 800
    solid = load_case("pulsed-heating", ["solver.dimensions=3", "domain.width=2um"])
    assert round(estimate_count(solid.domain, solid.particles, solid.geometry)) == 800 * 8 * 8


def test_boxes_of_one():
    """Re = U L / nu = 100 in the cavity and the vortices; both fill 50 x 50 particles."""
    cavity, vortices = load_case("lid-driven-cavity"), load_case("taylor-green")
    for case in (cavity, vortices):
        assert case.material.is_liquid and case.material.density_liquid == 1.0
        assert float(case.material.kinematic_viscosity_at(300.0)) == 0.01
        assert case.domain.width == case.domain.depth == 1.0
        assert round(estimate_count(case.domain, case.particles, case.geometry)) == 2500
    assert cavity.flow is not None and cavity.flow.surface.velocity == 1.0
    assert vortices.flow is not None
    assert {vortices.flow.faces[side].kind for side in PLANE} == {"periodic"}


def test_marangoni_layer_has_the_speed_that_it_states():
    """B = 1 and 0.01439 m/s; Re = 0.014, so that inertia does nothing."""
    case = load_case("marangoni-layer")
    wave, material = case.boundaries.surface_temperature_wave, case.material
    assert wave is not None
    slope = float(material.surface_tension_slope_at(1727.0))
    viscosity = float(material.viscosity_at(1727.0))
    exact = ThermocapillaryLayer(case.domain.depth, wave.period, wave.amplitude, slope, viscosity)
    assert exact.wave_number * case.domain.depth == pytest.approx(1.0, rel=1e-9)
    assert exact.surface_speed == pytest.approx(0.01439, rel=1e-3)
    assert exact.surface_speed * 1e-6 / float(material.kinematic_viscosity_at(1727.0)) < 0.02
    assert case.domain.width == wave.period


def test_natural_convection():
    """Ra = g beta dT L^3 / (nu D) = 1e4 and Pr = 0.71."""
    case = load_case("natural-convection")
    material, faces = case.material, case.boundaries
    nu, a = float(material.kinematic_viscosity_at(300.0)), material.diffusivity_reference
    difference = faces.temperature_of("left", 300.0) - faces.temperature_of("right", 300.0)
    assert isinstance(case.solver, MeltPoolSettings)
    lift = case.solver.gravity * float(material.expansion_at(300.0)) * difference
    assert lift / (nu * a) == pytest.approx(1e4, rel=1e-6)
    assert nu / a == pytest.approx(0.71, rel=1e-6)


def test_matter_that_moves():
    """Sound is ten times faster than what falls from the column's height; the sound wave runs once
    around in 20 ns; the column is twice as high as wide."""
    water, dam, wave = (load_case(n) for n in ("hydrostatic-column", "dam-break", "sound-wave"))
    for case in (water, dam):
        assert isinstance(case.solver, AblationSettings) and case.material.is_liquid
        fall = (case.solver.gravity * case.domain.depth) ** 0.5
        assert 10.0 <= case.solver.sound_speed / fall < 15.0
    assert dam.domain.width is not None and dam.domain.depth == 2.0 * dam.domain.width
    assert dam.vessel is not None and dam.vessel.right == pytest.approx(4.0 * dam.domain.width)
    assert isinstance(wave.solver, AblationSettings)
    assert wave.time.end * wave.solver.sound_speed == pytest.approx(wave.domain.depth)


def test_stefan_number():
    """c_p (T_hot - T_m) / L_f = 896 * 400 / 397e3; the solid is at its melting point."""
    case = load_case("stefan")
    hot = case.boundaries.temperature_of("surface", case.initial_temperature)
    assert case.material.melting is not None
    assert hot - case.material.melting.solidus == 400.0
    assert 0 < case.material.melting.solidus - case.initial_temperature < 0.02
    assert case.laser is None
