"""The documentation is true: its material file can be read and the files it names exist."""

import re
from pathlib import Path

from lasersph.input import build, parse_toml
from lasersph.materials import Material

ROOT = Path(__file__).resolve().parent.parent
PAGES = sorted(path for path in (ROOT / "docs").rglob("*.md") if "generated" not in path.parts)


def test_example_material_can_be_read():
    """The material file of the page "Extend" is accepted as it stands."""
    page = (ROOT / "docs" / "extend.md").read_text(encoding="utf-8")
    (text,) = re.findall(r"^```toml\n(.*?)^```", page, flags=re.MULTILINE | re.DOTALL)
    material = build(Material, parse_toml(text))
    assert material.liquidus == 692.68


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
