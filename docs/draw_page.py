"""Takes the pictures of the page for docs/web.md from a folder of runs, in Chromium.

    python docs/draw_page.py RUNS [RUN]

RUN is the name of a complete run in the folder; the folder is shown in the pictures.
"""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

from playwright.sync_api import expect, sync_playwright

IMAGES = Path(__file__).parent / "images"
TOKEN = "token-of-the-pictures"
FLAGS = ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"]
PATIENCE = 60_000
"""[ms]"""


def main(folder: str, run: str) -> None:
    """Write page-list.png and page-run.png."""
    server = subprocess.Popen(
        [sys.executable, "-m", "lasersph", "serve", folder, "--port", "0"],
        stdout=subprocess.PIPE,
        text=True,
        env=os.environ | {"LASERSPH_TOKEN": TOKEN},
    )
    assert server.stdout is not None
    found = re.search(r"http://\S+", server.stdout.readline())
    assert found is not None
    expect.set_options(timeout=PATIENCE)
    try:
        with sync_playwright() as driver:
            browser = driver.chromium.launch(executable_path=shutil.which("chromium"), args=FLAGS)
            page = browser.new_page(viewport={"width": 1280, "height": 860})
            page.goto(found[0])
            expect(page.locator(".card").first).to_be_visible()
            page.wait_for_load_state("load")
            page.wait_for_timeout(1500)
            page.screenshot(path=IMAGES / "page-list.png")
            page.get_by_role("link", name=run, exact=True).click()
            expect(page.locator(".legend .bar span").first).to_be_visible()
            expect(page.locator(".plot canvas").first).to_be_visible()
            page.wait_for_timeout(1500)
            page.screenshot(path=IMAGES / "page-run.png")
            browser.close()
    finally:
        server.terminate()
        server.wait()


if __name__ == "__main__":
    main(*sys.argv[1:])
