"""`lasersph serve`: a page of the runs and sweeps of a folder, in a browser."""

from __future__ import annotations

import os
import secrets
import socket
import sys
from importlib.util import find_spec
from ipaddress import ip_address
from pathlib import Path
from typing import Annotated

import typer

from lasersph.cli.failures import WrongCommand

PORT = 8157
"""Where it is free: no well-known service has it."""
TOKEN = "LASERSPH_TOKEN"
SHORTEST_TOKEN = 16

Folder = Annotated[Path, typer.Argument(metavar="[DIR]", help="Folder of runs and sweeps.")]
Port = Annotated[
    int | None,
    typer.Option("--port", min=0, max=65535, help=f"Default: {PORT}, or a free one."),
]
Open = Annotated[bool, typer.Option("--open", help="Open the page in a browser.")]
Host = Annotated[
    str, typer.Option("--host", metavar="ADDRESS", help="Listen there; others can then reach it.")
]
AllowHost = Annotated[
    list[str] | None,
    typer.Option(
        "--allow-host", metavar="NAME", help="Name of a proxy that passes requests on under it."
    ),
]

AllowRun = Annotated[
    bool, typer.Option("--allow-run", help="Let the page start, stop and resume runs.")
]


def serve(
    folder: Folder = Path("runs"),
    port: Port = None,
    open_page: Open = False,
    host: Host = "127.0.0.1",
    allow_host: AllowHost = None,
    allow_run: AllowRun = False,
) -> None:
    """Show the runs and sweeps of a folder as a page in a browser: live curves, particles, maps."""
    # The web libraries are an extra.
    missing = [name for name in ("starlette", "uvicorn") if find_spec(name) is None]
    if missing:
        from lasersph.output.reader import install_hint

        raise WrongCommand(install_hint(" and ".join(missing), "web"))
    from lasersph.web import server
    from lasersph.web.starting import StartingPages

    # Refuse a wrong folder, token or address before the server starts.
    if not folder.is_dir():
        raise WrongCommand(f"{folder} is not a folder: give one that holds runs")
    token = os.environ.get(TOKEN) or secrets.token_urlsafe(24)
    if len(token) < SHORTEST_TOKEN or not token.isascii():
        raise WrongCommand(f"${TOKEN} needs {SHORTEST_TOKEN} or more plain letters")
    listening = bound_socket(host, port)

    # Beyond this machine the token travels in the open.
    if not is_loopback(host):
        print(
            f"warning: whoever reaches {host} and knows the token sees all runs, and it is sent "
            "without encryption: an ssh tunnel (ssh -L) is safer",
            file=sys.stderr,
        )

    # Names under which the page may be asked for.
    hosts = [*(allow_host or ()), *([] if is_loopback(host) else [host, socket.gethostname()])]
    pages = StartingPages(folder) if allow_run else server.Pages(folder)
    app = server.make_app(folder, token=token, hosts=hosts, pages=pages)

    # The address with the token is what a browser needs.
    name = f"[{host}]" if ":" in host else host
    address = f"http://{name}:{listening.getsockname()[1]}/?token={token}"

    def say() -> None:
        print(f"runs of {folder.resolve()}: {address}\nend with Ctrl-C", flush=True)
        if open_page:
            import webbrowser

            webbrowser.open(address)

    server.serve(app, pages, listening, say)


def bound_socket(host: str, port: int | None) -> socket.socket:
    """A socket at an address; a port that is not asked for may be another.

    Raises:
        WrongCommand: the address is none of this machine, or the port is taken.
    """
    family = socket.AF_INET6 if ":" in host else socket.AF_INET
    reason = ""
    # The usual port first, then any that is free; a port that is asked for is the only one.
    for wanted in (PORT, 0) if port is None else (port,):
        listening = socket.socket(family, socket.SOCK_STREAM)
        listening.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        try:
            listening.bind((host, wanted))
        except OSError as error:
            listening.close()
            reason = error.strerror or str(error)
            continue
        return listening
    raise WrongCommand(f"cannot listen on {host}, port {port}: {reason}")


def is_loopback(host: str) -> bool:
    """Whether an address leads to this machine alone."""
    try:
        return ip_address(host).is_loopback
    except ValueError:
        return host == "localhost"
