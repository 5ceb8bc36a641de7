"""Layered light on particles that have moved: each column takes all of its light, by what lies in
it, and reflects by the temperatures of what lies at its surface now."""

from math import exp

import numpy as np
import pytest
from flow_boxes import pool

from lasersph.irradiation.absorbing_cells import cell_at_corner, light_per_cover, running_sum
from lasersph.irradiation.light import energies

LIT = (50e-9, 50.05e-9)
"""Begin and end of a step near the peak of the pulse [s]."""
HOT = ("laser.reflectivity={table=[['300 K', 0.9], ['3000 K', 0.3]]}",)


def lit_pool(move, *settings):
    """A pool under the light of a step, on its lattice and where `move(x, z, spacing)` puts it."""
    solver = pool(lambda x, z: z > -5e-7, *settings)
    backend, light = solver.backend, solver.body.light
    solver.advect(0.0)
    light.shine(*LIT)
    temperature = solver.particles["temperature"]
    light.absorb(temperature)
    lattice = backend.to_host(light.deposit)
    x, z = backend.to_host(solver.position)
    place = np.array(move(x.copy(), z.copy(), solver.domain.spacing))
    backend.copy(backend.asarray(place), solver.position)
    solver.state.time = LIT[0]
    solver.illuminate(LIT[1] - LIT[0])
    light.absorb(temperature)
    return solver, lattice, backend.to_host(light.deposit)


def stir(x, z, spacing):
    """Displacements of the particles of the pool by up to 0.4 of the spacing."""
    shift = np.random.default_rng(1).uniform(-0.4, 0.4, (2, x.size)) * spacing
    melt = z > -5e-7
    left, right = x.min() - 0.2 * spacing, x.max() + 0.2 * spacing
    return np.clip(x + melt * shift[0], left, right), np.minimum(
        z + melt * shift[1], -0.1 * spacing
    )


def test_on_the_lattice():
    """Particles that flow but have not moved take what they took."""
    _, lattice, found = lit_pool(lambda x, z, spacing: (x, z))
    assert found == pytest.approx(lattice, rel=1e-12, abs=1e-15 * lattice.max())


def test_no_light_is_lost_or_made():
    """Whatever the places, the light that enters is absorbed to the last particle."""
    solver, lattice, found = lit_pool(stir)
    light = solver.body.light
    assert np.abs(found - lattice).max() > 0.01 * lattice.max()
    booked = energies(light, float(found.sum()))
    assert booked["unassigned"] == pytest.approx(0.0, abs=1e-14 * light.incident)
    assert booked["incident"] > booked["absorbed"] > 0.0


def test_on_every_backend(backend):
    """A particle moved by half a cell to the right and down keeps the light of its column, and with
    a quarter of its square takes a fifth of the next one's, beside a whole square there."""
    solver = pool(lambda x, z: z > -1e-6, "particles.spacing=625 nm", backend=backend)
    light, columns = solver.body.light, solver.surface_columns
    light.shine(*LIT)
    light.absorb(solver.particles["temperature"])
    lattice = backend.to_host(light.deposit)
    x, z = backend.to_host(solver.position)
    moved = np.array([x, z])
    moved[:, 0] += [0.5 * 625e-9, -0.5 * 625e-9]
    position, count = backend.asarray(moved), x.size
    columns.find(position, backend.asarray(light_rows(moved), "index"))
    light.distribute(position, backend.asarray(-moved[1]), columns)
    total = light.absorb(solver.particles["temperature"])
    deposit = backend.to_host(light.deposit)
    assert deposit.shape == (count,) and deposit.sum() == pytest.approx(total, rel=1e-5)
    assert energies(light, total)["unassigned"] == pytest.approx(0.0, abs=1e-6 * light.incident)
    assert deposit[1] == pytest.approx(0.8 * lattice[1], rel=1e-3)
    assert deposit[0] == pytest.approx(lattice[0] + 0.2 * lattice[1], rel=1e-3)


def light_rows(place):
    """Particles of the uppermost row."""
    return np.flatnonzero(-place[1] < 625e-9)


def test_what_lies_above_takes_the_light():
    """A particle below another one takes exp(-alpha w) of what it would take alone."""
    alpha, w = 0.5, 1.0
    grid = {"low": (0.0,), "inverse_width": (1.0,), "inverse_height": 1.0}
    grid |= {"columns": (1.0,), "levels": 4.0}
    taken = []
    for depths in ((0.5, 1.5), (0.5, 0.5)):
        tau = np.zeros(5)
        for depth in depths:
            for lower in (0.0, 1.0):
                cell, _, cover = cell_at_corner(
                    (0.5, 0.0), depth, 1.0, upper=(0.0,), lower=lower, **grid
                )
                tau[cell] += alpha * w * cover
        total, distance = tau[:4].copy(), 1
        while distance < 4:
            before = total.copy()
            total = [running_sum(k, before[k], before, distance, 4) for k in range(4)]
            total, distance = np.array(total), 2 * distance
        per_cover = [light_per_cover(tau[k], total[k], alpha * w) for k in range(4)]
        taken.append([per_cover[int(depth)] for depth in depths])
    first = 1.0 - exp(-0.5)
    assert taken[0] == pytest.approx([first, first * exp(-0.5)], rel=1e-12)
    assert taken[1] == pytest.approx([0.5 * (1.0 - exp(-1.0))] * 2, rel=1e-12)


def test_corners_by_hand():
    """A quarter of a cell to the right and down: 9/16, 3/16, 3/16, 1/16; beyond the ends and the
    surface the next cell takes the part, and what lies below all cells is none of them."""
    grid = {"low": (0.0,), "inverse_width": (1.0,), "inverse_height": 1.0}
    grid |= {"columns": (3.0,), "levels": 2.0}

    def corner(x, depth, right, lower, size=1.0):
        return cell_at_corner((x, 0.0), depth, size, upper=(right,), lower=lower, **grid)

    assert corner(0.75, 0.75, 0.0, 0.0) == (0, 0, 0.5625)
    assert corner(0.75, 0.75, 1.0, 0.0) == (2, 1, 0.1875)
    assert corner(0.75, 0.75, 1.0, 1.0) == (3, 1, 0.0625)
    assert corner(0.25, 0.25, 0.0, 0.0) == (0, 0, 0.0625)
    assert corner(2.75, 0.5, 1.0, 0.0) == (4, 2, 0.25)
    assert corner(0.5, 1.75, 0.0, 1.0) == (6, 0, 0.0)
    # half as high, wholly in one row, or with a quarter of a cell in each of two
    assert corner(0.5, 0.25, 0.0, 0.0, size=0.5) == (0, 0, 0.5)
    assert corner(0.5, 1.0, 0.0, 0.0, size=0.5) == (0, 0, 0.25)
    assert corner(0.5, 1.0, 0.0, 1.0, size=0.5) == (1, 0, 0.25)


def test_reflectivity_follows_what_lies_at_the_surface():
    """Cold particles from below exchanged for those of the surface reflect more."""

    def turn_over(x, z, spacing):
        depth = np.round(-z / spacing - 0.5)
        is_fine = depth < 8
        return x, np.where(is_fine, -(7.5 - depth) * spacing, z)

    cold_below = ("initial_temperature=400 K",)
    reflected = []
    for move in (lambda x, z, spacing: (x, z), turn_over):
        solver, *_ = lit_pool(move, *HOT, *cold_below)
        reflected.append(solver.body.light.reflected)
    assert reflected[1] > 1.2 * reflected[0]


@pytest.mark.parametrize("kind", ["beer-lambert", "surface"])
def test_numbers_of_particles_do_not_matter(kind):
    """Particles that exchange their places exchange their light; none is lost or made."""
    order = []

    def exchange(x, z, spacing):
        order[:] = [np.arange(x.size)]
        melt = np.flatnonzero(z > -5e-7)
        order[0][melt] = np.random.default_rng(2).permutation(melt)
        return x[order[0]], z[order[0]]

    solver, lattice, found = lit_pool(exchange, f"laser.absorption.kind={kind}")
    assert found == pytest.approx(lattice[order[0]], rel=1e-12, abs=1e-15 * lattice.max())
    assert not np.array_equal(found > 0.0, lattice > 0.0) or kind == "beer-lambert"
    booked = energies(solver.body.light, float(found.sum()))
    assert booked["unassigned"] == pytest.approx(0.0, abs=1e-14 * booked["incident"])


def test_half_a_column_is_shared():
    """The uppermost row moved by half a column: each takes half of the light of two columns."""

    def move(x, z, spacing):
        return x + np.where(z > -spacing, 0.5 * spacing, 0.0), z

    solver, lattice, found = lit_pool(move, "laser.absorption.kind=surface")
    top = solver.body.filling.surface
    half = 0.5 * (lattice[top][1:-2] + lattice[top][2:-1])
    assert found[top][1:-2] == pytest.approx(half, rel=1e-9)
    assert found.sum() == pytest.approx(lattice.sum(), rel=1e-12)


def test_losses_follow_what_lies_at_the_surface():
    """What has come up loses heat, what has gone down no longer does; the area stays."""

    def turn_over(x, z, spacing):
        depth = np.round(-z / spacing - 0.5)
        return x, np.where(depth < 8, -(7.5 - depth) * spacing, z)

    solver, *_ = lit_pool(turn_over, "boundaries.convection=1e6 W/(m^2 K)")
    exchange, backend = solver.heat.exchange, solver.backend
    first = solver.body.filling.surface
    exchange.evaluate(solver.particles["temperature"])
    power, area = backend.to_host(exchange.power), backend.to_host(exchange.area)
    assert not power[first].any() and not area[first].any()
    now = backend.to_host(exchange.rows).astype(int)
    assert np.array_equal(now, first + 7 * first.size)
    assert (power[now] > 0.0).all()
    assert area.sum() == pytest.approx(solver.domain.width, rel=1e-12)
