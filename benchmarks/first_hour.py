"""Times of the first hour: `make run` in a fresh clone, each tutorial; sizes of wheel and pages.

    python benchmarks/first_hour.py            all of it, into docs/times.json and the README here
    python benchmarks/first_hour.py --run      only `make run`
    python benchmarks/first_hour.py --tutorials    only the tutorials

`make run` is timed with what it installs, with an empty folder of compiled loops, and once more
with loops and environment in place. Packages come from pip's cache where it has them. A tutorial is
run as a notebook in a folder of its own, one after another, with one folder of compiled loops. They
need the extras docs, study and web. Nothing else should run on the machine.
"""

from __future__ import annotations

import argparse
import json
import os
import platform
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from datetime import date
from pathlib import Path
from time import perf_counter

from readme_times import RECORD, ROOT, commit, write_tables

TUTORIALS = ROOT / "docs" / "tutorials"
BIN = Path(sys.executable).parent
PAGES = ROOT / "docs" / "_build" / "html"


def timed(command: list[str], folder: Path, loops: Path) -> float:
    """Seconds of a command in a folder, with its own folder of compiled loops."""
    variables = os.environ | {"LASERSPH_CACHE": str(loops), "MPLBACKEND": "Agg"}
    variables.pop("PYTHONPATH", None)
    # Cells of tutorials call lasersph, as in an environment that is active.
    variables["PATH"] = os.pathsep.join([str(BIN), variables.get("PATH", os.defpath)])
    begin = perf_counter()
    done = subprocess.run(command, cwd=folder, env=variables, capture_output=True, text=True)
    if done.returncode:
        raise SystemExit(f"{' '.join(command)} ended with {done.returncode}\n{done.stderr[-2000:]}")
    return perf_counter() - begin


def make_run(folder: Path) -> Iterator[tuple[str, float]]:
    """Times [s] of `make run` in a fresh clone below a folder, and again."""
    clone, loops = folder / "clone", folder / "loops"
    subprocess.run(["git", "clone", "--quiet", str(ROOT), str(clone)], check=True)
    make = ["make", f"PYTHON={sys.executable}"]
    yield "`make .venv/.run`: environment and packages", timed([*make, ".venv/.run"], clone, loops)
    yield "`make run` then, loops not compiled yet", timed([*make, "run"], clone, loops)
    again = [*make, "run", "OUT=runs/again"]
    yield "`make run` again, into another folder", timed(again, clone, loops)


def tutorials(folder: Path) -> Iterator[tuple[str, float]]:
    """Times [s] of the tutorials, each run as a notebook."""
    for page in sorted(TUTORIALS.glob("*.md")):
        if page.stem == "index":
            continue
        place = folder / page.stem
        place.mkdir()
        notebook = place / f"{page.stem}.ipynb"
        convert = [str(BIN / "mystnb-to-jupyter"), str(page), str(notebook)]
        subprocess.run(convert, check=True, capture_output=True)
        run = [str(BIN / "jupyter-execute"), "--timeout=1200", notebook.name]
        yield f"tutorial `{page.stem}`", timed(run, place, folder / "loops")


def sizes(folder: Path) -> Iterator[tuple[str, int]]:
    """Sizes [bytes] of the wheel, and of the built pages where there are some."""
    build = [sys.executable, "-m", "build", "--wheel", "--outdir", str(folder), str(ROOT)]
    subprocess.run(build, check=True, capture_output=True)
    yield "wheel", next(folder.glob("*.whl")).stat().st_size
    if PAGES.exists():
        files = (file for file in PAGES.rglob("*") if file.is_file())
        yield "built pages (`make docs`)", sum(file.stat().st_size for file in files)


def main() -> None:
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--run", action="store_true", help="only `make run`")
    parser.add_argument("--tutorials", action="store_true", help="only the tutorials")
    parser.add_argument("--sizes", action="store_true", help="only sizes of wheel and pages")
    chosen = parser.parse_args()
    every = not (chosen.run or chosen.tutorials or chosen.sizes)
    when = {
        "date": date.today().isoformat(),
        "commit": commit(),
        "machine": f"{os.cpu_count()} cores, {platform.machine()}",
    }
    record = json.loads(RECORD.read_text(encoding="utf-8"))
    rows = {row["what"]: row for row in record.get("first_hour", [])}
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for is_chosen, part, unit in (
            (chosen.run, make_run, "seconds"),
            (chosen.tutorials, tutorials, "seconds"),
            (chosen.sizes, sizes, "bytes"),
        ):
            for what, number in part(folder) if every or is_chosen else ():
                rows[what] = {"what": what, unit: round(number, 1)} | when
                print(f"{what:60} {number:12.1f} {unit}", flush=True)
    record["first_hour"] = list(rows.values())
    RECORD.write_text(json.dumps(record, indent=2, ensure_ascii=False) + "\n", encoding="utf-8")
    write_tables(record)


if __name__ == "__main__":
    main()
