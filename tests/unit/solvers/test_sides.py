"""What images carry beyond each kind of side, for particles placed by hand."""

import numpy as np
import pytest

from lasersph.boundaries import Boundaries
from lasersph.boundaries.flow_sides import FlowSides
from lasersph.particles.images import MIRROR, OPEN, PERIODIC, images_of
from lasersph.solvers.melt_pool.sides import Sides

BOX = ((0.0, 1.0), (-1.0, 0.0))
REACH = 0.3
V = np.array([2.0, 3.0])
"""Velocity of the source in all tests [m/s]."""
NEAR = {"left": (0.1, -0.5), "right": (0.9, -0.5), "bottom": (0.5, -0.9), "surface": (0.5, -0.1)}


def sides_of(heat=None, **flow):
    """Sides of a box with the given kinds, no-slip and adiabatic where not given."""
    return Sides(BOX, Boundaries(**(heat or {})), FlowSides.model_validate(flow), 300.0)


def rules_at(sides, point):
    """Rules of the images of one particle, and the faces that each of them crossed."""
    position = np.array([point], float).T
    images = images_of(position, REACH, sides.face_pairs(has_bottom=True))
    return sides.rules(images, position), images.crossed


def velocity_beyond(sides, point, corner=False):
    """S v + c of the image beyond one face, or of the one beyond two."""
    rules, crossed = rules_at(sides, point)
    (k,) = np.flatnonzero((crossed != 0).sum(axis=0) == (2 if corner else 1)) if corner else (0,)
    return rules.factor[:, k] * V + rules.added[:, k]


@pytest.mark.parametrize("side", ["left", "right"])
@pytest.mark.parametrize(
    ("kind", "expected"),
    [
        ("no-slip", (-2.0, -3.0)),
        ("free-slip", (-2.0, 3.0)),
        ("symmetry", (-2.0, 3.0)),
        ({"kind": "moving-wall", "velocity": 5.0}, (-2.0, 7.0)),
    ],
)
def test_beside(side, kind, expected):
    """u changes its sign; w too at a wall, to 2 w_wall - w, so that the mean is the wall's."""
    assert velocity_beyond(sides_of(**{side: kind}), NEAR[side]) == pytest.approx(expected)


@pytest.mark.parametrize(
    ("side", "kind", "expected"),
    [
        ("bottom", "no-slip", (-2.0, -3.0)),
        ("bottom", "symmetry", (2.0, -3.0)),
        ("surface", "free-slip", (2.0, -3.0)),
        ("surface", "free-surface", (2.0, -3.0)),
        ("surface", {"kind": "moving-wall", "velocity": 5.0}, (8.0, -3.0)),
    ],
)
def test_above_and_below(side, kind, expected):
    """w changes its sign, u too at a wall."""
    assert velocity_beyond(sides_of(**{side: kind}), NEAR[side]) == pytest.approx(expected)


def test_periodic():
    """One period away the velocity is the same, and heat knows no face."""
    heat = {"sides": "periodic"}
    sides = sides_of(heat, left="periodic", right="periodic")
    rules, _ = rules_at(sides, NEAR["left"])
    assert velocity_beyond(sides, NEAR["left"]) == pytest.approx(V)
    assert not rules.held.any() and not rules.flux.any() and not rules.normal.any()


def test_corner_below_a_moving_lid():
    """Point symmetric as between walls at rest: the velocity of the lid ends at its corner."""
    sides = sides_of(surface={"kind": "moving-wall", "velocity": 5.0})
    assert velocity_beyond(sides, (0.1, -0.1), corner=True) == pytest.approx(V)


def test_corner_of_two_walls_at_rest():
    """Point symmetric walls: S = +1 for both components."""
    assert velocity_beyond(sides_of(), (0.1, -0.9), corner=True) == pytest.approx(V)


def test_slope_of_a_stressed_surface():
    """Added beyond the surface, with the other sign beyond a side as well, nowhere else."""
    sides = sides_of(left="symmetry", surface="free-surface")
    rules, crossed = rules_at(sides, (0.1, -0.1))
    slopes = {tuple(c): s for c, s in zip(crossed.T.tolist(), rules.slope, strict=True)}
    assert slopes == {(1, 0): 0.0, (0, 2): 1.0, (1, 2): -1.0}


def test_pool_in_a_block():
    """Without [flow]: mirrors beside, a free surface above, nothing beyond the block's floor."""
    sides = Sides(BOX, Boundaries(), None, 300.0)
    assert [sides.flow_kind(s) for s in ("left", "bottom", "surface")] == [
        "symmetry", "no-slip", "free-surface",
    ]  # fmt: skip
    (x, z), (_, deep) = sides.face_pairs(has_bottom=False), sides.face_pairs(has_bottom=True)
    assert (x.lower_kind, z.lower_kind, z.upper_kind) == (MIRROR, OPEN, MIRROR)
    assert deep.lower_kind == MIRROR
    assert sides.fastest_wall() == 0.0


def test_periodic_pool():
    """A block that repeats for heat repeats for the flow."""
    sides = Sides(BOX, Boundaries(sides="periodic"), None, 300.0)
    assert sides.face_pairs(has_bottom=False)[0].lower_kind == PERIODIC


def test_fastest_wall():
    """The largest speed, whatever its sign."""
    wall = {"kind": "moving-wall", "velocity": -5.0}
    assert sides_of(surface=wall, left={"kind": "moving-wall", "velocity": 4.0}).fastest_wall() == 5


def test_held_face():
    """Beyond a held face: its temperature, outward normal, and n . x of the face."""
    sides = sides_of({"left": "fixed-temperature", "left_temperature": 310.0})
    rules, _ = rules_at(sides, NEAR["left"])
    assert (rules.held[0], rules.wall_temperature[0], rules.flux[0]) == (1.0, 310.0, 0.0)
    assert rules.normal[:, 0].tolist() == [-1.0, 0.0]
    assert rules.plane[0] == 0.0
    sides = sides_of({"bottom": "wall"})
    rules, _ = rules_at(sides, NEAR["bottom"])
    assert (rules.held[0], rules.wall_temperature[0], rules.plane[0]) == (1.0, 300.0, 1.0)


def test_heated_face():
    """Beyond a face of prescribed flux: the flux, and no temperature."""
    sides = sides_of({"right": "prescribed-flux", "right_flux": 7.0})
    rules, _ = rules_at(sides, NEAR["right"])
    assert (rules.held[0], rules.flux[0], rules.plane[0]) == (0.0, 7.0, 1.0)
    assert rules.normal[:, 0].tolist() == [1.0, 0.0]


def test_wave_of_a_held_surface():
    """The image above x has the surface's temperature there: 300 + 10 cos(2 pi 0.5)."""
    wave = {"amplitude": 10.0, "period": 1.0}
    heat = {"surface": "fixed-temperature", "surface_temperature": 300.0,
            "surface_temperature_wave": wave}  # fmt: skip
    rules, _ = rules_at(sides_of(heat, surface="free-surface"), NEAR["surface"])
    assert rules.wall_temperature[0] == pytest.approx(290.0)


def test_corner_between_a_held_and_an_insulated_face():
    """The corner takes the held face's temperature and normal, whichever axis comes first."""
    for heat, at, normal in (
        ({"left": "fixed-temperature", "left_temperature": 310.0}, 310.0, [-1.0, 0.0]),
        ({"bottom": "fixed-temperature", "bottom_temperature": 290.0}, 290.0, [0.0, -1.0]),
    ):
        rules, crossed = rules_at(sides_of(heat), (0.1, -0.9))
        (corner,) = np.flatnonzero((crossed != 0).all(axis=0))
        assert (rules.held[corner], rules.wall_temperature[corner]) == (1.0, at)
        assert rules.normal[:, corner].tolist() == normal
