"""Sources: every citation key in the code stands in the bibliography, and is spelt one way."""

import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "docs" / "_extensions"))
from references_page import PAGE, anchor, entries, references_page  # noqa: E402  (no package)

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


def test_page_is_current():
    """`python docs/_extensions/references_page.py` writes it anew; no mark of BibTeX is left."""
    bibliography = (ROOT / "docs" / "references.bib").read_text(encoding="utf-8")
    text = PAGE.read_text(encoding="utf-8")
    assert text == references_page(bibliography)
    assert not re.search(r"[{}\\]", text)
    assert len(entries(bibliography)) == bibliography.count("\n@") + 1


def test_links_lead_to_a_work():
    """Each link to the page of references names one of its sections."""
    known = {anchor(key) for key in re.findall(r"^## (.*)$", PAGE.read_text("utf-8"), re.MULTILINE)}
    pages = [page for page in (ROOT / "docs").rglob("*.md") if "generated" not in page.parts]
    linked = {
        key
        for page in pages
        for key in re.findall(r"references\.md#([^)]+)\)", page.read_text("utf-8"))
    }
    assert len(linked) > 40
    assert linked <= known
