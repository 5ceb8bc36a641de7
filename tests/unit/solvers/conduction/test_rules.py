"""Time-step limits, plateau rules, and Newton against the published iteration."""

import numpy as np
import pytest
from two_particles import (
    COLD,
    SPACING,
    enthalpy_of,
    set_enthalpy,
    solver_of,
    temperature_of,
)

from lasersph.boundaries import Boundaries
from lasersph.lasers import Laser
from lasersph.physics.evaporation import saturation_pressure, vapor_constants
from lasersph.solvers.conduction.surface_exchange import SupercriticalSurface
from lasersph.solvers.step_control import NotConverged, binding_limit, choose_step
from lasersph.solvers.time_settings import TimeSettings

SQUARE = Laser.model_validate(
    {
        "fluence": 100.0, "beam": {"kind": "uniform"}, "reflectivity": 0.5,
        "pulse": {"kind": "square", "duration": 1e-9}, "absorption": {"kind": "surface"},
    }
)  # fmt: skip


def stored(solver):
    """Sum of mass times enthalpy [J/m^2]."""
    return float(solver.backend.to_host(solver.particles["mass"]) @ enthalpy_of(solver))


def test_binding_limit():
    """The smallest one, by name; the first of equals."""
    assert binding_limit({"end": 2.0, "light": 1.0, "growth": 1.0}) == ("light", 1.0)


@pytest.mark.parametrize(
    ("snapshot", "expected"),
    [
        (10.0, ("light", 2.0, 2.0)),
        (3.0, ("light", 1.5, 2.0)),
        (1.5, ("snapshot", 1.5, 2.0)),
        (2.0 + 1e-12, ("snapshot", 2.0 + 1e-12, 2.0)),
    ],
)
def test_the_way_to_a_snapshot_is_split(snapshot, expected):
    """With steps of 2 a snapshot 10 away changes nothing, 3 away two steps of 1.5 reach it, and one
    that is 2 away but for rounding is reached at once."""
    assert choose_step({"end": 50.0, "light": 2.0, "snapshot": snapshot}) == expected


def test_limits_of_a_fixed_step():
    """A fixed step leaves the end as the only other limit."""
    solver = solver_of(time=TimeSettings(end=1e-9, step=3e-12, is_fixed=True))
    assert solver.time_step_limits() == {"end": 1e-9, "fixed step": 3e-12}


def test_limits_of_the_implicit_scheme():
    """After a step of 1 ps that heated by 100 K, with 50 K aimed at, the next one is half."""
    time = TimeSettings(end=1e-8, step=2e-12, temperature_change=50.0, growth=1.25)
    solver = solver_of(time=time, laser=SQUARE, scheme="implicit")
    first = solver.time_step_limits()
    assert first["end"] == 1e-8
    assert first["light"] == 2e-12
    dark = solver_of(time=time, scheme="implicit").time_step_limits()
    assert dark["largest step"] == 2e-12 and "light" not in dark
    assert first["pulse edge"] == pytest.approx(1e-9)
    state = solver.state
    state.time, state.time_step, state.unclipped_step = 2.5e-10, 1e-12, 1e-12
    state.temperature_change = 100.0
    limits = solver.time_step_limits()
    assert limits["temperature change"] == pytest.approx(0.5e-12)
    assert limits["growth"] == pytest.approx(1.25e-12)
    assert limits["pulse edge"] == pytest.approx(7.5e-10)
    assert limits["end"] == pytest.approx(9.75e-9)


def test_light_of_a_step_is_absorbed():
    """100 J/m2 in 1 ns, half reflected: 0.1 ns bring 5 J/m2 to the surface particle."""
    solver = solver_of(laser=SQUARE, scheme="implicit")
    solver.step(1e-10)
    energy = solver.state.energy
    assert (energy["incident"], energy["absorbed"], energy["reflected"]) == pytest.approx(
        (10, 5, 5)
    )
    mass = 2705.0 * SPACING
    assert enthalpy_of(solver).sum() * mass == pytest.approx(5.0, rel=1e-9)
    assert temperature_of(solver)[0] > temperature_of(solver)[1] > COLD


def test_clip_discards_what_exceeds_the_latent_heat():
    """Both particles 1 MJ/kg beyond full vapor: 2 m 1e6 J are discarded, h is cut."""
    solver = solver_of(phase_change=True, plateau="clip")
    limit = solver.body.curve.enthalpy_vaporized
    set_enthalpy(solver, [limit + 1e6, limit + 1e6])
    solver.step(1e-12)
    assert enthalpy_of(solver) == pytest.approx([limit, limit], rel=1e-12)
    mass = 2705.0 * SPACING
    assert solver.state.energy["discarded"] == pytest.approx(2e6 * mass, rel=1e-9)


def test_hold_keeps_every_joule_at_the_boiling_point():
    """Under hold the enthalpy stays beyond the latent heat and T at the boiling point."""
    solver = solver_of(phase_change=True, plateau="hold")
    limit = solver.body.curve.enthalpy_vaporized
    set_enthalpy(solver, [limit + 1e6, limit + 1e6])
    solver.step(1e-12)
    assert enthalpy_of(solver) == pytest.approx([limit + 1e6] * 2, rel=1e-12)
    assert temperature_of(solver) == pytest.approx([2730.0, 2730.0])


def test_evaporate_removes_latent_heat_from_the_surface():
    """Clausius-Clapeyron at 1 atm and T_b: 0.82 p / sqrt(2 pi R_s T) L_v, here 385 GW/m2... by
    hand 0.82 * 101325 / sqrt(2 pi 308.17 * 2730) = 36.14 kg/(m2 s)."""
    solver = solver_of(phase_change=True, plateau="evaporate")
    h = float(solver.body.curve.enthalpy_at(2730.0))
    set_enthalpy(solver, [h, h])
    before = stored(solver)
    solver.step(1e-14)
    flux = 0.82 * 101325.0 / np.sqrt(2 * np.pi * 308.17 * 2730.0)
    assert flux == pytest.approx(36.14, rel=1e-3)
    evaporated = solver.body.backend.to_host(solver.particles["evaporated_mass"])
    assert evaporated == pytest.approx([flux * 1e-14, 0.0], rel=1e-3)
    energy = solver.state.energy
    assert energy["removed"] == pytest.approx(flux * 10.53e6 * 1e-14, rel=1e-3)
    assert stored(solver) - before == pytest.approx(-energy["removed"], rel=1e-4)


def test_flux_leaves_against_the_surroundings():
    """In air nothing leaves at T_b, and 0.748 / 0.816 of what leaves into vacuum where p_sat is
    2.393 atm (Mach 0.5, Knight 1979); into vacuum as much as under plateau = "evaporate"."""
    evaporated = {}
    vapor = vapor_constants(solver_of().body.material.vaporization)
    grid = np.linspace(2730.0, 3100.0, 371)
    pressures = [saturation_pressure(T, **vapor) for T in grid]
    hot = float(np.interp(101325.0 / 0.41782981, pressures, grid))
    for T in (2730.0, hot):
        for rule, pressure in (("flux", 101325.0), ("flux", 0.0), ("evaporate", 0.0)):
            words = {"vaporization": "flux"} if rule == "flux" else {"plateau": "evaporate"}
            solver = solver_of(phase_change=True, ambient_pressure=pressure, **words)
            h = float(solver.body.curve.enthalpy_at(T))
            set_enthalpy(solver, [h, h])
            before = stored(solver)
            solver.step(1e-14)
            mass = solver.body.backend.to_host(solver.particles["evaporated_mass"])
            evaporated[T, rule, pressure] = mass[0]
            assert stored(solver) - before == pytest.approx(
                -solver.state.energy["removed"], rel=1e-4, abs=1e-12
            )
    assert evaporated[2730.0, "flux", 101325.0] == 0.0
    for T in (2730.0, hot):
        assert evaporated[T, "flux", 0.0] == evaporated[T, "evaporate", 0.0] > 0.0
    share = evaporated[hot, "flux", 101325.0] / evaporated[hot, "flux", 0.0]
    assert share == pytest.approx(0.74787297 / 0.81568064, rel=1e-3)


def test_surface_above_the_critical_temperature_stops_the_run():
    """Before the step, with the temperature, and the state as it was."""
    solver = solver_of(phase_change=True, vaporization="flux", ambient_pressure=101325.0)
    for T, stops in ((7990.0, False), (8010.0, True)):
        h = float(solver.body.curve.enthalpy_at(T))
        set_enthalpy(solver, [h, 0.0])
        before, time = enthalpy_of(solver), solver.state.time
        if not stops:
            solver.step(1e-16)
            continue
        with pytest.raises(SupercriticalSurface, match="8010 K, above the critical temperature"):
            solver.step(1e-16)
        assert np.array_equal(enthalpy_of(solver), before) and solver.state.time == time


def test_published_iteration_gives_the_step_of_newton():
    """Through melting both iterations meet at the same enthalpies."""
    results = []
    for iteration in ("newton", "published"):
        solver = solver_of(count=12, phase_change=True, iteration=iteration, tolerance=1e-10)
        top = float(solver.body.curve.enthalpy_at(1500.0))
        melting = float(solver.body.curve.enthalpy_at(933.0)) + 0.3 * 397e3
        set_enthalpy(solver, [top, top, top, melting, melting] + [0.0] * 7)
        for _ in range(3):
            solver.step(2e-11)
        melt = solver.body.backend.to_host(solver.particles["melt_fraction"])
        assert ((melt > 0.0) & (melt < 1.0)).any()
        results.append(enthalpy_of(solver))
    assert results[1] == pytest.approx(results[0], rel=1e-4, abs=10.0)


def test_held_surface_warms_the_column_to_its_temperature():
    """A face at 900 K: energy comes in as negative loss, and in the end T is 900 K throughout."""
    hot = Boundaries(surface="fixed-temperature", surface_temperature=900.0, bottom="adiabatic")
    solver = solver_of(count=6, boundaries=hot, time=TimeSettings(end=1e-6))
    for _ in range(40):
        solver.step(2e-8)
    assert temperature_of(solver) == pytest.approx(np.full(6, 900.0), abs=1e-3)
    assert solver.state.energy["lost"] == pytest.approx(-stored(solver), rel=1e-9)
    assert stored(solver) == pytest.approx(6 * SPACING * 2705.0 * 896.0 * 600.0, rel=1e-5)


def test_steps_that_do_not_converge_are_halved(monkeypatch):
    """Two refusals quarter the step; a refusal for ever is reported and leaves the state."""
    solver = solver_of(laser=SQUARE)
    advance, refused = solver.scheme.advance, []

    def refusing(state, step, exchanged):
        if len(refused) < 2:
            refused.append(step)
            raise NotConverged("no")
        return advance(state, step, exchanged)

    monkeypatch.setattr(solver.scheme, "advance", refusing)
    assert solver.step(4e-11) == 1e-11
    assert refused == [4e-11, 2e-11]
    assert solver.state.energy["incident"] == pytest.approx(1.0)

    def never(*_):
        raise NotConverged("no")

    monkeypatch.setattr(solver.scheme, "advance", never)
    before = enthalpy_of(solver)
    with pytest.raises(NotConverged):
        solver.step(4e-11)
    assert np.array_equal(enthalpy_of(solver), before)
    assert solver.state.time == 1e-11
