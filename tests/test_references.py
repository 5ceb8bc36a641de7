"""Sources: every citation key in the code stands in the bibliography, and is spelt one way."""

import re
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
KEY = re.compile(r"\[([A-Za-z][A-Za-z\-]*(?:19|20)\d\d[a-z]?)\b")


def test_citations_are_in_the_bibliography():
    """Each `[Name2020]` in a source file, alone or with an equation, is a key of references.bib;
    none stands there twice."""
    bibliography = (ROOT / "docs" / "references.bib").read_text(encoding="utf-8")
    listed = re.findall(r"^@\w+\{([^,]+),", bibliography, flags=re.MULTILINE)
    known = set(listed)
    cited = {
        (key, path.relative_to(ROOT).as_posix())
        for path in sorted((ROOT / "src").rglob("*.py"))
        for key in KEY.findall(path.read_text(encoding="utf-8"))
    }
    assert cited
    assert len(listed) == len(known), "a key stands twice"
    assert not [where for where in sorted(cited) if where[0] not in known]
