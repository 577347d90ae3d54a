"""A store on a played disk: a server uses it, and its record shows what power losses would leave."""

import shutil
import signal
from collections import Counter
from collections.abc import Iterable, Iterator
from contextlib import AbstractContextManager
from pathlib import Path
from tempfile import TemporaryDirectory

from tests.server.disk.disk import Call, Disk, File, Record
from tests.server.disk.images import Loss, Platter, losses
from tests.server.disk.load import Team, Told, answer_all, proof, team
from tests.server.processes import Served, serving


class Recording:
    """A store, what servers did to it, and what they told their clients.

    Args:
        folder: empty; it gets the store, a copy of it as it was at the beginning, and the server's log.
    """

    def __init__(self, folder: Path) -> None:
        self.told = Told()
        self._folder = folder
        self._store, self._before = folder / "store" / "store.db", folder / "before" / "store.db"
        self._store.parent.mkdir()
        self.disk = Disk(self._store)

    def fill(self, n_queries: int, n_annotators: int) -> Team:
        """Create the store, which is not recorded, with queries and those who answer them."""
        people = team(self.disk.url, n_queries, n_annotators)
        shutil.copytree(self._store.parent, self._before.parent)
        return people

    def serving(self) -> AbstractContextManager[Served]:
        """Run a server that uses the disk."""
        return serving(self.disk.url, self._folder, {}, variables=self.disk.environment)

    def answer(self, server: Served, people: Team, seed: int, most: int) -> None:
        """Answer with all annotators at once, `most` answers each."""
        answer_all(server.address, people, self.told, lambda: self.disk.position, seed, most)

    def answer_and_end(self, people: Team, seed: int, most: int) -> None:
        """Answer with a server that is killed after half of the answers, then with one that is stopped."""
        for end in (signal.SIGKILL, signal.SIGTERM):
            with self.serving() as server:
                self.answer(server, people, seed + end, most // 2)
                server.process.send_signal(end)
                server.process.wait(30)

    def losses(self, seed: int, step: int = 1, without: tuple[Call, File] | None = None) -> Iterator[Loss]:
        """Yield every `step`th power loss, if wanted as if some calls were not made."""
        made: Iterable[Record] = (one for one in self.disk.records() if (one.call, one.file) != without)
        told = [one.seen for one in self.told.answers if one.seen is not None]
        return losses(Platter(self._before), made, told, seed, step)

    def wrong(self, some: Iterable[Loss]) -> Counter[str]:
        """Open the store that each power loss leaves as a server does, and count what is wrong with all of them."""
        wrong: Counter[str] = Counter()
        for loss in some:
            with TemporaryDirectory() as folder:
                store = Path(folder) / "store" / "store.db"
                loss.lay(store)
                wrong += proof(f"sqlite:///{store}", self.told, loss.position)
        return wrong
