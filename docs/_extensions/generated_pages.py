"""Writes docs/generated/*.md before Sphinx reads the pages that include them."""

from pathlib import Path
from typing import Any

from case_keys import case_keys
from gallery_page import gallery_page
from metals_table import metals_page
from papers_page import papers_page, read_papers
from result_keys import history_columns, summary_keys
from validation_charts import draw_charts
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
    from lasersph.case import Case
    from lasersph.validation import names
    from lasersph.validation.records import state_of
    from lasersph.validation.study import home_of

    target = DOCS / "generated"
    target.mkdir(exist_ok=True)
    states = [state_of(name, DOCS / "validation") for name in names()]
    by_name = {state.name: state for state in states}
    draw_charts(states, target)
    readmes = {name: (home_of(name) / "README.md").read_text("utf-8") for name in names()}
    pages = {
        "case_keys.md": case_keys(Case.model_json_schema()),
        "summary_keys.md": summary_keys(),
        "history_columns.md": history_columns(),
        "gallery.md": gallery_page(),
        "examples.md": gallery(ROOT / "examples"),
        "metals.md": metals_page(),
        "validation.md": validation_table(states, readmes),
        "papers.md": papers_page(read_papers(DOCS / "papers.toml"), by_name),
    }
    for name, text in pages.items():
        (target / name).write_text(text, encoding="utf-8")


def setup(app: Any) -> dict[str, bool]:
    """Called by Sphinx."""
    app.connect("builder-inited", write_pages)
    return {"parallel_read_safe": True}
