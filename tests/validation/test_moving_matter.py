"""The validations of matter that moves, shortened; in full with `pytest -m validate`."""

import pytest

from lasersph.validation import dam_break, hydrostatic_column, sound_wave


@pytest.mark.parametrize("validation", [sound_wave, hydrostatic_column, dam_break])
def test_quick(validation, tmp_path):
    """Speed of sound in 1-D, 1 s of water at rest, a column 15 particles wide that collapses."""
    report = validation.run(tmp_path, quick=True)
    assert report.passed, report.table()
    assert all(figure.exists() for figure in report.figures)
