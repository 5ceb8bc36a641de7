"""`Model`: the frozen pydantic model that every input object of lasersph is.

Unknown keys are refused with the nearest spelling; numbers are finite; defaults are SI numbers.
"""

from __future__ import annotations

import difflib
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

from pydantic import BaseModel, ConfigDict, ValidationInfo, model_validator
from pydantic_core import PydanticCustomError


class Model(BaseModel):
    """Base of all input objects: frozen, no unknown keys, SI floats inside."""

    # what checks a kind of object is built with the first one: a fifth of the time of a start
    model_config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False, defer_build=True)

    @model_validator(mode="before")
    @classmethod
    def _refuse_unknown_keys(cls, data: Any) -> Any:
        if isinstance(data, dict):
            # The known keys go along, for the hint.
            known = list(cls.model_fields)
            unknown = [str(key) for key in data if key not in cls.model_fields]
            if unknown:
                raise PydanticCustomError(
                    "unknown_keys",
                    "unknown key {shown}",
                    {
                        "shown": ", ".join(f'"{key}"{did_you_mean(key, known)}' for key in unknown),
                        "keys": unknown,
                        "known": known,
                    },
                )
        return data


def with_rows_of_file(
    data: Any,
    info: ValidationInfo,
    columns: tuple[str, ...],
    *,
    key: str = "rows",
    wider: tuple[str, ...] = (),
    largest: Mapping[str, float] | None = None,
) -> Any:
    """Values of a model with the rows of the CSV file that `path` names, where no rows are given.

    A path counts from the folder of the case file.

    Args:
        columns: names in the file, all in SI. key: under which the rows are kept. wider: names
            that are read instead where the file has all of them. largest: of a table over time,
            see `csv_rows.read_rows`; its times are then in s.
    """
    path = data.get("path") if isinstance(data, dict) else None
    if not path or not isinstance(path, str) or data.get(key):
        return data
    from lasersph.input.csv_rows import has_columns, read_rows  # few cases name a file

    file = Path((info.context or {}).get("folder") or Path()) / Path(path).expanduser()
    rows = read_rows(file, wider if wider and has_columns(file, wider) else columns, largest)
    over_time = [(f"{row[0]!r} s", *row[1:]) for row in rows] if largest is not None else rows
    return data | {key: over_time}


def refusal(*problems: tuple[str, str]) -> PydanticCustomError:
    """An error for validators that knows which keys are at fault.

    Args:
        problems: (key, text) with the key as in "laser.beam", relative to the model that checks,
            and the text as "what is wrong; what would be right".
    """
    text = "; ".join(f"{key}: {text}" for key, text in problems)
    return PydanticCustomError("at_key", "{text}", {"text": text, "problems": list(problems)})


def nearest(word: str, known: Iterable[str]) -> str | None:
    """The known word spelt most like `word`, or None if none is near."""
    # Case and hyphens are no difference.
    plain = {name.lower().replace("-", "_"): name for name in known}
    found = difflib.get_close_matches(word.lower().replace("-", "_"), plain, n=1, cutoff=0.6)
    return plain[found[0]] if found else None


def did_you_mean(word: str, known: Iterable[str]) -> str:
    """' (do you mean "spacing"?)' or nothing."""
    near = nearest(word, known)
    return f' (do you mean "{near}"?)' if near else ""
