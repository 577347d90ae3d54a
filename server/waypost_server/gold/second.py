"""Second answers: a share of a run's queries is answered once more, by somebody else, to measure agreement.

The draw depends on the run's seed and the place of the query alone, so a run that is continued or repeated draws alike.
The second annotator gets a copy of the query in the run's shadow. So the second answer is never the learner's, and
never charged to the run.
"""

import hashlib
from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

from sqlalchemy import bindparam, exists, false, func, or_, select, update

from waypost import wire
from waypost_server.db import wakeups
from waypost_server.db.prepared import Prepared, Record
from waypost_server.db.tables import IS_WAITING, answers, second_answers, skips, users
from waypost_server.db.tables import queries as query_table
from waypost_server.db.tables import runs as run_table
from waypost_server.db.transaction import Tx
from waypost_server.gold import scoring, shadow
from waypost_server.queries import service as queries
from waypost_server.runs import service as runs

Kinds = tuple[wire.Kind, ...] | None

_own = run_table.alias("own")
_shadow = run_table.alias("shadow")
_copy = query_table.alias("copy")


@dataclass(frozen=True)
class Pair:
    """Two answers to one query, by two annotators."""

    query: int
    kind: wire.Kind
    first: wire.Answer
    second: wire.Answer

    @property
    def labels(self) -> list[tuple[str, str]]:
        """The labels that both answers have, in pairs."""
        both = zip(scoring.labels(self.first), scoring.labels(self.second), strict=True)
        return [(one, other) for one, other in both if one is not None and other is not None]


def is_drawn(seed: int, episode: int, ordinal: int, share: float) -> bool:
    """Return whether the query at a place of a run is answered twice."""
    digest = hashlib.sha256(f"{seed} {episode} {ordinal}".encode()).digest()
    return int.from_bytes(digest[:8]) < share * 2**64


def want(tx: Tx, run: Record, query: Record) -> None:
    """Want a second answer to a query that has just been answered, if the query is drawn; `run` is locked.

    A demonstration is not answered twice: it must be played, and many demonstrations are equally good.
    """
    if query.kind == "hier_demo" or not is_drawn(run.seed, query.episode, query.ordinal, run.second_answers):
        return
    shadow.ensure(tx, run)
    wanted = tx.upsert(second_answers).values(of_query_id=query.id, run_id=run.id, done=False)
    tx.conn.execute(wanted.on_conflict_do_nothing())
    tx.wake(wakeups.QUEUE)


def take(tx: Tx, user: int, kinds: Kinds, run: str | None) -> int | None:
    """Return a copy to lease, of a query that this annotator never answered; None if there is none."""
    found = _next(kinds, run is not None).first(tx.conn, {"user": user, "run": run})
    if found is None:
        return None
    runs.lock(tx, found.shadow)
    # In the meantime, somebody else may have got it.
    found = _next(kinds, True).first(tx.conn, {"user": user, "run": found.run_id})
    if found is None:
        return None
    if found.query_id is not None:
        return int(found.query_id)
    copy = shadow.open_query(tx, found.shadow, queries.ASK.validate_json(found.ask), found)
    tx.conn.execute(
        update(second_answers).where(second_answers.c.of_query_id == found.of_query_id).values(query_id=copy)
    )
    return copy


@lru_cache(maxsize=256)
def _next(kinds: Kinds, one_run: bool) -> Prepared:
    """Return the statement that selects the oldest query of which an annotator may get the copy."""
    own = (answers.c.query_id == second_answers.c.of_query_id, answers.c.user_id == bindparam("user"))
    either = or_(skips.c.query_id == second_answers.c.of_query_id, skips.c.query_id == second_answers.c.query_id)
    statement = (
        select(second_answers.c.of_query_id, second_answers.c.query_id, second_answers.c.run_id)
        .add_columns(query_table.c.ask, query_table.c.priority, query_table.c.created_at, _shadow.c.id.label("shadow"))
        .join(query_table, query_table.c.id == second_answers.c.of_query_id)
        .join(_own, _own.c.id == second_answers.c.run_id)
        .join(_shadow, _shadow.c.gold_of == _own.c.id)
        .outerjoin(_copy, _copy.c.id == second_answers.c.query_id)
        .where(IS_WAITING, _own.c.state == "running", query_table.c.state == "answered")
        .where(or_(_copy.c.id.is_(None), _copy.c.state == "open"))
        .where(~exists().where(*own), ~exists().where(either, skips.c.user_id == bindparam("user")))
        .order_by(second_answers.c.of_query_id)
        .limit(1)
    )
    if one_run:
        statement = statement.where(second_answers.c.run_id == bindparam("run"))
    if kinds is not None:
        statement = statement.where(or_(false(), *(query_table.c.kind == kind for kind in kinds)))
    return Prepared(statement)


def settle(tx: Tx, query: int, *, done: bool) -> bool:
    """Say whether the copy `query` has its answer. Return whether it is a copy for a second answer at all."""
    changed = update(second_answers).where(second_answers.c.query_id == query).values(done=done)
    return bool(tx.conn.execute(changed).rowcount)


_first = answers.alias("first")
_second = answers.alias("second")
PAIRS = (
    select(query_table.c.id, query_table.c.kind, _first.c.content.label("first"), _second.c.content.label("second"))
    .add_columns(users.c.name.label("annotator"), _second.c.units, _second.c.seconds, _second.c.active_seconds)
    .select_from(second_answers)
    .join(query_table, query_table.c.id == second_answers.c.of_query_id)
    .join(_first, _first.c.id == query_table.c.answer_id)
    .join(_copy, _copy.c.id == second_answers.c.query_id)
    .join(_second, _second.c.id == _copy.c.answer_id)
    .join(users, users.c.id == _second.c.user_id)
    # An answer that was sent back may have been given again by the annotator who gave the second one.
    .where(_first.c.user_id != _second.c.user_id)
    .order_by(query_table.c.id)
)
"""The queries with two answers that count, each with the second one's annotator and cost."""


def pairs(tx: Tx, run: str) -> list[Pair]:
    """Return the queries of a run that two annotators answered, with both answers."""
    rows = tx.conn.execute(PAIRS.where(second_answers.c.run_id == run))
    return [
        Pair(row.id, row.kind, queries.ANSWER.validate_json(row.first), queries.ANSWER.validate_json(row.second))
        for row in rows
    ]


def disagreeing(tx: Tx, run: str) -> Sequence[int]:
    """Return the queries of a run whose two answers differ in a label."""
    return [pair.query for pair in pairs(tx, run) if any(one != other for one, other in pair.labels)]


def n_waiting(tx: Tx, run: str) -> int:
    """Return how many second answers a run still wants."""
    counted = select(func.count()).select_from(second_answers).where(second_answers.c.run_id == run, IS_WAITING)
    return int(tx.conn.execute(counted).scalar_one())


def spent(tx: Tx, run: str) -> Any:
    """Return the micro-units and the active seconds of a run's second answers; nobody else pays for them."""
    sums = (
        select(
            func.coalesce(func.sum(_second.c.units), 0).label("units"),
            func.coalesce(func.sum(_second.c.active_seconds), 0.0).label("active_seconds"),
        )
        .select_from(second_answers)
        .join(_copy, _copy.c.id == second_answers.c.query_id)
        .join(_second, _second.c.id == _copy.c.answer_id)
        .where(second_answers.c.run_id == run)
    )
    return tx.conn.execute(sums).one()
