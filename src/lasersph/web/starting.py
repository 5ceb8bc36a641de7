"""Answers of a server that may start runs (`--allow-run`): form, check, start, stop, resume."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from starlette.concurrency import run_in_threadpool
from starlette.requests import Request
from starlette.responses import JSONResponse, Response
from starlette.routing import Route

from lasersph.web import form
from lasersph.web.folder_list import Entry
from lasersph.web.processes import Processes
from lasersph.web.server import Pages


class StartingPages(Pages):
    """The pages of a folder, with which runs can be started."""

    may_run = True

    def __init__(self, root: Path) -> None:
        super().__init__(root)
        self._processes = Processes(root)

    def routes(self) -> list[Route]:
        """Those that read, and those that start and stop."""
        return [
            Route("/api/form/{case}", self.form),
            Route("/api/check", self.check, methods=["POST"]),
            Route("/api/start", self.start, methods=["POST"]),
            Route("/api/run/{id}/stop", self.stop, methods=["POST"]),
            Route("/api/run/{id}/resume", self.resume, methods=["POST"]),
            *super().routes(),
        ]

    def note_of(self, entry: Entry) -> str:
        """What a process of this server said when it failed."""
        return self._processes.note_of(entry.path)

    def form(self, request: Request) -> Response:
        """Fields of a shipped case, with settings that choose other kinds of its tables."""
        settings = request.query_params.getlist("set")[: form.MOST_SETTINGS]
        return JSONResponse(form.form_of(request.path_params["case"], settings))

    async def check(self, request: Request) -> Response:
        """Problems, or the forecast."""
        case, settings, _ = _asked(await request.json())
        return JSONResponse(await run_in_threadpool(form.checked, case, settings))

    async def start(self, request: Request) -> Response:
        """Start a run whose case is right."""
        case, settings, name = _asked(await request.json())
        found = await run_in_threadpool(form.checked, case, settings)
        if found["problems"]:
            raise ValueError(found["problems"][0]["text"])
        folder = await run_in_threadpool(self._processes.start, name, case, settings)
        return JSONResponse({"id": self.folders.run_of(folder)})

    def stop(self, request: Request) -> Response:
        """Stop a run with a checkpoint."""
        self._processes.stop(self._entry(request).path)
        return Response(status_code=204)

    def resume(self, request: Request) -> Response:
        """Go on with a run."""
        self._processes.resume(self._entry(request).path)
        return Response(status_code=204)


def _asked(content: Any) -> tuple[str, list[str], str]:
    """Case, settings and name of a run. Raises ValueError."""
    if not isinstance(content, dict):
        raise ValueError("a case, settings and a name are wanted")
    case, name = content.get("case"), content.get("name", "")
    settings = content.get("settings", [])
    is_right = isinstance(settings, list) and len(settings) <= form.MOST_SETTINGS
    if not (is_right and all(isinstance(one, str) for one in [case, name, *settings])):
        raise ValueError("case and name are texts, settings a list of KEY=VALUE")
    return str(case), settings, name
