"""The files that a power loss can leave, from the record of what happened to them.

What was synced is there. Of everything since, each sector of 512 bytes is there or not, independently of all others.
A write whose sync failed may never arrive, even if a later sync succeeds: Linux forgets such writes.
"""

import itertools
import random
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, field
from enum import Enum
from pathlib import Path

from tests.server.disk.disk import Call, File, Record

SECTOR = 512  # bytes
SHARES = (0.02, 0.5, 0.98)  # of what was not synced: how much of it is kept

Chance = Callable[[], bool]  # whether one sector, truncation or name is kept


class _State(Enum):
    PENDING = 1
    SYNCED = 2
    FORGOTTEN = 3


@dataclass
class _Change:
    offset: int  # of a write; of a truncation, the new size
    content: bytes | None  # None for a truncation
    state: _State = _State.PENDING

    def apply(self, to: bytearray, chance: Chance) -> None:
        is_synced = self.state is _State.SYNCED
        if self.content is None:
            if is_synced or chance():
                to.extend(bytes(max(0, self.offset - len(to))))
                del to[self.offset :]
            return
        whole = (self.offset, self.offset + len(self.content))
        for start, end in [whole] if is_synced else _sectors(*whole):
            if is_synced or chance():
                to.extend(bytes(max(0, start - len(to))))
                to[start:end] = self.content[start - self.offset : end - self.offset]


@dataclass
class _Content:
    """What a file has had since it was synced, and what came after."""

    synced: bytearray
    changes: list[_Change] = field(default_factory=list)

    def sync(self, state: _State) -> None:
        for change in self.changes:
            if change.state is _State.PENDING:
                change.state = state
        while self.changes and self.changes[0].state is _State.SYNCED:
            self.changes.pop(0).apply(self.synced, lambda: True)

    def image(self, chance: Chance) -> bytes:
        found = bytearray(self.synced)
        for change in self.changes:
            change.apply(found, chance)
        return bytes(found)


class Platter:
    """The files of a store as far as they are on the disk.

    Args:
        store: the path of the store, with its files as they were when the recording began.
    """

    def __init__(self, store: Path) -> None:
        self._names: dict[File, _Content] = {}
        self._renamed: list[tuple[File, _Content | None]] = []  # names that came or went since the folder was synced
        self._inodes: dict[int, _Content] = {}
        for file, path in paths(store).items():
            if path.exists():
                self._names[file] = _Content(bytearray(path.read_bytes()))

    def apply(self, record: Record) -> None:
        """Let a call happen."""
        if record.call is Call.CREATE:
            self._inodes[record.inode] = _Content(bytearray())
            self._renamed.append((record.file, self._inodes[record.inode]))
        elif record.call is Call.UNLINK:
            self._renamed.append((record.file, None))
        elif record.call is Call.WRITE:
            self._content(record).changes.append(_Change(record.offset, record.content))
        elif record.call is Call.TRUNCATE:
            self._content(record).changes.append(_Change(record.offset, None))
        elif record.file is not File.FOLDER:
            self._content(record).sync(_State.FORGOTTEN if record.failed else _State.SYNCED)
        elif not record.failed:
            self._names = self._named(lambda: True)
            self._renamed.clear()

    def image(self, chance: Chance) -> dict[File, bytes]:
        """Return the files that are left if the power fails now."""
        return {file: content.image(chance) for file, content in self._named(chance).items()}

    def _content(self, record: Record) -> _Content:
        """Return the file of a record; a file that was not created since the beginning is the one of its name then."""
        if record.inode not in self._inodes:
            self._inodes[record.inode] = self._names[record.file]
        return self._inodes[record.inode]

    def _named(self, chance: Chance) -> dict[File, _Content]:
        names = dict(self._names)
        for file, content in self._renamed:
            if chance():
                names.pop(file, None)
                if content is not None:
                    names[file] = content
        return names


@dataclass(frozen=True)
class Loss:
    """One loss of power: everything before `position` in the log has happened, and `image` is left."""

    position: int
    image: dict[File, bytes]

    def lay(self, store: Path) -> None:
        """Write the image to a folder that has no store."""
        store.parent.mkdir(parents=True)
        for file, content in self.image.items():
            paths(store)[file].write_bytes(content)


def losses(
    platter: Platter, records: Iterable[Record], told: Iterable[int], seed: int, step: int = 1
) -> Iterator[Loss]:
    """Yield every `step`th of the power losses just before each sync and just after clients were told something.

    Each leaves nothing that was not synced. Before a sync there is another one that leaves a part of it.

    Args:
        platter: the disk as it was before the first record.
        told: the positions in the log at which clients were told something.
        seed: decides about the parts.
    """
    number = itertools.count()

    def loss(position: int, share: float = 0.0) -> Iterator[Loss]:
        if (n := next(number)) % step == 0:
            choose = random.Random(f"{seed} {n}")
            yield Loss(position, platter.image(lambda: choose.random() < share))

    shares, moments, end = random.Random(seed), sorted(set(told), reverse=True), 0
    for record in records:
        while moments and moments[-1] <= record.start:
            yield from loss(moments.pop())
        if record.call is Call.SYNC:
            yield from loss(record.start)
            yield from loss(record.start, shares.choice(SHARES))
        platter.apply(record)
        end = record.end
    yield from loss(end)


def paths(store: Path) -> dict[File, Path]:
    """Return the paths of the files of a store."""
    ends = {File.STORE: "", File.WAL: "-wal", File.JOURNAL: "-journal"}
    return {file: store.with_name(store.name + end) for file, end in ends.items()}


def _sectors(start: int, end: int) -> Iterator[tuple[int, int]]:
    """Yield the parts of a range of bytes that lie in one sector each."""
    while start < end:
        border = min(end, (start // SECTOR + 1) * SECTOR)
        yield start, border
        start = border
