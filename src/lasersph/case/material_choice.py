"""The `material` key of a case: a name, a path, or a table that changes a named material.

    material = "steel-304"                     a shipped material or one of the user's folder
    material = "my-alloy.toml"                 a file, relative to the case file
    material = { base = "steel-304", conductivity = "20 W/(m K)" }
    [material] without base                    a whole material written into the case, e.g.
        density = "1 kg/m^3", heat_capacity = "1 J/(kg K)", diffusivity = "0.01 m^2/s",
        kinematic_viscosity = "0.01 m^2/s"

In a changed material a property replaces the base's whole law, a section (melting, vaporization,
optics) keeps the base's other numbers. Numbers without a source have "set in the case". Of the two
viscosities the one that is set replaces both of the base, and the density of its melt stays. A
constant diffusivity may stand instead of the conductivity k = D rho c_p.
"""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any, get_args

from pydantic import BeforeValidator, GetJsonSchemaHandler, ValidationInfo
from pydantic_core import CoreSchema

from lasersph.input import QuantityError, parse_quantity, read_toml, refusal
from lasersph.materials import Law, Material, Optics, load_material, material_file
from lasersph.materials.material import VISCOSITIES
from lasersph.materials.sections import Electrons

SET_HERE = "set in the case"
UNNAMED = "of the case"
SECTIONS = ("melting", "vaporization", "optics", "electrons")
LAWS = tuple(
    key
    for section in (Optics, Electrons)
    for key, field in section.model_fields.items()
    for kind in get_args(field.annotation) or (field.annotation,)
    if isinstance(kind, type) and issubclass(kind, Law)
)
"""Keys of sections that are laws, with a source of their own."""
UNSOURCED = ("source", "note", "uncertainty")
SOURCED_BELOW = (*LAWS, "by_wavelength")
"""Keys of sections whose laws and tables have sources of their own."""
PLAIN = ("name", "title", "composition", "note", "reference_temperature", "sulfur")


def _choose(value: Any, info: ValidationInfo) -> Any:
    """A material, or the data of one, from what the case says."""
    folder = (info.context or {}).get("folder")
    if isinstance(value, str | Path):
        return load_material(_located(value, folder))
    if isinstance(value, dict):
        return _changed(value, folder) if "base" in value else _whole(value)
    return value


def _located(name: str | Path, folder: Path | None) -> str | Path:
    """A path relative to the case's folder, or the name as it is."""
    is_path = str(name).endswith(".toml") or "/" in str(name) or isinstance(name, Path)
    return Path(folder) / Path(name).expanduser() if is_path and folder else name


def _whole(table: dict[str, Any]) -> dict[str, Any]:
    """The data of a material written into the case."""
    # Plain values and sections as they are, properties with a source.
    data: dict[str, Any] = {"name": UNNAMED}
    for key, value in table.items():
        if value is None or key in PLAIN:
            data[key] = value
        elif key in SECTIONS:
            data[key] = _changed_section({}, value) if isinstance(value, dict) else value
        else:
            data[key] = _sourced(value)
    # k = D rho c_p where a constant diffusivity stands in for the conductivity.
    if "conductivity" not in data and "diffusivity" in data:
        conductivity = _conductivity(data)
        if conductivity is not None:
            data["conductivity"] = conductivity
            data.pop("diffusivity")
    return data


def _conductivity(data: dict[str, Any]) -> dict[str, Any] | None:
    """D rho c_p where all three are constants; None where one is not or cannot be read."""
    product = 1.0
    for name, kind in (
        ("diffusivity", "diffusivity"),
        ("density", "density"),
        ("heat_capacity", "specific_heat"),
    ):
        value = data.get(name, {}).get("value")
        if not isinstance(value, str):
            return None
        try:
            product *= parse_quantity(value, kind)
        except QuantityError:
            return None
    return {"value": f"{product!r} W/(m K)", "source": f"D rho c_p, D {SET_HERE}"}


def _changed(table: dict[str, Any], folder: Path | None) -> dict[str, Any]:
    """The data of the base with the table's changes."""
    # The base as its file has it.
    base = table["base"]
    if not isinstance(base, str):
        raise ValueError('base must be the name or path of a material; write e.g. "steel-304"')
    located = _located(base, folder)
    material = load_material(located)
    data = read_toml(material_file(located)).data
    changes = {key: value for key, value in table.items() if key != "base"}

    # A viscosity that is set replaces both of the base; the density of the melt was their quotient.
    if len(changes.keys() & VISCOSITIES) == 1:
        if data.keys() >= set(VISCOSITIES) and "density" not in changes:
            data["density"] = _with_melt(data["density"], material.density_liquid)
        data = {key: value for key, value in data.items() if key not in VISCOSITIES}
    if changes:
        data["note"] = f"{data.get('note', '')} Changed in the case: {', '.join(changes)}.".strip()

    # Changes: sections keep the base's other numbers, properties are replaced whole.
    for key, value in changes.items():
        if key in SECTIONS and isinstance(value, dict):
            data[key] = _changed_section(data.get(key, {}), value)
        elif key in SECTIONS or key in PLAIN:
            data[key] = value
        else:
            data[key] = _sourced(value)

    # The diffusivity of a changed metal gives its conductivity, if nothing else does.
    if "diffusivity" in changes:
        conductivity = _conductivity(data)
        if "conductivity" in changes or conductivity is None:
            why = (
                "beside conductivity" if conductivity else "where one of D, rho, c_p is no constant"
            )
            raise refusal(("diffusivity", f"says nothing {why}; write conductivity alone"))
        data["conductivity"] = conductivity
    return data


def _with_melt(density: dict[str, Any], melt: float) -> dict[str, Any]:
    """The density of a base, its melt's as both viscosities of the base have it [kg/m^3]."""
    liquid = {"value": f"{melt!r} kg/m^3", "source": "viscosity / kinematic_viscosity of the base"}
    return {"solid": density.get("solid", density), "liquid": liquid}


def _changed_section(section: dict[str, Any], changes: dict[str, Any]) -> dict[str, Any]:
    # One source for all numbers of the section becomes a source for each.
    merged = dict(section)
    source = merged.get("source", {})
    sources = source if isinstance(source, dict) else dict.fromkeys(merged, source)
    sources = {key: sources[key] for key in sources if key not in UNSOURCED + SOURCED_BELOW}
    stated = {key: u for key, u in merged.get("uncertainty", {}).items() if key not in changes}
    merged["uncertainty"] = stated  # that of the base says nothing about a changed number
    # Each changed number is from the case; laws and tables have sources of their own.
    for key, value in changes.items():
        if value is None:
            continue
        if key in LAWS:
            merged[key] = _sourced(value)
        elif key == "by_wavelength" and isinstance(value, dict):
            tables = {name: _sourced(table) for name, table in value.items()}
            for table in tables.values():
                if table.get("reflectivity") is not None:
                    table["reflectivity"] = _sourced(table["reflectivity"])
            merged[key] = merged.get(key, {}) | tables
        elif key in UNSOURCED:
            merged[key] = value
        else:
            merged[key] = value
            sources[key] = SET_HERE
    # A source in words covers the whole section.
    if not isinstance(changes.get("source"), str):
        merged["source"] = sources | dict(changes.get("source", {}))
    return merged


def _sourced(value: Any) -> Any:
    """A property given in short ("20 W/(m K)") or without source as a table with one."""
    if not isinstance(value, dict):
        return {"value": value, "source": SET_HERE}
    # Laws of solid and liquid have a source each.
    laws = {key: _sourced(value[key]) for key in ("solid", "liquid") if value.get(key) is not None}
    return value | laws if laws else {"source": SET_HERE} | value


class _MaterialSchema:
    """JSON Schema of the key: a name, or a table of what a material knows."""

    def __get_pydantic_json_schema__(
        self, _schema: CoreSchema, _handler: GetJsonSchemaHandler
    ) -> dict[str, Any]:
        """Quantities may be text or a table with their law, so that they have no type."""
        # Keys of the material, in the form in which a case may write them.
        whole = Material.model_json_schema()
        keys: dict[str, Any] = {
            "base": {
                "type": "string",
                "description": "metal whose numbers hold where none is given here",
                "default": None,
                "examples": ["steel-304"],
            }
        }
        for name, part in whole["properties"].items():
            leaf = _resolved(part, whole["$defs"])
            below = leaf.get("properties", {})
            if name in SECTIONS:
                needed = [key for key in leaf.get("required", ()) if key != "source"]
                found = {
                    key: _key_description(below[key], whole["$defs"], key in needed)
                    for key in below
                }
                keys[name] = {
                    "type": "object",
                    "description": leaf["description"],
                    "properties": found,
                    "required": needed,
                    "x-needed": False,
                }
            else:
                keys[name] = _key_description(
                    part, whole["$defs"], name in whole["required"] and name != "name"
                )
        return {
            "anyOf": [
                {"type": "string", "examples": ["steel-304", "my-alloy.toml"]},
                {"type": "object", "properties": keys},
            ]
        }


def _resolved(part: dict[str, Any], definitions: dict[str, Any]) -> dict[str, Any]:
    """A part of a schema without its null and its reference."""
    part = part if "x-kind" in part else next(iter(part.get("anyOf", (part,))))
    return definitions[part["$ref"].rpartition("/")[2]] if "$ref" in part else part


def _key_description(
    part: dict[str, Any], definitions: dict[str, Any], is_needed: bool
) -> dict[str, Any]:
    """Meaning of a key, kind, unit and an example of the value that may stand there.

    "x-law" is true where that may be a law of the temperature as well, "x-needed" says whether a
    material without a base needs the key, "x-default" is the number that it has there otherwise.
    """
    leaf = _resolved(part, definitions)
    value = _resolved(leaf.get("properties", {}).get("value", leaf), definitions)
    # Unit, kind and example are those of the value, where the key may be a law.
    found = {key: value[key] for key in ("x-unit", "x-kind", "examples") if value.get(key)}
    if value is not leaf:
        found["x-law"] = True
    elif "x-kind" not in found:
        found["x-value"] = "text" if value.get("type") == "string" else "table"
    found["x-needed"] = is_needed
    if isinstance(part.get("default"), float):
        found["x-default"] = part["default"]
    return found | {key: part[key] for key in ("description",) if part.get(key)}


MaterialChoice = Annotated[Material, BeforeValidator(_choose), _MaterialSchema()]
