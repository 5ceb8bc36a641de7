"""Answers of a server that may start runs (`--allow-run`): form, check, start, stop, resume."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

from starlette.concurrency import run_in_threadpool
from starlette.requests import Request
from starlette.responses import JSONResponse, Response
from starlette.routing import Route

from lasersph.web import form
from lasersph.web.case_source import CaseSource, source_of
from lasersph.web.folder_list import Entry, FolderList
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
            Route("/api/form", self.form, methods=["POST"]),
            Route("/api/check", self.check, methods=["POST"]),
            Route("/api/start", self.start, methods=["POST"]),
            Route("/api/run/{id}/stop", self.stop, methods=["POST"]),
            Route("/api/run/{id}/resume", self.resume, methods=["POST"]),
            *super().routes(),
        ]

    def note_of(self, entry: Entry) -> str:
        """Last words of a process of this server that failed."""
        return self._processes.note_of(entry.path)

    async def form(self, request: Request) -> Response:
        """Fields of a case, with settings that choose other kinds of its tables."""
        asked = await self._asked(request)
        found = await run_in_threadpool(form.form_of, asked.source, asked.settings)
        return JSONResponse(found | {"folder": self._processes.free_name(asked.source.name)})

    async def check(self, request: Request) -> Response:
        """Problems, or the forecast."""
        asked = await self._asked(request)
        return JSONResponse(await run_in_threadpool(form.checked, asked.source, asked.settings))

    async def start(self, request: Request) -> Response:
        """Start a run whose case is right."""
        asked = await self._asked(request)
        # A run that the case refuses would end at once.
        found = await run_in_threadpool(form.checked, asked.source, asked.settings)
        if found["problems"]:
            first = found["problems"][0]
            raise ValueError(": ".join(filter(None, (first["key"], first["text"]))))
        start = self._processes.start
        folder = await run_in_threadpool(start, asked.name, asked.source, asked.settings)
        return JSONResponse({"id": self.folders.run_of(folder)})

    async def _asked(self, request: Request) -> Asked:
        return await run_in_threadpool(asked_for, await request.json(), self.folders)

    def stop(self, request: Request) -> Response:
        """Stop a run with a checkpoint."""
        self._processes.stop(self._entry(request).path)
        return Response(status_code=204)

    def resume(self, request: Request) -> Response:
        """Go on with a run."""
        self._processes.resume(self._entry(request).path)
        return Response(status_code=204)


@dataclass(frozen=True)
class Asked:
    """A case with settings, and the name of the run that is to be started, empty for none."""

    source: CaseSource
    settings: list[str]
    name: str


def asked_for(content: Any, folders: FolderList) -> Asked:
    """Case and settings of a request; those that it leaves out are of the run it begins with.

    Raises ValueError, and what `source_of` raises.
    """
    # The content comes from outside: a table, texts, a list of bounded length.
    if not isinstance(content, dict):
        raise ValueError("a case, settings and a name are wanted")
    source, name = source_of(content, folders), content.get("name", "")
    settings = content.get("settings", list(source.settings))
    is_right = isinstance(settings, list) and len(settings) <= form.MOST_SETTINGS
    if not (is_right and all(isinstance(one, str) for one in [name, *settings])):
        raise ValueError("the name is a text, settings a list of KEY=VALUE")
    return Asked(source, settings, name)
