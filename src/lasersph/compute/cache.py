"""Folder of generated loops: one Python file per loop, named by the hash of its whole text.

The text holds every function, constant and option that the loop's result depends on, so a file
never goes stale: an edit gives another name. Numba keeps the machine code beside it in
`__pycache__`. The folder is $LASERSPH_CACHE, else $XDG_CACHE_HOME/lasersph, else ~/.cache/lasersph,
else, where that is not writable, a folder of this user below the system's temporary folder.
"""

from __future__ import annotations

import hashlib
import importlib.util
import os
import sys
import tempfile
from functools import cache
from pathlib import Path
from types import ModuleType

_PREFIX = "loop_"


@cache
def _writable(folder: Path) -> bool:
    """Whether files can be made in the folder, which is created."""
    try:
        folder.mkdir(parents=True, exist_ok=True)
        (folder / "__pycache__").mkdir(exist_ok=True)
        with tempfile.TemporaryFile(dir=folder / "__pycache__"):
            return True
    except OSError:
        return False


def location() -> Path:
    """Folder in use, created where needed.

    Raises:
        OSError: neither the cache folder nor the temporary folder can be written.
    """
    home = os.environ.get("XDG_CACHE_HOME") or Path("~/.cache").expanduser()
    chosen = Path(os.environ.get("LASERSPH_CACHE") or Path(home, "lasersph"))
    if _writable(chosen):
        return chosen
    user = os.getuid() if hasattr(os, "getuid") else os.environ.get("USERNAME", "user")
    fallback = Path(tempfile.gettempdir(), f"lasersph-{user}")
    fallback.mkdir(mode=0o700, exist_ok=True)
    if hasattr(os, "getuid") and fallback.stat().st_uid != os.getuid():
        raise OSError(f"cache folder {fallback} belongs to another user; set LASERSPH_CACHE")
    if not _writable(fallback):
        raise OSError(f"no writable cache folder: tried {chosen} and {fallback}")
    return fallback


def load(text: str) -> ModuleType:
    """Module with this text from the cache folder; the file is written where it is missing."""
    digest = hashlib.sha256(text.encode()).hexdigest()[:24]
    folder = location()
    path = folder / f"{_PREFIX}{digest}.py"
    name = f"lasersph_{folder_key(folder)}_{path.stem}"
    if name in sys.modules:
        return sys.modules[name]
    if not path.is_file() or path.read_text(encoding="utf-8") != text:
        handle, temporary = tempfile.mkstemp(dir=folder, suffix=".tmp")
        with os.fdopen(handle, "w", encoding="utf-8") as file:
            file.write(text)
        os.replace(temporary, path)
    spec = importlib.util.spec_from_file_location(name, path)
    assert spec is not None and spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    sys.modules[name] = module
    spec.loader.exec_module(module)
    return module


def folder_key(folder: Path) -> str:
    """Short name of a cache folder, so that modules of two folders do not mix."""
    return hashlib.sha256(str(folder).encode()).hexdigest()[:8]


def files() -> list[Path]:
    """Generated sources in the folder, newest last."""
    return sorted(location().glob(f"{_PREFIX}*.py"), key=lambda path: path.stat().st_mtime)


def _all_files() -> list[Path]:
    folder = location()
    inner = (folder / "__pycache__").glob(f"{_PREFIX}*")
    return [*folder.glob(f"{_PREFIX}*.py"), *folder.glob("*.tmp"), *inner]


def size() -> int:
    """Bytes in the folder: sources and machine code."""
    return sum(path.stat().st_size for path in _all_files())


def clear() -> int:
    """Remove all generated loops; returns the bytes set free. Loops in use keep working."""
    freed = 0
    for path in _all_files():
        freed += path.stat().st_size
        path.unlink(missing_ok=True)
    return freed
