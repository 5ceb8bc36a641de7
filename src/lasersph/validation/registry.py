"""The list of validations: every folder beside this file that has a README is one.

`README.md` says what is asked, of whom, and within which bands; `case.toml` what is run,
`rows.toml` what is compared, `reference.csv` with what; `compare(study)` in `rows.py` does it.
"""

from __future__ import annotations

import tomllib
from importlib import import_module
from pathlib import Path

from lasersph.input import CaseError, nearest
from lasersph.validation.report import Report
from lasersph.validation.study import HOME, Study, module_of, title_of


def names() -> tuple[str, ...]:
    """Names of all validations, in the order in which they are best run."""
    # A folder with a README is a validation; case.toml gives its place in the order.
    homes = [file.parent for file in HOME.glob("*/README.md")]
    return tuple(home.name.replace("_", "-") for home in sorted(homes, key=_order))


def _order(home: Path) -> tuple[int, str]:
    keys = tomllib.loads((home / "case.toml").read_text(encoding="utf-8"))
    return keys["order"], home.name


def titles() -> dict[str, str]:
    """Name and the question that it answers."""
    return {name: title_of(name) for name in names()}


def known_name(name: str) -> str:
    """The name of a validation.

    Raises:
        CaseError: there is none of that name; says the nearest one.
    """
    if name not in names():
        near = nearest(name, names())
        hint = f'do you mean "{near}"?' if near else "there are " + ", ".join(names())
        raise CaseError(f'no validation "{name}"', hint)
    return name


def validate(
    name: str,
    out: str | Path,
    *,
    quick: bool = False,
    threads: int | None = None,
    backend: str = "cpu",
) -> Report:
    """Run one validation and draw its figures into `out`.

        report = lasersph.validate("stefan", "runs/stefan", quick=True)
        print(report.table())

    Runs that an earlier call with the same sources left there are taken or continued.

    Args:
        quick: shortened, with bands as stated in its rows; still judged.
        threads: of each run; None takes all processors. backend: "cpu" or "cuda".

    Raises:
        CaseError: no such validation; says the nearest name. NoDevice: no graphics card.
    """
    # The module compares, the study collects.
    module = import_module(module_of(known_name(name)))
    folder = Path(out)
    folder.mkdir(parents=True, exist_ok=True)
    study = Study(name, folder, quick=quick, threads=threads, backend=backend)
    module.compare(study)
    return study.report()
