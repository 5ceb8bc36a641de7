"""How many runs a study may take whose runs are emulated."""

from __future__ import annotations

from pydantic import Field

from lasersph.input import Count, Model
from lasersph.sweeps.plan_reading import Mistakes


class RunBudget(Model):
    """How many runs may be made.

    Attributes:
        first: runs before the first look; None for four more than twice the keys. most: at most.
    """

    first: Count | None = None
    most: Count = 32
    seed: int = Field(default=1, ge=0, strict=True)

    def first_runs(self, keys: int) -> int:
        """Runs before the first look where so many keys vary."""
        return self.first or min(4 + 2 * keys, self.most)

    def refuse_too_few(self, keys: int, mistakes: Mistakes) -> None:
        """Add a mistake where an emulator of so many keys has too few runs."""
        least = keys + 2  # a mean, and a length of each key
        for name, value in (("first", self.first), ("most", self.most)):
            if value is not None and value < least:
                problem = f"too few: an emulator of {keys} key{'s' * (keys > 1)} needs {least} runs"
                mistakes.add(("runs", name), problem, f"write e.g. {name} = {8 + 2 * keys}")
        if self.first is not None and self.first > self.most:
            mistakes.add(
                ("runs", "first"), f"more than most, {self.most}", f"write most = {self.first}"
            )
