"""The schedule of gold queries: when an annotator gets one, which one, and the score of the answer.

An annotator gets one gold query in each block of 1 / rate queries of a run. Its position in the block is pseudo-random;
it depends only on the user, the run, the rate and the number of the block. A gold query is leased only in place of a
query of the run. So annotators do not wait longer, and at most this share of their answers is lost to the run.
"""

import hashlib
from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import ceil, floor
from typing import Any

from sqlalchemy import Row, bindparam, exists, func, insert, select, update

from waypost import wire
from waypost_server.db import wakeups
from waypost_server.db.prepared import Record
from waypost_server.db.tables import gold, gold_showings, gold_streams, skips
from waypost_server.db.tables import queries as query_table
from waypost_server.db.transaction import Tx
from waypost_server.gold import scoring, shadow
from waypost_server.queries import service as queries
from waypost_server.runs import service as runs

# A permutation of small numbers that differs between annotators, so that each gets gold queries in a different order.
_ORDER = (gold.c.id * 7_919 + bindparam("user") * 104_729) % 65_537

_SHOWING = (
    select(gold_showings.c.query_id, query_table.c.state)
    .join(query_table, query_table.c.id == gold_showings.c.query_id)
    .where(gold_showings.c.user_id == bindparam("user"), gold_showings.c.gold_id == gold.c.id)
)
_TIMES = (
    select(func.count())
    .where(
        gold_showings.c.user_id == bindparam("user"),
        gold_showings.c.gold_id == gold.c.id,
        query_table.c.id == gold_showings.c.query_id,
        query_table.c.state == "answered",
    )
    .correlate(gold)
    .scalar_subquery()
)


@dataclass(frozen=True)
class Position:
    """An annotator's position in the stream of a run's queries."""

    user: int
    run: str
    handed: int

    def is_gold(self, rate: float) -> bool:
        """Return whether a gold query is due here: one per block [j / rate, (j + 1) / rate), at a random position."""
        share = Fraction(rate).limit_denominator(1_000_000)
        if share <= 0:
            return False
        block = ceil((self.handed + 1) * share) - 1
        first, behind = floor(block / share), floor((block + 1) / share)
        return self.handed == first + floor(self._random(block) * (behind - first))

    def _random(self, block: int) -> Fraction:
        """Return a number in [0, 1) that depends on the user, the run and the block alone."""
        digest = hashlib.sha256(f"{self.user} {self.run} {block}".encode()).digest()
        return Fraction(int.from_bytes(digest[:8]), 2**64)


def replace_with_gold(tx: Tx, user: int, kinds: Sequence[wire.Kind] | None, query: int, due: Record) -> int:
    """Return the query to lease when `query` is next: a gold query if one is due for this annotator, else `query`.

    Args:
        tx: the transaction.
        user: the annotator.
        kinds: the kinds of query that the annotator accepts; None for all.
        query: the query that is next.
        due: what `shadow.due` says of the query.
    """
    if due.gold_rate <= 0 or not _next_position(tx, user, due.run).is_gold(due.gold_rate):
        return query
    runs.lock(tx, due.shadow)
    chosen = _choose(tx, user, kinds, due.run)
    if chosen is None:
        return query
    tx.wake(wakeups.QUEUE)  # `query` is free for other annotators who wait
    return _open_showing(tx, user, chosen.id) or _show(tx, user, chosen, due)


def _next_position(tx: Tx, user: int, run: str) -> Position:
    """Return an annotator's position in a run, and advance it."""
    statement = tx.upsert(gold_streams).values(user_id=user, run_id=run, handed=1)
    moved = statement.on_conflict_do_update(
        index_elements=["user_id", "run_id"], set_={"handed": gold_streams.c.handed + 1}
    ).returning(gold_streams.c.handed)
    return Position(user, run, tx.conn.execute(moved).scalar_one() - 1)


def _choose(tx: Tx, user: int, kinds: Sequence[wire.Kind] | None, run: str) -> Row[*tuple[Any, ...]] | None:
    """Return the gold query that this annotator has answered least often, or None if there is none for them."""
    skipped = exists().where(
        gold_showings.c.user_id == bindparam("user"),
        gold_showings.c.gold_id == gold.c.id,
        skips.c.query_id == gold_showings.c.query_id,
        skips.c.user_id == bindparam("user"),
    )
    statement = (
        select(gold.c.id, gold.c.ask)
        .where(gold.c.run_id == run, gold.c.retired_at.is_(None))
        .where(gold.c.author_id.is_distinct_from(bindparam("user")))
        .where(~skipped, ~_SHOWING.where(query_table.c.state == "leased").correlate(gold).exists())
        .order_by(_TIMES, _ORDER, gold.c.id)
        .limit(1)
    )
    if kinds is not None:
        statement = statement.where(gold.c.kind.in_(kinds))
    return tx.conn.execute(statement, {"user": user}).one_or_none()


def _open_showing(tx: Tx, user: int, item: int) -> int | None:
    """Return the query of an earlier showing to this annotator that is still open, if there is one."""
    open_now = (gold_showings.c.gold_id == item, query_table.c.state == "open")
    return tx.conn.execute(_SHOWING.where(*open_now).correlate(None), {"user": user}).scalar()


def _show(tx: Tx, user: int, chosen: Row[*tuple[Any, ...]], due: Record) -> int:
    """Create the query of a new showing in the run's shadow. It looks like the query that it replaces."""
    disguised = queries.ASK.validate_json(chosen.ask).model_copy(
        update={"episode": due.episode, "ordinal": due.ordinal}
    )
    query = shadow.open_query(tx, due.shadow, disguised, due)
    tx.conn.execute(insert(gold_showings).values(query_id=query, gold_id=chosen.id, user_id=user))
    return query


def score(tx: Tx, query: int, answer: wire.Answer) -> None:
    """Score the first answer to a gold query: store how many of its labels are right.

    The score stays when the answer is retracted. Otherwise an annotator could try answers until one is right.
    """
    accepted = (
        select(gold.c.accepted)
        .join(gold_showings, gold_showings.c.gold_id == gold.c.id)
        .where(gold_showings.c.query_id == query)
    )
    known = scoring.KNOWN.validate_json(tx.conn.execute(accepted).scalar_one())
    marks = scoring.marks(known, answer)
    tx.conn.execute(
        update(gold_showings)
        .where(gold_showings.c.query_id == query, gold_showings.c.n_labels.is_(None))
        .values(n_labels=len(marks), n_right=sum(mark.is_right for mark in marks))
    )
