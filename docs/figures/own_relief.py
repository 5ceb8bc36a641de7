"""The relief of docs/own_relief.md, from the metal and the case as that page writes them."""

import re
import subprocess
import sys
import tempfile
from pathlib import Path

from figures.stored import StoredFigure, store_picture

ROOT = Path(__file__).resolve().parents[2]
PAGE = ROOT / "docs" / "own_relief.md"
SHIPPED = ROOT / "src" / "lasersph" / "case" / "cases" / "texture-steel.toml"
BLOCK = re.compile(r"^```toml\n(.*?)^```", re.MULTILINE | re.DOTALL)


def write_files(folder: Path) -> Path:
    """Write the metal and the case into a folder, as a reader would; the path of the case."""
    metal, changes = BLOCK.findall(PAGE.read_text(encoding="utf-8"))
    (folder / "alsi.toml").write_text(metal, encoding="utf-8")
    case = folder / "relief.toml"
    case.write_text(changed(SHIPPED.read_text(encoding="utf-8"), changes), encoding="utf-8")
    return case


def changed(text: str, changes: str) -> str:
    """A case with the lines of `changes`: a key that it has is replaced, others are added."""
    section = ""
    for line in filter(None, changes.splitlines()):
        if line.startswith("["):
            section = line
            continue
        key = line.split(" = ")[0]
        head, mark, body = text.partition(f"{section}\n") if section else ("", "", text)
        if not mark and section:
            raise ValueError(f"the case has no {section}")
        own, bar, rest = body.partition("\n[")
        old = re.compile(rf"^{key} = .*$", re.MULTILINE)
        own = old.sub(lambda _, new=line: new, own) if old.search(own) else f"{line}\n{own}"
        text = head + mark + own + bar + rest
    return text


def _draw(target: Path) -> None:
    with tempfile.TemporaryDirectory() as folder:
        case = write_files(Path(folder))
        command = [sys.executable, "-m", "lasersph", "run", case.name, "--out", "relief"]
        subprocess.run(command, cwd=folder, check=True)
        store_picture(Path(folder) / "relief" / "figures" / "relief.png", target)


OWN_RELIEF = StoredFigure(
    "own-relief",
    _draw,
    (
        "docs/own_relief.md",
        SHIPPED.relative_to(ROOT).as_posix(),
        "lasersph.simulation.recipes.melt_pool",
        "src/lasersph/plots/relief.py",
    ),
)
