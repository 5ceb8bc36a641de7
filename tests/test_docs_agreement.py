"""What does not agree with the experiment is said first, in the numbers of the example's data."""

import re
from pathlib import Path

import pytest
from figures import GALLERY
from figures.experiment import agreement, reliefs

from lasersph import available_cases, load_case

ROOT = Path(__file__).resolve().parent.parent
FIRST_TEXTS = (
    "README.md",
    "docs/index.md",
    "docs/texture.md",
    "docs/tutorials/texture.md",
    "docs/validation.md",
)
"""What a user reads of textures first."""
LINK = re.compile(r"\]\((?:docs/|\.\./)?texture_experiment\.md\)")


def read(name):
    """The text of a file, with single spaces."""
    return " ".join((ROOT / name).read_text(encoding="utf-8").split())


@pytest.mark.parametrize("name", FIRST_TEXTS)
def test_agreement_is_said_first(name):
    """In the first part of the text, with a link to the page that has the whole comparison."""
    first = read(name).partition("## ")[0] if name != "README.md" else read(name)[:2500]
    place = first.find(agreement())
    assert place >= 0, agreement()
    assert LINK.search(first, place)


def test_gallery_says_the_agreement():
    """Beside the picture of the relief that one pulse leaves."""
    (entry,) = (one for one in GALLERY if one.figure.name == "texture-steel-relief")
    assert agreement() in entry.text and LINK.search(entry.text)


def test_pages_have_the_numbers_of_the_data():
    """The page of the experiment and the tables of the examples quote what is stored."""
    steel, aluminum = reliefs()["steel"], reliefs()["aluminum"]
    page = read("docs/texture_experiment.md")
    assert f"below the original surface | {steel[1]} | {steel[0]} |" in page
    assert f"leaves {aluminum[0]} from peak to valley" in page and aluminum[1] in page
    spot = read("examples/texture-of-a-spot/README.md")
    assert steel[0] in spot and steel[1] in spot and aluminum[1] in spot


BEAMS = {"top-hat": "top-hat", "gaussian": "Gaussian"}


@pytest.mark.parametrize("entry", GALLERY, ids=lambda entry: entry.title)
def test_gallery_names_the_beam_of_the_case(entry):
    """A text that says how the light lies on the surface says it as the case does."""
    _, verb, case, *_ = entry.commands[0].split()
    named = [kind for kind, word in BEAMS.items() if word in entry.text]
    if verb == "run" and named:
        name = str(ROOT / case) if case.endswith(".toml") else case
        beam = load_case(name).laser.beam
        assert named == [beam.kind]


WRITTEN = re.compile(r"^%%writefile \S+\.toml\n(.*?)^```", re.MULTILINE | re.DOTALL)
SPOTS = re.compile(r'kind = "(gaussian|top-hat)"')
TUTORIALS = sorted((ROOT / "docs" / "tutorials").glob("*.md"))


@pytest.mark.parametrize("page", TUTORIALS, ids=lambda page: page.stem)
def test_section_of_a_spot_is_called_a_line_focus(page):
    """Where a page writes a case with a spot in two dimensions, which is no round spot."""
    text = page.read_text(encoding="utf-8")
    sections = [
        case
        for case in WRITTEN.findall(text)
        if SPOTS.search(case) and re.search(r"^dimensions = 2\b", case, re.MULTILINE)
    ]
    assert not sections or "line focus" in text


COMMAND = re.compile(
    r"lasersph (?:run|check|threshold|converge|spot) +([a-z][a-z0-9-]*)(?![-\w./])"
)


def test_commands_name_cases_that_are_shipped():
    """Of all pages, texts of examples and validations, and comments of cases."""
    folders = [ROOT / name for name in ("docs", "examples", "src", "benchmarks")]
    files = [ROOT / "README.md", *(file for one in folders for file in one.rglob("*.md"))]
    files += [file for one in folders for file in one.rglob("*.toml")]
    named = {
        (file.relative_to(ROOT).as_posix(), name)
        for file in files
        for name in COMMAND.findall(file.read_text(encoding="utf-8"))
    }
    assert len(named) > 20
    assert [pair for pair in sorted(named) if pair[1] not in available_cases()] == []
