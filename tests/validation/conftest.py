"""Validations at full resolution run only when they are asked for: `pytest -m validate`."""

import pytest

from lasersph.validation.study import Study


@pytest.fixture
def study(tmp_path):
    """A study of a validation by its name, shortened or in full, in an empty folder."""

    def of(name, *, quick=False):
        return Study(name, tmp_path, quick=quick)

    return of


def pytest_collection_modifyitems(config, items):
    """Deselect tests marked `validate` unless -m names the mark."""
    if "validate" in config.getoption("-m"):
        return
    full = [item for item in items if item.get_closest_marker("validate")]
    if full:
        config.hook.pytest_deselected(items=full)
        items[:] = [item for item in items if item not in full]
