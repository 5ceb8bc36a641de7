"""Changes to a binary file that happen wholly or not at all, however the process ends.

HDF5 rewrites pieces of a file in place when it closes it; a process killed there leaves a file
that no program opens. Here HDF5 writes into memory (a copy of each 16 KiB page that it touches)
and `commit` brings the pages to the disk so that no moment is harmful:

1. what lies beyond the old end is written first: the old content does not refer to it;
2. changed pages of the old content go to a journal file, which appears whole or not at all;
3. the folder's generation is raised, so that readers of the old content read again;
4. the pages are written into the file, and the journal is removed.

A kill before 2 leaves the old content, a kill after it a journal from which the next opening
finishes the work. A full disk is met in 1 to 3, since 4 needs no new room,
and leaves the old content. This is the write-ahead log of databases (Gray and Reuter, Transaction
Processing, 1993), for one file.
"""

from __future__ import annotations

import hashlib
import io
import json
import os
from pathlib import Path
from typing import Any, BinaryIO

from lasersph.output.atomic import replace_file
from lasersph.output.errors import OutputError, clear_errors
from lasersph.output.generation import raise_generation

PAGE = 16384
JOURNAL_SUFFIX = ".journal"


class Transaction(io.RawIOBase):
    """A file object over `path` whose writes stay in memory until `commit`.

    Without a commit the file is untouched: open one, inside `generation.read_unchanged`, to read
    a file that another process may be writing.
    """

    def __init__(self, path: Path) -> None:
        """Open `path`, which need not exist; an unfinished commit of an earlier run shows
        finished. Raises OutputError."""
        super().__init__()
        self.path = path
        self.pages: dict[int, bytearray] = {}
        self.position = 0
        self.file: BinaryIO | None = None
        # the journal first: a file opened after it holds all that lies beyond the old end
        unfinished = read_journal(path)
        with clear_errors("read", path):
            if path.exists():
                self.file = open(path, "rb")  # noqa: SIM115  (closed in close())
        self.stored = os.fstat(self.file.fileno()).st_size if self.file else 0
        self.size = self.stored
        if unfinished is not None:
            self.pages, self.size = unfinished

    def readable(self) -> bool:
        return True

    def writable(self) -> bool:
        return True

    def seekable(self) -> bool:
        return True

    def tell(self) -> int:
        return self.position

    def seek(self, offset: int, whence: int = io.SEEK_SET) -> int:
        start = (0, self.position, self.size)[whence]
        self.position = start + offset
        return self.position

    def readinto(self, buffer: Any) -> int:
        target = memoryview(buffer).cast("B")
        count = max(0, min(len(target), self.size - self.position))
        # Page by page: from memory where it was written, else from the disk.
        done = 0
        while done < count:
            number, offset = divmod(self.position, PAGE)
            length = min(PAGE - offset, count - done)
            page = self.pages.get(number)
            if page is None:
                piece = self._stored_bytes(self.position, length)
            else:
                piece = page[offset : offset + length]
            target[done : done + length] = piece
            self.position += length
            done += length
        return done

    def write(self, data: Any) -> int:
        source = memoryview(data).cast("B")
        done = 0
        while done < len(source):
            number, offset = divmod(self.position, PAGE)
            length = min(PAGE - offset, len(source) - done)
            # A page is copied at its first write.
            page = self.pages.get(number)
            if page is None:
                page = self.pages[number] = bytearray(self._stored_bytes(number * PAGE, PAGE))
            page[offset : offset + length] = source[done : done + length]
            self.position += length
            done += length
        self.size = max(self.size, self.position)
        return done

    def truncate(self, size: int | None = None) -> int:
        self.size = self.position if size is None else size
        return self.size

    def commit(self) -> None:
        """Bring all writes to the disk. Raises OutputError; the old content is then intact."""
        # A new file needs no journal: it appears whole.
        if self.stored == 0:
            replace_file(self.path, self._write_whole)
            self.close()
            return

        # What lies beyond the old end, and the old pages that really changed.
        beyond = [piece for n in sorted(self.pages) if (piece := self._part_beyond_end(n))]
        changed = {
            number: page
            for number, page in self.pages.items()
            if number * PAGE < self.stored
            and bytes(page) != self._stored_bytes(number * PAGE, PAGE)
        }
        with clear_errors("write", self.path):
            descriptor = os.open(self.path, os.O_RDWR)
            try:
                # Steps 1 to 3 of the header: what fails here leaves the old content.
                try:
                    for offset, data in beyond:
                        write_at(descriptor, offset, data)
                    os.fsync(descriptor)
                    write_journal(self.path, changed, self.size)
                    raise_generation(self.path.parent)
                except BaseException:
                    journal_of(self.path).unlink(missing_ok=True)
                    os.ftruncate(descriptor, self.stored)
                    raise
                # Step 4: from here on the journal finishes the work, whoever does it.
                apply_journal(self.path, descriptor, changed, self.size)
            finally:
                os.close(descriptor)
        self.close()

    def close(self) -> None:
        self.pages = {}
        if self.file is not None:
            self.file.close()
            self.file = None
        super().close()

    def _write_whole(self, stream: BinaryIO) -> None:
        """Write a new file from its pages."""
        for number in range(-(-self.size // PAGE)):
            page = self.pages.get(number, bytes(PAGE))
            stream.write(page[: min(PAGE, self.size - number * PAGE)])

    def _part_beyond_end(self, number: int) -> tuple[int, memoryview] | None:
        """The part of a page that lies beyond the old end of the file, with its offset."""
        start = max(self.stored - number * PAGE, 0)
        if start >= PAGE:
            return None
        return number * PAGE + start, memoryview(self.pages[number])[start:]

    def _stored_bytes(self, start: int, length: int) -> bytes:
        """Bytes of the file on the disk, zeros beyond its end."""
        if self.file is None or start >= self.stored:
            return bytes(length)
        self.file.seek(start)
        return self.file.read(length).ljust(length, b"\0")


def journal_of(path: Path) -> Path:
    """Name of the journal beside a file."""
    return path.with_name(path.name + JOURNAL_SUFFIX)


def write_at(descriptor: int, offset: int, data: Any) -> None:
    """Write all bytes of `data` at a place in an open file."""
    view = memoryview(data)
    # The system may take fewer bytes than it was given.
    while view:
        count = os.pwrite(descriptor, view, offset)
        view, offset = view[count:], offset + count


def write_journal(path: Path, pages: dict[int, bytearray], size: int) -> None:
    """Write the journal: a line of JSON (page numbers, file size, checksum), then the pages."""
    numbers = sorted(pages)
    body = b"".join(bytes(pages[number]) for number in numbers)
    head = {"pages": numbers, "size": size, "sha256": hashlib.sha256(body).hexdigest()}
    data = json.dumps(head).encode() + b"\n" + body
    replace_file(journal_of(path), lambda stream: stream.write(data))


def read_journal(path: Path) -> tuple[dict[int, bytearray], int] | None:
    """Pages and file size of an unfinished commit; None where there is none.

    Raises:
        OutputError: the journal is damaged.
    """
    journal = journal_of(path)
    with clear_errors("read", journal):
        # No journal, no unfinished commit.
        try:
            line, _, body = journal.read_bytes().partition(b"\n")
        except FileNotFoundError:
            return None
    try:
        # The checksum tells a whole journal from one of a failing disk.
        head = json.loads(line)
        if hashlib.sha256(body).hexdigest() != head["sha256"]:
            raise ValueError("checksum")
    except (ValueError, KeyError, TypeError) as error:
        raise OutputError(f"cannot read {journal}: it is damaged") from error
    pages = {
        number: bytearray(body[k * PAGE : (k + 1) * PAGE]) for k, number in enumerate(head["pages"])
    }
    return pages, head["size"]


def apply_journal(path: Path, descriptor: int, pages: dict[int, bytearray], size: int) -> None:
    """Write the journal's pages into the open file, set its size, remove the journal."""
    # Pages in their order, then the size, then the disk; the journal goes last.
    for number in sorted(pages):
        write_at(descriptor, number * PAGE, pages[number])
    os.ftruncate(descriptor, size)
    os.fsync(descriptor)
    journal_of(path).unlink(missing_ok=True)


def finish_commit(path: Path) -> None:
    """Finish the commit that a killed process left, if there is one. Raises OutputError."""
    unfinished = read_journal(path)
    if unfinished is None:
        return
    raise_generation(path.parent)
    with clear_errors("write", path):
        descriptor = os.open(path, os.O_RDWR)
        try:
            apply_journal(path, descriptor, *unfinished)
        finally:
            os.close(descriptor)


def discard(path: Path) -> None:
    """Remove a file and its journal, if they are there. Raises OutputError."""
    raise_generation(path.parent)
    with clear_errors("write", path):
        path.unlink(missing_ok=True)
        journal_of(path).unlink(missing_ok=True)


def rename_damaged(path: Path) -> Path:
    """Rename a damaged file and its journal to `<name>.damaged`; return the new name."""
    aside = path.with_name(path.name + ".damaged")
    # The journal keeps its file: finishing it later would need both.
    raise_generation(path.parent)
    with clear_errors("write", path):
        os.replace(path, aside)
        if journal_of(path).exists():
            os.replace(journal_of(path), journal_of(aside))
    return aside
