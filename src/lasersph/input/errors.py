"""Problems of an input file, a line each: where, which key, what is wrong, what instead."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Problem:
    """One mistake: `file:line: key: what is wrong; what would be right`."""

    problem: str
    hint: str = ""
    key: str = ""
    file: str = ""
    line: int | None = None

    def __str__(self) -> str:
        """The problem as one line, without what is not known of its place."""
        place = f"{self.file}:{self.line}" if self.file and self.line else self.file
        text = ": ".join(part for part in (place, self.key, self.problem) if part)
        return f"{text}; {self.hint}" if self.hint else text


class CaseError(ValueError):
    """An input (case file, material file, override) that lasersph refuses; holds every problem.

    `file`, `line`, `key`, `problem` and `hint` are those of the first problem.
    """

    def __init__(
        self,
        problem: str | list[Problem],
        hint: str = "",
        *,
        key: str = "",
        file: str = "",
        line: int | None = None,
    ) -> None:
        """Take one problem in its parts, or a list of `Problem`."""
        if isinstance(problem, str):
            problem = [Problem(problem, hint, key, file, line)]
        self.problems = problem
        first = problem[0]
        self.problem, self.hint = first.problem, first.hint
        self.key = first.key
        self.file = first.file
        self.line = first.line
        super().__init__("\n".join(str(each) for each in problem))
