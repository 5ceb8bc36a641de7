"""`FlowConditions`: what holds for the flow at each face of a closed box, named by face.

    no-slip        the fluid has the velocity of the wall, which rests: v = 0
    moving-wall    the fluid has the velocity of the wall, which moves along itself
    free-slip      nothing crosses, no stress: v n = 0, d(v t)/dn = 0
    symmetry       the same; also heat and pressure are mirrored
    periodic       what leaves at one face enters at the other
    flat           v n = 0, and the tangential gradient of surface tension is the stress
                   eta d(v t)/dn (top only)                            [Demuth2020, eq. (15)]
    free-surface   the same
    moving         moves with the liquid, under surface tension and its gradient (top only)

n is the normal of a face and t its tangent: x along surface and bottom, z along all sides.
Without a `[solver.flow]` table, or with one that names the surface of a metal that melts, what is
molten flows in the block below the surface.
"""

from __future__ import annotations

from typing import Annotated, Any, Literal, get_args

from pydantic import BeforeValidator, Field, GetJsonSchemaHandler, model_validator
from pydantic_core import CoreSchema

from lasersph.boundaries.initial_flow import InitialFlow, RestingFlow
from lasersph.boundaries.initial_surface import InitialSurface
from lasersph.input import Model, Velocity, refusal
from lasersph.particles.faces import ENDS, LATERAL, SURFACE, face_pairs

FlowKind = Literal[
    "no-slip",
    "moving-wall",
    "free-slip",
    "symmetry",
    "periodic",
    "free-surface",
    "flat",
    "moving",
]
FREE = ("free-surface", "flat", "moving")
"""Kinds of surfaces that are driven by surface tension."""
WALLS = ("no-slip", "moving-wall")


class FlowCondition(Model):
    """Condition for the flow at one face: a word, or a table with the velocity of the wall."""

    kind: FlowKind = Field(default="no-slip", description="how the fluid meets the face")
    velocity: Velocity = Field(
        default=0.0,
        description="of a moving wall, along it: x at surface and bottom, z at the sides",
    )

    @model_validator(mode="after")
    def _check_velocity(self) -> FlowCondition:
        if self.kind == "moving-wall" and self.velocity == 0.0:
            raise refusal(
                ("velocity", 'a moving wall needs its velocity; write velocity = "1 m/s"')
            )
        if self.kind != "moving-wall" and self.velocity != 0.0:
            raise refusal(
                (
                    "velocity",
                    f'says nothing where kind = "{self.kind}"; leave it out or write '
                    'kind = "moving-wall"',
                )
            )
        return self

    @property
    def is_wall(self) -> bool:
        """Whether the fluid sticks to this face."""
        return self.kind in WALLS

    @classmethod
    def __get_pydantic_json_schema__(
        cls, schema: CoreSchema, handler: GetJsonSchemaHandler
    ) -> dict[str, Any]:
        """A word or the table."""
        words = [kind for kind in get_args(FlowKind) if kind != "moving-wall"]
        table = handler.resolve_ref_schema(handler(schema))
        return {"anyOf": [{"enum": words, "type": "string"}, table]}


def _from_word(value: Any) -> Any:
    if not isinstance(value, str | dict | FlowCondition):
        raise ValueError('must be a word or a table; write e.g. "no-slip"')
    return {"kind": value} if isinstance(value, str) else value


AT_REST = FlowCondition.model_validate({})
Condition = Annotated[FlowCondition, BeforeValidator(_from_word)]


class FlowConditions(Model):
    """A closed box that is all fluid: what holds for the flow at its faces, and how it starts."""

    left: Condition = Field(default=AT_REST, description="at the smaller x; default: as sides")
    right: Condition = Field(default=AT_REST, description="at the larger x; default: as sides")
    front: Condition | None = Field(
        default=None,
        exclude_if=lambda given: given is None,
        description="at the smaller y; 3-D; default: as sides",
    )
    back: Condition | None = Field(
        default=None,
        exclude_if=lambda given: given is None,
        description="at the larger y; 3-D; default: as sides",
    )
    sides: Condition | None = Field(
        default=None,
        exclude_if=lambda given: given is None,
        description='at both ends of x and y; default: "no-slip"',
    )
    bottom: Condition = Field(default=AT_REST, description="at the smallest z")
    surface: Condition = Field(default=AT_REST, description="at z = 0")
    initial: InitialFlow = Field(default=RestingFlow(), description="velocity at the start")
    initial_surface: InitialSurface | None = Field(
        default=None, description="height of a surface that moves at the start"
    )

    @model_validator(mode="before")
    @classmethod
    def _fill_sides(cls, data: Any) -> Any:
        """Let left and right be as the sides, where the case does not say."""
        if not isinstance(data, dict) or data.get("sides") is None:
            return data
        return {side: data["sides"] for side in LATERAL[0]} | data

    @model_validator(mode="after")
    def _check_pairs(self) -> FlowConditions:
        problems = []
        # a period joins two faces, so both say so
        for one, other in face_pairs(3):
            kinds = {side: self.faces[side].kind for side in (one, other)}
            single = [side for side, kind in kinds.items() if kind == "periodic"]
            if len(single) == 1:
                partner = other if single[0] == one else one
                problems.append(
                    (
                        single[0],
                        f'periodic on one side only; write {partner} = "periodic" too, or another '
                        "kind here",
                    )
                )
        # surface tension acts at the top alone
        for side, condition in self.faces.items():
            if side != SURFACE and (kind := condition.kind) in FREE:
                key = side if getattr(self, side) not in (None, self.sides) else "sides"
                problems.append((key, f'a free surface lies at the top; write surface = "{kind}"'))
        # heights need a surface that moves
        if self.initial_surface is not None and self.surface.kind != "moving":
            problems.append(
                (
                    "initial_surface",
                    f'says nothing where surface = "{self.surface.kind}"; write surface = "moving"',
                )
            )
        if problems:
            raise refusal(*problems)
        return self

    @property
    def names_surface_only(self) -> bool:
        """Whether it says nothing but what kind of free surface there is."""
        is_named = self.surface.kind in ("flat", "moving") and self.initial == RestingFlow()
        others = (each for face, each in self.faces.items() if face != SURFACE)
        return is_named and all(each == AT_REST for each in others)

    @property
    def mirror(self) -> str:
        """Front or back where that alone of the two is a plane of symmetry, else nothing."""
        planes = [face for face in LATERAL[1] if self.faces[face].kind == "symmetry"]
        return planes[0] if len(planes) == 1 else ""

    @property
    def faces(self) -> dict[str, FlowCondition]:
        """The conditions by face, those of y, which only blocks have, included."""
        return {name: getattr(self, name) or self.sides or AT_REST for name in ENDS}
