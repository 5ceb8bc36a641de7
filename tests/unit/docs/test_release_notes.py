"""What a release needs to agree on: version, changelog, citation."""

import re
from pathlib import Path

import pytest
from release_notes import cited_version, notes_of

from lasersph import __version__

ROOT = Path(__file__).resolve().parents[3]
LOG = """# Changelog

## 0.2.0 (not yet released)

### Added
- Two.

## 0.1.0 (2026-12-01)

- One.
"""


def test_notes_are_the_part_of_the_version():
    """From its head to that of the version before."""
    assert notes_of(LOG, "0.2.0") == ("not yet released", "### Added\n- Two.")
    assert notes_of(LOG, "0.1.0") == ("2026-12-01", "- One.")


def test_missing_part():
    """A version that nobody wrote down cannot be released."""
    with pytest.raises(ValueError, match=r"no part '## 0\.3\.0"):
        notes_of(LOG, "0.3.0")


def test_package_changelog_and_citation_agree():
    """One version everywhere, and a changelog that is short enough to be read."""
    text = (ROOT / "CHANGELOG.md").read_text(encoding="utf-8")
    _, notes = notes_of(text, __version__)
    assert cited_version((ROOT / "CITATION.cff").read_text(encoding="utf-8")) == __version__
    entries = [line for line in notes.splitlines() if line and not re.match(r"#|- |\S.*:$", line)]
    assert not [line for line in entries if line.startswith(" ")], "one line a change"
    assert len(notes.splitlines()) <= 70
