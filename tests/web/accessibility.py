"""What readers who do not see or do not use a mouse would meet in a page."""

from axe_playwright_python.sync_playwright import Axe


def serious(page):
    """What axe-core finds serious or critical."""
    found = Axe().run(page).response["violations"]
    return [
        (one["id"], [node["html"] for node in one["nodes"]])
        for one in found
        if one["impact"] in ("serious", "critical")
    ]
