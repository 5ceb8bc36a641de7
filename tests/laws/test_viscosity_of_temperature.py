"""A melt whose viscosity depends on its temperature, where one that does not is the same, or where
the flow is known."""

import numpy as np
import pytest
from flow_boxes import box, host_fields, place_of, start_from
from law_runs import go

from lasersph import compute
from lasersph.case import load_case
from lasersph.simulation.recipes import recipe_of

COUETTE = {
    "left": "periodic", "right": "periodic", "bottom": "no-slip",
    "surface": {"kind": "moving-wall", "velocity": 0.1},
}  # fmt: skip


def film_after(surface, *nodes):
    """Fields and heights of the film of `moving-film` after 2 ns; nodes: of its viscosity."""
    law = {"table": list(nodes), "source": "test"}
    case = load_case("moving-film", ("particles.spacing=56nm", f"solver.flow.surface={surface}"))
    material = case.resolved()["material"] | {"viscosity": law}
    case = type(case).model_validate(case.resolved() | {"material": material})
    solver = recipe_of(case).build(compute.cpu(threads=1))
    for _ in range(16):
        solver.step(1.25e-10)
    fields, free = host_fields(solver), solver.domain.surface
    found = {name: fields[name] for name in ("velocity", "pressure", "position", "enthalpy")}
    return found | ({} if free.ghosts is None else {"height": free.line.height})


@pytest.mark.parametrize("surface", ["moving", "flat"])
def test_temperature_sets_the_viscosity(surface):
    """A film of 1627 K to 1827 K that is half as viscous as at its reference of 298 K is the film
    of that viscosity, in pairs, at the surface and at the wall; halves are exact in binary, so that
    only the share in which a stress settles is rounded otherwise."""
    half = film_after(surface, ("1000 K", "14 mPa s"), ("1500 K", "7 mPa s"), ("4000 K", "7 mPa s"))
    alone = film_after(surface, ("1000 K", "7 mPa s"), ("3900 K", "7 mPa s"))
    for name, values in alone.items():
        scale = np.abs(values).max()
        assert half[name] == pytest.approx(values, rel=1e-9, abs=1e-12 * scale), name
    speed = np.abs(alone["velocity"]).max()
    cold = film_after(surface, ("1000 K", "14 mPa s"), ("4000 K", "14 mPa s"))
    assert np.abs(cold["velocity"] - alone["velocity"]).max() > 0.1 * speed


@pytest.mark.parametrize("surface", ["moving", "flat"])
def test_same_bits_where_it_does_not_vary(surface):
    """The loops for a viscosity that varies give 1 g_ij and no force where it is the same."""
    constant = film_after(surface, ("1000 K", "7 mPa s"), ("4000 K", "7 mPa s"))
    colder = film_after(surface, ("298 K", "7 mPa s"), ("2000 K", "7 mPa s"), ("4000 K", "3 mPa s"))
    for name, values in constant.items():
        assert np.array_equal(colder[name], values), name


def test_sheared_film_between_warm_and_cold():
    """Couette's flow below a hot wall: du/dz ~ 1/mu, steep where it is warm. Within 1 % of the
    speed of the wall; 10 % off where the viscosity is the same everywhere."""
    table = [["300 K", "0.01 m^2/s"], ["400 K", "0.0025 m^2/s"]]
    law = {"table": table, "source": "test"}
    heat = {"sides": "periodic", "surface": "fixed-temperature", "surface_temperature": 400.0,
            "bottom": "fixed-temperature", "bottom_temperature": 300.0}  # fmt: skip
    solver = box(flow=COUETTE, heat=heat, width=0.5, end=100.0, step=0.5, gravity=0.0,
                 material={"kinematic_viscosity": law})  # fmt: skip
    height = place_of(solver)[1] + 1.0
    start_from(solver, 100.0 * height)
    go(solver, 100.0)
    exact = 0.1 * np.log(1.0 - 0.75 * height) / np.log(0.25)  # nu = 0.01 (1 - 0.75 height)
    error = solver.backend.to_host(solver.flow.velocity)[0] - exact
    assert np.abs(error).max() < 0.01 * 0.1
    assert np.abs(0.1 * height - exact).max() > 0.1 * 0.1
