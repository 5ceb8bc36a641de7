"""Writes docs/keys.md and docs/generated/*.md before Sphinx reads the pages."""

from pathlib import Path
from typing import Any

from case_keys import PAGE, keys_page
from constants_page import constants_of, constants_page, draw_kinds
from gallery_page import gallery_page
from metals_table import metals_page
from papers_page import draw_overview, overview, paper_page, read_papers
from result_keys import history_columns, summary_keys
from validation_charts import draw_charts
from validation_pages import validation_page
from validation_table import validation_table

DOCS = Path(__file__).resolve().parent.parent
ROOT = DOCS.parent


def gallery(folder: Path) -> str:
    """Every example's own README and its case file or plan."""
    parts = []
    for case in sorted([*folder.glob("*/case.toml"), *folder.glob("*/plan.toml")]):
        readme = case.with_name("README.md").read_text(encoding="utf-8")
        title, _, text = readme.partition("\n")
        picture = f"../examples/{case.parent.name}/figure.png"
        file = case.read_text(encoding="utf-8").rstrip()
        parts.append(f"#{title}\n{text}\n![{title[2:]}]({picture})\n\n```toml\n{file}\n```\n")
    return "\n".join(parts)


def write_pages(_app: object) -> None:
    """Make every generated page anew."""
    from lasersph.validation import names
    from lasersph.validation.records import state_of
    from lasersph.validation.study import home_of

    target = DOCS / "generated"
    target.mkdir(exist_ok=True)
    states = [state_of(name, DOCS / "validation") for name in names()]
    by_name = {state.name: state for state in states}
    draw_charts(states, target)
    papers = read_papers(DOCS / "papers.toml")
    draw_overview(papers, by_name, target / "papers.svg")
    constants = constants_of(ROOT / "src" / "lasersph")
    draw_kinds(constants, target / "numbers.svg")
    readmes = {name: (home_of(name) / "README.md").read_text("utf-8") for name in names()}
    pages = {
        "summary_keys.md": summary_keys(),
        "history_columns.md": history_columns(),
        "gallery.md": gallery_page(),
        "examples.md": gallery(ROOT / "examples"),
        "metals.md": metals_page(),
        "numbers.md": constants_page(constants),
        "validation.md": validation_table(states, readmes),
        "papers.md": overview(papers, by_name),
    }
    pages |= {f"paper-{name}.md": paper_page(name, papers[name], by_name) for name in papers}
    (target / "validation").mkdir(exist_ok=True)
    for state in states:
        pages[f"validation/{state.name}.md"] = validation_page(state, readmes[state.name])
    for name, text in pages.items():
        (target / name).write_text(text, encoding="utf-8")
    if PAGE.read_text(encoding="utf-8") != (keys := keys_page()):
        PAGE.write_text(keys, encoding="utf-8")


def setup(app: Any) -> dict[str, bool]:
    """Called by Sphinx."""
    app.connect("builder-inited", write_pages)
    return {"parallel_read_safe": True}
