"""The viewer of `web/viewer.js` outside a server: as the text of one module, and in a notebook."""

from __future__ import annotations

from importlib.resources import files
from pathlib import Path
from typing import Any

from lasersph.output.errors import OutputError, install_hint
from lasersph.output.frame_blocks import particle_block, particle_index

FILES = (
    "shaders.js",
    "surface_body.js",
    "scene.js",
    "sources.js",
    "moments.js",
    "viewer_fields.js",
    "viewer_look.js",
    "viewer.js",
)


def viewer_module() -> str:
    """Text of the viewer as one ES module that imports nothing."""
    folder = files("lasersph").joinpath("web")
    # One text without imports: the files follow each other in the order of their needs.
    lines = [
        line for name in FILES for line in folder.joinpath(name).read_text("utf-8").split("\n")
    ]
    return "\n".join(line for line in lines if not line.startswith("import "))


def make_widget(folder: Path) -> Any:
    """The particles of a run as an `anywidget.AnyWidget`, whose frames the kernel sends.

    It answers messages {id, ask: "index"} with {id, index}, and {id, ask: "block", name} with {id}
    and one buffer; what cannot be answered with {id, error}.

    Raises:
        OutputError: anywidget is not installed.
    """
    try:
        import anywidget  # pyright: ignore[reportMissingImports]
    except ImportError as error:
        raise OutputError(install_hint("anywidget", "notebook")) from error

    widget = anywidget.AnyWidget(_esm=viewer_module())
    widget.on_msg(lambda _, asked, __: widget.send(*answer(folder, asked)))
    return widget


def answer(folder: Path, asked: dict[str, Any]) -> tuple[dict[str, Any], list[bytes]]:
    """The message and the buffers that answer a viewer's message."""
    head = {"id": asked.get("id")}
    # Errors go back as text: a viewer cannot read a traceback.
    try:
        if asked.get("ask") == "index":
            return {**head, "index": particle_index(folder)}, []
        return head, [particle_block(folder, str(asked.get("name")))]
    except (OutputError, ValueError, KeyError) as error:
        return {**head, "error": str(error)}, []
