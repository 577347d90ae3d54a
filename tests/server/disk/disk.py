"""A disk that records what a process does to an SQLite store, and that fails when it is told to (`disk.c`)."""

import shutil
import struct
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from dataclasses import dataclass
from enum import IntEnum, IntFlag
from functools import cache
from pathlib import Path

import pytest

SOURCE = Path(__file__).with_name("disk.c")
_RECORD = struct.Struct("=BBBxIQq")
_FAULT = struct.Struct("=6i")


class File(IntEnum):
    """A file of a store, or the folder that names it."""

    STORE = 1
    WAL = 2
    JOURNAL = 3
    FOLDER = 4


class Call(IntFlag):
    """A call that changes what is on the disk."""

    WRITE = 1
    SYNC = 2
    TRUNCATE = 4
    UNLINK = 8
    CREATE = 16


@dataclass(frozen=True)
class Record:
    """One call, as it took effect.

    Args:
        failed: whether the process was told that the call failed. Half of a failed write is in `content`.
        inode: which file it was, because names are used again.
        offset: of a write, in bytes; of a truncation, the new size.
        start: the size of the log before this record, in bytes.
    """

    call: Call
    file: File
    failed: bool
    inode: int
    offset: int
    content: bytes
    start: int

    @property
    def end(self) -> int:
        """The size of the log after this record, in bytes."""
        return self.start + _RECORD.size + len(self.content)


class Disk:
    """The disk of one store. The log and the faults are files beside the store's folder.

    Args:
        store: the path of the SQLite file, in a folder of its own.
    """

    def __init__(self, store: Path) -> None:
        self.store = store.resolve()
        self._log = self.store.parent.with_suffix(".log")
        self._fault = self.store.parent.with_suffix(".fault")
        self._log.touch()
        self._fault.write_bytes(bytes(_FAULT.size))

    @property
    def url(self) -> str:
        """The URL of the store."""
        return f"sqlite:///{self.store}"

    @property
    def environment(self) -> dict[str, str]:
        """The environment of a process that uses this disk."""
        names = {"DISK_STORE": self.store, "DISK_LOG": self._log, "DISK_FAULT": self._fault}
        return {"LD_PRELOAD": str(library()), **{name: str(path) for name, path in names.items()}}

    @property
    def position(self) -> int:
        """The size of the log in bytes: everything before it has happened."""
        return self._log.stat().st_size

    @property
    def failed(self) -> int:
        """How many calls have failed since the last `fail`."""
        return int(_FAULT.unpack(self._fault.read_bytes())[5])

    def fail(self, number: int, calls: Call, file: File | None = None, *, skip: int = 0, times: int = -1) -> None:
        """Let calls on one file or on any fail: `skip` of them still succeed, then `times` fail (-1: all).

        Args:
            number: the errno of a call that fails.
        """
        self._change(0)
        self._change(0, calls, file or 0, skip, times, 0)
        self._change(number)

    def heal(self) -> None:
        """Let no call fail any more. The count of failed calls stays."""
        self._change(0)

    def _change(self, *values: int) -> None:
        """Overwrite the first numbers of the struct, in place: the process has it in its memory."""
        with self._fault.open("r+b") as file:
            file.write(struct.pack(f"={len(values)}i", *values))

    def records(self) -> Iterator[Record]:
        """Yield what happened, in order."""
        with self._log.open("rb") as log:
            while header := log.read(_RECORD.size):
                call, file, failed, length, inode, offset = _RECORD.unpack(header)
                start, content = log.tell() - _RECORD.size, log.read(length)
                yield Record(Call(call), File(file), bool(failed), inode, offset, content, start)


@cache
def library() -> Path:
    """Return the compiled `disk.c`; skip the test where nothing compiles it for this system."""
    compiler = shutil.which("cc") or shutil.which("gcc")
    if compiler is None or sys.platform != "linux":
        pytest.skip("a played disk needs Linux and a C compiler (cc, gcc)")
    built = Path(tempfile.mkdtemp(prefix="waypost-disk")) / "disk.so"
    flags = ["-shared", "-fPIC", "-O1", "-Wall", "-Wextra", "-Werror"]
    done = subprocess.run(
        [compiler, *flags, "-o", built, SOURCE, "-ldl", "-pthread"], capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr
    return built
