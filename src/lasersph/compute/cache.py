"""Folder of generated loops: one text file per loop, named by the hash of its whole text.

The text holds every function, constant and option that the loop's result depends on; what
translates it (`SHARED`) enters the hash, so a file never goes stale: an edit gives another name.
The machine code of a loop lies beside it, and the assembly of kernels of a graphics card. The
folder is $LASERSPH_CACHE, else $XDG_CACHE_HOME/lasersph, else ~/.cache/lasersph, else, where that
is not writable, a folder of this user below the system's temporary folder.
"""

from __future__ import annotations

import ctypes
import hashlib
import importlib.util
import os
import sys
import tempfile
import warnings
from collections.abc import Callable
from functools import cache
from pathlib import Path
from types import ModuleType
from typing import NamedTuple

from lasersph.compute import machine_code, numba_internals, trial
from lasersph.compute.compile_lock import compiling_alone
from lasersph.compute.compiling import reported

_PREFIX = "loop_"
SHARED = (
    "machine_code.py",
    "native_calls.py",
    "native_code.py",
    "native_expressions.py",
    "native_functions.py",
    "native_signatures.py",
    "native_text.py",
    "native_values.py",
    "operators.py",
)
_loaded: dict[str, ModuleType] = {}
_entries: dict[str, Entry] = {}
_first_miss: list[Callable[[], None]] = []


class Entry(NamedTuple):
    """A compiled function of unsigned integers: its address, and whether it was found on disk."""

    address: int
    is_found: bool


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
    # the folder that the user or the desktop names
    home = os.environ.get("XDG_CACHE_HOME") or Path("~/.cache").expanduser()
    chosen = Path(os.environ.get("LASERSPH_CACHE") or Path(home, "lasersph"))
    if _writable(chosen):
        return chosen

    # where that cannot be written: a folder of this user alone, since what lies there is run
    user = os.getuid() if hasattr(os, "getuid") else os.environ.get("USERNAME", "user")
    fallback = Path(tempfile.gettempdir(), f"lasersph-{user}")
    fallback.mkdir(mode=0o700, exist_ok=True)
    if hasattr(os, "getuid") and fallback.stat().st_uid != os.getuid():
        raise OSError(f"cache folder {fallback} belongs to another user; set LASERSPH_CACHE")
    if not _writable(fallback):
        raise OSError(f"no writable cache folder: tried {chosen} and {fallback}")
    return fallback


def load(text: str) -> ModuleType:
    """Module with this text of a graphics card's kernels, from the folder or written to it.

    Where the disk is full, the module is made from memory.
    """
    # the hash of the text is the file's name, so that an edited text is another file
    folder = location()
    path = folder / f"{_PREFIX}{_digest(text)}.py"
    name = f"lasersph_{folder_key(folder)}_{path.stem}"
    if name in _loaded:
        return _loaded[name]
    try:
        _put_text(path, text)
        # import it as a module
        spec = importlib.util.spec_from_file_location(name, path)
        assert spec is not None and spec.loader is not None
        module = sys.modules[name] = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(module)
    except OSError as error:
        # full disk: the same text from memory, with nothing stored
        _warn(error)
        module = _executed(name, path, text)
    _loaded[name] = module
    return module


def kept(key: str, make: Callable[[], str]) -> str:
    """Assembly that `make` writes, from the folder where it lies there under a key."""
    folder = location()
    path = folder / f"{_PREFIX}{_digest(key)}.ptx"
    if path.is_file():
        return path.read_text(encoding="utf-8")
    # another process may have written it while this one waited for the lock
    with reported(), compiling_alone(folder, _digest(key)):
        if path.is_file():
            return path.read_text(encoding="utf-8")
        text = make()
        try:
            _write(path, text.encode())
        except OSError as error:
            _warn(error)
        return text


def entry(text: str, *, is_fast: bool = True) -> int:
    """Address of the function `loop` of a text, compiled where the folder has no machine code.

    Args:
        is_fast: whether its sums may be rearranged.
    """
    folder = location()
    numba_internals.check_entry(lambda: trial.passes(folder))
    name = f"{_PREFIX}{_digest(text)}"
    key = f"{folder}/{name}"
    if key not in _entries:
        # look on disk first, then compile
        found = _read_entry(folder, name)
        _entries[key] = found or _missing_entry(folder, name, text, is_fast)
    return _entries[key].address


def function(text: str, arguments: int, *, is_fast: bool = False) -> Callable[..., None]:
    """Foreign function `loop` of a text, of so many unsigned integers; see `entry`."""
    return ctypes.PYFUNCTYPE(None, *[ctypes.c_uint64] * arguments)(entry(text, is_fast=is_fast))


def at_first_miss(begin: Callable[[], None]) -> Callable[[], None]:
    """Call `begin` once, when a loop is not found in the folder; returns what forgets it."""
    _first_miss[:] = [begin]
    return _first_miss.clear


def compile_ahead(text: str) -> None:
    """Put the function of a text into the folder, unless it lies there or is being compiled."""
    folder = location()
    name = f"{_PREFIX}{_digest(text)}"
    with compiling_alone(folder, _digest(text), waits=False) as is_ours:
        if is_ours and not _code_file(folder, name).is_file():
            _put_code(folder, name, text, is_fast=True)


def _missing_entry(folder: Path, name: str, text: str, is_fast: bool) -> Entry:
    """The function of a text that the folder lacks: compiled here, or by who compiles it now."""
    # the first miss of a run starts the processes that compile ahead
    while _first_miss:
        _first_miss.pop()()
    # another process may have compiled it while this one waited for the lock
    with reported(), compiling_alone(folder, name.removeprefix(_PREFIX)):
        found = _read_entry(folder, name)
        return found or _make_entry(folder, name, text, is_fast)


def _code_file(folder: Path, name: str) -> Path:
    """Where the machine code of a function for this processor lies."""
    return folder / f"{name}-{machine_code.target()}.o"


def _read_entry(folder: Path, name: str) -> Entry | None:
    """The function whose machine code lies in the folder; None where there is none."""
    try:
        content = _code_file(folder, name).read_bytes()
    except OSError:
        return None
    address = machine_code.address_of(content, name)
    return None if address is None else Entry(address, True)


def _make_entry(folder: Path, name: str, text: str, is_fast: bool) -> Entry:
    """The function of a text, with its text and machine code written to the folder."""
    address = machine_code.address_of(_put_code(folder, name, text, is_fast), name)
    assert address is not None
    return Entry(address, False)


def _put_code(folder: Path, name: str, text: str, is_fast: bool) -> bytes:
    """Write the text and machine code of a function to the folder, as far as that takes them."""
    content = machine_code.compile_text(text, name, is_fast=is_fast)
    try:
        _put_text(folder / f"{name}.py", text)
        _write(_code_file(folder, name), content)
    except OSError as error:
        _warn(error)
    return content


def _executed(name: str, path: Path, text: str) -> ModuleType:
    """Module of a text, which need not lie at the path."""
    module = sys.modules[name] = ModuleType(name)
    exec(compile(text, str(path), "exec"), module.__dict__)
    return module


def _digest(text: str) -> str:
    """Name of a text."""
    return hashlib.sha256(_shared() + text.encode()).hexdigest()[:24]


@cache
def _shared() -> bytes:
    """Text of what translates loops."""
    return b"".join(Path(__file__).with_name(name).read_bytes() for name in SHARED)


def _put_text(path: Path, text: str) -> None:
    """Write a text unless it is there."""
    if not path.is_file() or path.read_text(encoding="utf-8") != text:
        _write(path, text.encode())


def _write(path: Path, content: bytes) -> None:
    """Write a file at once: another process sees all of it or nothing."""
    # write beside it and rename, which is atomic on one file system
    handle, temporary = tempfile.mkstemp(dir=path.parent, suffix=".tmp")
    try:
        with os.fdopen(handle, "wb") as file:
            file.write(content)
        os.replace(temporary, path)
    except OSError:
        os.unlink(temporary)
        raise


def _warn(error: OSError) -> None:
    warnings.warn(f"compiled loops are not stored: {error}", RuntimeWarning, stacklevel=2)


def statistics() -> tuple[int, int]:
    """(loops found in the folder, loops compiled) by this process so far."""
    found = sum(one.is_found for one in _entries.values())
    return found, len(_entries) - found


def folder_key(folder: Path) -> str:
    """Short name of a cache folder, so that modules of two folders do not mix."""
    return hashlib.sha256(str(folder).encode()).hexdigest()[:8]


def files() -> list[Path]:
    """Generated sources in the folder, newest last."""
    return sorted(location().glob(f"{_PREFIX}*.py"), key=lambda path: path.stat().st_mtime)


def _all_files() -> list[Path]:
    folder = location()
    inner = (folder / "__pycache__").glob(f"{_PREFIX}*")
    ends = (f"{_PREFIX}*.py", f"{_PREFIX}*.o", f"{_PREFIX}*.ptx", f"{trial.PREFIX}*", "*.tmp")
    return [*(path for end in ends for path in folder.glob(end)), *inner]


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
