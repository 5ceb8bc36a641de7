"""The validations of matter that moves, shortened; in full with `pytest -m validate`."""

import pytest

from lasersph.validation import validate


@pytest.mark.parametrize("name", ["sound-wave", "hydrostatic-column", "dam-break"])
def test_quick(name, tmp_path):
    """Speed of sound in 1-D, 1 s of water at rest, a column 15 particles wide that collapses."""
    report = validate(name, tmp_path, quick=True)
    assert report.passed, report.table()
    assert all(figure.exists() for figure in report.figures)
