"""The beam shot down columns: all of it is absorbed, whatever the surface looks like."""

import numpy as np
import pytest

from lasersph.irradiation import columns as rules
from lasersph.irradiation.first_hit import FirstHitLight
from lasersph.lasers import Laser
from lasersph.materials import load_material
from lasersph.particles.kinds import EJECTED, INTERIOR, LEAVING, WALL

DX = 2e-7
SIDE, LAYERS = 12, 8
R = 0.75
PULSE = {"kind": "square", "duration": 1e-8}


def laser(beam=None):
    """10 J/cm^2 within 10 ns."""
    beam = beam or {"kind": "uniform"}
    kind = {"fluence_kind": "peak"} if beam["kind"] == "gaussian" else {}
    return Laser.model_validate(
        {"fluence": 1e5, "beam": beam, "pulse": PULSE, "absorption": {"kind": "surface"},
         "reflectivity": R} | kind
    )  # fmt: skip


def block(dimension, side=SIDE):
    """Particles of a block of `side` columns along each axis, shape (dim, n); surface at z = 0."""
    lateral = DX * (np.arange(side) + 0.5 - side / 2)
    depth = -DX * (np.arange(LAYERS) + 0.5)
    mesh = np.meshgrid(depth, *[lateral] * (dimension - 1), indexing="ij")
    return np.array([part.ravel() for part in (*mesh[1:], mesh[0])])


def columns_of(backend, position, *, beam=None, periodic=True, rows=None):
    """Columns over a block, sorted, after a step of 50 ps; and what particles absorbed [J]."""
    dimension, count = position.shape
    deposit = backend.zeros(count)
    half = 0.5 * SIDE * DX
    found = FirstHitLight(
        backend, laser(beam), load_material("aluminium-aa6014"),
        ((-half, half),) * (dimension - 1), DX, (periodic,) * (dimension - 1), deposit,
    )  # fmt: skip
    kind = np.full(count, INTERIOR if rows is None else EJECTED)
    if rows is not None:
        kind[rows] = INTERIOR
    found.find_hit(
        backend.asarray(position),
        backend.asarray(kind),
        backend.asarray(np.arange(count), "index"),
    )
    found.shine(1e-9, 1.05e-9)
    absorbed = found.absorb(backend.asarray(np.full(count, 300.0)))
    assert absorbed == pytest.approx(backend.to_host(deposit).sum(), rel=1e-12)
    return found, backend.to_host(deposit)


def beam_energy(found, beam=None):
    """Integrated beam of the step over the block [J]."""
    size = 0.5 * SIDE * DX * np.ones((found.dimension - 1, 1))
    area = (SIDE * DX) ** (found.dimension - 1)
    return float(laser(beam).energy_density(-size, size, 1e-9, 1.05e-9)[0] * area)


def rotated(position, angle, axes):
    """Positions turned about the middle of the surface."""
    turned = position.copy()
    a, b = axes
    turned[a] = np.cos(angle) * position[a] - np.sin(angle) * position[b]
    turned[b] = np.sin(angle) * position[a] + np.cos(angle) * position[b]
    return turned


def surface(name, dimension):
    """Particles below a surface of a kind, within the columns."""
    if name in ("tilted", "turned"):
        if dimension < (2 if name == "tilted" else 3):
            return block(dimension)
        angle, axes = (0.3, (0, -1)) if name == "tilted" else (0.7, (0, 1))
        turned = rotated(block(dimension, 2 * SIDE), angle, axes)
        return turned[:, np.all(np.abs(turned[:-1]) < 0.5 * SIDE * DX, axis=0)]
    x = block(dimension)
    if name == "shifted" and dimension > 1:
        x[0] += 0.3 * DX
    if name == "cratered":
        return x[:, ~((np.abs(x[0]) < 2.5 * DX) & (x[-1] > -4 * DX))]
    if name == "stairs":
        return x[:, x[-1] < -np.abs(np.rint(x[0] / DX)) * DX / 2]
    if name == "scattered":
        return x + 0.3 * DX * np.random.default_rng(3).uniform(-1, 1, x.shape)
    return x


SURFACES = ("flat", "shifted", "tilted", "turned", "cratered", "stairs", "scattered")


@pytest.mark.parametrize("name", SURFACES)
@pytest.mark.parametrize("dimension", [1, 2, 3])
def test_all_light_is_absorbed(backend, dimension, name):
    """Absorbed power is (1 - R) times the integrated beam to 1e-12."""
    found, deposit = columns_of(backend, surface(name, dimension))
    assert found.incident == pytest.approx(beam_energy(found), rel=1e-12)
    assert deposit.sum() == pytest.approx((1.0 - R) * beam_energy(found), rel=1e-12)
    assert found.transmitted == 0.0 and deposit.min() >= 0.0


@pytest.mark.parametrize("name", SURFACES)
@pytest.mark.parametrize("kind", ["gaussian", "top-hat"])
def test_all_light_of_a_spot_is_absorbed(backend, kind, name):
    """The same with beams that vary over the surface, and closed sides."""
    size = {"radius_1e2": 5e-7} if kind == "gaussian" else {"radius": 7e-7}
    beam = {"kind": kind} | size
    found, deposit = columns_of(backend, surface(name, 3), beam=beam, periodic=False)
    assert deposit.sum() == pytest.approx((1.0 - R) * beam_energy(found, beam), rel=1e-12)


@pytest.mark.parametrize("dimension", [1, 2, 3])
def test_flat_surface_shares_evenly(backend, dimension):
    """On a flat lattice each particle of the top layer absorbs (1 - R) I dx^(d-1) dt."""
    position = block(dimension)
    _, deposit = columns_of(backend, position)
    expected = (1.0 - R) * 1e13 * DX ** (dimension - 1) * 5e-11
    top = position[-1] > -DX
    np.testing.assert_allclose(deposit[top], expected, rtol=1e-12)
    assert not deposit[~top].any()


def test_crater_wall_takes_nothing(backend):
    """Light falls on the floor and on the rim, not on the wall between them."""
    position = surface("cratered", 2)
    _, deposit = columns_of(backend, position)
    lit = position[:, deposit > 0.0]
    assert lit.shape[1] == SIDE
    inside = np.abs(lit[0]) < 2.5 * DX
    np.testing.assert_allclose(lit[1, inside], -4.5 * DX)
    np.testing.assert_allclose(lit[1, ~inside], -0.5 * DX)


def test_what_has_left_is_transparent(backend):
    """What has been ejected, and walls, neither absorb nor shade."""
    position = block(2)
    below = np.flatnonzero(position[1] < -DX)
    found, deposit = columns_of(backend, position, rows=below)
    assert not deposit[position[1] > -DX].any()
    assert found.transmitted == 0.0
    np.testing.assert_allclose(found.column_tops(), -DX)


def test_light_through_a_hole_is_transmitted(backend):
    """Columns without any particle let their light through, and say so."""
    position = block(2)
    rows = np.flatnonzero(position[0] > 0.0)
    found, deposit = columns_of(backend, position, rows=rows)
    assert found.transmitted == pytest.approx(0.5 * found.incident, rel=1e-12)
    assert deposit.sum() == pytest.approx((1.0 - R) * 0.5 * found.incident, rel=1e-12)
    assert np.isnan(found.column_tops()).sum() == SIDE / 2


def test_old_light_goes_out(backend):
    """A particle that is no longer met absorbs nothing, also if it was met before."""
    position = block(2)
    found, _ = columns_of(backend, position)
    below = np.flatnonzero(position[1] < -DX)
    kind = backend.zeros(position.shape[1])
    found.find_hit(backend.asarray(position), kind, backend.asarray(below, "index"))
    assert not backend.to_host(found.deposit)[position[1] > -DX].any()


def test_place_and_corner():
    """A particle at 2.3 spacings from the edge covers 0.2 of column 1 and 0.8 of column 2."""
    column, beyond = rules.column_along(np.array([2.3, 0.0]), (1.0, 0.0), 0.0, 1.0)
    assert column == 1.0 and beyond == pytest.approx(0.8)

    def corner(right, column=column, wraps=0.0, kind=LEAVING):
        return rules.column_at_corner(
            column, beyond, 0.0, 0.0, kind, right, 0.0, 4.0, 1.0, wraps, 0.0
        )

    assert corner(0.0) == (1, pytest.approx(0.2))
    assert corner(1.0) == (2, pytest.approx(0.8))
    assert corner(1.0, column=3.0) == (4, 0.0)
    assert corner(1.0, column=3.0, wraps=1.0) == (0, pytest.approx(0.8))
    assert corner(0.0, column=-1.0, wraps=1.0) == (3, pytest.approx(0.2))
    assert corner(0.0, kind=EJECTED) == corner(0.0, kind=WALL) == (4, 0.0)


def test_slivers_are_not_the_highest():
    """A particle that covers little of a column is its highest only where nothing else stands."""
    up = np.array([0.0, 1.0])
    assert rules.heights(np.array([0.0, 5.0]), 0.05, up) == (rules.NOWHERE, 5.0)
    assert rules.heights(np.array([0.0, 5.0]), 0.5, up) == (5.0, 5.0)
    assert rules.top_of(rules.NOWHERE, 5.0) == 5.0 and rules.top_of(1.0, 5.0) == 1.0
    assert rules.cover_of_uppermost(np.array([0.0, 0.6]), 0.3, 1.0, up, 0.5) == 0.3
    assert rules.cover_of_uppermost(np.array([0.0, 0.4]), 0.3, 1.0, up, 0.5) == 0.0
