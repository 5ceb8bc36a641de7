"""Made-up run folders: written once in a process for the same arguments, and copied after that."""

import atexit
import os
import shutil
import tempfile
from collections.abc import Callable
from functools import cache, wraps
from pathlib import Path

from process_watch import MARK


@cache
def store() -> Path:
    """Folder of those that were written; it ends with the tests, or with this process."""
    folder = Path(tempfile.mkdtemp(prefix="kept-runs-", dir=os.environ.get(MARK)))
    atexit.register(shutil.rmtree, folder, ignore_errors=True)
    return folder


def written_once(write: Callable[..., Path]) -> Callable[..., Path]:
    """The function that writes a run folder; it copies what the same call has written before.

    A call with a function among its arguments, which may look while it writes, always writes.
    """
    kept: dict[str, Path] = {}

    @wraps(write)
    def written_or_copied(folder: Path, *arguments, **settings) -> Path:
        if any(map(callable, (*arguments, *settings.values()))):
            return write(folder, *arguments, **settings)
        call = repr((arguments, sorted(settings.items())))
        if call not in kept:
            kept[call] = write(store() / f"{write.__module__}-{write.__name__}-{len(kept)}",
                               *arguments, **settings)  # fmt: skip
        # files as new as if they had been written now
        shutil.copytree(kept[call], folder, copy_function=shutil.copy, dirs_exist_ok=True)
        return folder

    return written_or_copied
