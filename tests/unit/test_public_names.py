"""The names that `import lasersph` offers, and what it does not load."""

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


def test_import_loads_no_library():
    """Neither pydantic nor anything numerical."""
    code = (
        "import sys, lasersph;"
        "loaded = {'numba', 'numpy', 'scipy', 'h5py', 'matplotlib', 'pint', 'pydantic'};"
        "assert not loaded & set(sys.modules), loaded & set(sys.modules)"
    )
    subprocess.run([sys.executable, "-c", code], check=True)
