"""`make docs` finds all that it needs in the extra `docs`, and what it builds needs no network."""

import ast
import re
import shutil
import subprocess
import sys
import tomllib
from functools import cache
from importlib.metadata import PackageNotFoundError, packages_distributions, requires
from pathlib import Path

import pytest
from packaging.requirements import Requirement

ROOT = Path(__file__).resolve().parent.parent
DOCS = ROOT / "docs"
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
EXTRAS = PROJECT["optional-dependencies"]
CELL = re.compile(r"^```{code-cell}[^\n]*\n(.*?)^```", re.MULTILINE | re.DOTALL)
CELLS = {
    page.name: [text for text in CELL.findall(page.read_text(encoding="utf-8"))]
    for page in sorted((DOCS / "tutorials").glob("*.md"))
}
"""Of each page that is executed when the documentation is built."""

NEEDED_EXTRAS = {
    r"lasersph[. ](calibrate|sensitivity|find|uncertain)\b": "study",
    r"lasersph serve\b": "web",
    r"history_frame\(|snapshots_dataset\(|\.frame\(": "frames",
    r"\.widget\(|show_particles": "notebook",
    r"--engine dask|Cluster": "dask",
    r"crater-3d": "view",
}
"""What a cell that calls this needs: by the extra that `install_hint` names in the sources."""


def requirements_of(extra):
    """The requirements of an extra, those of our own extras in it written out."""
    found = []
    for one in map(Requirement, EXTRAS[extra]):
        own = one.extras if one.name == PROJECT["name"] else ()
        found += [name for inner in own for name in requirements_of(inner)] or [one.name]
    return found


@cache
def installed_with_docs():
    """Names of all distributions that the package and its extra `docs` bring, as far as they are
    installed here."""
    found = set()
    waiting = [Requirement(text).name for text in PROJECT["dependencies"]]
    waiting += requirements_of("docs")
    while waiting:
        name = re.sub(r"[-_.]+", "-", waiting.pop()).lower()
        if name in found:
            continue
        found.add(name)
        try:
            texts = requires(name) or []
        except PackageNotFoundError:
            continue
        waiting += [one.name for one in map(Requirement, texts) if one.marker is None]
    return found


@cache
def owners_of_modules():
    """Names of the distributions that have a module, by its name."""
    return packages_distributions()


def test_every_extra_with_a_hint_has_a_pattern():
    """An extra that a message of the program names is looked for in the cells."""
    named = set()
    texts = (file.read_text(encoding="utf-8") for file in (ROOT / "src").rglob("*.py"))
    for text in (one for one in texts if "install_hint" in one):
        for call in ast.walk(ast.parse(text)):
            if isinstance(call, ast.Call) and getattr(call.func, "id", "") == "install_hint":
                named.add(call.args[1].value if len(call.args) > 1 else "frames")
    assert named <= set(NEEDED_EXTRAS.values())


@pytest.mark.parametrize("page", CELLS)
def test_extra_docs_brings_what_cells_call(page):
    """Each cell runs after `pip install '.[docs]'`."""
    brought = set(requirements_of("docs"))
    for cell in CELLS[page]:
        for pattern, extra in NEEDED_EXTRAS.items():
            if re.search(pattern, cell):
                assert set(requirements_of(extra)) <= brought, f"{extra}, for {pattern}"


@pytest.mark.parametrize("page", CELLS)
def test_extra_docs_brings_what_cells_import(page):
    """Every import of a cell is of the standard library, a dependency or of the extra."""
    brought = installed_with_docs() | {"lasersph", "ipython"}
    for cell in CELLS[page]:
        if cell.lstrip().startswith("%%"):
            continue
        for node in ast.walk(ast.parse(cell)):
            modules = [alias.name for alias in node.names] if isinstance(node, ast.Import) else []
            modules += [node.module] if isinstance(node, ast.ImportFrom) else []
            for module in {name.partition(".")[0] for name in modules}:
                owners = owners_of_modules().get(module, [module])
                owned = {re.sub(r"[-_.]+", "-", one).lower() for one in owners}
                assert module in sys.stdlib_module_names or owned & brought, module


PAGE = "# Formulas\n\n$a^2$ in a line, and\n\n$$\\frac{\\partial T}{\\partial t}=\\nabla^2 T$$\n"
FROM_NETWORK = re.compile(
    r"<(?:script|link|img|iframe)\b[^>]*(?:src|href)=[\"']?(?:https?:)?//[^>]*"
)


def test_settings_name_no_address():
    """Formulas and widgets of the built pages come from files."""
    found = {}
    for node in ast.parse((DOCS / "conf.py").read_text(encoding="utf-8")).body:
        if isinstance(node, ast.Assign) and isinstance(node.targets[0], ast.Name):
            found[node.targets[0].id] = ast.unparse(node.value)
    assert "//" not in found["mathjax_path"] and found["nb_ipywidgets_js"] == "{}"
    assert not [name for name in found if name.startswith("html_") and "//" in found[name]]


def test_built_pages_load_nothing_from_a_network(tmp_path):
    """Scripts, styles, fonts and pictures of a page with formulas are files beside it."""
    for package in ("sphinx", "furo", "myst_nb", "sphinx-mathjax-offline"):
        pytest.importorskip(package)
    source, target = tmp_path / "source", tmp_path / "html"
    source.mkdir()
    for name in ("conf.py", "_static", "_extensions"):
        copy = shutil.copytree if (DOCS / name).is_dir() else shutil.copy
        copy(DOCS / name, source / name)
    (source / "index.md").write_text(PAGE, encoding="utf-8")
    settings = source / "conf.py"
    text = settings.read_text(encoding="utf-8").replace('    "generated_pages",\n', "")
    settings.write_text(text, encoding="utf-8")  # without the pages made of records
    command = [sys.executable, "-m", "sphinx", "-q", "-W", "-b", "html", str(source), str(target)]
    done = subprocess.run(command, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    page = (target / "index.html").read_text(encoding="utf-8")
    assert r"\nabla^2" in page and not FROM_NETWORK.findall(page)
    (script,) = re.findall(r'src="([^"]*tex-svg.js[^"]*)"', page)
    assert (target / script.partition("?")[0]).stat().st_size > 1_000_000
    for style in target.rglob("*.css"):
        assert not re.search(r"(@import|url\()\s*[\"']?(https?:)?//", style.read_text("utf-8"))
