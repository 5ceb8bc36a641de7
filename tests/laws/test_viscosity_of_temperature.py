"""A melt whose viscosity depends on its temperature, where one that does not is the same, or where
the flow is known."""

import numpy as np
import pytest
from flow_boxes import host_fields, place_of, start_from
from law_runs import go

from lasersph import compute
from lasersph.case import load_case
from lasersph.simulation.recipes import recipe_of

DEPTH, PERIOD, SLOPE = 280e-9, 1.76e-6, 4.3e-4


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
    return found | ({"height": free.line.height} if free.moves else {})


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


def exact_surface_speed(mu, stress, nodes=24):
    """Speed [m/s] of a layer of viscosity mu(z) [Pa s] below a flat surface with a wave of stress.

    Slow flow with the stream function psi(z) cos kx, at Chebyshev's points, D = d/dz: (D^2 + k^2)
    mu (D^2 + k^2) psi = 4 k^2 D mu D psi; psi = D psi = 0 at the bottom, psi = 0 and mu (D^2 + k^2)
    psi = stress at the surface.
    """
    count, k = np.arange(nodes + 1), 2.0 * np.pi / PERIOD
    x = np.cos(np.pi * count / nodes)
    c = np.where(count % nodes == 0, 2.0, 1.0) * (-1.0) ** count
    D = np.outer(c, 1.0 / c) / (x[:, None] - x + np.eye(nodes + 1))
    D = (D - np.diag(D.sum(axis=1))) * 2.0 / DEPTH
    m, strain = np.diag(mu(0.5 * (x - 1.0) * DEPTH)), D @ D + k**2 * np.eye(nodes + 1)
    A, b = strain @ m @ strain - 4.0 * k**2 * D @ m @ D, np.zeros(nodes + 1)
    A[0], A[1], A[-1], A[-2] = np.eye(nodes + 1)[0], (m @ strain)[0], np.eye(nodes + 1)[-1], D[-1]
    b[1] = stress
    return (D @ np.linalg.solve(A, b))[0]


def test_layer_that_is_warm_above():
    """Temperatures of 1500 K below and 2100 K above, where a wave of 1 K drives it: the viscosity
    falls to a quarter over ten rows. The speed of the surface, by its rows and what their stress
    adds, is within 4 % of the exact one, which is 2.6 times that of the colder liquid."""
    law = {"table": [["1500 K", "7 mPa s"], ["2100 K", "1.75 mPa s"]], "source": "test"}
    wave = {"amplitude": "1 K", "period": f"{PERIOD} m"}
    heat = {"surface": "fixed-temperature", "surface_temperature": "2100 K",
            "surface_temperature_wave": wave, "bottom": "fixed-temperature",
            "bottom_temperature": "1500 K"}  # fmt: skip
    settings = ("particles.spacing=28nm", "solver.flow.surface=flat", "initial_temperature=1500 K")
    case = load_case("moving-film", (*settings, f"domain.width={PERIOD} m"))
    tables = case.resolved()
    tables |= {"boundaries": heat, "material": tables["material"] | {"viscosity": law}}
    solver = recipe_of(type(case).model_validate(tables)).build(compute.cpu(threads=1))
    share = 1.0 + place_of(solver)[1] / DEPTH
    start_from(solver, 704.0 * 600.0 * share)
    go(solver, 200e-9)
    surface, k = solver.domain.surface, 2.0 * np.pi / PERIOD
    fields, host = host_fields(solver), solver.backend.to_host
    top = host(surface.at_surface) > 0.0
    u = fields["velocity"][0] + 0.5 * host(surface.ghost_velocity_jump)[0]
    speed = 2.0 * np.mean((u * np.sin(k * fields["position"][0]))[top])
    exact = exact_surface_speed(lambda z: 7e-3 - 5.25e-3 * (1.0 + z / DEPTH), SLOPE * k)
    assert speed == pytest.approx(exact, rel=0.04)
    assert exact > 2.6 * exact_surface_speed(lambda z: 7e-3 + 0.0 * z, SLOPE * k)
