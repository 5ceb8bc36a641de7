"""No benchmark asks for a name that the package has no longer."""

from importlib import import_module
from pathlib import Path

import pytest

FOLDER = Path(__file__).parents[3] / "benchmarks"


@pytest.mark.parametrize("name", sorted(path.stem for path in FOLDER.glob("*.py")))
def test_benchmark_can_be_imported(name):
    """Benchmarks run seldom, so that a renamed function would be noticed late."""
    import_module(name)
