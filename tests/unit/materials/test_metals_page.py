"""The page of metals: a row for each, made from the files, and a figure of all."""

import sys
from pathlib import Path

from lasersph.materials import available_materials

DOCS = Path(__file__).parents[3] / "docs"


def test_every_metal_of_several_sources_is_on_the_page(monkeypatch):
    """Those of the papers have their own files; numbers, optics and held values of all others."""
    monkeypatch.syspath_prepend(str(DOCS / "_extensions"))
    monkeypatch.delitem(sys.modules, "metals_table", raising=False)
    from metals_table import METALS, metals_page

    papers = {"aluminium-aa6014", "aluminium-demuth", "steel-304-demuth"}
    assert set(METALS) == set(available_materials()) - papers
    page = metals_page()
    assert "| copper | 1357.77 | 209 | 2843 | 4.73 | 401 | 151 |\n" in page
    assert "| copper | 7997 | 4.02 | 1.32 |" in page
    assert "| gold | 0.979, 12.1 nm | 0.706, 18.9 nm | 0.384, 15.1 nm |" in page
    assert "- **nickel**: `density.solid` above 1173 K (8530 kg/m^3); `density.liquid`" in page
    assert "$ lasersph material show copper\nPure copper" in page
    assert (DOCS / "images" / "metals.png").is_file()
