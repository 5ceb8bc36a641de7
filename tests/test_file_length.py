"""Files stay short enough to be read: a guideline alone does not keep them so, a test does."""

from pathlib import Path
from statistics import median

ROOT = Path(__file__).resolve().parent.parent
LONGEST = 400
OTHERS = "uplot.js"
"""Packed into one line, of a library."""


def test_no_file_is_longer_than_400_lines(capsys):
    """Every file of sources, tests and benchmarks has at most 400 lines; the median is printed."""
    scripts = [file for file in (ROOT / "src").rglob("*.js") if file.name != OTHERS]
    folders = (ROOT / name for name in ("src", "tests", "benchmarks"))
    files = [*(file for folder in folders for file in sorted(folder.rglob("*.py"))), *scripts]
    lengths = {path: len(path.read_text(encoding="utf-8").splitlines()) for path in files}
    with capsys.disabled():
        print(f"\n{len(files)} files, median {median(lengths.values()):.0f} lines")
    too_long = {str(path): length for path, length in lengths.items() if length > LONGEST}
    assert not too_long
