"""What holds for the flow at the sides of a box."""

import pytest
from pydantic import ValidationError

from lasersph.boundaries import FlowCondition, FlowConditions


def test_a_word_or_a_table():
    """A word is the kind; a table adds the velocity; sides not named are walls at rest."""
    flow = FlowConditions.model_validate(
        {"left": "free-slip", "surface": {"kind": "moving-wall", "velocity": "2 mm/s"}}
    )
    assert flow.left == FlowCondition(kind="free-slip")
    assert (flow.surface.kind, flow.surface.velocity) == ("moving-wall", 2e-3)
    assert flow.bottom == flow.right == FlowCondition(kind="no-slip", velocity=0.0)
    assert set(flow.faces) == {"left", "right", "front", "back", "bottom", "surface"}
    free = {name for name, side in flow.faces.items() if not side.is_wall}
    assert free == {"left"}


def test_round_trip():
    """Plain data of the sides read back is the same."""
    flow = FlowConditions.model_validate({"left": "periodic", "right": "periodic"})
    assert FlowConditions.model_validate(flow.model_dump()) == flow


@pytest.mark.parametrize(
    ("data", "message"),
    [
        ({"bottom": "periodic"}, 'write surface = "periodic" too'),
        ({"right": "periodic"}, 'write left = "periodic" too'),
        ({"left": "free-surface"}, 'write surface = "free-surface"'),
        ({"left": "moving-wall"}, "a moving wall needs its velocity"),
        ({"left": {"kind": "free-slip", "velocity": 1.0}}, "says nothing"),
        ({"left": 3}, "must be a word or a table"),
    ],
)
def test_refusals(data, message):
    """What contradicts itself is refused in words."""
    with pytest.raises(ValidationError, match=message):
        FlowConditions.model_validate(data)


@pytest.mark.parametrize(
    "front, back, mirror",
    [
        ("symmetry", "no-slip", "front"),
        ("no-slip", "symmetry", "back"),
        ("symmetry", "symmetry", ""),
        ("no-slip", "no-slip", ""),
    ],
)
def test_half_of_a_block(front, back, mirror):
    """One plane of symmetry along y ends the half of a block; two end a part of a pattern."""
    assert FlowConditions.model_validate({"front": front, "back": back}).mirror == mirror
