"""Print the notes of a release: the part of CHANGELOG.md under the version of the package.

    python docs/release_notes.py

Ends with a line and exit code 1 where that part is missing or has no date yet, or where
CITATION.cff names another version.
"""

from __future__ import annotations

import re
import sys
from pathlib import Path

from lasersph import __version__

ROOT = Path(__file__).resolve().parents[1]
HEAD = re.compile(r"^## (?P<version>\d+\.\d+\.\d+) \((?P<date>[^)]*)\)$", re.MULTILINE)
DATE = re.compile(r"\d{4}-\d{2}-\d{2}")


def notes_of(changelog: str, version: str) -> tuple[str, str]:
    """Date and text of a version in a changelog. Raises ValueError where it is not there."""
    heads = list(HEAD.finditer(changelog))
    for head, following in zip(heads, [*heads[1:], None], strict=True):
        if head["version"] == version:
            end = following.start() if following else len(changelog)
            return head["date"], changelog[head.end() : end].strip()
    raise ValueError(f"CHANGELOG.md has no part '## {version} (DATE)'")


def cited_version(citation: str) -> str:
    """The version that CITATION.cff names; empty where it names none."""
    found = re.search(r"^version: (\S+)$", citation, re.MULTILINE)
    return found[1] if found else ""


def main() -> None:
    """Print the notes, or say what is missing."""
    try:
        date, text = notes_of((ROOT / "CHANGELOG.md").read_text(encoding="utf-8"), __version__)
    except ValueError as error:
        sys.exit(str(error))
    if not DATE.fullmatch(date):
        sys.exit(f"CHANGELOG.md: {__version__} has no date yet, but '{date}'; write YYYY-MM-DD")
    cited = cited_version((ROOT / "CITATION.cff").read_text(encoding="utf-8"))
    if cited != __version__:
        sys.exit(f"CITATION.cff names version {cited}, the package is {__version__}")
    print(f"lasersph {__version__}, {date}\n\n{text}")


if __name__ == "__main__":
    main()
