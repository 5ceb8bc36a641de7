"""Fixtures for all tests."""

import os
import tempfile

import pytest

os.environ.setdefault(
    "LASERSPH_CACHE", os.path.join(tempfile.gettempdir(), f"lasersph-test-{os.getuid()}")
)


@pytest.fixture(scope="session", params=["cpu", "strict"])
def backend(request):
    """Backend in double precision: the CPU's, and the one whose arrays refuse NumPy."""
    from lasersph import compute

    return getattr(compute, request.param)(threads=2)
