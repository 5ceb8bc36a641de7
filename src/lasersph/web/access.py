"""Who may ask what: host names, token, origin, and the headers of every answer.

The page is for one person. A random token stands in the address that the server prints; the browser
gets a cookie for it that scripts cannot read and other sites cannot send. The name of the cookie
comes from the token, since cookies do not know ports and two servers would overwrite one name.
Only names of this machine are taken as host, against pages of other sites that give themselves its
address (DNS rebinding); requests that change something must come from a page of this server.
"""

from __future__ import annotations

import hashlib
import hmac
from collections.abc import Iterable
from http.cookies import CookieError, SimpleCookie
from urllib.parse import urlsplit

from starlette.datastructures import Headers, MutableHeaders
from starlette.requests import Request
from starlette.responses import PlainTextResponse, RedirectResponse, Response
from starlette.types import ASGIApp, Message, Receive, Scope, Send

LOOPBACK = ("127.0.0.1", "localhost", "::1")
POLICY = (
    "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data: blob:; "
    "connect-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'"
)
HEADERS = {
    "content-security-policy": POLICY,
    "x-content-type-options": "nosniff",
    "referrer-policy": "no-referrer",
    "cross-origin-resource-policy": "same-origin",
    "cross-origin-opener-policy": "same-origin",
    "cache-control": "no-store",
}
"""Of answers that do not say otherwise."""
LARGEST_BODY = 1 << 16
"""Bytes of a request: a case as it is typed."""


class Access:
    """Lets only the owner of the token ask, around the application that answers."""

    def __init__(self, app: ASGIApp, *, token: str, hosts: Iterable[str] = ()) -> None:
        """Guard an application.

        Args:
            hosts: names beside those of this machine under which a proxy passes requests on.
        """
        self.app, self._token = app, token
        self._outer = frozenset(name.lower() for name in hosts)
        # The cookie is named by the token: two servers of one machine keep theirs apart.
        digest = hashlib.sha256(b"lasersph " + token.encode()).hexdigest()
        self._cookie, self._value = f"lasersph-{digest[:12]}", digest[12:]

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Answer a request, or refuse it."""
        # Start and end of the server pass, requests are judged.
        if scope["type"] == "lifespan":
            await self.app(scope, receive, send)
            return
        if scope["type"] != "http":  # no web sockets here
            return
        request = Request(scope)

        async def send_with_headers(message: Message) -> None:
            if message["type"] == "http.response.start":
                headers = MutableHeaders(scope=message)
                for name, value in HEADERS.items():
                    headers.setdefault(name, value)
            await send(message)

        # Refuse, greet or answer; every answer gets the headers.
        answer = self._refusal(request) or self._welcome(request)
        await (answer or self.app)(scope, receive, send_with_headers)

    def _refusal(self, request: Request) -> Response | None:
        """The answer to a request that must not be served."""
        headers = request.headers
        # Names of this server only, against DNS rebinding.
        if host_name(headers.get("host", "")) not in {*LOOPBACK, *self._outer}:
            return PlainTextResponse(
                "This name is not one of the server's: add --allow-host NAME.\n", 400
            )
        # Changes come from a page of this server, against requests forged by other sites.
        if request.method not in ("GET", "HEAD") and not self._is_own_page(headers):
            return PlainTextResponse("The request comes from another site.\n", 403)
        # No body longer than a case, and none of unknown length.
        length = headers.get("content-length", "0")
        if not length.isdigit() or int(length) > LARGEST_BODY or "transfer-encoding" in headers:
            return PlainTextResponse("The request is too long.\n", 413)
        return None

    def _welcome(self, request: Request) -> Response | None:
        """A cookie for the token, a refusal without either, nothing where all is well."""
        # The address with the token is traded for a cookie, once.
        given = request.query_params.get("token")
        if given is not None and request.url.path in ("", "/"):
            if not hmac.compare_digest(given.encode(), self._token.encode()):
                return PlainTextResponse("The token in this address is wrong.\n", 403)
            answer = RedirectResponse("./", 303)
            # no path: the browser takes the folder of the address, with the prefix of a proxy
            answer.set_cookie(
                self._cookie, self._value, path=None, httponly=True, samesite="strict"
            )
            return answer
        # A script sends the token itself, a browser its cookie; both are compared in constant time.
        scheme, _, bearer = request.headers.get("authorization", "").partition(" ")
        if scheme.lower() == "bearer":
            is_known = hmac.compare_digest(bearer.strip().encode(), self._token.encode())
        else:
            is_known = hmac.compare_digest(self._cookie_of(request).encode(), self._value.encode())
        if is_known:
            return None
        return PlainTextResponse(
            "Open the address with the token that lasersph serve has printed.\n", 403
        )

    def _cookie_of(self, request: Request) -> str:
        try:
            found = SimpleCookie(request.headers.get("cookie", "")).get(self._cookie)
        except CookieError:
            return ""
        return "" if found is None else found.value

    def _is_own_page(self, headers: Headers) -> bool:
        """Whether a page of this server sent a request; scripts send no origin."""
        # Browsers say where a request comes from; a script that knows the token may not.
        if headers.get("sec-fetch-site", "same-origin") not in ("same-origin", "none"):
            return False
        origin = headers.get("origin")
        if origin is None:
            return "authorization" in headers
        # The origin is this host, or the name of a proxy.
        found = urlsplit(origin)
        is_same = found.netloc.lower() == headers.get("host", "").lower()
        return is_same or (found.hostname or "") in self._outer


def host_name(host: str) -> str:
    """The name in a Host header, without its port."""
    try:
        return urlsplit(f"//{host}").hostname or ""
    except ValueError:
        return ""
