"""The names that `import lasersph` offers, and what it does not load."""

import inspect
import re
import subprocess
import sys

import pytest

import lasersph


def test_names_come_from_their_rooms():
    """Each public name is the room's own object."""
    from lasersph.case import Case, load_case
    from lasersph.input import CaseError
    from lasersph.output import open_run
    from lasersph.simulation import run
    from lasersph.studies import calibrate, process_map
    from lasersph.sweeps import sweep

    assert (lasersph.sweep, lasersph.map) == (sweep, process_map)
    assert lasersph.calibrate is calibrate
    assert (lasersph.Case, lasersph.load_case) == (Case, load_case)
    assert (lasersph.open_run, lasersph.run) == (open_run, run)
    assert lasersph.CaseError is CaseError
    assert set(dir(lasersph)) >= {"Case", "load_case", "open_run", "run", "__version__"}


def test_unknown_name():
    """As of any module."""
    with pytest.raises(AttributeError, match="no attribute 'simulate'"):
        _ = lasersph.simulate


@pytest.mark.parametrize("name", sorted(set(lasersph.__all__) - {"__version__", "plots"}))
def test_examples_are_shown_as_code(name):
    """In `help` and on the page of the API: a line of code alone below a sentence is no block, as
    what all lines are indented by is taken away."""
    text = inspect.getdoc(getattr(lasersph, name)) or ""
    code = [line for line in text.splitlines() if re.match(r"[\w.= (]*lasersph\.\w+\(", line)]
    assert all(line.startswith("    ") for line in code), code


def test_import_loads_no_library():
    """Neither pydantic nor anything numerical."""
    code = (
        "import sys, lasersph;"
        "loaded = {'numba', 'numpy', 'scipy', 'h5py', 'matplotlib', 'pint', 'pydantic'};"
        "assert not loaded & set(sys.modules), loaded & set(sys.modules)"
    )
    subprocess.run([sys.executable, "-c", code], check=True)
