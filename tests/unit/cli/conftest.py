"""Where commands are given."""

import pytest


@pytest.fixture
def in_empty_folder(tmp_path, monkeypatch):
    """A test runs in a folder of its own."""
    monkeypatch.chdir(tmp_path)
