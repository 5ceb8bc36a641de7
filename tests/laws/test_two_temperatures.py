"""Electrons and lattice: exact exchange, exact diffusion, the limits of one temperature, energy."""

from itertools import pairwise

import numpy as np
import pytest
from short_pulses import CONSTANT, EXACT, GOLD, case_of, go, host, solver_of, split

from lasersph import compute
from lasersph.analytic.two_temperatures import constant_exchange, linear_exchange, pulse_rise
from lasersph.observers import EnergyBudget
from lasersph.observers.hot_electrons import HotElectrons
from lasersph.simulation.recipes import recipe_of
from lasersph.solvers.conduction.electron_step import HotElectrons as TooHot
from lasersph.solvers.step_control import choose_step

DARK = ("laser=", "particles.spacing=50nm", "particles.coarsest=0.3um")
RINGS = ("solver.geometry=axisymmetric",)
EVEN = ("particles.arrangement=uniform", "particles.coarsest=", "particles.ratio=",
        "domain.depth=0.4 um")  # fmt: skip
FIXED = ("time.is_fixed=true", "solver.step_error=0.49")


@pytest.mark.parametrize("step", ["10 fs", "100 fs", "2 ps"])
def test_exchange_of_constant_capacities_is_exact(tmp_path, step):
    """Without space any step gives the closed form, however long."""
    solver = solver_of(case_of(tmp_path, *DARK, *FIXED, f"time.step={step}"))
    split(solver, 5000.0, 400.0)
    go(solver, 4e-12)
    expected = constant_exchange(4e-12, 5000.0, 400.0, 2.1e4, 2.49e6, 2.1e16)
    for name, wanted in zip(("electron_temperature", "temperature"), expected, strict=True):
        assert host(solver, name) == pytest.approx(np.full(solver.body.count, wanted), rel=1e-9)


def test_exchange_of_linear_capacity(tmp_path):
    """C_e = gamma T_e: the closed form to 1e-6, and of second order in the step."""
    errors = []
    law = "material.electrons.heat_capacity={ coefficient = '71 J/(m^3 K^2)' }"
    for step in ("40 fs", "20 fs", "2 fs"):
        settings = (*DARK, *FIXED, law, f"time.step={step}", "material.heat_capacity=1e7 J/(kg K)")
        solver = solver_of(case_of(tmp_path, *settings))
        split(solver, 5000.0, 300.0)
        go(solver, 4e-12)
        # the lattice has the heat capacity of the metal less gamma T_l: next to none of 1e10
        hot, _ = linear_exchange(4e-12, 5000.0, 300.0, 71.0, 1e10, 2.1e16)
        errors.append(abs(host(solver, "electron_temperature")[0] / hot - 1.0))
    assert np.log2(errors[0] / errors[1]) > 1.9
    assert errors[2] < 1e-6


def test_half_space_under_a_pulse(tmp_path):
    """Rises at three depths and three times: within 0.5 % of the Laplace closed form."""
    solver = solver_of(case_of(tmp_path, "particles.spacing=1nm", "particles.fine_depth=100nm"))
    depth = -solver.body.filling.position[-1, : solver.body.count]
    times = (0.5e-12, 1e-12, 5e-12)
    places = (0, 50, 150)
    exact = {place: pulse_rise(depth[place], np.array(times), EXACT) for place in places}
    for number, time in enumerate(times):
        go(solver, time)
        for part, name in enumerate(("electron_temperature", "temperature")):
            found = host(solver, name) - 300.0
            for place, rises in exact.items():
                largest = np.max(rises[part])
                assert found[place] == pytest.approx(rises[part][number], abs=5e-3 * largest)


def test_steps_are_of_second_order(tmp_path):
    """Light, diffusion and exchange together: halving the step quarters the error."""
    found = []
    for step in (10.0, 5.0, 2.5):
        solver = solver_of(case_of(tmp_path, *FIXED, f"time.step={step} fs"))
        go(solver, 1e-12)
        found.append([host(solver, name) for name in ("electron_temperature", "temperature")])
    for part in range(2):
        first, second = (np.abs(a[part] - b[part]).max() for a, b in pairwise(found))
        assert 1.8 < np.log2(first / second) < 2.3


def test_strong_coupling_is_one_temperature(tmp_path):
    """G to infinity: the run of one temperature, within 0.5 % of the rise."""
    pulse = "laser.pulse={ kind = 'gaussian', fwhm = '1 ns', center = '2 ns' }"
    settings = (pulse, "domain.depth=20um", "particles.spacing=40nm", "particles.coarsest=1um",
                "time.end=4ns", "time.step=10ps", "laser.fluence=0.1 J/cm^2")  # fmt: skip
    strong = "material.electrons.coupling=1e22 W/(m^3 K)"
    two = solver_of(case_of(tmp_path, *settings, strong))
    one = solver_of(case_of(tmp_path, *settings, "solver.heat=one-temperature"))
    for time in (2.2e-9, 3.5e-9):
        go(two, time)
        go(one, time)
        T = host(one, "temperature")
        assert host(two, "temperature") == pytest.approx(T, abs=5e-3 * (T.max() - 300.0))


def test_long_pulse_on_steel():
    """10 ns: the melt depth of one temperature, within 1 %."""
    from lasersph.case import load_case

    depths = []
    for heat in ("one-temperature", "two-temperature"):
        case = load_case("dlip-steel", (
            "solver.kind=conduction", "solver.dimensions=1", "domain.extent=full", "probes=",
            "laser.beam={kind='uniform'}", "material=steel-304", "laser.reflectivity=0.556",
            "laser.absorption.absorption_coefficient=8e7 1/m", "particles.spacing=16nm",
            "laser.fluence=1.0 J/cm^2", "time.step=0.25ns", f"solver.heat={heat}",
        ))  # fmt: skip
        solver = solver_of(case)
        width, deepest = solver.body.filling.width[-1, : solver.body.count], 0.0
        for time in np.arange(40e-9, 75e-9, 1e-9):
            go(solver, time)
            deepest = max(deepest, float(np.sum(width * host(solver, "melt_fraction"))))
        depths.append(deepest)
    assert depths[0] > 150e-9
    assert depths[1] == pytest.approx(depths[0], rel=0.01)


def test_energy_of_electrons_lattice_and_latent_heat(tmp_path):
    """Gold melts and is handed over: the books, summed from the fields, close to 1e-6."""
    case = case_of(tmp_path, *GOLD)
    solver = solver_of(case)
    budget, seen = EnergyBudget(1), HotElectrons(1)
    recipe = recipe_of(case)
    budget.observe(recipe.view(solver, 0, ""))
    states, shares = set(), []
    for time in np.arange(1.0, 20.0) * 5e-12:
        go(solver, time)
        states.add(solver.state.has_two)
        view = recipe.view(solver, 1, "")
        row, parts = budget.observe(view), seen.observe(view)
        assert row["energy_imbalance_relative"] < 1e-6
        total = parts["electrons.energy_J"] + parts["electrons.lattice_energy_J"]
        assert total == pytest.approx(row["energy_absorbed_J"], rel=1e-6)
        shares.append(parts["electrons.energy_J"] / total)
    assert row["energy_latent_J"] > 0.0
    assert shares[0] > 0.3 > shares[-1]


def test_hand_over_keeps_the_energy(tmp_path):
    """The enthalpy of each particle goes on as it is, and pulses come back to two."""
    pulse = "laser.pulse={ kind = 'square', duration = '1 ps', count = 2, period = '0.3 ns' }"
    case = case_of(tmp_path, pulse, "time.end=0.4ns", "material.electrons.coupling=1e18 W/(m^3 K)")
    solver = solver_of(case)
    states, before = [], None
    while solver.state.time < 0.35e-9:
        limits = solver.time_step_limits()
        name = min(limits, key=lambda key: limits[key])
        had = solver.state.has_two
        heat = float(np.sum(host(solver, "enthalpy") * host(solver, "mass")))
        solver.step(limits[name])
        if solver.state.has_two != had:
            states.append((had, solver.state.has_two))
            before = before or heat
    assert states[:3] == [(0.0, 1.0), (1.0, 0.0), (0.0, 1.0)]
    absorbed = solver.state.energy["absorbed"]
    assert absorbed == pytest.approx(20.0, rel=1e-9)
    assert np.sum(host(solver, "enthalpy") * host(solver, "mass")) == pytest.approx(20.0, rel=1e-9)


def warmed(folder, dimensions, spacing, *settings):
    """Solver of graded layers under uniform light, six columns wide, 1 ps after the start."""
    width = 6.0 * spacing
    solver = solver_of(case_of(
        folder, f"solver.dimensions={dimensions}", f"particles.spacing={spacing} nm",
        f"domain.width={width} nm", "particles.coarsest=1 um", "particles.ratio=0.9",
        "domain.depth=6 um", "time.growth=2", *settings,
    ))  # fmt: skip
    go(solver, 1e-12)
    return solver


def temperatures(solver):
    """T_e and T_l of each particle [K], (2, n), and the layer it is in."""
    names = ("electron_temperature", "temperature")
    layer = solver.body.filling.layer[: solver.body.count]
    return np.array([host(solver, name) for name in names]), layer


def layer_means(folder, dimensions, spacing, *settings):
    """T_e and T_l of each layer [K], (2, layers), and the absorbed energy over the area that the
    light meets [J/m^2]."""
    solver = warmed(folder, dimensions, spacing, *settings)
    found, layer = temperatures(solver)
    means = [np.bincount(layer, values) / np.bincount(layer) for values in found]
    area = float(host_area(solver).sum())
    held = float(np.sum(host(solver, "enthalpy") * host(solver, "mass")))
    assert held == pytest.approx(solver.state.energy["absorbed"], rel=1e-9, abs=0.0)
    return np.array(means), held / area


def host_area(solver):
    """Cross-section of each particle that light passes [m^(d-1)]."""
    return np.array(solver.body.backend.to_host(solver.body.area))


def apart(found, wanted, layer=slice(None)):
    """Largest differences of T_e and T_l over the largest rise of each [1].

    Args:
        wanted: of layers. layer: in which what is found lies; the same ones if not given.
    """
    rise = wanted.max(axis=1) - 300.0
    return np.abs(found - wanted[:, layer]).max(axis=1) / rise


def test_layers_of_one_nanometer_are_one_in_1d_and_2d(tmp_path):
    """Spacing of 1 nm at the surface, graded to 1 um: 5e-7 of the rise, half of what is asked for
    so that it holds in 3-D, which differs by twice as much."""
    one, heat = layer_means(tmp_path, 1, 1.0)
    two, same = layer_means(tmp_path, 2, 1.0)
    assert np.all(apart(two, one) < 5e-7)
    assert same == pytest.approx(heat, rel=1e-9)


def test_dimensions_differ_by_the_square_of_the_spacing(tmp_path):
    """What they differ by is the error of their sums, in 3-D twice that of 2-D at most."""
    found = {}
    for spacing, dimensions in ((16.0, 2), (16.0, 3), (8.0, 2)):
        one, heat = layer_means(tmp_path, 1, spacing)
        more, same = layer_means(tmp_path, dimensions, spacing)
        found[dimensions, spacing] = apart(more, one)
        assert same == pytest.approx(heat, rel=1e-9)
    order = np.log2(found[2, 16.0] / found[2, 8.0])
    assert np.all((order > 1.8) & (order < 2.2))
    assert np.all(found[3, 16.0] < 2.0 * found[2, 16.0])


@pytest.mark.parametrize("settings", [(), EVEN], ids=["graded", "even"])
def test_rings_of_one_nanometer_are_layers_of_1d(tmp_path, settings):
    """(r, z), spacing of 1 nm at the surface, graded to 1 um or not at all: every ring from the
    axis to the side has the temperatures of its layer in 1-D, to 5e-7 of the rise as in a plane;
    1e-6 is asked for."""
    one, heat = layer_means(tmp_path, 1, 1.0, *settings)
    solver = warmed(tmp_path, 2, 1.0, *RINGS, *settings)
    found, layer = temperatures(solver)
    assert np.all(apart(found, one, layer) < 5e-7)
    held = float(np.sum(host(solver, "enthalpy") * host(solver, "mass")))
    assert held / float(host_area(solver).sum()) == pytest.approx(heat, rel=1e-9)


@pytest.mark.parametrize("spacing", [40.0, 20.0])
@pytest.mark.parametrize("ratio", ["0.9", "0.7778"])
def test_rings_are_layers_of_a_plane(tmp_path, ratio, spacing):
    """(r, z) of coarser layers: every ring has the mean of its layer in a plane to 1e-6 of the
    rise; columns of the plane differ by 4e-5 and more where layers of fewer columns begin."""
    graded = (f"particles.ratio={ratio}", "particles.fine_depth=100 nm", "domain.width=0.4 um")
    means, _ = layer_means(tmp_path, 2, spacing, *graded)
    rings = warmed(tmp_path, 2, spacing, *RINGS, *graded)
    assert np.all(apart(temperatures(rings)[0], means, temperatures(rings)[1]) < 1e-6)


def test_half_of_a_pattern_is_the_whole(tmp_path):
    """Two beams on a period, and on half of it between symmetric sides: the same temperatures."""
    pattern = (
        "solver.dimensions=2", "laser.beam={ kind = 'interference', period = '0.4 um' }",
        "laser.fluence_kind=mean", "domain.width=0.4 um", "particles.spacing=40 nm",
        "particles.arrangement=uniform", "particles.coarsest=", "particles.ratio=",
        "domain.depth=0.8 um", "time.growth=2",
    )  # fmt: skip
    found = {}
    for extent in ("half", "full"):
        solver = solver_of(case_of(tmp_path, *pattern, f"domain.extent={extent}"))
        go(solver, 1e-12)
        count = solver.body.count
        place = np.round(solver.body.filling.position[:, :count] * 1e11)
        # mirrored about the bright line
        keys = [(abs(x), z) for x, z in place.T]
        found[extent] = dict(zip(keys, host(solver, "electron_temperature"), strict=True))
        heat = float(np.sum(host(solver, "enthalpy") * host(solver, "mass")))
        assert heat == pytest.approx(solver.state.energy["absorbed"], rel=1e-9, abs=0.0)
    assert found["half"].keys() == found["full"].keys()
    rise = max(found["full"].values()) - 300.0
    assert rise > 500.0
    for key, T in found["half"].items():
        assert pytest.approx(found["full"][key], abs=1e-6 * rise) == T


def steps_of(solver, end):
    """Names and lengths of all steps to a time [s]."""
    names, lengths = [], []
    while solver.state.time < end * (1.0 - 1e-12):
        limits = solver.time_step_limits() | {"end": end - solver.state.time}
        name, step, unclipped = choose_step(limits)
        lengths.append(solver.step(step, unclipped))
        names.append(name)
    return names, lengths


@pytest.mark.parametrize(("pulse", "first"), [(1e-13, 1e-17), (1e-15, 1e-19)])
def test_steps_grow_from_attoseconds_to_nanoseconds(tmp_path, pulse, first):
    """The light of 100 fs begins with 10 as, of 1 fs with 0.1 as; steps without light grow on."""
    shape = f"{{ kind = 'gaussian', fwhm = '{pulse} s', center = '{4.0 * pulse} s' }}"
    solver = solver_of(case_of(
        tmp_path, f"laser.pulse={shape}", "time.end=20 ns", "particles.spacing=20nm",
        "particles.fine_depth=100 nm", "time.cooling=0.05",
    ))  # fmt: skip
    names, lengths = steps_of(solver, 20e-9)
    known = {"first step", "light", "pulse edge", "growth", "error", "cooling", "end"}
    assert set(names) <= known
    assert {"first step", "growth", "cooling"} <= set(names)
    assert lengths[names.index("first step")] == pytest.approx(first, rel=0.02, abs=0.0)
    assert max(lengths) > 5e-10
    assert solver.state.has_two == 0.0
    # none jumps over light: 5 sigma on either side of its center are 4.2 pulses
    times = np.cumsum(lengths)
    is_lit = np.abs(times - 4.0 * pulse) < 2.1 * pulse
    assert np.max(np.array(lengths)[is_lit]) <= 0.11 * pulse


def test_electrons_beyond_the_table(tmp_path):
    """A run stops with the temperature, the end of the table and the keys."""
    table = "[['300 K', '2e4 J/(m^3 K)'], ['1500 K', '3e4 J/(m^3 K)']]"
    law = f"material.electrons.heat_capacity={{ table = {table} }}"
    solver = solver_of(case_of(tmp_path, law))
    with pytest.raises(TooHot, match=r"which ends at 1500 K; give less light .*heat_capacity"):
        go(solver, 2e-12)


def test_strict_arrays_and_threads_give_the_same_bits(tmp_path):
    """Steps touch arrays through loops only, and sums do not depend on threads."""
    results = []
    for backend in (compute.cpu(threads=1), compute.cpu(threads=2), compute.strict(threads=2)):
        solver = solver_of(case_of(tmp_path, *GOLD, "particles.spacing=20nm"), backend=backend)
        go(solver, 0.7e-12)
        results.append([host(solver, name) for name in solver.fields])
    for other in results[1:]:
        assert all(np.array_equal(a, b) for a, b in zip(results[0], other, strict=True))


def test_constant_case_is_that_of_the_closed_form():
    """The numbers of the case file and of the exact solution are the same ones."""
    for text in ("2.1e4 J/(m^3 K)", "2.1e16 W/(m^3 K)", "8e6 1/m", "10 J/m^2", "150 fs", "318 W"):
        assert text in CONSTANT
    assert EXACT.C_l + EXACT.C_e == 2511e3
