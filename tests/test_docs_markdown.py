"""Texts of the documentation open no HTML tag: one that is never closed changes all of its page."""

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


@pytest.mark.parametrize("name", TEXTS)
def test_no_tag_is_opened(name):
    """Outside of code, formulas and addresses of the web."""
    assert [found[0] for found in TAG.finditer(CODE.sub("", TEXTS[name]))] == []
