"""Which modules a computation runs through, by imports, and that it runs through no other."""

import ast
import sys
from pathlib import Path

import pytest

from lasersph.case import load_case
from lasersph.simulation import run
from lasersph.validation import sources

SHORT = {
    "stefan": ["particles.spacing=2 um", "time.end=4 ns", "time.step=2 ns"],
    "natural-convection": ["particles.spacing=0.125 m", "time.end=20 ms"],
    "dam-break": ["particles.spacing=9.525 mm", "time.end=1 ms"],
}


def modules_of(kind):
    """Modules of a run with a kind of solver."""
    return sources.hashes([sources.TIME_LOOP, sources.recipe_module(kind)])


def test_a_solver_without_the_others():
    """Conduction depends on its own solver and on no other, though all of them are loaded."""
    found = modules_of("conduction")
    for module in ("solvers.conduction.implicit", "compute.launch", "materials.caloric_curve"):
        assert f"lasersph.{module}" in found
    for module in ("solvers.melt_pool.flow", "solvers.ablation.solver", "plots.style"):
        assert f"lasersph.{module}" not in found
    assert "lasersph.input.findings" not in found  # what is said of a case that is refused
    assert "lasersph.solvers.melt_pool.flow" in modules_of("melt-pool")
    assert "lasersph.solvers.conduction.implicit" in modules_of("melt-pool")


def test_words_do_not_count():
    """Docstrings, lines of comments and empty ones are left out; strings that are read stay."""
    text = (
        '"""Words."""\n\n# words\nX = 1  # kept\n"""Words\nof X."""\n\n'
        'def f():\n    """Words."""\n    # words\n    return """\n# text\n\n"""\n'
    )
    kept = 'X = 1  # kept\ndef f():\n    return """\n# text\n\n"""'
    assert sources.code_of(text, ast.parse(text)) == kept


def test_of_a_validation():
    """The folder itself and what it calls; the runner that prints and draws changes no number."""
    found = sources.hashes(["lasersph.validation.dlip_aluminium.rows"])
    assert {"lasersph.validation.dlip_steel.rows", "lasersph.validation.comparison"} <= set(found)
    assert not {"lasersph.validation.study", "lasersph.validation.dlip_steel.figures"} & set(found)
    kernels = sources.hashes(["lasersph.validation.kernels.rows"])
    assert "lasersph.sph.kernels" in kernels and "lasersph.case.loading" not in kernels


@pytest.mark.parametrize("name", SHORT)
def test_nothing_else_is_executed(name, tmp_path):
    """Every function of the package that a run calls lies in a module of the list."""
    case = load_case(name, SHORT[name])
    run(case, tmp_path / "first", threads=1)  # what is compiled and imported only once
    files = set()
    sys.setprofile(lambda frame, event, _: files.add(frame.f_code.co_filename))
    try:
        run(case, tmp_path / "second", threads=1)
    finally:
        sys.setprofile(None)
    inner = [Path(file).relative_to(sources.ROOT) for file in files if str(sources.ROOT) in file]
    called = {".".join(["lasersph", *file.with_suffix("").parts]) for file in inner}
    assert len(called) > 30
    assert {name.removesuffix(".__init__") for name in called} <= set(modules_of(case.solver.kind))
