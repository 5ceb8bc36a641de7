"""Texts of the documentation read on a code host as well, and open no HTML tag: one that is never
closed changes all of its page."""

import re
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "docs" / "_extensions"))
from result_keys import history_columns, summary_keys  # noqa: E402  (the folder is no package)

CODE = re.compile(r"```.*?```|(`+)(?!`).+?(?<!`)\1(?!`)|\$\$.*?\$\$|\$[^$\n]*\$", re.DOTALL)
TAG = re.compile(r"(?<!\\)<(?!https?:)[a-zA-Z/][^>\n]*>?")
TEXTS = {
    str(file.relative_to(ROOT)): file.read_text(encoding="utf-8")
    for folder in ("docs", "examples", "src/lasersph/validation")
    for file in sorted((ROOT / folder).rglob("*.md"))
    if "generated" not in file.parts
} | {"keys of a summary": summary_keys(), "columns of a history": history_columns()}


SPHINX_ONLY = re.compile(r"(?<!!)\[\]\([^)]*\)|\{cite:\w+\}`[^`]*`")
"""Links without a text, and citations by a role: a code host shows nothing of the ones and the role
of the others. Write [Start](start.md) and [Demuth & Lasagni 2020](references.md#demuth2020)."""
INCLUDE = re.compile(r"^(.*)\n\n```\{include\}", re.MULTILINE)


@pytest.mark.parametrize("name", TEXTS)
def test_links_have_a_text(name):
    """And citations too."""
    assert [found[0] for found in SPHINX_ONLY.finditer(TEXTS[name])] == []


@pytest.mark.parametrize("name", TEXTS)
def test_what_is_put_in_is_told(name):
    """A page says what stands where its source has an include, which a code host leaves empty."""
    before = INCLUDE.findall(TEXTS[name])
    assert len(before) == TEXTS[name].count("```{include}")
    assert all(line.startswith("*`make docs` writes what follows here: ") for line in before)


@pytest.mark.parametrize("name", TEXTS)
def test_no_tag_is_opened(name):
    """Outside of code, formulas and addresses of the web."""
    assert [found[0] for found in TAG.finditer(CODE.sub("", TEXTS[name]))] == []
