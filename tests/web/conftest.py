"""A real browser for pages: Debian's Chromium without a screen, driven by Playwright."""

import json
import os
import re
import shutil
import subprocess
import sys
from contextlib import contextmanager
from pathlib import Path

import numpy as np
import pytest
from synthetic_run import make_run
from synthetic_sweep import grid_points, made_up_sweep

FLAGS = ("--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader")
PATIENCE = 60_000
"""How long a page may take for anything [ms], on a machine ten times slower than today's."""
SCREENSHOTS = Path(__file__).resolve().parents[2] / "screenshots"
TOKEN = "token-of-the-browser-tests"
EVERY_PICTURE = """Promise.all([...document.images].map((one) => {
  one.loading = "eager";
  return one.decode().catch(() => {});
}))"""
"""Waits for the pictures that are only fetched when they are looked at."""
QUIET = ("--disable-quic", "--no-first-run", "--disable-background-networking", "--disable-sync")


@pytest.fixture(scope="session")
def chromium():
    """Playwright and the path of Chromium; skipped where either is missing, never in CI."""
    program = shutil.which("chromium")
    try:
        from playwright.sync_api import expect, sync_playwright
    except ImportError:
        expect = sync_playwright = None
    if program is None or expect is None or sync_playwright is None:
        reason = "needs Chromium (Debian: apt install chromium) and playwright (extra test)"
        if os.environ.get("CI"):
            pytest.fail(reason)
        pytest.skip(reason)
    expect.set_options(timeout=PATIENCE)
    with sync_playwright() as playwright:
        yield playwright.chromium, program


def start(chromium, *more):
    kind, program = chromium
    return kind.launch(executable_path=program, args=[*FLAGS, *QUIET, *more])


@pytest.fixture(scope="session")
def browser(chromium):
    """One browser for all tests, with WebGL by software."""
    found = start(chromium)
    yield found
    found.close()


@pytest.fixture(scope="session")
def browser_without_webgl(chromium):
    """A browser as on a machine that offers no WebGL."""
    found = start(chromium, "--disable-gpu", "--disable-3d-apis")
    yield found
    found.close()


def watched_page(browser):
    """A page with the list of all that went wrong in it: `page.complaints`."""
    page = browser.new_page(viewport={"width": 760, "height": 560})
    page.complaints = []
    page.on("pageerror", lambda error: page.complaints.append(str(error)))
    page.on(
        "console",
        lambda message: (
            page.complaints.append(message.text) if message.type in ("error", "warning") else None
        ),
    )
    return page


@contextmanager
def page_without_complaints(browser):
    """A page in which nothing may be reported as wrong."""
    found = watched_page(browser)
    yield found
    complaints = found.complaints
    found.close()
    assert not complaints


@pytest.fixture
def page(browser):
    """A page in which nothing may be reported as wrong."""
    with page_without_complaints(browser) as found:
        yield found


@pytest.fixture
def page_without_webgl(browser_without_webgl):
    """The same without WebGL."""
    with page_without_complaints(browser_without_webgl) as found:
        yield found


def keep_picture(page, name):
    """Keep a picture of a whole page."""
    SCREENSHOTS.mkdir(exist_ok=True)
    page.evaluate(EVERY_PICTURE)
    page.evaluate("scrollTo(0, 0)")
    page.screenshot(path=SCREENSHOTS / f"{name}.png", full_page=True)


@pytest.fixture
def keep():
    """Keeps a picture of a page under a name."""
    return keep_picture


class Watched:
    """A page whose complaints are noted.

    Attributes:
        errors: of the console and of scripts. foreign: requests to other servers.
    """

    def __init__(self, page):
        self.page, self.errors, self.foreign = page, [], []
        page.on("console", lambda one: one.type == "error" and self.errors.append(one.text))
        page.on("pageerror", lambda one: self.errors.append(str(one)))
        page.on("request", self._note)

    def _note(self, request):
        if not re.match(r"(http://127\.0\.0\.1[:/]|data:|blob:)", request.url):
            self.foreign.append(request.url)

    def keep(self, name):
        """Keep a picture of the whole page."""
        keep_picture(self.page, name)


@pytest.fixture
def open_page(browser, serve):
    """Opens pages of their own, each with its cookies; all must end without a complaint, and before
    the servers that `serve` has started for them."""
    opened = []

    def open_one(address, *, width=1280, height=860, dark=False, expected=()):
        context = browser.new_context(
            viewport={"width": width, "height": height},
            color_scheme="dark" if dark else "light",
            reduced_motion="reduce",
        )
        context.set_default_timeout(PATIENCE)
        watched = Watched(context.new_page())
        opened.append((context, watched, expected))
        watched.page.goto(address)
        return watched

    yield open_one
    for context, watched, expected in opened:
        watched.page.wait_for_timeout(50)  # for the last message of the console
        context.close()
        assert not watched.foreign
        assert [
            one for one in watched.errors if not re.search("|".join(expected) or "$^", one)
        ] == []


class Server:
    """`lasersph serve` as a process of its own."""

    def __init__(self, folder, *options):
        self.folder, self.options, self.port = folder, options, 0
        self.start()

    def start(self):
        """Start, on the same port where there was one before."""
        environment = os.environ | {"LASERSPH_TOKEN": TOKEN}
        command = [sys.executable, "-m", "lasersph", "serve", str(self.folder)]
        self.process = subprocess.Popen(
            [*command, "--port", str(self.port), *self.options],
            stdout=subprocess.PIPE,
            text=True,
            env=environment,
        )
        line = self.process.stdout.readline()
        self.port = int(line.partition("/?token=")[0].rpartition(":")[2])

    @property
    def address(self):
        """With the token."""
        return f"http://127.0.0.1:{self.port}/?token={TOKEN}"

    def kill(self):
        """End it at once."""
        self.process.kill()
        self.process.wait()
        self.process.stdout.close()


@pytest.fixture
def serve():
    """Starts servers that end with the test."""
    started = []

    def start(folder, *options):
        started.append(Server(folder, *options))
        return started[-1]

    yield start
    for server in started:
        server.kill()


def write_calibration(folder):
    """A sweep with the answer of a calibration."""
    made_up_sweep(folder, grid_points(), failed=(2,))
    draws = np.random.default_rng(3).normal(1.05, 0.02, (4000, 2)) @ [[1.0, -0.5], [0.0, 0.5]]
    lines = [f"{factor},{share},1.0\n" for factor, share in draws]
    (folder / "posterior.csv").write_text("factor,share,weight\n" + "".join(lines))
    unknown = {"mean": 1.05, "sd": 0.02, "low_95": 1.01, "high_95": 1.09, "unit": ""}
    share = {"mean": 0.0, "sd": 0.014, "low_95": -0.03, "high_95": 0.03, "unit": ""}
    datum = {"measurement": 1, "number": "melt.depth_max_m", "unit": "m", "measured": 2.1e-7}
    datum |= {"standard_error": 1.2e-8, "computed": 2.05e-7, "pull": 0.4}
    answer = {
        "unknowns": {"factor": unknown, "share": share},
        "covariance": [[4e-4, -2e-4], [-2e-4, 2e-4]],
        "warnings": [],
        "data": [datum],
        "chi_squared": {"value": 0.16, "degrees_of_freedom": 0, "probability": 1.0},
    }
    (folder / "calibration.json").write_text(json.dumps(answer))


@pytest.fixture(scope="session")
def runs(tmp_path_factory):
    """Three runs, one of them stopped, a damaged one, and a calibration. Read only."""
    from lasersph.output import open_run
    from lasersph.plots import style
    from lasersph.plots.run_figures import DRAWINGS

    root = tmp_path_factory.mktemp("page") / "runs"
    make_run(root / "hot", strength=1.2)
    make_run(root / "cool", strength=0.4)
    make_run(root / "stopped", complete=False)
    for name, depth in (("hot", 80), ("cool", 20)):
        rows = "".join(f"{x}e-7,{x - depth}e-9\n" for x in range(1, 25, 2))
        (root / name / "surface.csv").write_text(f"x_m,height_m\n{rows}")
    (root / "damaged").mkdir()
    (root / "damaged" / "resolved.json").write_text("{")
    write_calibration(root / "map")
    (root / "hot" / "figures").mkdir()
    figures = {one.name: one.draw(open_run(root / "hot")) for one in DRAWINGS}
    drawn = [(name, figure) for name, figure in figures.items() if figure is not None]
    for name, figure in drawn[:2]:
        style.save(figure, root / "hot" / "figures" / f"{name}.png")
    return root


@pytest.fixture(scope="session")
def shown(runs):
    """One server that shows these runs, with the form for new ones."""
    server = Server(runs, "--allow-run")
    yield server
    server.kill()


@pytest.fixture
def address(shown):
    """Of that server."""
    return shown.address
