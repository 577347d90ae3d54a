"""Run the server's app in this process on an SQLite store, or read a store without a server.

Apart from `cli.py` and `demo.py`, this is the only module of the learner that imports the server.
"""

from collections.abc import Callable, Iterable, Iterator
from contextlib import ExitStack, closing, contextmanager
from pathlib import Path

from waypost import wire
from waypost.client import Client
from waypost_learner.remote.connection import Connection
from waypost_learner.remote.in_process import InProcessTransport
from waypost_server.app import create_app
from waypost_server.auth import tokens
from waypost_server.db.engine import BadDatabase, Database
from waypost_server.db.schema import WrongSchema
from waypost_server.errors import NotFound, Refusal
from waypost_server.queries import frames
from waypost_server.runs import curves, listing, service
from waypost_server.settings import Settings
from waypost_server.users import service as users
from waypost_server.watch.records import reading, restoring

_MOST_RUNS = 100_000


@contextmanager
def embedded(store: Path) -> Iterator[Connection]:
    """Connect to the server's app in this process, on an SQLite file that is created if it does not exist.

    Raises:
        ValueError: the file cannot be used as a store; the message is one sentence for the user.
    """
    with ExitStack() as stack:
        with _unusable_store():
            connection = _start(store, stack)
        yield connection


def _start(store: Path, stack: ExitStack) -> Connection:
    app = create_app(Settings(database=f"sqlite:///{store}"))
    transport = stack.enter_context(InProcessTransport(app))
    db = app.state.context.db

    def connect(name: str, role: wire.Role) -> Client:
        user = db.write_now(lambda tx: users.ensure_user(tx, name, role))
        token = db.write_now(lambda tx: tokens.create_token(tx, user.id, "embedded"))
        stack.callback(db.write_now, lambda tx: tokens.revoke_token(tx, token.id))
        client = Client("http://localhost", token.token, transport)
        stack.callback(client.close)
        return client

    return Connection(connect("learner", "learner"), connect("oracle", "annotator"))


class StoredRuns:
    """The runs of a store and their curves, read without a server or a user."""

    def __init__(self, db: Database) -> None:
        self._db = db

    def runs(self) -> list[wire.Run]:
        """Return the runs, newest first."""
        return self._db.read_now(lambda tx: listing.list_runs(tx, listing.Filter(limit=_MOST_RUNS))).runs

    def curves(self, run: str) -> wire.Curves:
        """Return success and cost of a run, by episode."""
        return self._db.read_now(lambda tx: curves.curves(tx, run))

    def run(self, run: str) -> wire.Run:
        """Return a run.

        Raises:
            ValueError: the store has no such run.
        """
        try:
            return self._db.read_now(lambda tx: service.view(tx, run))
        except NotFound as refusal:
            raise ValueError(refusal.detail) from refusal

    def records(self, run: str, part: wire.RecordPart, after: int | None = None) -> wire.RecordPage:
        """Return one page of a part of a run's records; `after` is the cursor of the page before."""
        return self._db.read_now(lambda tx: reading.page(tx, run, part, after))

    def frame(self, frame: str) -> bytes:
        """Return a picture as a PNG file, by its SHA-256."""
        return self._db.read_now(lambda tx: frames.find(tx, frame))


@contextmanager
def stored_runs(file: Path) -> Iterator[StoredRuns]:
    """Open an SQLite store to read its runs.

    Raises:
        ValueError: there is no such file, or it is not a store; the message is one sentence for the user.
    """
    if not file.is_file():  # opening it would create it
        raise ValueError(f"there is no store {file}")
    with ExitStack() as stack:
        with _unusable_store():
            runs = StoredRuns(stack.enter_context(closing(Database(f"sqlite:///{file}"))))
        yield runs


def restored(database: str, records: Callable[[], Iterable[wire.Record]]) -> wire.Run:
    """Recreate a run in a store from its records, and return it. An administrator of the store owns it.

    Args:
        database: the URL of the store; an SQLite file is created if it does not exist.
        records: returns the run first, then its frames, queries, ledger and episodes.

    Raises:
        ValueError: the store cannot be used or has the run, or a record is not valid. Nothing is stored then.
    """
    with ExitStack() as stack:
        with _unusable_store():
            db = stack.enter_context(closing(Database(database)))
        try:
            return db.write_now(
                lambda tx: restoring.restore(tx, records(), users.ensure_administrator(tx).id, users.ensure_former_user)
            )
        except Refusal as refusal:
            raise ValueError(refusal.detail) from refusal


@contextmanager
def _unusable_store() -> Iterator[None]:
    """Turn the server's errors about a store into ValueErrors with the same message."""
    try:
        yield
    except (BadDatabase, WrongSchema) as error:
        raise ValueError(str(error)) from error
