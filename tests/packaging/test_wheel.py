"""The wheel, away from the checkout: the command, the shipped data and a small run work, with the
dependencies at hand and with the oldest ones that pyproject.toml allows."""

import json
import os
import subprocess
import sys
import tomllib
import venv
import zipfile
from pathlib import Path

import pytest

from lasersph import __version__

ROOT = Path(__file__).resolve().parents[2]


def run(*command: object, cwd: Path, cache: Path | None = None) -> str:
    """What a command prints; a failing one fails the test with its output."""
    environment = {key: value for key, value in os.environ.items() if key != "PYTHONPATH"}
    environment |= {"MPLBACKEND": "Agg", "PIP_DISABLE_PIP_VERSION_CHECK": "1", "COLUMNS": "100"}
    if cache is not None:
        environment["XDG_CACHE_HOME"] = str(cache)
    done = subprocess.run(
        [str(word) for word in command], cwd=cwd, env=environment, capture_output=True, text=True
    )
    assert done.returncode == 0, f"{command}\n{done.stdout}\n{done.stderr}"
    return done.stdout


@pytest.fixture(scope="module")
def wheel(tmp_path_factory) -> Path:
    """The wheel of this checkout."""
    target = tmp_path_factory.mktemp("wheel")
    run(sys.executable, "-m", "build", "--wheel", "--outdir", target, ROOT, cwd=target)
    (path,) = target.glob("lasersph-*.whl")
    return path


def environment_with(wheel: Path, folder: Path, *arguments: object) -> Path:
    """Folder of the programs of a fresh environment that the wheel was installed into."""
    venv.create(folder / "venv", with_pip=False, symlinks=True)
    programs = folder / "venv" / "bin"
    run(
        *(sys.executable, "-m", "pip", "--python", programs / "python", "install", "--quiet"),
        *("--no-compile", *arguments, wheel),  # bytecode of what is imported is made then
        cwd=folder,
    )
    return programs


def works(programs: Path, folder: Path) -> None:
    """The installed package does what the checkout does, and is not the checkout."""
    cache = folder / "cache"
    where = run(programs / "python", "-c", "import lasersph; print(lasersph.__file__)", cwd=folder)
    assert str(programs.parent) in where

    lasersph = programs / "lasersph"
    assert __version__ in run(lasersph, "--version", cwd=folder, cache=cache)
    cases = run(lasersph, "cases", cwd=folder, cache=cache)
    assert all(name in cases for name in ("dlip-steel", "dlip-aluminium", "stefan"))
    assert "steel-304" in run(lasersph, "material", "list", cwd=folder, cache=cache)
    run(lasersph, "new", "dlip-steel", "mine.toml", cwd=folder, cache=cache)
    run(lasersph, "check", "mine.toml", cwd=folder, cache=cache)
    run(lasersph, "run", "stefan", "--quick", "--out", "out", cwd=folder, cache=cache)
    summary = json.loads((folder / "out" / "summary.json").read_text())
    assert summary["energy"]["imbalance_relative"] < 1e-6
    assert (folder / "out" / "report.html").stat().st_size > 10_000
    run(lasersph, "validate", "kernels", cwd=folder, cache=cache)


def test_wheel_holds_every_file(wheel):
    """Data files (materials, cases, references, py.typed) are in the wheel like the modules."""
    source = ROOT / "src"
    wanted = {
        path.relative_to(source).as_posix()
        for path in (source / "lasersph").rglob("*")
        if path.is_file() and "__pycache__" not in path.parts
    }
    assert wanted <= set(zipfile.ZipFile(wheel).namelist())


def test_wheel_works_outside_the_checkout(wheel, tmp_path):
    """Installed into a fresh environment that sees this one's dependencies."""
    programs = environment_with(wheel, tmp_path, "--no-deps")
    (packages,) = (tmp_path / "venv").glob("lib/python*/site-packages")
    seen = [entry for entry in sys.path if entry.endswith("site-packages")]
    (packages / "dependencies.pth").write_text("\n".join(seen), encoding="utf-8")
    works(programs, tmp_path)


@pytest.mark.release
def test_wheel_runs_the_first_case(wheel, tmp_path):
    """The README's first minute: into an empty environment, then a coarse run with its report."""
    programs = environment_with(wheel, tmp_path)
    works(programs, tmp_path)
    run(
        *(programs / "lasersph", "run", "dlip-steel", "--quick", "--out", "steel"),
        cwd=tmp_path,
        cache=tmp_path / "cache",
    )
    assert json.loads((tmp_path / "steel" / "summary.json").read_text())["melt"]["depth_max_m"] > 0


@pytest.mark.release
def test_source_archive_works(tmp_path):
    """The source archive installs the same as the wheel."""
    run(sys.executable, "-m", "build", "--sdist", "--outdir", tmp_path, ROOT, cwd=tmp_path)
    (archive,) = tmp_path.glob("lasersph-*.tar.gz")
    works(environment_with(archive, tmp_path), tmp_path)


@pytest.mark.slow
@pytest.mark.packaging
def test_wheel_works_with_oldest_dependencies(wheel, tmp_path):
    """Installed from the package index, every direct dependency at its lower bound."""
    metadata = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
    bounds = metadata["project"]["dependencies"]
    oldest = [bound.replace(">=", "==") for bound in bounds]
    assert all("==" in bound for bound in oldest)
    constraints = tmp_path / "oldest.txt"
    constraints.write_text("\n".join(oldest) + "\n", encoding="utf-8")
    works(environment_with(wheel, tmp_path, "--constraint", constraints), tmp_path)
