"""A recording of a server that is killed once and then stopped, and the power losses in it."""

import shutil
import signal
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory

from tests.server.disk.images import Loss, Platter, losses
from tests.server.disk.load import Told, answer_all, proof, team
from tests.server.disk.recording import Disk, Record
from tests.server.processes import serving

N_ANNOTATORS = 3


@dataclass(frozen=True)
class Recording:
    """What happened to a store, from a closed store to a closed store.

    Args:
        before: the path of the store as it was at the beginning.
    """

    before: Path
    records: Sequence[Record]
    told: Told

    def losses(self, seed: int) -> Iterator[Loss]:
        """Yield the power losses at each sync."""
        return losses(Platter(self.before), self.records, seed)

    def wrong(self, some: Iterable[Loss]) -> Counter[str]:
        """Open the store that each power loss leaves, and count what is wrong with all of them."""
        wrong: Counter[str] = Counter()
        for loss in some:
            with TemporaryDirectory() as folder:
                store = Path(folder) / "store" / "store.db"
                loss.lay(store)
                wrong += proof(f"sqlite:///{store}", self.told, loss.position)
        return wrong


def record(folder: Path, seed: int, n_answers: int) -> Recording:
    """Record a server while annotators answer. It is killed after half of the answers, and stopped at the end."""
    store, before, told = folder / "store" / "store.db", folder / "before", Told()
    store.parent.mkdir()
    disk = Disk(store)
    people = team(disk.url, n_answers, N_ANNOTATORS)
    shutil.copytree(store.parent, before)
    for end in (signal.SIGKILL, signal.SIGTERM):
        with serving(disk.url, folder, {}, variables=disk.environment) as server:
            most = n_answers // 2 // N_ANNOTATORS
            answer_all(server.address, people, told, lambda: disk.position, seed + end, most)
            server.process.send_signal(end)
            server.process.wait(30)
    return Recording(before / store.name, list(disk.records()), told)
