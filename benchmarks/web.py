"""The page of `lasersph serve`: first particles with many runs, memory with a large run, sizes.

    python benchmarks/web.py first [--runs 200]     seconds to the list and to the first particles
    python benchmarks/web.py memory [--gigabytes 5] memory of the server while all frames are read
    python benchmarks/web.py size                   what the page adds to the wheel, and the extra

`first` needs Chromium and playwright (extra `test`).
"""

from __future__ import annotations

import argparse
import json
import re
import shutil
import tempfile
import urllib.request
from importlib.metadata import distribution
from pathlib import Path

import numpy as np
from browser_page import TOKEN, chromium, serve

import lasersph
from lasersph.output import RunFolder
from lasersph.output.run_folder import Origin

EXTRA = ("starlette", "uvicorn", "anyio", "h11", "click", "idna", "typing_extensions")
"""What `lasersph[web]` installs; typer brings click as well."""
MEGABYTE = 1e6
MOMENTS = """
window.moments = {};
const look = () => {
  const viewer = document.querySelector(".scene > div")?.shadowRoot;
  if (document.querySelector(".card")) moments.listed ??= performance.now();
  if (viewer?.querySelector(".scale:not([hidden])")) moments.drawn ??= performance.now();
  if (!moments.drawn) requestAnimationFrame(look);
};
requestAnimationFrame(look);
addEventListener("click", (event) => { moments.clicked ??= event.timeStamp; }, true);
"""
"""Notes in the page, by its own clock [ms since it was asked for], when its cards are there, when
one of them is clicked, and when the particles were drawn: then the viewer shows its scale."""


def write_run(folder: Path, particles: int, gigabytes: float) -> None:
    """A run of random temperatures, whose particle file has a size or at least 21 frames."""
    case = {"title": "benchmark", "material": {}, "time": {"end": 1.0}}
    run = RunFolder.create(folder, Origin("", case, {"lasersph": lasersph.__version__}))
    random = np.random.default_rng(1)
    side = int(particles**0.5)
    grid = np.stack(np.meshgrid(np.arange(side), -np.arange(side))).reshape(2, -1) * 1e-8
    width = np.full(grid.shape, 1e-8, dtype=np.float32)
    file = folder / "particles.vtkhdf"
    for step in range(10**6):
        heat = random.random(grid.shape[1], dtype=np.float32) * 3000.0
        units = {"temperature": "K", "width": "m"}
        fields = {"temperature": heat, "width": width}
        run.particles.append(step * 1e-9, grid.astype(np.float32), fields, units=units)
        run.history.append({"time_s": step * 1e-9, "step": step, "temperature_max_K": 3000.0})
        if step >= 20 and file.stat().st_size >= gigabytes * 1e9:
            break
    run.close()


def ask(address: str) -> bytes:
    """An answer of the server."""
    request = urllib.request.Request(address, headers={"Authorization": f"Bearer {TOKEN}"})
    with urllib.request.urlopen(request) as answer:
        return answer.read()


def first(folder: Path, runs: int, particles: int) -> None:
    """From the address to the list, and from a click on a card to the particles of its run."""
    from playwright.sync_api import expect

    write_run(folder / "run-000", particles, 0.0)
    for number in range(1, runs):
        shutil.copytree(folder / "run-000", folder / f"run-{number:03d}")
    with serve(folder) as (_, address), chromium() as browser:
        for visit in ("first visit", "second visit"):
            page = browser.new_page()
            page.add_init_script(MOMENTS)
            page.goto(address)
            expect(page.locator(".card")).to_have_count(runs, timeout=60_000)
            page.get_by_role("link", name=f"run-{runs // 2:03d}").click()
            expect(page.locator(".scene .scale")).to_be_visible(timeout=60_000)
            while "drawn" not in (found := page.evaluate("moments")):
                page.wait_for_timeout(50)  # until the next frame notes it
            listed, drawn = found["listed"], found["drawn"] - found["clicked"]
            print(
                f"{visit}, {runs} runs: list after {listed / 1e3:.2f} s, particles "
                f"{drawn / 1e3:.2f} s after the click, {(listed + drawn) / 1e3:.2f} s together"
            )
            page.close()


def memory(folder: Path, gigabytes: float, particles: int) -> None:
    """Largest memory of the server when every block of a large run was asked for."""
    write_run(folder / "large", particles, gigabytes)
    size = sum(file.stat().st_size for file in folder.rglob("*") if file.is_file())
    with serve(folder) as (process, tokened):
        address = tokened.partition("?")[0]
        status = Path(f"/proc/{process.pid}/status")
        (run,) = json.loads(ask(f"{address}api/runs"))["runs"]
        base = f"{address}api/run/{run['id']}"
        index = json.loads(ask(f"{base}/particles"))
        asked = 0
        for field, offsets in index["blocks"].items():
            for offset, count in sorted(set(zip(offsets, index["counts"], strict=True))):
                ask(f"{base}/block/particles.{field}.{offset}.{count}.{index['stamp']}")
                asked += 1
        ask(f"{base}/history?from=0")
        peak = re.search(r"VmHWM:\s+(\d+)", status.read_text())
        assert peak is not None
        print(
            f"{size / 1e9:.2f} GB, {asked} blocks of {particles} particles: the server took "
            f"{int(peak[1]) * 1024 / MEGABYTE:.0f} MB at most"
        )


def size() -> None:
    """Bytes of the page, and of the packages that the extra installs."""
    page = Path(lasersph.__file__).parent / "web"
    files = [file for file in page.iterdir() if file.is_file()]
    print(f"page: {sum(file.stat().st_size for file in files) / MEGABYTE:.2f} MB")
    total = 0.0
    for name in EXTRA:
        found = distribution(name)
        parts = [Path(str(found.locate_file(one))) for one in found.files or ()]
        mine = sum(one.stat().st_size for one in parts if one.is_file()) / MEGABYTE
        total += mine
        print(f"  {name} {found.version}: {mine:.2f} MB")
    print(f"extra web: {total:.2f} MB")


def main() -> None:
    """Read the command line."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0] if __doc__ else "")
    parser.add_argument("what", choices=("first", "memory", "size"))
    parser.add_argument("--runs", type=int, default=200)
    parser.add_argument("--particles", type=int, default=0, help="default: 2000, or 1000000")
    parser.add_argument("--gigabytes", type=float, default=5.0)
    given = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        if given.what == "first":
            first(Path(folder), given.runs, given.particles or 2000)
        elif given.what == "memory":
            memory(Path(folder), given.gigabytes, given.particles or 1_000_000)
        else:
            size()


if __name__ == "__main__":
    main()
