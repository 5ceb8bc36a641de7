"""The window of a browser, and what its console says."""

import re

import pytest
from playwright.sync_api import expect

PATIENCE = 60_000
"""For the window to follow [ms], on a busy machine."""
LOST = "Failed to load resource|ERR_CONNECTION|ERR_FAILED|ERR_EMPTY"
"""What the console says of requests that a test lets fail."""


def wait_until_drawn(page):
    """Until what was asked for is on the screen: two frames of the window later."""
    page.evaluate(f"() => {'new Promise(requestAnimationFrame).then(() => ' * 3}0{')' * 3}")


def wait_for_particles(page):
    """Until the first picture of the particles was drawn."""
    expect(page.locator(".stage").first).to_have_attribute("data-shown", re.compile("."))
    wait_until_drawn(page)


def width_of(page):
    """How far the page reaches to the right [pixels]."""
    return page.evaluate("document.documentElement.scrollWidth")


def narrow(page):
    """Make the window as wide as a telephone; curves follow its size a moment later."""
    page.set_viewport_size({"width": 390, "height": 844})
    for _ in range(PATIENCE // 100):
        if width_of(page) == 390:
            return
        page.wait_for_timeout(100)
    pytest.fail(f"the page is {width_of(page)} pixels wide")
