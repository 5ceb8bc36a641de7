"""What images carry beyond each kind of side, for particles placed by hand."""

from dataclasses import replace

import numpy as np
import pytest

from lasersph.boundaries import Boundaries
from lasersph.boundaries.flow_sides import FlowSides
from lasersph.particles.images import MIRROR, OPEN, PERIODIC, ways_of
from lasersph.solvers.melt_pool.sides import Sides

BOX = ((0.0, 1.0), (-1.0, 0.0))
V = np.array([2.0, 3.0])
"""Velocity of the source in all tests [m/s]."""
NEAR = {"left": [(1, 0)], "right": [(2, 0)], "bottom": [(0, 1)], "surface": [(0, 2)]}
"""Ways of the images of a particle near one side: faces crossed of either axis."""


def sides_of(heat=None, **flow):
    """Sides of a box with the given kinds, no-slip and adiabatic where not given."""
    return Sides(BOX, Boundaries(**(heat or {})), FlowSides.model_validate(flow), 300.0)


def corner_of(across, along):
    """Ways of the images of a particle near two faces."""
    return [(across, 0), (0, along), (across, along)]


def rules_at(sides, chosen):
    """Rules of images that came by the chosen ways, and the faces that each of them crossed."""
    ways = ways_of(sides.face_pairs(has_bottom=True))
    columns = [ways.crossed.T.tolist().index(list(way)) for way in chosen]
    few = replace(
        ways, sign=ways.sign[:, columns], offset=ways.offset[:, columns],
        crossed=ways.crossed[:, columns],
    )  # fmt: skip
    return sides.rules(few), few.crossed


def velocity_beyond(sides, ways):
    """S v + c of the image beyond one face, or of the one beyond two."""
    rules, _ = rules_at(sides, ways)
    return rules.factor[:, -1] * V + rules.added[:, -1]


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
    assert velocity_beyond(sides, corner_of(1, 2)) == pytest.approx(V)


def test_corner_of_two_walls_at_rest():
    """Point symmetric walls: S = +1 for both components."""
    assert velocity_beyond(sides_of(), corner_of(1, 1)) == pytest.approx(V)


def test_slope_of_a_stressed_surface():
    """Added beyond the surface, with the other sign beyond a side as well, nowhere else."""
    sides = sides_of(left="symmetry", surface="free-surface")
    rules, crossed = rules_at(sides, corner_of(1, 2))
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
    """The image above x has the surface's temperature there: 300 + 10 cos(2 pi x)."""
    wave = {"amplitude": 10.0, "period": 1.0}
    heat = {"surface": "fixed-temperature", "surface_temperature": 300.0,
            "surface_temperature_wave": wave}  # fmt: skip
    sides = sides_of(heat, surface="free-surface")
    rules, _ = rules_at(sides, [*NEAR["surface"], *NEAR["bottom"]])
    assert rules.varies.tolist() == [True, False] and rules.wall_temperature[0] == 300.0
    assert sides.varying_temperature(np.array([0.5, 0.0])) == pytest.approx([290.0, 310.0])


def test_corner_between_a_held_and_an_insulated_face():
    """The corner takes the held face's temperature and normal, whichever axis comes first."""
    for heat, at, normal in (
        ({"left": "fixed-temperature", "left_temperature": 310.0}, 310.0, [-1.0, 0.0]),
        ({"bottom": "fixed-temperature", "bottom_temperature": 290.0}, 290.0, [0.0, -1.0]),
    ):
        rules, crossed = rules_at(sides_of(heat), corner_of(1, 1))
        (corner,) = np.flatnonzero((crossed != 0).all(axis=0))
        assert (rules.held[corner], rules.wall_temperature[corner]) == (1.0, at)
        assert rules.normal[:, corner].tolist() == normal
