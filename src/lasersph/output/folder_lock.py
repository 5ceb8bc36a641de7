"""The lock of a run folder: one process at a time computes in it, and a dead one never keeps it.

`.lock` is there while a process writes. Two things tell whether its owner lives:

- The owner holds a lock of the operating system on the file (flock), which ends with the process
  however it dies. On one machine this is all that is needed.
- On network folders such a lock may reach no further than the machine that took it, or outlive
  a machine that vanished. The owner therefore touches the file every few seconds. A process on
  another machine that sees no touch for a minute of its own clock takes the folder over with a
  new file in place of the old one; clocks of two machines are never compared.

An owner that only slept looks before each step whether the file is still its own and stops where
it is not. A sleep of a minute between that look and the end of the step could still let both
write; only a lock that all machines honor excludes this.
"""

from __future__ import annotations

import json
import os
import socket
import threading
import time
import uuid
from datetime import UTC, datetime
from functools import cache
from pathlib import Path

from lasersph.output.errors import FolderLocked, FolderRefused, OutputError, clear_errors

NAME = ".lock"
BEAT = 5.0
"""From one touch to the next [s]."""
SILENCE = 60.0
"""Without a touch for so long [s], an owner on another machine counts as dead: several times what
a loaded machine or file server delays a touch."""
POLL = 0.5
"""From one look at another's lock to the next [s]; also what a process that took a folder over
leaves to another that does so at the same moment before it looks which of them has it."""


class FolderLock:
    """Keeps other processes from writing into a folder until `release` or the process ends."""

    def __init__(self, folder: Path, *, wait: float = 0.0) -> None:
        """Take the lock.

        Args:
            wait: how long another process may take to leave the folder [s].

        Raises:
            FolderLocked: another process is writing; says which and where.
            FolderRefused: the folder cannot be written.
        """
        self.path = folder / NAME
        with clear_errors("write", folder, FolderRefused):
            self._descriptor = self._acquire(time.monotonic() + wait)
            for left in folder.glob(f"{NAME}.*"):  # of a process killed while it took the lock
                left.unlink(missing_ok=True)
        self._is_lost = False
        self._released = threading.Event()
        threading.Thread(target=self._touch, name="folder lock", daemon=True).start()

    @property
    def is_ours(self) -> bool:
        """Whether no other process took the folder over."""
        return not self._is_lost and is_file_at(self._descriptor, self.path)

    def confirm(self) -> None:
        """Make sure that the folder is still ours. Raises OutputError where it was taken over."""
        if not self.is_ours:
            raise OutputError(
                f"{self.path.parent} was taken over by {owner_text(self.path)}, since this process "
                f"gave no sign of life for {SILENCE:g} s"
            )

    def release(self) -> None:
        """Let other processes use the folder."""
        self._released.set()
        if is_file_at(self._descriptor, self.path):
            self.path.unlink(missing_ok=True)
        os.close(self._descriptor)

    def _touch(self) -> None:
        """Show every few seconds that the process lives, as long as the folder is ours."""
        while not self._released.wait(BEAT):
            try:
                # Ask which file lies there now: another process may have put its own in place.
                with open(self.path, "rb") as stream:  # opening asks a file server anew
                    self._is_lost = not os.path.samestat(
                        os.fstat(stream.fileno()), os.fstat(self._descriptor)
                    )
                if not self._is_lost:
                    os.utime(self.path)
            except OSError:  # released, or a file server that does not answer now
                continue

    def _acquire(self, until: float) -> int:
        """Descriptor of the locked file.

        Raises:
            FolderLocked: at the time `until` a living process still has it.
        """
        # `first_sign` and `last_sign` are marks of the other owner's file: its number and time of
        # change.
        first_sign = last_sign = None
        seen_at = 0.0
        while True:
            # 1. Nobody has the folder: place a file of our own.
            try:
                descriptor = os.open(self.path, os.O_RDWR)
            except FileNotFoundError:
                placed = self._place(None)
                if placed is not None:
                    return placed
                continue
            # 2. Somebody has: a lock of the system that can be taken on the same machine frees the
            # folder.
            try:
                is_free = lock_file(descriptor)
                if not is_file_at(descriptor, self.path):  # its owner has just left
                    continue
                state = os.fstat(descriptor)
                is_near = read_owner(self.path).get("machine") == machine()
                if is_near and is_free and (placed := self._place(state.st_ino)) is not None:
                    return placed  # the owner is dead: our machine has freed its lock
            finally:
                os.close(descriptor)
            # 3. Watch for touches, by our own clock only.
            now, sign = time.monotonic(), (state.st_ino, state.st_mtime_ns)
            first_sign = first_sign or sign
            if sign != last_sign:
                last_sign, seen_at = sign, now
            is_alive = sign != first_sign or (is_near and is_free is False)
            # 4. An owner that gives signs of life keeps the folder until the caller's patience
            # ends.
            if is_alive and now >= until:
                raise FolderLocked(
                    f"another process is writing to {self.path.parent}: {owner_text(self.path)}"
                )
            # 5. An owner without a sign for `SILENCE` is dead. Of two that replace its file at the
            # same moment the later one has it, so each looks once more after a pause.
            if not (is_near and is_free is False) and now - seen_at >= SILENCE:
                placed = self._place(state.st_ino)
                time.sleep(POLL)
                if placed is not None and is_file_at(placed, self.path):
                    return placed
            time.sleep(POLL)

    def _place(self, inode: int | None) -> int | None:
        """Put a locked file of our own at the path.

        Args:
            inode: of the dead owner's file, which it replaces; None where there is none.

        Returns:
            Its descriptor; None where another process was faster.
        """
        own = self.path.with_name(f"{NAME}.{uuid.uuid4().hex}")
        descriptor = os.open(own, os.O_RDWR | os.O_CREAT | os.O_EXCL, 0o666)
        clock = datetime.now(UTC).isoformat(sep=" ", timespec="seconds")
        owner = {"process": os.getpid(), "host": socket.gethostname(), "since": clock}
        # The file is locked and filled under a name of its own, then appears at the path in one
        # step.
        try:
            lock_file(descriptor)
            os.write(descriptor, json.dumps(owner | {"machine": machine()}).encode())
            if inode is None:
                link_or_rename(own, self.path)
            elif os.stat(self.path).st_ino == inode:
                os.replace(own, self.path)
        except (FileExistsError, FileNotFoundError):
            pass
        except BaseException:
            os.close(descriptor)
            own.unlink(missing_ok=True)
            raise
        own.unlink(missing_ok=True)
        # Another process may have replaced it in the meantime: the file at the path decides.
        if is_file_at(descriptor, self.path):
            return descriptor
        os.close(descriptor)
        return None


def link_or_rename(own: Path, path: Path) -> None:
    """Let a file appear at a path where there is none. Raises FileExistsError."""
    try:
        os.link(own, path)
    except FileExistsError:
        raise
    except OSError:  # a file system without hard links
        if not path.exists():
            os.replace(own, path)


def lock_file(descriptor: int) -> bool | None:
    """Lock an open file: True where it is ours now, False where another process has it.

    None on systems and network folders without locks: the touches alone tell.
    """
    try:
        import fcntl

        fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        return False
    except (ImportError, OSError):
        return None
    return True


def is_file_at(descriptor: int, path: Path) -> bool:
    """Whether an open file is the one that lies at a path."""
    try:
        return os.path.samestat(os.fstat(descriptor), os.stat(path))
    except FileNotFoundError:
        return False


def read_owner(path: Path) -> dict[str, str | int]:
    """Who wrote a lock file: process, host, since, machine; empty where that cannot be read."""
    try:
        return json.loads(path.read_bytes())
    except (OSError, ValueError):
        return {}


def owner_text(path: Path) -> str:
    """Who has a folder, for messages."""
    owner = read_owner(path)
    if not owner:
        return "a process that cannot be named"
    return f"process {owner['process']} on {owner['host']}, since {owner['since']}"


@cache
def machine() -> str:
    """Name of this machine since its last start, the same in all its containers."""
    try:
        return Path("/proc/sys/kernel/random/boot_id").read_text().strip()
    except OSError:
        return socket.gethostname()


def is_computing(folder: Path) -> bool:
    """Whether a process seems to compute in a folder. For display: it compares two clocks."""
    path = folder / NAME
    # The time of the last touch, as the file server's clock gives it.
    try:
        silence = time.time() - path.stat().st_mtime
    except OSError:
        return False
    owner = read_owner(path)
    if owner.get("machine") == machine() and not is_process(owner.get("process")):
        return silence < 1.5 * BEAT  # one in another container may live
    return silence < SILENCE


def is_process(number: object) -> bool:
    """Whether a number is that of a process that lives."""
    if not isinstance(number, int) or number <= 1:
        return False
    # Signal 0 is delivered to nobody; it only asks whether there is such a process.
    try:
        os.kill(number, 0)
    except PermissionError:
        return True
    except (ProcessLookupError, OverflowError):
        return False
    return True


def is_lock(path: Path) -> bool:
    """Whether a path is a lock, or what a process killed while it took one left."""
    return path.name == NAME or path.name.startswith(f"{NAME}.")
