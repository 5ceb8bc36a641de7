"""The documentation is true: its material file can be read and the files it names exist."""

import re
import runpy
import shlex
from itertools import pairwise
from pathlib import Path

import pytest
from typer.main import get_command

from lasersph import load_case, validation
from lasersph.case import available_cases
from lasersph.cli.app import app_of
from lasersph.input import build, parse_toml
from lasersph.materials import Material

ROOT = Path(__file__).resolve().parent.parent
PAGES = sorted(path for path in (ROOT / "docs").rglob("*.md") if "generated" not in path.parts)


def test_example_material_can_be_read():
    """The material file of the pages "Extend" is accepted as it stands."""
    page = (ROOT / "docs" / "extend" / "materials.md").read_text(encoding="utf-8")
    (text,) = re.findall(r"^```toml\n(.*?)^```", page, flags=re.MULTILINE | re.DOTALL)
    material = build(Material, parse_toml(text))
    assert material.liquidus == 692.68


def test_example_validation_runs(tmp_path, monkeypatch):
    """The folder of the pages "Extend" is a validation that passes, in full and shortened."""
    page = (ROOT / "docs" / "extend" / "validations.md").read_text(encoding="utf-8")
    _, _, section = page.partition("\n## Add a validation\n")
    fence = r"^```{code-block} \w+\n:caption: (\S+)\n(.*?)^```"
    files = dict(re.findall(fence, section.partition("\n## Add a room")[0], flags=re.M | re.S))
    home = tmp_path / "surface_rise"
    home.mkdir()
    for name, text in files.items():
        (home / name).write_text(text, encoding="utf-8")
    monkeypatch.setattr("lasersph.validation.__path__", [*validation.__path__, str(tmp_path)])
    for module in ("registry", "study"):
        monkeypatch.setattr(f"lasersph.validation.{module}.HOME", tmp_path)
    assert validation.titles() == {
        "surface-rise": "A surface under a constant flux: how hot it gets"
    }
    for quick, count in ((True, 1), (False, 3)):
        report = validation.validate("surface-rise", tmp_path / "runs", quick=quick)
        assert report.passed and len(report.rows) == count, report.table()
        assert report.figures[0].exists()


SECTIONS = [
    text
    for page in sorted((ROOT / "docs" / "extend").glob("*.md"))
    for text in re.split(r"^## ", page.read_text(encoding="utf-8"), flags=re.M)
    if "```python" in text
]


@pytest.mark.parametrize("section", SECTIONS, ids=[text.splitlines()[0] for text in SECTIONS])
def test_example_code_of_extend_runs(section, tmp_path, monkeypatch):
    """The blocks of Python of each section run one after the other, and what they assert holds."""
    monkeypatch.chdir(tmp_path)
    # loops read the text of their functions from files
    file = tmp_path / "example.py"
    blocks = re.findall(r"^```python\n(.*?)^```", section, flags=re.M | re.S)
    file.write_text("\n".join(blocks), encoding="utf-8")
    runpy.run_path(str(file))


def test_named_files_exist():
    """Every path below src or tests that a page or ARCHITECTURE.md names in `code` is there."""
    missing = []
    for page in [*PAGES, *ROOT.glob("*.md")]:
        text = page.read_text(encoding="utf-8").partition("## Where the next things go")[0]
        for name in re.findall(r"`((?:src|tests|examples|docs|lasersph)/[\w./-]*)`", text):
            place = ROOT / "src" / name if name.startswith("lasersph/") else ROOT / name
            if not place.exists():
                missing.append(f"{page.relative_to(ROOT)}: {name}")
    assert not missing


COMMAND = re.compile(r"^ *(?:\.venv/bin/)?(lasersph [a-z](?:\\\n|[^\n])*)", re.MULTILINE)
FENCED = re.compile(r"^( *)```(?!toml|python)[^\n]*\n(.*?)^\1```", re.MULTILINE | re.DOTALL)
COMMANDS = sorted(
    {
        command.replace("\\\n", " ")
        for page in [*PAGES, ROOT / "README.md"]
        for _, block in FENCED.findall(page.read_text(encoding="utf-8"))
        for command in COMMAND.findall(block)
    }
)


@pytest.mark.parametrize("command", COMMANDS)
def test_commands_of_the_docs_are_right(command):
    """Each verb, option and kind of value exists; keys that change a shipped case fit it."""
    _, verb, *rest = shlex.split(command, comments=True)
    arguments = rest[: rest.index("|")] if "|" in rest else rest
    get_command(app_of(verb)).make_context(verb, list(arguments))
    if verb in ("run", "check", "converge") and arguments[0] in available_cases():
        pairs = pairwise(arguments)
        load_case(arguments[0], [value for option, value in pairs if option == "--set"])
