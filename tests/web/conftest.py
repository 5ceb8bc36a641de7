"""A real browser for pages: Debian's Chromium without a screen, driven by Playwright."""

import os
import shutil

import pytest

FLAGS = ("--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader")
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
    expect.set_options(timeout=600_000)  # a busy machine is slow, not wrong
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


@pytest.fixture
def page(browser):
    """A page in which nothing may be reported as wrong."""
    found = watched_page(browser)
    yield found
    complaints = found.complaints
    found.close()
    assert not complaints


@pytest.fixture
def page_without_webgl(browser_without_webgl):
    """The same without WebGL."""
    found = watched_page(browser_without_webgl)
    yield found
    complaints = found.complaints
    found.close()
    assert not complaints
