"""The rules that ARCHITECTURE.md states, as far as the source text and what it loads can show."""

import ast
import re
import subprocess
import sys
from functools import cache

import pytest
from draw_architecture import PACKAGE, fenced_block, imported_modules, room_of

MODULES = sorted(PACKAGE.rglob("*.py"))
LAYERS = [room for room, _ in fenced_block("layers")]
ONLY_IN = {library: set(rooms.split()) for library, rooms in fenced_block("only-in")}
READS_FILES = {room: set(rooms.split()) for room, rooms in fenced_block("imports-only")}


@cache
def imports_of(path):
    """Lines and names of what a file imports, wherever in its text."""
    return tuple(imported_modules(path))


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
    for line, name in imports_of(path):
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


def imports_inside(room: str) -> dict[str, set[str]]:
    """Modules of the same room that each module of a room imports, wherever in its text."""
    names = {}
    for path in MODULES:
        if room_of(path) == room:
            parts = path.relative_to(PACKAGE).with_suffix("").parts
            names[".".join(("lasersph", *parts)).removesuffix(".__init__")] = path
    found: dict[str, set[str]] = {name: set() for name in names}
    for name, path in names.items():
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.ImportFrom) and node.module:
                inner = {f"{node.module}.{alias.name}" for alias in node.names}
                found[name] |= (inner & set(names)) or ({node.module} & set(names))
    return found


def ring_in(imports: dict[str, set[str]]) -> list[str]:
    """Modules of one ring, each importing the next and the last the first; [] where none is."""
    done: set[str] = set()

    def search(module: str, trail: list[str]) -> list[str]:
        if module in trail:
            return trail[trail.index(module) :]
        if module in done:
            return []
        for target in sorted(imports[module]):
            if ring := search(target, [*trail, module]):
                return ring
        done.add(module)
        return []

    return next((ring for module in sorted(imports) if (ring := search(module, []))), [])


@pytest.mark.parametrize("room", LAYERS)
def test_no_import_rings(room):
    """Inside a room too, imports have a direction."""
    assert not ring_in(imports_inside(room))


def test_rings_are_found():
    """A ring is named in its order; a diamond is none."""
    assert ring_in({"a": {"b"}, "b": {"c"}, "c": {"b"}}) == ["b", "c"]
    assert ring_in({"a": {"b", "c"}, "b": {"d"}, "c": {"d"}, "d": set()}) == []


def test_only_upper_rooms_see_the_case():
    """No room below `case` names it, and only rooms of whole runs stand above it."""
    upper = set(LAYERS[: LAYERS.index("case") + 1])
    assert upper == {"cli", "web", "validation", "studies", "sweeps", "simulation", "case"}
    seen = {
        room_of(path)
        for path in MODULES
        for _, name in imports_of(path)
        if name == "lasersph.case" or name.startswith("lasersph.case.")
    }
    assert seen - {""} <= upper


@pytest.mark.parametrize("room", READS_FILES)
def test_plots_and_reports_compute_nothing(room):
    """They import what reads files and says quantities, no solver and no run."""
    found = {
        name.split(".")[1]
        for path in MODULES
        if room_of(path) == room
        for _, name in imports_of(path)
        if name.startswith("lasersph.")
    }
    assert found <= READS_FILES[room] | {room}


@pytest.mark.parametrize("library", ONLY_IN)
def test_library_is_named_in_one_room(library):
    """A library that only one room may know is imported nowhere else."""
    wrong = [
        f"{path}:{line}: {name}"
        for path in MODULES
        for line, name in imports_of(path)
        if name.partition(".")[0] == library and room_of(path) not in ONLY_IN[library]
    ]
    assert not wrong, "\n".join(wrong)


INTERNALS = PACKAGE / "compute" / "numba_internals.py"
PRIVATE = re.compile(
    r"numba\.(core|np|parfors|misc|typed)\b|\bcgutils\b|numba_parallel_for|get_dummy_value"
    r"|\.(native_name|save_overload|overloads|stats)\b|\bNRT_"
)
"""Names of Numba that its documentation does not offer to programs."""


def test_private_parts_of_numba_are_in_one_file():
    """Only one file names what a newer Numba may change without a word."""
    ours = [path for path in MODULES if room_of(path) == "compute"]
    found = [path for path in ours if PRIVATE.search(path.read_text(encoding="utf-8"))]
    assert found == [INTERNALS]


SETTINGS = {"ConductionSettings", "MeltPoolSettings", "AblationSettings", "HeatSettings"}
RECIPES = PACKAGE / "simulation" / "recipes"


def kind_tests(path) -> list[int]:
    """Lines of a file that ask of which kind a solver is: isinstance, or `kind` compared."""
    found = []
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"), str(path))):
        if isinstance(node, ast.Call) and getattr(node.func, "id", "") == "isinstance":
            names = {name.id for name in ast.walk(node.args[1]) if isinstance(name, ast.Name)}
            if names & SETTINGS:
                found.append(node.lineno)
        elif isinstance(node, ast.Compare | ast.Match):
            asked = (
                [node.subject] if isinstance(node, ast.Match) else [node.left, *node.comparators]
            )
            found += [node.lineno for side in asked if ast.unparse(side).endswith("solver.kind")]
    return found


@pytest.mark.parametrize("path", MODULES, ids=lambda path: str(path.relative_to(PACKAGE)))
def test_only_recipes_know_the_kinds_of_solvers(path):
    """All that depends on the kind of a solver is in its folder and in its recipe."""
    if not path.is_relative_to(RECIPES):
        assert not kind_tests(path), "let the recipe or the settings answer"


def loaded_by(statement: str) -> set[str]:
    """Names in sys.modules after a statement, in a fresh interpreter."""
    code = f"import sys\n{statement}\nprint('loaded:', *sys.modules)"
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    return set(run.stdout.rpartition("loaded:")[2].split())


NUMERICAL = {"numpy", "numba", "scipy", "matplotlib", "h5py", "pint", "pydantic"}


@pytest.mark.parametrize(
    "statement",
    ["import lasersph", "from lasersph.cli import main; main(['--help'])"],
    ids=["import", "help"],
)
def test_no_library_is_loaded(statement):
    """Neither `import lasersph` nor `--help` loads a numerical, plotting, file or unit library."""
    assert not loaded_by(statement) & NUMERICAL


@pytest.mark.parametrize("case", ["dlip-steel", "ablation-depth", "natural-convection"])
def test_a_case_is_read_without_what_only_runs_need(case):
    """No library beside NumPy and pydantic, no loop, linear solver or observer, and few modules."""
    loaded = loaded_by(f"import lasersph\nlasersph.load_case({case!r})")
    assert not loaded & {"numba", "matplotlib", "h5py", "scipy"}
    rooms = {"compute", "linear_solvers", "observers", "simulation", "physics", "sph"}
    assert not loaded & {f"lasersph.{room}" for room in rooms}
    assert len([name for name in loaded if name.startswith("lasersph")]) < 80
