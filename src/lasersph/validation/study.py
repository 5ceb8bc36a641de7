"""`Study`: one validation while it runs: what it is to run and to compare, and what came out.

`compare(study)` in the `rows.py` of a folder makes its runs, adds rows, figures and remarks.
"""

from __future__ import annotations

import json
import tomllib
from pathlib import Path
from time import monotonic
from types import SimpleNamespace
from typing import TYPE_CHECKING, Any

import numpy as np

from lasersph import compute
from lasersph.case import Case, load_case
from lasersph.compute.backend import Backend
from lasersph.output import Run
from lasersph.plots import style
from lasersph.validation.comparison import Published, Row, number_at, read_comparisons
from lasersph.validation.drawing import Panel, draw
from lasersph.validation.report import Report
from lasersph.validation.runs import run_case
from lasersph.validation.tables import read_table

if TYPE_CHECKING:
    from matplotlib.figure import Figure

HOME = Path(__file__).parent
LIKE = "like"
"""Key of `case.toml` that names another validation, whose rows and keys hold here too."""


class Study:
    """One validation.

    Attributes:
        name: as in `lasersph validate NAME`. title: its question, in one line. quick: whether it
            runs shortened. plan: the keys of `case.toml`, those of its table `quick` over them
            where it runs shortened. folder: of its runs and figures.
        comparisons: kinds of rows by name, as `rows.toml` states them.
        rows, figures, remarks: those so far. cases: cases that were asked for, as texts that JSON
            reads as name and settings. solvers: kinds of those that ran.
    """

    def __init__(
        self,
        name: str,
        folder: Path,
        *,
        quick: bool = False,
        threads: int | None = None,
        backend: str = "cpu",
    ) -> None:
        # Plan and comparisons, those of another validation below its own.
        self.name = name
        self.title = title_of(name)
        self.folder = folder
        self.quick = quick
        self.threads, self.device = threads, backend
        homes = homes_of(name)
        self.plan = SimpleNamespace(**_plan_of(homes, quick=quick))
        self._home = homes[-1]
        self.comparisons = read_comparisons(
            file for home in homes if (file := home / "rows.toml").is_file()
        )
        # What is collected.
        self.rows: list[Row] = []
        self.figures: list[Path] = []
        self.remarks: list[str] = list(getattr(self.plan, "remarks", ()))
        self.cases: dict[str, None] = {}
        self.solvers: set[str] = set()
        self._started, self._saved = monotonic(), 0.0

    @property
    def backend(self) -> Backend:
        """Backend for loops that a validation runs itself."""
        return compute.cuda() if self.device == "cuda" else compute.cpu(self.threads)

    def case(self, *settings: str) -> Case:
        """The shipped case that `case.toml` names, with settings KEY=VALUE."""
        return self._load(self.plan.case, settings)

    def run(self, label: str, *settings: str, case: str = "") -> Run:
        """A run of that case, or of another shipped one, computed or taken from `runs/label`."""
        # Wall time of a run that is kept counts, too.
        wanted, begin = self._load(case or self.plan.case, settings), monotonic()
        self.solvers.add(wanted.solver.kind)
        folder = self.folder / "runs" / label
        one = run_case(wanted, folder, threads=self.threads, backend=self.device)
        self._saved += max(0.0, one.summary["wall_time_s"] - (monotonic() - begin))
        return one

    def _load(self, name: str, settings: tuple[str, ...]) -> Case:
        self.cases[json.dumps([name, *settings], ensure_ascii=False)] = None
        return load_case(name, settings)

    def table(self, name: str = "reference.csv") -> dict[str, np.ndarray]:
        """Columns of a table in the folder of the validation by name, (rows,)."""
        return read_table(self._home / name)

    def add(
        self,
        comparison: str,
        computed: float | None,
        reference: float | None = None,
        *,
        published: Published = None,
        judge: bool = True,
        share: float = 1.0,
        **words: Any,
    ) -> None:
        """Add a row of a kind that `rows.toml` states; args as of `Comparison.row`."""
        row = self.comparisons[comparison].row(
            computed,
            reference,
            published=published,
            judge=judge,
            quick=self.quick,
            share=share,
            words=words,
        )
        self.rows.append(row)

    def add_group(self, group: str, one: Run, **words: Any) -> None:
        """Add all rows of a group, whose numbers are those of a run's summary."""
        for name, comparison in self.comparisons.items():
            if comparison.group == group:
                value = number_at(one.summary, comparison.path, comparison.factor)
                self.add(name, value, **words)

    def draw(self, name: str, *panels: Panel, height: float = 3.4, **options: int) -> None:
        """Draw panels into NAME.png; options as of `drawing.draw`."""
        self.save(name, draw(panels, height=height, **options))

    def save(self, name: str, figure: Figure | None) -> None:
        """Write a figure, if there is one, as NAME.png."""
        if figure is not None:
            self.figures.append(style.save(figure, self.folder / f"{name}.png"))

    def report(self) -> Report:
        """All that there is so far."""
        return Report(
            self.name,
            self.title,
            tuple(self.rows),
            tuple(self.figures),
            tuple(self.remarks),
            self.quick,
            seconds=monotonic() - self._started + self._saved,
            cases=tuple(self.cases),
            solvers=tuple(sorted(self.solvers)),
        )


def home_of(name: str) -> Path:
    """Folder of a validation within the package."""
    return HOME / name.replace("-", "_")


def homes_of(name: str) -> list[Path]:
    """Folders whose keys and rows hold for a validation, its own last."""
    # Each folder may name another one that holds below it.
    homes = [home_of(name)]
    while LIKE in (keys := _keys_of(homes[0])):
        homes.insert(0, home_of(keys[LIKE]))
    return homes


def tables_of(name: str) -> list[Path]:
    """Tables of reference numbers that a validation may read."""
    return sorted(file for home in homes_of(name) for file in home.glob("*.csv"))


def module_of(name: str) -> str:
    """Module that compares a validation's numbers."""
    return f"lasersph.validation.{name.replace('-', '_')}.rows"


def title_of(name: str) -> str:
    """The question of a validation: the first line of its README."""
    with (home_of(name) / "README.md").open(encoding="utf-8") as stream:
        return stream.readline().removeprefix("#").strip()


def _plan_of(homes: list[Path], *, quick: bool) -> dict[str, Any]:
    """Keys of `case.toml` in some folders, later ones over earlier ones, those of `quick` last."""
    # Keys of the table `quick` lie over the others where it runs shortened.
    keys, short = {}, {}
    for home in homes:
        keys |= _keys_of(home)
        short |= keys.pop("quick", {})
    return keys | (short if quick else {})


def _keys_of(home: Path) -> dict[str, Any]:
    file = home / "case.toml"
    return tomllib.loads(file.read_text(encoding="utf-8")) if file.is_file() else {}
