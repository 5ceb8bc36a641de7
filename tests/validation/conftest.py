"""Studies for the tests of validations."""

import pytest

from lasersph.validation.study import Study


@pytest.fixture
def study(tmp_path):
    """A study of a validation by its name, shortened or in full, in an empty folder."""

    def of(name, *, quick=False):
        return Study(name, tmp_path, quick=quick)

    return of
