"""Forecasts: counts as the filling makes them, limits by name, warnings in words."""

import tracemalloc

import numpy as np
import pytest
from receding_metals import recession_of

from lasersph import compute
from lasersph.case import Case, available_cases, load_case
from lasersph.compute import backend, search
from lasersph.input import format_duration
from lasersph.simulation import forecast
from lasersph.simulation.case_forecast import SECONDS_PER_LOOP
from lasersph.simulation.known_loops import known_loops
from lasersph.simulation.layers import lay_out
from lasersph.simulation.recipes import recipe_of
from lasersph.simulation.recipes.melt_pool.forecast import flowing_share

LAYERS = {
    "ablation-aluminium": (40, 40, 400000),
    "ablation-depth": (160, 160, 160),
    "dam-break": (60, 60, 1800),
    "dlip-aluminium": (201, 151, 49912),
    "dlip-steel": (84, 46, 17110),
    "dots-steel": (20, 10, 14763),
    "heated-cube": (16, 16, 4096),
    "hydrostatic-column": (20, 20, 200),
    "lid-driven-cavity": (50, 50, 2500),
    "lid-driven-cube": (16, 16, 4096),
    "marangoni-layer": (20, 20, 1260),
    "moving-film": (14, 14, 1764),
    "natural-convection": (40, 40, 1600),
    "pulsed-heating": (800, 800, 800),
    "short-pulse-gold": (244, 150, 244),
    "sound-wave": (100, 100, 100),
    "spot-film": (14, 14, 4200),
    "spot-steel": (39, 23, 5410),
    "spot-weld": (102, 80, 9643),
    "stefan": (200, 200, 200),
    "taylor-green": (50, 50, 2500),
    "texture-aluminium": (73, 31, 2799),
    "texture-dots-steel": (29, 14, 95924),
    "texture-hexagons-steel": (29, 14, 166026),
    "texture-steel": (58, 26, 5491),
    "texture-steel-10ps": (47, 16, 7815),
}
"""Layers, the finest of them, and particles of the shipped cases: a regression. The estimate of the
melt decides on some, so that another estimate would make other runs."""


@pytest.mark.parametrize("name", available_cases())
def test_layers_of_shipped_cases(name: str) -> None:
    """The same particles as ever."""
    layers = lay_out(load_case(name))
    finest = int(np.sum(layers.thickness <= layers.spacing * (1.0 + 1e-9)))
    assert (layers.thickness.size, finest, layers.particle_count) == LAYERS[name]


def test_counts_are_those_of_the_layers() -> None:
    """Particles and layers are what `lay_out` gives, and memory grows with them."""
    case = load_case("dlip-steel", ["particles.spacing=32nm"])
    layers = lay_out(case)
    found = forecast(case)
    assert found.particles == layers.particle_count
    assert found.layers == layers.thickness.size
    assert found.memory > 330 * 2**20 + 400 * found.particles
    assert found.binding == "light"
    assert found.limits["light"] == pytest.approx(50e-12)


def test_fine_layers_hold_the_expected_pool() -> None:
    """Steel at 0.6 J/cm2 melts 296 nm; the finest layers reach that and two support radii more."""
    found = forecast(load_case("dlip-steel"))
    assert 296e-9 + 2 * 3.75 * 8e-9 < found.fine_depth < 420e-9


def test_coarse_spacing_is_warned_of() -> None:
    """Heat that reaches 229 nm is not resolved by 100 nm, nor is light absorbed within 10 nm, and
    `check` says so; 32 nm resolve the heat, which spreads the light."""
    found = forecast(load_case("dlip-steel", ["particles.spacing=100nm"]))
    assert any("within 10.5 nm, less than one spacing of 100 nm" in w for w in found.warnings)
    assert any("the heat of a pulse reaches 229 nm" in w for w in found.warnings)
    found = forecast(load_case("dlip-steel", ["particles.spacing=32nm"]))
    assert not any("less than one spacing" in w for w in found.warnings)


def test_what_a_first_run_pays_besides() -> None:
    """The loops that a run of the kind is known to call, and how long they take to compile."""
    case = load_case("dlip-steel")
    loops = known_loops(case)
    longer = format_duration(SECONDS_PER_LOOP * loops)
    words = f"compiles up to {loops} loops, once: roughly {longer} more"
    assert loops > 100 and words in str(forecast(case))
    assert longer in ("10 s", "11 s")  # a second more with every 16 loops


def test_explicit_runs_are_bound_by_conduction() -> None:
    """0.846 dx^2 / D = 0.77 ns for aluminium at 0.25 um (1-D)."""
    found = forecast(load_case("pulsed-heating"))
    assert found.limits["conduction"] == pytest.approx(0.846 * 0.25e-6**2 / 6.89e-5, rel=1e-3)


def test_flow_of_a_cavity() -> None:
    """The lid's speed and 0.12 of the support radius per step: 52 mm times 0.12 at 1 m/s; 75 mm
    times 0.06 where particles move."""
    found = forecast(load_case("lid-driven-cavity", ["time.end=10 s"]))
    assert found.flow is not None and found.flow.speed == 1.0 and found.flow.layer is None
    assert found.limits["advection"] == pytest.approx(0.00624)
    assert not {"capillary", "recoil"} & set(found.limits)
    assert (found.binding, found.steps) == ("advection", 1603)
    moving = forecast(load_case("lid-driven-cavity", ["time.end=10 s", "solver.frame=lagrangian"]))
    assert moving.limits["advection"] == pytest.approx(0.0045)


def test_flow_of_a_driven_layer_and_of_a_warm_wall() -> None:
    """The exact speed of slow flow; a fifth of sqrt(g beta dT L) = 1 m/s."""
    layer = forecast(load_case("marangoni-layer")).flow
    warm = forecast(load_case("natural-convection")).flow
    assert layer is not None and layer.speed == pytest.approx(0.01439, rel=1e-3)
    assert warm is not None and warm.speed == pytest.approx(0.2, rel=1e-3)


def test_flow_of_a_pool() -> None:
    """sqrt(nu t) = 101 nm of steel is dragged along at some m/s; coarse spacings are warned of."""
    settings = ["solver.kind=melt-pool", "particles.spacing=16nm"]
    found = forecast(load_case("dlip-steel", settings))
    assert found.flow is not None and found.flow.layer == pytest.approx(101e-9, rel=0.1)
    assert 3.0 < found.flow.speed < 15.0
    (few,) = [text for text in found.warnings if "drags along" in text]
    assert "the flow below the surface will be too slow" in few
    # 12.6 nm, rounded down: what is said to resolve it is not warned of
    assert 'particles.spacing = "12 nm" resolves it' in few
    fine = forecast(load_case("dlip-steel", [*settings, "particles.spacing=12nm"]))
    assert not any("drags along" in text for text in fine.warnings)
    coarse = forecast(load_case("dlip-steel", [*settings, "particles.spacing=100nm"]))
    (none,) = [text for text in coarse.warnings if "drags along" in text]
    assert "1.0 spacings of 100 nm: there is no profile of speeds in it" in none
    heat = forecast(load_case("dlip-steel", [*settings, "solver.kind=conduction"]))
    assert heat.steps < found.steps < 1.5 * heat.steps
    assert heat.wall_time < found.wall_time < 4.0 * heat.wall_time
    at_rest = forecast(load_case("dlip-steel", [*settings, "solver.marangoni=false"])).flow
    assert at_rest is not None and at_rest.speed == 0.0


@pytest.mark.parametrize(
    ("name", "settings", "each", "pair"),
    [
        ("dlip-steel", ["solver.kind=conduction"], 400.0, 36.0),
        ("dlip-steel", [], 1200.0, 64.0),
        ("dam-break", [], 400.0, 12.0),
    ],
)
def test_memory_by_solver(name, settings, each, pair) -> None:
    """330 MiB and 400 B a particle, more where a melt flows than where nothing is kept."""
    found = forecast(load_case(name, settings))
    expected = 330.0 * 2**20 + each * found.particles + pair * found.pairs
    assert found.memory == pytest.approx(expected)


def pool(spacing: str) -> Case:
    """A shallow block of aluminium."""
    shallow = ["particles.arrangement=uniform", "particles.ratio=", "domain.depth=2.4 um"]
    return load_case("dlip-aluminium", [*shallow, f"particles.spacing={spacing}"])


def step_with_a_molten_half(case: Case) -> None:
    """Take two steps; what the second takes is traced."""
    solver = recipe_of(case).build(compute.cpu(threads=1))
    curve, (x, z) = solver.body.curve, solver.body.filling.position[:, : solver.particle_count]
    depth = 1.05e-6 * np.cos(np.pi * x / 2.5e-6)
    h = np.interp(1500.0, curve.temperature, curve.enthalpy)
    for name in ("enthalpy", "enthalpy_before", "enthalpy_two_before"):
        solver.particles.set(name, np.where(-z < depth, h, 0.0))
    solver.body.update_temperature()
    for _ in range(2):  # the first also coarsens the pairs, which takes memory for a moment
        tracemalloc.reset_peak()
        solver.step(1e-12)


def memory_of(case: Case) -> tuple[float, float]:
    """Most bytes that such a step takes, and those that `check` expects."""
    tracemalloc.start(1)
    step_with_a_molten_half(case)
    peak = float(tracemalloc.get_traced_memory()[1])
    tracemalloc.stop()
    return peak, forecast(case).memory


def test_memory_of_a_pool_is_what_its_steps_take(monkeypatch) -> None:
    """What more particles take is within a fifth of what `check` says that they do."""
    # of room for rows and pairs little is ever written
    monkeypatch.setattr(search, "_PLACES_PER_ROW", 64)
    for growth in ("GROWTH", "MAPPED_GROWTH"):
        monkeypatch.setattr(backend, growth, 1)
    # loads what takes memory once; compiling takes ten times as long where memory is traced
    step_with_a_molten_half(pool("64 nm"))
    (small, less), (large, more) = memory_of(pool("40 nm")), memory_of(pool("24 nm"))
    assert large - small == pytest.approx(more - less, rel=0.2)


def test_a_run_that_ends_before_the_light_says_so() -> None:
    """Nothing melts, so that the finest layers hold the light only; `check` warns."""
    found = forecast(load_case("dlip-steel", ["time.end=2 ns"]))
    assert any("no light falls before time.end" in warning for warning in found.warnings)


def test_layers_too_shallow_for_what_evaporates():
    """Steel under steady light, Landau: in the second 2.5 of its times D/v^2 it recedes at 0.989 of
    the steady speed on the way from cold; the depth asked for is enough, one less is warned of."""
    exact = recession_of("steel-304-demuth", 1e11, conductivity_share=0.01)
    settings = [
        *("solver.vaporization=flux", "boundaries.ambient_pressure=0 Pa", "laser.fluence="),
        *("laser.fluence_kind=", "laser.intensity=1e11 W/m^2", "laser.beam.kind=uniform"),
        *("laser.beam.period=", "laser.pulse={ kind = 'square', duration = '1 ms' }"),
        *("laser.absorption={ kind = 'surface' }", "laser.reflectivity=0", "domain.extent=full"),
        *("particles.arrangement=uniform", "particles.coarsest=", "particles.ratio="),
        f"particles.spacing={exact.thermal_length / 4.0} m",
        f"domain.width={3.0 * exact.thermal_length} m",
        'material={ base = "steel-304-demuth", surface_tension = "1.6 N/m", '
        'conductivity = "0.267892 W/(m K)" }',
    ]
    cases = [
        load_case(
            "texture-steel",
            [*settings, f"time.end={end * exact.time} s", f"domain.depth={depth} nm"],
        )
        for end, depth in ((2.5, 200.0), (5.0, 431.0), (5.0, 660.0))
    ]
    said = [" ".join(recipe_of(case).warnings()) for case in cases]
    gone = [float(text.split()[1]) * 1e-9 for text in said[:2]]
    assert (gone[1] - gone[0]) / (2.5 * exact.time) == pytest.approx(0.989 * exact.speed, rel=0.01)
    assert 'the run is likely to stop before its end; write domain.depth = "656 nm"' in said[1]
    assert "evaporate" not in said[2]


def test_share_of_the_block_that_flows() -> None:
    """A pool in a block twice as deep is half the share of it; without light all is liquid."""
    shares = {}
    for depth in ("0.4um", "0.8um"):
        recipe = recipe_of(load_case("dlip-steel", [f"particles.fine_depth={depth}"]))
        found = flowing_share(recipe.case, recipe.layers, recipe.melt)
        shares[depth] = found * recipe.layers.fine_depth
    assert 0.05 < found < 0.1
    assert shares["0.4um"] == pytest.approx(shares["0.8um"])
    assert flowing_share(recipe.case, recipe.layers, None) == 1.0


def test_flow_costs_as_much_as_its_melt() -> None:
    """Fine columns beside the pool of a spot cost their heat alone."""
    wide = ["particles.spacing=12um", "particles.fine_width=0.8mm"]
    near, far = (forecast(load_case("spot-weld", settings)) for settings in (wide[:1], wide))
    assert near.steps == far.steps
    assert far.particles > 1.3 * near.particles
    assert near.wall_time < far.wall_time < 1.1 * near.wall_time


def test_numbers_and_layers_of_a_pool() -> None:
    """Steel in a spot: layers d/sqrt(Re) and d/sqrt(Pe) of its depth, no thicker than that."""
    found = forecast(load_case("spot-weld", ["particles.spacing=12um"]))
    flow = found.flow
    assert flow is not None
    assert set(flow.numbers) == {"Re", "Pe", "Ma", "Ca"}
    depth = flow.layers["viscous layer"] * flow.numbers["Re"] ** 0.5
    assert flow.layers["thermal layer"] == pytest.approx(depth / flow.numbers["Pe"] ** 0.5)
    assert "numbers of the pool    Re" in str(found)
    assert any("the speed of the surface will be off" in text for text in found.warnings)
    assert len(flow.unresolved) == 2
    # slow flow has no boundary layer, and metal that does not melt no pool
    lid = ["material=steel-304-demuth", "solver.flow.surface=flat", "solver.vaporization=plateau"]
    slow = forecast(load_case("spot-steel", lid)).flow
    cold = forecast(load_case("spot-steel", [*lid, "laser.fluence=0.1 J/cm^2"])).flow
    assert slow is not None and slow.numbers["Pe"] < slow.numbers["Re"] < 1.0 < slow.numbers["Ma"]
    assert slow.layers == {} and slow.unresolved == ()
    assert cold is not None and cold.numbers == {} and cold.layers == {}
