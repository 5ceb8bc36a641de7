"""What a browser asks the page, without a browser."""

from starlette.testclient import TestClient

from lasersph.web.server import make_app

TOKEN = "a token of some length"


def browser_of(root, pages):
    """A browser that has the token, of a server of these pages."""
    return TestClient(
        make_app(root, token=TOKEN, pages=pages),
        base_url="http://127.0.0.1",
        headers={"authorization": f"Bearer {TOKEN}"},
        raise_server_exceptions=False,
    )


def cards(browser):
    """Cards of the list, by name of the folder."""
    return {card["name"]: card for card in browser.get("/api/runs").json()["runs"]}
