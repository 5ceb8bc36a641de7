"""Pages that people finish: 1 500 words at most, with a picture and without commits; those that
cannot be short or show a picture say why here.

Paragraphs have 100 words at most, those of the texts of validations too. Counted are words outside
of code, formulas and addresses of links. All pages with their counts: `python
tests/test_docs_length.py`.
"""

import re
from pathlib import Path

import pytest

from lasersph.validation import names
from lasersph.validation.study import home_of

DOCS = Path(__file__).resolve().parent.parent / "docs"
EXAMPLES = DOCS.parent / "examples"
MOST = 1500
"""Words of a page: seven minutes of reading."""
MOST_IN_A_PARAGRAPH = 100
"""Words of a paragraph: half a minute of reading."""
MOST_IN_A_LINE = 102
"""Characters of a line of code: as many as fit a page that is 1 400 pixels wide."""
BLOCK = re.compile(r"^```([^\n]*)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
CODE = ("", "sh", "toml", "python", "{code-cell} ipython3", "{code-block} python")
"""What begins a block of code."""
NO_WORDS = re.compile(r"```.*?```|\$\$.*?\$\$|\$[^$\n]*\$|\]\([^)]*\)", re.DOTALL)
PICTURE = re.compile(r"!\[[^\]]*\]\([^)]+\)|\{code-cell\}")
"""A picture, or a cell of a notebook, which draws some when the pages are built."""
LONG: dict[str, str] = {}
MOST_COUNTED = 1500
"""Words of a page as `wc -w` counts them, with formulas, code and bars of tables."""
LONG_COUNTED = {
    "methods/dots.md": "a quarter of it is formulas and the bars of its tables",
    "methods/melt_pool.md": "formulas",
    "methods/moving_surface.md": "formulas",
    "methods/sections.md": "formulas and the bars of its tables",
    "results.md": "tables of files and keys to look things up in",
    "texture.md": "commands and their tables",
}
PLAIN = {
    "api.md": "made from docstrings",
    "benchmarks.md": "benchmarks/README.md: commands",
    "cases.md": "a table of keys",
    "cluster.md": "commands and files of a queue",
    "examples.md": "shows the pictures of the examples, put in when it is built",
    "extend.md": "a list of pages",
    "extend/materials.md": "a file to copy",
    "extend/observers.md": "code, which draws its figure",
    "extend/physics.md": "code",
    "extend/validations.md": "files to copy",
    "gallery.md": "shows all pictures, put in when it is built",
    "methods/index.md": "a list of pages",
    "notes/index.md": "a list of pages",
    "papers/ablation.md": "shows the figures of the paper, put in when it is built",
    "papers/texturing.md": "shows the figures of the paper, put in when it is built",
    "stability.md": "a table of promises",
    "sweeps.md": "plans to type; what comes out is on the page of maps",
    "tutorials/index.md": "a list of pages",
    "validation.md": "shows charts and figures, put in when it is built",
}
MADE = re.compile(r"`python docs/_extensions/\w+\.py` writes this page")
"""A page that a script writes is a table to look things up in."""
COMMIT = re.compile(r"\b(?=[a-f]*[0-9])(?=[0-9]*[a-f])[0-9a-f]{7}\b|\bcommits? [0-9a-f]{7}\b")
NOTES = ("notes/2026", "notes/first-hour")
"""Notes are tables of what was measured once."""
PAGES = {
    page.relative_to(DOCS).as_posix(): page.read_text(encoding="utf-8")
    for page in sorted(DOCS.rglob("*.md"))
    if not {"generated", "_build"} & set(page.relative_to(DOCS).parts)
}
PAGES = {page: text for page, text in PAGES.items() if not MADE.search(text)}

READ = {page: text for page, text in PAGES.items() if not page.startswith(NOTES)}
"""Pages that are read from top to bottom."""
VALIDATIONS = {name: (home_of(name) / "README.md").read_text(encoding="utf-8") for name in names()}


def words_of(text: str) -> int:
    """Words of a page, its tables and heads among them."""
    return sum(bool(re.search(r"\w", word)) for word in NO_WORDS.sub(" ", text).split())


@pytest.mark.parametrize("page", PAGES)
def test_page_is_short_enough(page):
    """A longer one is listed with its reason, and one that has become short no more."""
    words = words_of(PAGES[page])
    assert (words > MOST) == (page in LONG), f"{words} words"


@pytest.mark.parametrize("page", PAGES)
def test_page_is_short_enough_as_counted(page):
    """The same of all that is between blanks."""
    words = len(PAGES[page].split())
    assert (words > MOST_COUNTED) == (page in LONG_COUNTED), f"{words} words"


@pytest.mark.parametrize("page", READ)
def test_page_has_a_picture(page):
    """One without is listed with its reason, and one that has got a picture no more."""
    assert bool(PICTURE.search(PAGES[page])) == (page not in PLAIN)


@pytest.mark.parametrize("page", PAGES)
def test_page_names_no_commit(page):
    """Readers want a date; commits stand in the records that numbers come from."""
    assert COMMIT.findall(PAGES[page]) == []


@pytest.mark.parametrize("text", [*READ.values(), *VALIDATIONS.values()], ids=[*READ, *VALIDATIONS])
def test_paragraphs_are_short(text):
    """One thought each; lists and tables are no paragraphs."""
    plain = NO_WORDS.sub(" ", text)
    plain = "\n".join(line for line in plain.splitlines() if not line.startswith(("|", "<!--")))
    for paragraph in re.split(r"\n\s*\n|\n *- |\n *\d+\. ", plain):
        assert words_of(paragraph) <= MOST_IN_A_PARAGRAPH, paragraph


@pytest.mark.parametrize("page", READ)
def test_code_is_as_wide_as_the_page(page):
    """A longer line is read by moving it, half of it at a time."""
    for begins, block in BLOCK.findall(READ[page]):
        assert begins not in CODE or max(map(len, block.splitlines())) <= MOST_IN_A_LINE, block


def test_cases_of_examples_are_as_wide_as_the_page():
    """The page of the examples shows them as code."""
    files = [file for file in EXAMPLES.glob("*/*.toml") if file.name != "expected.toml"]
    lines = [(file, line) for file in files for line in file.read_text("utf-8").splitlines()]
    assert len(files) > 5
    assert [pair for pair in lines if len(pair[1]) > MOST_IN_A_LINE] == []


def test_listed_pages_exist():
    """And each has a reason."""
    assert {*LONG, *LONG_COUNTED, *PLAIN} <= {*PAGES}
    reasons = (*LONG.values(), *LONG_COUNTED.values(), *PLAIN.values())
    assert all(len(reason) > 3 for reason in reasons)


def test_what_counts_as_a_word():
    """Neither code nor formulas, bars of tables or addresses."""
    text = "# A head\n\n| two | words |\n|---|---|\n\n```\ncode\n```\n$x = 1$ [link](page.md) `a`\n"
    assert words_of(text) == 6


def main() -> None:
    for page, text in sorted(PAGES.items(), key=lambda one: -words_of(one[1])):
        picture = "" if PICTURE.search(text) else "no picture"
        print(f"{words_of(text):6} {page:40} {picture} {LONG.get(page, PLAIN.get(page, ''))}")


if __name__ == "__main__":
    main()
