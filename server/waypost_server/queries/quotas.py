"""Quotas: how many open queries a run and a learner may have, and how many bytes of pictures a learner."""

from dataclasses import dataclass

from sqlalchemy import Integer, bindparam, cast, func, select, update

from waypost_server import errors
from waypost_server.db.prepared import Prepared, Record
from waypost_server.db.tables import IS_UNANSWERED, queries, runs, users
from waypost_server.db.transaction import Tx

LOCK = 7_296_013  # with the id of a user: who holds it may add to the user's open queries (PostgreSQL)

_OWNER = select(runs.c.user_id).where(runs.c.id == bindparam("run")).scalar_subquery()
_LOCK = Prepared(select(func.pg_advisory_xact_lock(LOCK, cast(_OWNER, Integer))))
_COUNT = Prepared(select(func.count()).where(queries.c.run_id == bindparam("run"), IS_UNANSWERED))
_OF_ONE = select(func.count()).where(queries.c.run_id == runs.c.id, IS_UNANSWERED).correlate(runs).scalar_subquery()
_COUNT_OTHERS = Prepared(  # run by run: the database would rather read the queries of everybody for a list of runs
    select(func.coalesce(func.sum(_OF_ONE), 0)).where(
        runs.c.user_id == _OWNER, runs.c.state != "finished", runs.c.gold_of.is_(None), runs.c.id != bindparam("run")
    )
)


@dataclass(frozen=True)
class OpenQueries:
    """The maximum number of unanswered queries: of one run, and of all runs of one user together."""

    of_run: int
    of_user: int


def check_open(tx: Tx, run: Record, n_new: int, most: OpenQueries) -> None:
    """Refuse new queries of a locked run that are more than its owner or the run may have.

    Raises:
        TooManyQueries: with the numbers.
    """
    one = {"run": run.id}
    if not tx.one_writer:  # runs of the same user are locked by different transactions
        _LOCK.run(tx.conn, one)
        _COUNT_OTHERS.ahead(tx.conn, one)
    n_open = _COUNT.value(tx.conn, one)
    if n_open + n_new > most.of_run:
        raise errors.TooManyQueries(
            f"The run has {n_open} open queries and may have at most {most.of_run}; wait for answers.", retry_after=1
        )
    n_others = int(_COUNT_OTHERS.value(tx.conn, one))
    if n_open + n_others + n_new > most.of_user:
        raise errors.TooManyQueries(
            f"The runs of this learner have {n_open + n_others} open queries and may have at most {most.of_user}; wait "
            "for answers, or finish a run.",
            retry_after=1,
        )


def use_bytes(tx: Tx, user: int, more: int, most: int) -> None:
    """Add the size of new pictures to what a user has uploaded.

    Raises:
        TooManyPictures: it would be more than the user may have.
    """
    changed = update(users).where(users.c.id == user).values(frame_bytes=users.c.frame_bytes + more)
    used = int(tx.conn.execute(changed.returning(users.c.frame_bytes)).scalar_one())
    if used > most:
        raise errors.TooManyPictures(
            f"Your pictures have {used - more} bytes, and these have {more} more; they may have at most {most}. Delete "
            "finished runs that you no longer need, or ask the operator for more."
        )
