"""Folders for the addresses of the page."""

import shutil

import pytest
from page_client import browser_of
from synthetic_run import make_run

from lasersph.web.server import Pages


@pytest.fixture(scope="session")
def made(tmp_path_factory):
    """A folder with a complete run and one that was stopped."""
    root = tmp_path_factory.mktemp("runs")
    complete = make_run(root / "complete")
    (complete / "figures").mkdir()
    (complete / "figures" / "temperature.png").write_bytes(b"\x89PNG made up")
    (complete / "report.html").write_text("<script>1</script>")
    make_run(root / "series" / "stopped", complete=False)
    return root


@pytest.fixture
def root(made, tmp_path):
    """A copy of it that a test may spoil."""
    return shutil.copytree(made, tmp_path / "runs")


@pytest.fixture
def browser(root):
    """Of the copy."""
    return browser_of(root, Pages(root))
