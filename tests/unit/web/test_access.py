"""Who may ask the page, and what every answer says to the browser."""

import pytest
from starlette.applications import Starlette
from starlette.responses import PlainTextResponse
from starlette.routing import Route
from starlette.testclient import TestClient

from lasersph.web.access import LARGEST_BODY, Access

TOKEN = "a token of some length"
HOST = "http://127.0.0.1:8157"


async def everything(request):
    """An application that tells all."""
    return PlainTextResponse("secret")


def guarded(token=TOKEN, hosts=()):
    """The application behind its guard."""
    routes = [Route("/{path:path}", everything, methods=["GET", "POST"])]
    return Access(Starlette(routes=routes), token=token, hosts=hosts)


def client(**headers):
    """A browser that does not know the token yet."""
    return TestClient(guarded(), base_url=HOST, follow_redirects=False, headers=headers)


@pytest.fixture
def known():
    """A browser that has opened the address with the token."""
    found = client()
    assert found.get("/", params={"token": TOKEN}).status_code == 303
    return found


def test_nothing_without_the_token():
    """Neither the page nor data, and no word of what there is."""
    for path in ("/", "/api/runs", "/static/page.js", "/favicon.ico"):
        answer = client().get(path)
        assert answer.status_code == 403
        assert "secret" not in answer.text


@pytest.mark.parametrize("token", ["", "wrong", TOKEN + "x", TOKEN[:-1], "ä"])
def test_wrong_token_is_refused(token):
    """In the address and as a bearer."""
    answer = client().get("/", params={"token": token})
    assert answer.status_code == 403
    assert "set-cookie" not in answer.headers
    bearer = client().get("/api/runs", headers={"authorization": f"Bearer {token}".encode()})
    assert bearer.status_code == 403


def test_token_becomes_a_cookie_and_leaves_the_address():
    """No script reads it, no other site sends it, and a prefix of a proxy stays."""
    browser = client()
    answer = browser.get("/", params={"token": TOKEN})
    assert answer.status_code == 303
    assert answer.headers["location"] == "./"
    cookie = answer.headers["set-cookie"].lower()
    assert "httponly" in cookie and "samesite=strict" in cookie and "path=" not in cookie
    assert TOKEN not in cookie
    assert browser.get("/api/runs").text == "secret"


def test_scripts_send_the_token_as_bearer():
    """Without a cookie."""
    answer = client().get("/api/runs", headers={"authorization": f"Bearer {TOKEN}"})
    assert answer.text == "secret"


def test_two_servers_of_one_machine_have_cookies_of_their_own():
    """Cookies do not know ports: names differ, so that none overwrites another."""
    names = set()
    for token in (TOKEN, "another token of this length"):
        browser = TestClient(guarded(token), base_url=HOST, follow_redirects=False)
        answer = browser.get("/", params={"token": token})
        names.add(answer.headers["set-cookie"].partition("=")[0])
    assert len(names) == 2


def test_only_names_of_this_machine_are_hosts(known):
    """Another site that gives itself our address (DNS rebinding) is refused, token or not."""
    for host in ("evil.example", "127.0.0.1.evil.example", "", "[", "10.0.0.1"):
        assert known.get("/api/runs", headers={"host": host}).status_code == 400
    for host in ("localhost:9000", "127.0.0.1", "[::1]:8157"):
        answer = known.get("/api/runs", headers={"host": host, "authorization": f"Bearer {TOKEN}"})
        assert answer.status_code == 200


def test_name_of_a_proxy_can_be_allowed():
    """As with --allow-host."""
    outer = TestClient(guarded(hosts=["Hub.example"]), base_url="https://hub.example")
    assert outer.get("/x", headers={"authorization": f"Bearer {TOKEN}"}).status_code == 200


@pytest.mark.parametrize(
    "headers",
    [
        {"origin": "http://evil.example"},
        {"origin": "http://127.0.0.1:9999"},  # another server of this machine shares our cookies
        {"origin": "null"},
        {"origin": HOST, "sec-fetch-site": "cross-site"},
        {"origin": HOST, "sec-fetch-site": "same-site"},
        {},
    ],
)
def test_requests_of_other_pages_change_nothing(known, headers):
    """A request that could change something needs our own page as its origin."""
    assert known.post("/api/start", headers=headers).status_code == 403


def test_own_page_and_scripts_may_change_things(known):
    """A browser sends the origin of our page, a script the token itself."""
    assert known.post("/x", headers={"origin": HOST}).status_code == 200
    assert client().post("/x", headers={"authorization": f"Bearer {TOKEN}"}).status_code == 200


def test_long_requests_are_refused(known):
    """No upload, whether its length is told or not."""
    body = b"x" * (LARGEST_BODY + 1)
    assert known.post("/x", headers={"origin": HOST}, content=body).status_code == 413
    parts = iter([b"x"])
    assert known.post("/x", headers={"origin": HOST}, content=parts).status_code == 413
    odd = {"origin": HOST, "content-length": "-1"}
    assert known.post("/x", headers=odd).status_code == 413


def test_every_answer_tells_the_browser_what_it_may_do(known):
    """Also refusals: only our own scripts, nothing framed, guessed, kept or sent on."""
    for answer in (known.get("/"), client().get("/")):
        policy = answer.headers["content-security-policy"]
        assert "default-src 'none'" in policy and "script-src 'self'" in policy
        assert "unsafe" not in policy and "http" not in policy
        assert "frame-ancestors 'none'" in policy
        assert answer.headers["x-content-type-options"] == "nosniff"
        assert answer.headers["referrer-policy"] == "no-referrer"
        assert answer.headers["cross-origin-resource-policy"] == "same-origin"
        assert answer.headers["cache-control"] == "no-store"
        assert "access-control-allow-origin" not in answer.headers
