"""A server of the page and a browser, for benchmarks and for the pictures of the documentation."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

TOKEN = "token-of-benchmarks-and-pictures"
FLAGS = (
    "--no-sandbox",
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
    "--disable-background-networking",
)
"""Of Chromium: WebGL by the processor, as on a machine without a graphics card."""


@contextmanager
def serve(folder: str | Path) -> Iterator[tuple[subprocess.Popen[str], str]]:
    """Process of `lasersph serve` and its address, with the token."""
    process = subprocess.Popen(
        [sys.executable, "-m", "lasersph", "serve", str(folder), "--port", "0"],
        stdout=subprocess.PIPE,
        text=True,
        env=os.environ | {"LASERSPH_TOKEN": TOKEN},
    )
    assert process.stdout is not None
    try:
        found = re.search(r"http://\S+", process.stdout.readline())
        assert found is not None
        yield process, found[0]
    finally:
        process.terminate()
        process.wait()


@contextmanager
def chromium() -> Iterator[Any]:
    """Chromium of this machine, driven by playwright (extra `test`)."""
    from playwright.sync_api import sync_playwright  # pyright: ignore[reportMissingImports]

    with sync_playwright() as driver:
        browser = driver.chromium.launch(executable_path=shutil.which("chromium"), args=FLAGS)
        yield browser
        browser.close()
