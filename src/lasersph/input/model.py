"""`Model`: the frozen pydantic model that every input object of lasersph is.

Unknown keys are refused with the nearest spelling; numbers are finite; defaults are SI numbers.
"""

from __future__ import annotations

import difflib
from collections.abc import Iterable
from typing import Any

from pydantic import BaseModel, ConfigDict, model_validator
from pydantic_core import PydanticCustomError


class Model(BaseModel):
    """Base of all input objects: frozen, no unknown keys, SI floats inside."""

    model_config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False)

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
