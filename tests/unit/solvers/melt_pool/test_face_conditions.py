"""What ghosts carry beyond each kind of face, for particles placed by hand."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from lasersph.boundaries import Boundaries
from lasersph.boundaries.flow_conditions import FlowConditions
from lasersph.particles.ghosts import MIRROR, OPEN, PERIODIC, ghost_types_of
from lasersph.solvers.melt_pool.face_conditions import FaceConditions

BOX = ((0.0, 1.0), (-1.0, 0.0))
V = np.array([2.0, 3.0])
"""Velocity of the source in all tests [m/s]."""
FLAT = SimpleNamespace(crossing=MIRROR)
NEAR = {"left": [(1, 0)], "right": [(2, 0)], "bottom": [(0, 1)], "surface": [(0, 2)]}
"""Types of the ghosts of a particle near one face: faces crossed of either axis."""


def conditions_of(heat=None, **flow):
    """Conditions of a box with the given kinds, no-slip and adiabatic where not given."""
    return FaceConditions(
        BOX, Boundaries(**(heat or {})), FlowConditions.model_validate(flow), 300.0
    )


def corner_of(across, along):
    """Types of the ghosts of a particle near two faces."""
    return [(across, 0), (0, along), (across, along)]


def rules_at(conditions, chosen):
    """Rules of ghosts of the chosen types, and the faces that each of them crossed."""
    ghost_types = ghost_types_of(conditions.ghost_faces(FLAT, has_bottom=True))
    columns = [ghost_types.crossed.T.tolist().index(list(ghost_type)) for ghost_type in chosen]
    few = replace(
        ghost_types, sign=ghost_types.sign[:, columns], offset=ghost_types.offset[:, columns],
        crossed=ghost_types.crossed[:, columns],
    )  # fmt: skip
    return conditions.rules(few), few.crossed


def velocity_beyond(conditions, ghost_types):
    """S v + c of the ghost beyond one face, or of the one beyond two."""
    rules, _ = rules_at(conditions, ghost_types)
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
    assert velocity_beyond(conditions_of(**{side: kind}), NEAR[side]) == pytest.approx(expected)


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
    assert velocity_beyond(conditions_of(**{side: kind}), NEAR[side]) == pytest.approx(expected)


def test_periodic():
    """One period away the velocity is the same, and heat knows no face."""
    heat = {"sides": "periodic"}
    conditions = conditions_of(heat, left="periodic", right="periodic")
    rules, _ = rules_at(conditions, NEAR["left"])
    assert velocity_beyond(conditions, NEAR["left"]) == pytest.approx(V)
    assert not rules.dirichlet.any() and not rules.flux.any() and not rules.normal.any()


def test_corner_below_a_moving_lid():
    """Point symmetric as between walls at rest: the velocity of the lid ends at its corner."""
    conditions = conditions_of(surface={"kind": "moving-wall", "velocity": 5.0})
    assert velocity_beyond(conditions, corner_of(1, 2)) == pytest.approx(V)


def test_corner_of_two_walls_at_rest():
    """Point symmetric walls: S = +1 for both components."""
    assert velocity_beyond(conditions_of(), corner_of(1, 1)) == pytest.approx(V)


def test_stress_beyond_a_surface():
    """Beyond the surface a ghost has more of the tangential velocity, which a side turns around."""
    conditions = conditions_of(left="symmetry", surface="free-surface")
    rules, crossed = rules_at(conditions, corner_of(1, 2))
    more = zip(crossed.T.tolist(), rules.factor[0] * rules.stressed, strict=True)
    assert {tuple(c): s for c, s in more} == {(1, 0): 0.0, (0, 2): 1.0, (1, 2): -1.0}


def test_pool_in_a_block():
    """Without [flow]: mirrors beside, a free surface above, nothing beyond the block's floor."""
    conditions = FaceConditions(BOX, Boundaries(), None, 300.0)
    assert [conditions.flow_kind(s) for s in ("left", "bottom", "surface")] == [
        "symmetry", "no-slip", "free-surface",
    ]  # fmt: skip
    x, z = conditions.ghost_faces(FLAT, has_bottom=False)
    _, deep = conditions.ghost_faces(FLAT, has_bottom=True)
    assert (x.lower_kind, z.lower_kind, z.upper_kind) == (MIRROR, OPEN, MIRROR)
    assert deep.lower_kind == MIRROR
    assert conditions.largest_wall_speed() == 0.0


def test_periodic_pool():
    """A block that repeats for heat repeats for the flow."""
    conditions = FaceConditions(BOX, Boundaries(sides="periodic"), None, 300.0)
    assert conditions.ghost_faces(FLAT, has_bottom=False)[0].lower_kind == PERIODIC


def test_away_from_walls():
    """The distance inside walls that rest or move; planes along which melt slips are no such."""
    wall = {"kind": "moving-wall", "velocity": 1.0}
    found = conditions_of(surface=wall, left="no-slip", right="free-slip", bottom="symmetry")
    (x, _), (_, z) = BOX
    assert found.away_from_walls(0.25) == ((x + 0.25, -np.inf), (np.inf, z - 0.25))


def test_largest_wall_speed():
    """The largest speed, whatever its sign."""
    wall = {"kind": "moving-wall", "velocity": -5.0}
    found = conditions_of(surface=wall, left={"kind": "moving-wall", "velocity": 4.0})
    assert found.largest_wall_speed() == 5


def test_dirichlet_face():
    """Beyond a Dirichlet face: its temperature, outward normal, and n . x of the face."""
    conditions = conditions_of({"left": "fixed-temperature", "left_temperature": 310.0})
    rules, _ = rules_at(conditions, NEAR["left"])
    assert (rules.dirichlet[0], rules.wall_temperature[0], rules.flux[0]) == (1.0, 310.0, 0.0)
    assert rules.normal[:, 0].tolist() == [-1.0, 0.0]
    assert rules.plane[0] == 0.0
    conditions = conditions_of({"bottom": "wall"})
    rules, _ = rules_at(conditions, NEAR["bottom"])
    assert (rules.dirichlet[0], rules.wall_temperature[0], rules.plane[0]) == (1.0, 300.0, 1.0)


def test_neumann_face():
    """Beyond a face of prescribed flux: the flux, and no temperature."""
    conditions = conditions_of({"right": "prescribed-flux", "right_flux": 7.0})
    rules, _ = rules_at(conditions, NEAR["right"])
    assert (rules.dirichlet[0], rules.flux[0], rules.plane[0]) == (0.0, 7.0, 1.0)
    assert rules.normal[:, 0].tolist() == [1.0, 0.0]


def test_wave_of_a_dirichlet_surface():
    """The ghost above x has the surface's temperature there: 300 + 10 cos(2 pi x)."""
    wave = {"amplitude": 10.0, "period": 1.0}
    heat = {"surface": "fixed-temperature", "surface_temperature": 300.0,
            "surface_temperature_wave": wave}  # fmt: skip
    conditions = conditions_of(heat, surface="free-surface")
    rules, _ = rules_at(conditions, [*NEAR["surface"], *NEAR["bottom"]])
    assert rules.varies.tolist() == [True, False] and rules.wall_temperature[0] == 300.0
    assert conditions.varying_temperature(np.array([[0.5, 0.0]])) == pytest.approx([290.0, 310.0])


def test_corner_of_a_dirichlet_and_an_insulated_face():
    """The corner takes the Dirichlet face's temperature and normal, whichever axis comes first."""
    for heat, at, normal in (
        ({"left": "fixed-temperature", "left_temperature": 310.0}, 310.0, [-1.0, 0.0]),
        ({"bottom": "fixed-temperature", "bottom_temperature": 290.0}, 290.0, [0.0, -1.0]),
    ):
        rules, crossed = rules_at(conditions_of(heat), corner_of(1, 1))
        (corner,) = np.flatnonzero((crossed != 0).all(axis=0))
        assert (rules.dirichlet[corner], rules.wall_temperature[corner]) == (1.0, at)
        assert rules.normal[:, corner].tolist() == normal


SPACE = ((0.0, 1.0), (0.0, 1.0), (-1.0, 0.0))


def rules_in_space(heat, kinds):
    """Rules by type in a box of three axes whose faces are of some kinds for the flow, and others
    symmetric; a moving surface of such a box has the velocity 5 along x."""
    conditions = FaceConditions(SPACE, Boundaries(**heat), None, 300.0)
    conditions.flow_kind = lambda face: kinds.get(face, "symmetry")
    conditions.wall_velocity = lambda face: 5.0 if kinds.get(face) == "moving-wall" else 0.0
    types = ghost_types_of(conditions.ghost_faces(FLAT, has_bottom=True))
    number = {tuple(crossed): k for k, crossed in enumerate(types.crossed.T.tolist())}
    return conditions.rules(types), number


@pytest.mark.parametrize(
    ("crossed", "factor"),
    [
        # a wall turns all around, a plane of symmetry its normal component; products of both
        ((1, 0, 0), (-1, -1, -1)),
        ((0, 1, 0), (1, -1, 1)),
        ((1, 1, 0), (-1, 1, -1)),
        ((1, 0, 1), (1, 1, 1)),
        ((1, 1, 1), (1, -1, 1)),
    ],
)
def test_edges_and_corners_in_space(crossed, factor):
    """Walls at left and bottom, symmetry at the front."""
    rules, number = rules_in_space({}, {"left": "no-slip", "bottom": "no-slip"})
    assert rules.factor[:, number[crossed]].tolist() == list(factor)
    assert not rules.added.any()


def test_wall_that_moves_in_space():
    """Along x, on beyond a plane of symmetry at the front; it ends at a side that it meets, and at
    a wall beside it."""
    rules, number = rules_in_space({}, {"surface": "moving-wall", "back": "no-slip"})
    added = {crossed: rules.added[:, k].tolist() for crossed, k in number.items()}
    assert added[0, 0, 2] == added[0, 1, 2] == [10.0, 0.0, 0.0]
    assert added[1, 0, 2] == added[1, 1, 2] == added[0, 2, 2] == added[0, 2, 0] == [0.0] * 3


def test_heat_in_space():
    """The left face holds 310 K, with its normal along -x, in edges and corners as well."""
    rules, number = rules_in_space({"left": "fixed-temperature", "left_temperature": 310.0}, {})
    for crossed in ((1, 0, 0), (1, 1, 0), (1, 1, 2)):
        k = number[crossed]
        assert (rules.dirichlet[k], rules.wall_temperature[k]) == (1.0, 310.0)
        assert rules.normal[:, k].tolist() == [-1.0, 0.0, 0.0] and rules.heat_face[k] == 1.0
    assert not rules.dirichlet[number[0, 1, 2]]
