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

DARK = ("laser=", "particles.spacing=50nm", "particles.coarsest=0.3um")
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


def test_dimensions(tmp_path):
    """Layers of one nanometer below light of 120 nm: 1-D, 2-D and 3-D."""
    found = {}
    for dimensions in (1, 2, 3):
        solver = solver_of(case_of(
            tmp_path, f"solver.dimensions={dimensions}", "particles.spacing=10nm",
            "particles.coarsest=100nm", "domain.depth=2um", "domain.width=60nm",
        ))  # fmt: skip
        go(solver, 1e-12)
        layer, T = solver.body.filling.layer[: solver.body.count], host(solver, "temperature")
        found[dimensions] = np.bincount(layer, T) / np.bincount(layer)
    rise = found[1].max() - 300.0
    for dimensions in (2, 3):
        assert found[dimensions] == pytest.approx(found[1], abs=1e-3 * rise)


def test_steps_grow_from_attoseconds(tmp_path):
    """Steps begin far below the pulse, are bound by names that a reader knows, and grow."""
    solver = solver_of(case_of(tmp_path, "time.end=1ns"))
    shortest, names = 1.0, []
    while solver.state.time < 0.9e-9:
        names += go(solver, solver.state.time + 2e-12)
        shortest = min(shortest, solver.state.time_step)
    assert {"first step", "growth", "error"} & set(names) >= {"first step", "growth"}
    assert solver.state.has_two == 0.0


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
