"""Practice queries that learners sent for the domains of their runs. They are deleted with the run."""

from sqlalchemy import select

from waypost import wire
from waypost.wire.gold import MOST_EXERCISES
from waypost_server import errors
from waypost_server.db.tables import practices
from waypost_server.db.tables import runs as run_table
from waypost_server.db.transaction import Tx
from waypost_server.gold.exercises import Exercises
from waypost_server.queries import frame_uses
from waypost_server.runs import service as runs

FIRST = 10_000  # the ids of queries from files are smaller


def put(tx: Tx, run: str, wanted: wire.PracticePut, user: int) -> None:
    """Store the practice queries of a run's domain; others that its learner sent before are gone.

    Raises:
        Forbidden: the user may not change the run.
        NotFound, Unprocessable: there is no such run, or the queries do not fit it, or a picture is not stored.
    """
    row = runs.lock_own(tx, run, user)
    exercises = Exercises(runs.vocabulary_of(row.vocabulary), wanted)
    exercises.check(["body"])
    if absent := frame_uses.show(tx, run, exercises.frames()):
        raise errors.Unprocessable(["body"], f"frame {absent[0]} is not stored; upload it before")
    stored = {"content": wanted.model_dump_json()}
    added = tx.upsert(practices).values(run_id=run, **stored)
    tx.conn.execute(added.on_conflict_do_update(index_elements=["run_id"], set_=stored))


def numbers(tx: Tx) -> dict[str, int]:
    """Return the domains that have such practice, and the number of the newest run of each."""
    listed = select(run_table.c.number, run_table.c.vocabulary).join(practices, practices.c.run_id == run_table.c.id)
    rows = tx.conn.execute(listed.order_by(run_table.c.number))
    return {runs.vocabulary_of(row.vocabulary).domain: row.number for row in rows}


def of_number(tx: Tx, number: int) -> Exercises | None:
    """Return the practice queries of the run with a number; None if there are none."""
    columns = (run_table.c.vocabulary, practices.c.content)
    sent = select(*columns).join(practices, practices.c.run_id == run_table.c.id).where(run_table.c.number == number)
    row = tx.conn.execute(sent).one_or_none()
    if row is None:
        return None
    content = wire.PracticePut.model_validate_json(row.content)
    return Exercises(runs.vocabulary_of(row.vocabulary), content, FIRST + number * MOST_EXERCISES)


def of_query(tx: Tx, query: int) -> Exercises | None:
    """Return the practice queries to which the query with an id belongs; None if there is no such query."""
    found = of_number(tx, (query - FIRST) // MOST_EXERCISES)
    return found if found is not None and query in found.ids else None
