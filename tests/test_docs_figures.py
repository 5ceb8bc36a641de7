"""Stored figures of the documentation: all are there, small and shown; stale ones are known."""

import json
import re
import sys

import draw_figures
import pytest
from figures import GALLERY, REGISTRY

sys.path.insert(0, str(draw_figures.DOCS / "_extensions"))
from validation_charts import judged  # pyright: ignore  # the folder is no package

PAGES = [page for page in draw_figures.DOCS.rglob("*.md") if "generated" not in page.parts]
LARGEST = 150_000
"""Of a stored figure [bytes]: all of them together stay below 3 MB."""
LARGEST_MOVIE = 600_000


@pytest.mark.parametrize("name", REGISTRY)
def test_figure_is_stored_small_and_shown(name):
    """Its file and the hashes of its sources are there; it is in the gallery or on a page."""
    figure = REGISTRY[name]
    file = figure.path(draw_figures.IMAGES)
    assert file.stat().st_size < (LARGEST_MOVIE if figure.kind == "gif" else LARGEST)
    assert set(draw_figures.read_stamps()[name]) == set(figure.sources)
    texts = [page.read_text(encoding="utf-8") for page in PAGES]
    in_gallery = name in {entry.figure.name for entry in GALLERY}
    assert in_gallery or any(f"images/{file.name}" in text for text in texts)


def test_every_page_of_methods_shows_a_figure_of_our_own():
    """One that is drawn by `draw_figures`, a benchmark or an extension, or recorded."""
    docs = draw_figures.DOCS
    extensions = "".join(file.read_text() for file in (docs / "_extensions").glob("*.py"))
    scripts = "".join(file.read_text() for file in (docs.parent / "benchmarks").glob("*.py"))
    drawn = {figure.path(draw_figures.IMAGES) for figure in REGISTRY.values()}
    for page in set((docs / "methods").glob("*.md")) - {docs / "methods" / "index.md"}:
        text = page.read_text(encoding="utf-8")
        images = re.findall(r"\(([^()\s]+\.(?:png|svg|gif))\)", text)
        files = [(page.parent / image).resolve() for image in images]
        recorded = [one for one in files if docs / "validation" in one.parents and one.is_file()]
        measured = [one for one in files if f"docs/images/{one.name}" in scripts]
        made = [one for one in files if one.parent.name == "generated"]
        made = [one for one in made if f'"{one.name}"' in extensions]
        of_run = re.search(r"`figures/[a-z-]+\.png` of this run", text)  # by a command above
        assert recorded or measured or made or of_run or drawn & set(files), page.name


def test_change_of_a_source_makes_a_figure_stale(tmp_path, monkeypatch):
    """The source that changed is named; a figure that was never drawn is stale as well."""
    figure = REGISTRY["methods-evaporation"]
    now = draw_figures.stamp(figure)
    monkeypatch.setattr(draw_figures, "STAMPS", tmp_path / "stamps.json")
    assert draw_figures.stale_sources(figure.name) == ["not drawn yet"]
    for module in (None, "lasersph.physics.evaporation"):
        stored = now | ({module: "another"} if module else {})
        draw_figures.STAMPS.write_text(json.dumps({figure.name: stored}))
        assert draw_figures.stale_sources(figure.name) == ([module] if module else [])


def test_hash_follows_imports():
    """A module that the named one computes with counts, and one that draws does not."""
    source = "lasersph.simulation.recipes.melt_pool"
    closure = draw_figures.sources.hashes([source])
    assert any(name.startswith("lasersph.sph.") for name in closure)
    assert not any(name.startswith("lasersph.plots") for name in closure)


def row(computed: float, verdict: bool | None, own: bool = False) -> dict:
    """A row of a record whose reference is 1 and whose tolerance is 0.1."""
    return {
        "quantity": f"number {computed:g}", "published": None, "reference": 1.0,
        "computed": computed, "tolerance": 0.1, "verdict": verdict, "own": own,
    }  # fmt: skip


def test_charts_show_every_judged_number():
    """Met left of 1, missed right of it; what is only shown, or our own, is left out."""
    rows = [row(1.05, True), row(1.3, False), row(5.0, None), row(6.0, False, own=True)]
    assert judged({"rows": rows}) == pytest.approx({"number 1.05": 0.5, "number 1.3": 3.0})
