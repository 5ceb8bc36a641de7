"""`Case`: the whole problem as one frozen model made of the rooms' own models, in SI units."""

from __future__ import annotations

import json
from typing import Any, Self

from pydantic import PrivateAttr, model_validator

from lasersph.case.checks import problems_of
from lasersph.case.contents import CaseContents
from lasersph.input import refusal


class Case(CaseContents):
    """One problem: metal, light, block, particles, boundaries, solver, times, what is stored."""

    _name: str = PrivateAttr("")
    _text: str = PrivateAttr("")
    _conversion_note: str = PrivateAttr("")

    @model_validator(mode="after")
    def _check_together(self) -> Self:
        """Refuse contradictions that no room can see alone."""
        # A refusal names every key that is at fault, not the first one only.
        found = problems_of(self)
        if found:
            raise refusal(*found)
        return self

    @property
    def name(self) -> str:
        """Name of the shipped case or stem of the file; the title of a case built in Python."""
        return self._name or self.title or "case"

    @property
    def text(self) -> str:
        """The case file as given, headed by its overrides as comments."""
        return self._text or "# Built in Python: all values are in resolved.json.\n"

    @property
    def conversion_note(self) -> str:
        """One line that says which keys of an older file were read elsewhere; empty for none."""
        return self._conversion_note

    def named(self, name: str, text: str, conversion_note: str = "") -> Self:
        """The same case with the name, the text and the conversion note of its file."""
        # The model is frozen: the copy is named before anybody sees it.
        copy = self.model_copy()
        copy._name = name
        copy._text = text
        copy._conversion_note = conversion_note
        return copy

    def resolved(self) -> dict[str, Any]:
        """Everything with all defaults filled in, SI, as plain data for JSON."""
        return json.loads(self.model_dump_json())

    def hash(self) -> str:
        """Short name of the content: equal for equal cases however they were written."""
        from lasersph.output import hash_of_case

        return hash_of_case(self.resolved())
