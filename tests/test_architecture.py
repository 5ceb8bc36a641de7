"""The architecture that ARCHITECTURE.md states: imports point down its list of rooms, and loading
the package or asking the command line for help starts no numerical library."""

import ast
import re
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parent.parent
PACKAGE = ROOT / "src" / "lasersph"
MODULES = sorted(PACKAGE.rglob("*.py"))


def fenced_block(name: str) -> list[list[str]]:
    """The words of every line of the fenced block `name` in ARCHITECTURE.md."""
    text = (ROOT / "ARCHITECTURE.md").read_text(encoding="utf-8")
    match = re.search(rf"^```{name}\n(.*?)^```", text, flags=re.MULTILINE | re.DOTALL)
    assert match, f"ARCHITECTURE.md has no block ```{name}"
    return [line.split() for line in match[1].splitlines() if line.strip()]


LAYERS = [words[0] for words in fenced_block("layers")]
ONLY_IN = {words[0]: set(words[1:]) for words in fenced_block("only-in")}


def room_of(path: Path) -> str:
    """The room a file belongs to; the package's own modules belong to ''."""
    parts = path.relative_to(PACKAGE).parts
    return parts[0] if len(parts) > 1 else ""


def imported_modules(path: Path) -> list[tuple[int, str]]:
    """(line, absolute dotted name) of every import in a file, wherever in the file it stands."""
    package = ("lasersph", *path.relative_to(PACKAGE).parts[:-1])
    found = []
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"), str(path))):
        if isinstance(node, ast.Import):
            found += [(node.lineno, alias.name) for alias in node.names]
        elif isinstance(node, ast.ImportFrom):
            start = package[: len(package) - node.level + 1] if node.level else ()
            module = ".".join([*start, *([node.module] if node.module else [])])
            if module == "lasersph":  # `from lasersph import rooms`
                found += [(node.lineno, f"lasersph.{alias.name}") for alias in node.names]
            else:
                found.append((node.lineno, module))
    return found


def test_layer_list_is_the_folder_list():
    """Every folder with code is a room of the list, and no room is listed twice."""
    rooms = {room_of(path) for path in MODULES} - {""}
    assert rooms <= set(LAYERS), f"not in ARCHITECTURE.md: {sorted(rooms - set(LAYERS))}"
    assert len(set(LAYERS)) == len(LAYERS)


@pytest.mark.parametrize("path", MODULES, ids=lambda path: str(path.relative_to(PACKAGE)))
def test_imports_point_down(path):
    """No file imports from a room above its own.

    The package's own modules may use every room; only the top room may import the package itself,
    whose public names come from rooms.
    """
    room = room_of(path)
    wrong = []
    for line, name in imported_modules(path):
        top, _, rest = name.partition(".")
        if top != "lasersph" or not room:
            continue
        target = rest.partition(".")[0]
        if target in LAYERS:
            if LAYERS.index(target) < LAYERS.index(room):
                wrong.append(f"{path}:{line}: {room} imports {name}, which lies above it")
        elif target != "__version__" and (target or room != LAYERS[0]):
            wrong.append(f"{path}:{line}: {name} is no room; import it from the room that owns it")
    assert not wrong, "\n".join(wrong)


@pytest.mark.parametrize("library", ONLY_IN)
def test_library_is_named_in_one_room(library):
    """A library that only one room may know is imported nowhere else."""
    wrong = [
        f"{path}:{line}: {name}"
        for path in MODULES
        for line, name in imported_modules(path)
        if name.partition(".")[0] == library and room_of(path) not in ONLY_IN[library]
    ]
    assert not wrong, "\n".join(wrong)


def loaded_by(statement: str) -> set[str]:
    """Top-level names in sys.modules after a statement, in a fresh interpreter."""
    code = f"import sys\n{statement}\nprint(*{{name.partition('.')[0] for name in sys.modules}})"
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    return set(run.stdout.split())


def test_import_starts_no_backend():
    """`import lasersph` loads no numerical, plotting, file or unit library."""
    assert not loaded_by("import lasersph") & {"numba", "matplotlib", "h5py", "pint", "scipy"}


@pytest.mark.parametrize("case", ["dlip-steel", "ablation-depth", "natural-convection"])
def test_a_case_is_read_without_what_only_runs_need(case):
    """SciPy, the loops, plots and files take longer to load than all else that reads a case."""
    loaded = loaded_by(f"import lasersph\nlasersph.load_case({case!r})")
    assert not loaded & {"numba", "matplotlib", "h5py", "scipy"}
