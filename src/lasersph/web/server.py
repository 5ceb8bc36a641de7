"""The addresses of the page, and the loop that answers them.

All addresses are relative in the page and have no prefix here, so that it works behind a proxy that
strips one. Functions that read files are no coroutines: Starlette runs them in threads.
"""

from __future__ import annotations

import importlib
import socket
import threading
from collections.abc import Callable, Iterable
from importlib.resources import files
from pathlib import Path
from typing import Any

import uvicorn
from starlette.applications import Starlette
from starlette.exceptions import HTTPException
from starlette.middleware import Middleware
from starlette.requests import Request
from starlette.responses import FileResponse, JSONResponse, Response, StreamingResponse
from starlette.routing import Route

from lasersph import __version__
from lasersph.input import CaseError
from lasersph.output import OutputError
from lasersph.output.growing_table import new_rows
from lasersph.web import live, run_page
from lasersph.web.access import Access
from lasersph.web.case_source import in_words
from lasersph.web.folder_list import Entry, FolderList, refuse_links
from lasersph.web.sweep_page import Sweeps

CONTENT = {
    ".html": "text/html; charset=utf-8",
    ".js": "text/javascript; charset=utf-8",
    ".css": "text/css; charset=utf-8",
    ".svg": "image/svg+xml",
    ".txt": "text/plain; charset=utf-8",
}
STATIC = {
    file.name: file.read_bytes()
    for file in files("lasersph.web").iterdir()
    if Path(file.name).suffix in CONTENT
}
"""The files of the page by name."""
REPORT_POLICY = (
    "sandbox allow-scripts; default-src 'none'; style-src 'unsafe-inline'; img-src data: blob:; "
    "script-src 'unsafe-inline'"
)
"""A report may have been written by anyone who can write the folder: it gets an origin of its own
and no way to ask the server anything."""
FOREVER = "private, max-age=31536000, immutable"
SHUTDOWN = 2
"""Seconds for open requests when the server is stopped."""


class Pages:
    """Answers of one server.

    Attributes:
        folders: runs and sweeps below its folder. is_stopping: whether the server is about to end.
        may_run: whether runs can be started.
    """

    may_run = False

    def __init__(self, root: Path) -> None:
        self.folders, self._cards = FolderList(root), run_page.Cards()
        self._sweeps = Sweeps(self.folders)
        self.is_stopping: Callable[[], bool] = lambda: False

    def routes(self) -> list[Route]:
        """The addresses with the functions that answer them."""
        return [
            Route("/", self.index),
            Route("/favicon.ico", lambda request: _static("icon.svg")),
            Route("/static/{name}", self.static),
            Route("/api/alive", lambda request: Response(status_code=204)),
            Route("/api/runs", self.runs),
            Route("/api/sweep/{id}", self.sweep),
            Route("/api/sweep/{id}/map", self.map),
            Route("/api/run/{id}", self.run),
            Route("/api/run/{id}/history", self.history),
            Route("/api/run/{id}/log", self.log),
            Route("/api/run/{id}/relief", self.relief),
            Route("/api/run/{id}/live", self.live),
            Route("/api/run/{id}/figure/{name}", self.figure),
            Route("/api/run/{id}/report", self.report),
            Route("/api/run/{id}/particles", self.particles),
            Route("/api/run/{id}/block/{name:path}", self.block),
        ]

    async def index(self, request: Request) -> Response:
        """The page."""
        return _static("index.html")

    async def static(self, request: Request) -> Response:
        """A file of the page."""
        return _static(request.path_params["name"])

    def read_ahead(self) -> None:
        """Read what the first visitor asks for: the list, and the library that reads particles."""
        # The list, and the library of HDF5, which takes long to load.
        self.list_runs()
        importlib.import_module("lasersph.output.frame_blocks")

    def runs(self, request: Request) -> Response:
        """All runs and sweeps of the folder."""
        return JSONResponse(self.list_runs())

    def list_runs(self) -> dict[str, Any]:
        """Content of the start page."""
        entries = self.folders.entries()
        shown = [one for one in entries if one.kind == "run" and not one.sweep]
        return {
            "folder": str(self.folders.root),
            "version": __version__,
            "may_run": self.may_run,
            "runs": [self._cards.card(one) for one in shown],
            "sweeps": [self._sweeps.card(one) for one in entries if one.kind == "sweep"],
        }

    def run(self, request: Request) -> Response:
        """One run."""
        found = run_page.details(self._entry(request))
        return JSONResponse(found | {"may_run": self.may_run})

    def sweep(self, request: Request) -> Response:
        """One sweep."""
        entry = self.folders.find(request.path_params["id"], "sweep")
        return JSONResponse(self._sweeps.details(entry))

    def map(self, request: Request) -> Response:
        """A number of a sweep between its runs."""
        # Keys and column of the map.
        entry = self.folders.find(request.path_params["id"], "sweep")
        asked = request.query_params
        keys = [key for key in (asked.get("x", ""), asked.get("y", "")) if key]
        return JSONResponse(self._sweeps.map(entry, keys, asked.get("show", "")))

    def history(self, request: Request) -> Response:
        """New rows of history.csv; the header X-Next says where the next ones begin."""
        entry = self._entry(request)
        path = entry.path / "history.csv"
        # The number of bytes comes from outside.
        text = request.query_params.get("from", "0")
        if not text.isascii() or not text.isdigit() or len(text) > 15:
            raise HTTPException(400, "from must be a number of bytes")
        rows, following = new_rows(path, int(text)) if path.exists() else (b"", 0)
        return Response(rows, media_type="text/csv", headers={"X-Next": str(following)})

    def log(self, request: Request) -> Response:
        """The end of run.log."""
        return Response(run_page.log_text(self._entry(request).path), media_type="text/plain")

    def relief(self, request: Request) -> Response:
        """Height of the surface over the place at the end."""
        return JSONResponse(run_page.relief(self._entry(request)))

    async def live(self, request: Request) -> Response:
        """Events of a run."""
        entry = self._entry(request)
        stream = live.events(entry, self.note_of, self.is_stopping)
        return StreamingResponse(
            stream, media_type="text/event-stream", headers={"x-accel-buffering": "no"}
        )

    def note_of(self, entry: Entry) -> str:
        """Note on a run beside its files."""
        return ""

    def figure(self, request: Request) -> Response:
        """A picture of a run."""
        entry = self._entry(request)
        path = run_page.figure_file(entry.path, request.path_params["name"])
        return FileResponse(path, media_type=f"image/{path.suffix[1:]}")

    def report(self, request: Request) -> Response:
        """The report of a run, where it can do no harm."""
        path = self._entry(request).path / "report.html"
        if not path.is_file():
            raise KeyError(path.name)
        return FileResponse(
            path, media_type=CONTENT[".html"], headers={"content-security-policy": REPORT_POLICY}
        )

    def particles(self, request: Request) -> Response:
        """Times, fields and names of the blocks of the particles of a run."""
        from lasersph.output.frame_blocks import particle_index

        return JSONResponse(particle_index(self._entry(request).path))

    def block(self, request: Request) -> Response:
        """Numbers of one field at one time, little-endian float32."""
        from lasersph.output.frame_blocks import particle_block

        # Blocks never change: the browser keeps them.
        numbers = particle_block(self._entry(request).path, request.path_params["name"])
        headers = {"cache-control": FOREVER}
        return Response(numbers, media_type="application/octet-stream", headers=headers)

    def _entry(self, request: Request) -> Entry:
        entry = self.folders.find(request.path_params["id"], "run")
        refuse_links(entry.path)
        return entry


def _static(name: str) -> Response:
    return Response(
        STATIC[name],
        media_type=CONTENT[Path(name).suffix],
        headers={"cache-control": "no-cache"},
    )


def make_app(
    root: Path, *, token: str, hosts: Iterable[str] = (), pages: Pages | None = None
) -> Starlette:
    """The application that answers for a folder of runs.

    Args:
        hosts: names beside those of this machine under which a proxy passes requests on.
        pages: functions that answer; default: those that only read.
    """
    # Guard around the pages, and an answer in words for each kind of error.
    pages = pages or Pages(root)
    return Starlette(
        routes=pages.routes(),
        middleware=[Middleware(Access, token=token, hosts=hosts)],
        exception_handlers={
            HTTPException: _refused,
            KeyError: _missing,
            OutputError: _unreadable,
            ValueError: _wrong,
        },
    )


def _error(status: int, text: str) -> Response:
    return JSONResponse({"error": text}, status)


def _refused(request: Request, error: Any) -> Response:
    return _error(error.status_code, error.detail)


def _missing(request: Request, error: Exception) -> Response:
    return _error(404, "there is nothing at this address")


def _unreadable(request: Request, error: Exception) -> Response:
    return _error(422, str(error))


def _wrong(request: Request, error: Exception) -> Response:
    return _error(400, in_words(error) if isinstance(error, CaseError) else str(error))


def serve(
    app: Starlette, pages: Pages, listening: socket.socket, started: Callable[[], None]
) -> None:
    """Answer until Ctrl-C or SIGTERM.

    Args:
        listening: bound to the address. started: called when requests are answered.
    """
    # Quiet, and with time for open requests at the end.
    config = uvicorn.Config(
        app,
        log_level="warning",
        access_log=False,
        server_header=False,
        timeout_graceful_shutdown=SHUTDOWN,
    )
    config.load()  # before the address is printed
    server = uvicorn.Server(config)
    # Event streams end when the server is asked to.
    pages.is_stopping = lambda: server.should_exit
    listening.listen()
    threading.Thread(target=pages.read_ahead, daemon=True).start()
    started()
    server.run(sockets=[listening])
