"""One word, one meaning: names that the field has other terms for do not come back.

Only words that mean nothing else here are listed; `held`, `image`, `side`, `reach` and the like
are plain English as well, and a reader has to judge them.
"""

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parent.parent
FOLDERS = ("src", "tests", "docs", "examples", "benchmarks")
ENDINGS = {".py", ".md", ".toml", ".cu"}

OLD_WORDS = {
    # old word: (the field's term, where it may stand)
    r"far[_ ]?array|far_(functions|reductions)": ("device array", ""),
    r"(held|heated)[_ ](faces?|boundary|boundaries|walls?)": ("Dirichlet or Neumann face", ""),
    r"(flat|rigid)[_ ]?lid": ("flat surface", ""),
    r"rearrange(ment|s)? of particles|particle[_ ]rearrangement": ("particle shifting", ""),
    r"crowd(s|ed|ing)?\b": ("density drift", ""),
    r"(particles?|cells?|region) (awake|asleep)|(awake|sleeping) (particle|cell|region)": (
        "active, inactive",
        "",
    ),
    r"\bsolver\.sleep\b": ("solver.active_region", "tests/cases/test_older_files.py"),
    r"\bforeseen\b|\bforesee\(": ("initial guess, trial step", ""),
    r"\bthinned\(": ("accumulate_evaporated_mass", ""),
    r"\bpace =|[_.]pace\b": ("unclipped_step", ""),
    r"\bsoundness\b": ("diagnostics", ""),
    r"\bclass (Matter|Level|Layout|Start|Numbers)\b": (
        "particle state, time level, geometry, initial state, parameters",
        "src/lasersph/linear_solvers/grid_levels.py",  # a level of the multigrid
    ),
    r"\bclass (Sides|Roles?)\b": ("flow conditions, particle kind", ""),
    r"\bclass (Exposure|Rearrangement|Carried|Images|Ways)\b": (
        "free surface, particle shifting, checkpoint scalars, ghosts",
        "",
    ),
    r"\bdef _?(reach|spread|pull|push|held|settled|carried|lid|way|ways|stride)\(": (
        "a verb, or the quantity that is returned",
        "tests/unit/compute/|docs/draw_architecture.py",
    ),
    r"\b(lasersph\.observers\.together|lasersph\.report\.words|lasersph\.reading)\b": (
        "observer list, summary text, input",
        "",
    ),
}
"""In any case of letters. The keys of files, such as `lid_pressure`, are users' and stay."""


def texts():
    """Path below the root and text of all files but this one."""
    for folder in FOLDERS:
        for file in sorted((ROOT / folder).rglob("*")):
            if file.suffix in ENDINGS and file != Path(__file__).resolve():
                yield file.relative_to(ROOT).as_posix(), file.read_text(encoding="utf-8")


TEXTS = dict(texts())


@pytest.mark.parametrize("word", OLD_WORDS)
def test_old_words_are_gone(word):
    """The term to write instead is told with each place."""
    term, allowed = OLD_WORDS[word]
    found = [
        f'{name}:{number}: write "{term}": {line.strip()}'
        for name, text in TEXTS.items()
        if not (allowed and re.match(allowed, name)) and re.search(word, text, re.IGNORECASE)
        for number, line in enumerate(text.splitlines(), start=1)
        if re.search(word, line, re.IGNORECASE)
    ]
    assert not found, "\n".join(found)


def test_words_are_found():
    """Each pattern finds an old word, so that none is empty by a slip."""
    old = (
        "a far array, held faces, the flat lid, particle rearrangement, Crowding, awake cells, "
        "solver.sleep, foreseen, def thinned(, pace = 1, soundness, class Matter, class Sides, "
        "class Exposure, def pull(, lasersph.report.words"
    )
    assert all(re.search(word, old, re.IGNORECASE) for word in OLD_WORDS)


SPELLING = re.compile(r"(?<![-_\"`./=])\baluminium\b(?![-_.\"`/]\w|`|\.toml)", re.IGNORECASE)
"""The British spelling, but in names: of files, cases and metals."""


def test_prose_spells_aluminum():
    """Titles of cases and metals, and pages outside of code: two spellings look like two metals."""
    written = {name: text for name, text in TEXTS.items() if not name.startswith("docs/generated")}
    prose = {
        name: re.sub(r"```.*?```", "", text, flags=re.DOTALL) for name, text in written.items()
    }
    lines = [
        f"{name}: {line}"
        for name, text in prose.items()
        for line in text.splitlines()
        if name.endswith(".md") or (name.startswith("src/") and line.startswith("title ="))
    ]
    assert len(lines) > 1000
    assert [line for line in lines if SPELLING.search(line)] == []
    assert SPELLING.search("of pure aluminium.")
    assert not SPELLING.search("`dlip-aluminium`, material=aluminium, aluminium.csv, `aluminium`")
