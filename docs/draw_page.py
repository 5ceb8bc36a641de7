"""Takes the pictures of the page for docs/web.md from a folder of runs, in Chromium.

    python docs/draw_page.py RUNS [RUN [SWEEP]]

RUN is the name of a complete run in the folder, SWEEP that of a sweep; the folder is shown in the
pictures.
"""

from __future__ import annotations

import sys
from pathlib import Path

from playwright.sync_api import expect

DOCS = Path(__file__).parent
sys.path.insert(0, str(DOCS.parent / "benchmarks"))

from browser_page import chromium, serve  # noqa: E402

IMAGES = DOCS / "images"
PATIENCE = 60_000
"""[ms]"""


def main(folder: str, run: str = "", sweep: str = "") -> None:
    """Write page-list.png, page-run.png and page-sweep.png."""
    expect.set_options(timeout=PATIENCE)
    shows = {"run": (run, ".legend .bar span"), "sweep": (sweep, ".axes image")}
    with serve(folder) as (_, address), chromium() as browser:
        page = browser.new_page(viewport={"width": 1280, "height": 860})

        def keep(name: str) -> None:
            page.wait_for_timeout(1500)  # until pictures and curves are drawn
            page.screenshot(path=IMAGES / f"page-{name}.png")

        page.goto(address)
        expect(page.locator(".card").first).to_be_visible()
        page.wait_for_load_state("load")
        keep("list")
        for kind, (name, sign) in shows.items():
            if name:
                page.get_by_role("link", name=name, exact=True).click()
                expect(page.locator(sign).first).to_be_visible()
                keep(kind)
                page.get_by_role("link", name="Runs", exact=True).click()


if __name__ == "__main__":
    main(*sys.argv[1:])
