"""The window of a browser, and what its console says."""

import pytest

PATIENCE = 60_000
"""For the window to follow [ms], on a busy machine."""
LOST = "Failed to load resource|ERR_CONNECTION|ERR_FAILED|ERR_EMPTY"
"""What the console says of requests that a test lets fail."""


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
