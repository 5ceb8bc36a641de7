"""What the documentation does to tables and lists when it is built."""

import sys

import draw_figures
from docutils import nodes
from figures import GALLERY

sys.path.insert(0, str(draw_figures.DOCS / "_extensions"))
import gallery_page  # pyright: ignore  # the folder is no package
import units_in_tables  # pyright: ignore

BLANK = units_in_tables.NO_BREAK


def kept(text, parent=nodes.paragraph):
    """The text of a cell after the extension has seen it."""
    document = nodes.document(None, None)
    inner = parent(text, "", nodes.Text(text)) if parent is nodes.paragraph else parent(text, text)
    document += nodes.entry("", inner)
    units_in_tables.keep_units(None, document)
    return document.astext()


def test_numbers_stay_with_their_units():
    """Of lengths, times, shares, stresses, and after a bracket; words may part."""
    assert kept("186 nm") == f"186{BLANK}nm"
    assert kept("0.65 nm, 0.2 %") == f"0.65{BLANK}nm, 0.2{BLANK}%"
    assert kept("3 µm and 10 MPa") == f"3{BLANK}µm and 10{BLANK}MPa"
    assert kept("5 spacings of 2 metals") == "5 spacings of 2 metals"


def test_powers_are_written_as_powers():
    """A narrow column would part 1.7e- and 06; powers part before their point alone."""
    assert kept("1.74452e-05") == "1.74452\u200b·10⁻⁵"
    assert kept("Ra 1e+03, 3e11 W/m²") == f"Ra 10³, 3\u200b·10¹¹{BLANK}W/m²"
    assert kept("0.6 e, a1e3, 2e") == "0.6 e, a1e3, 2e"


def test_what_is_typed_is_left():
    """A command in a cell keeps its blanks."""
    assert kept("sleep 5 s", nodes.literal) == "sleep 5 s"


def test_stale_pictures_are_folded(monkeypatch):
    """The gallery shows pictures; which are old is for whoever opens the list."""
    monkeypatch.setattr(gallery_page, "stale_sources", lambda name: ["a module"])
    page = gallery_page.gallery_page()
    before, _, folded = page.partition("<details>")
    assert "a module" not in before and folded.count("a module") == len(GALLERY)
    monkeypatch.setattr(gallery_page, "stale_sources", lambda name: [])
    assert "<details>" not in gallery_page.gallery_page()
