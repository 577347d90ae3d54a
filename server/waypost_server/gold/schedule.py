"""Gold queries put to annotators: when, which, and how good what they answered was.

Where in an annotator's stream of a run's queries they come is a function of who, which run and its rate alone: one in
each block of 1 / rate queries, at a drawn place. One comes only where the run's own query would have, so an annotator
waits for nothing longer, and a run never for more than that share of anybody's answers.
"""

import hashlib
from dataclasses import dataclass
from fractions import Fraction
from math import ceil, floor
from typing import Any

from sqlalchemy import Row, bindparam, exists, func, insert, select, update

from waypost import wire
from waypost_server.db import canonical, wakeups
from waypost_server.db.engine import Tx
from waypost_server.db.tables import gold, gold_streams, probes, skips
from waypost_server.db.tables import queries as query_table
from waypost_server.db.tables import runs as run_table
from waypost_server.gold import scoring
from waypost_server.leases.selection import Taker
from waypost_server.queries import service as queries
from waypost_server.runs import service as runs

# A permutation of small numbers that differs between annotators, so that gold queries come to each in another order.
_ORDER = (gold.c.id * 7_919 + bindparam("user") * 104_729) % 65_537

_own = run_table.alias("own")
_shadow = run_table.alias("shadow")
_DUE = (
    select(_own.c.id.label("run"), _own.c.gold_rate, _shadow.c.id.label("shadow"), query_table.c.episode)
    .add_columns(query_table.c.ordinal, query_table.c.priority)
    .join(_own, _own.c.id == query_table.c.run_id)
    .join(_shadow, _shadow.c.gold_of == _own.c.id)
    .where(query_table.c.id == bindparam("query"), _own.c.gold_rate > 0)
)
_PROBE = (
    select(probes.c.query_id, query_table.c.state)
    .join(query_table, query_table.c.id == probes.c.query_id)
    .where(probes.c.user_id == bindparam("user"), probes.c.gold_id == gold.c.id)
)
_TIMES = (
    select(func.count())
    .where(
        probes.c.user_id == bindparam("user"),
        probes.c.gold_id == gold.c.id,
        query_table.c.id == probes.c.query_id,
        query_table.c.state == "answered",
    )
    .correlate(gold)
    .scalar_subquery()
)


@dataclass(frozen=True)
class Place:
    """Where an annotator is in the stream of a run's queries."""

    user: int
    run: str
    handed: int

    def is_gold(self, rate: float) -> bool:
        """Say whether a gold query belongs here: one in each block [j / rate, (j + 1) / rate), at a drawn place."""
        share = Fraction(rate).limit_denominator(1_000_000)
        if share <= 0:
            return False
        block = ceil((self.handed + 1) * share) - 1
        first, behind = floor(block / share), floor((block + 1) / share)
        return self.handed == first + floor(self._drawn(block) * (behind - first))

    def _drawn(self, block: int) -> Fraction:
        """Return a number in [0, 1) that only who, which run and which block decide."""
        digest = hashlib.sha256(f"{self.user} {self.run} {block}".encode()).digest()
        return Fraction(int.from_bytes(digest[:8]), 2**64)


def instead(tx: Tx, taker: Taker, query: int) -> int:
    """Return the query to hand out where `query` is next: itself, or a gold one if its place is here."""
    due = tx.conn.execute(_DUE, {"query": query}).one_or_none()
    if due is None or not _next_place(tx, taker.user, due.run).is_gold(due.gold_rate):
        return query
    runs.lock(tx, due.shadow)
    chosen = _choose(tx, taker, due.run)
    if chosen is None:
        return query
    tx.wake(wakeups.QUEUE)  # the other query is free for whoever waits
    return _reopened(tx, taker.user, chosen.id) or _put(tx, taker.user, chosen, due)


def _next_place(tx: Tx, user: int, run: str) -> Place:
    """Return where an annotator is, and move on."""
    statement = tx.upsert(gold_streams).values(user_id=user, run_id=run, handed=1)
    moved = statement.on_conflict_do_update(
        index_elements=["user_id", "run_id"], set_={"handed": gold_streams.c.handed + 1}
    ).returning(gold_streams.c.handed)
    return Place(user, run, tx.conn.execute(moved).scalar_one() - 1)


def _choose(tx: Tx, taker: Taker, run: str) -> Row[*tuple[Any, ...]] | None:
    """Return the gold query this annotator has answered least often, if there is any for them."""
    skipped = exists().where(
        probes.c.user_id == bindparam("user"),
        probes.c.gold_id == gold.c.id,
        skips.c.query_id == probes.c.query_id,
        skips.c.user_id == bindparam("user"),
    )
    statement = (
        select(gold.c.id, gold.c.ask)
        .where(gold.c.run_id == run, gold.c.retired_at.is_(None))
        .where(gold.c.author_id.is_distinct_from(bindparam("user")))
        .where(~skipped, ~_PROBE.where(query_table.c.state == "leased").correlate(gold).exists())
        .order_by(_TIMES, _ORDER, gold.c.id)
        .limit(1)
    )
    if taker.kinds is not None:
        statement = statement.where(gold.c.kind.in_(taker.kinds))
    return tx.conn.execute(statement, {"user": taker.user}).one_or_none()


def _reopened(tx: Tx, user: int, item: int) -> int | None:
    """Return the query by which this annotator was handed a gold one before and did not answer it."""
    open_now = (probes.c.gold_id == item, query_table.c.state == "open")
    return tx.conn.execute(_PROBE.where(*open_now).correlate(None), {"user": user}).scalar()


def _put(tx: Tx, user: int, chosen: Row[*tuple[Any, ...]], due: Row[Any]) -> int:
    """Make a query of a gold one, in the run's shadow, dressed as one of the episode that is being asked about."""
    dressed = queries.ASK.validate_json(chosen.ask).model_copy(update={"episode": due.episode, "ordinal": due.ordinal})
    text = canonical.text(dressed.model_dump(mode="json"))
    ordinal = select(func.count()).where(query_table.c.run_id == due.shadow)
    row = {
        "run_id": due.shadow,
        "episode": 0,
        "ordinal": tx.conn.execute(ordinal).scalar_one(),
        "kind": dressed.kind,
        "state": "open",
        "priority": due.priority,
        "ask": text,
        "digest": canonical.digest(text),
        "reserve": 0,
        "revision": 0,
        "used": False,
        "created_at": tx.now,
    }
    query = int(tx.conn.execute(insert(query_table).values(row).returning(query_table.c.id)).scalar_one())
    tx.conn.execute(insert(probes).values(query_id=query, gold_id=chosen.id, user_id=user))
    return query


def score(tx: Tx, query: int, answer: wire.Answer) -> None:
    """Mark an answer to a gold query, and keep how many of its labels are right."""
    accepted = select(gold.c.accepted).join(probes, probes.c.gold_id == gold.c.id).where(probes.c.query_id == query)
    known = scoring.KNOWN.validate_json(tx.conn.execute(accepted).scalar_one())
    marks = scoring.marks(known, answer)
    _set_score(tx, query, len(marks), sum(mark.is_right for mark in marks))


def unscore(tx: Tx, query: int) -> None:
    """Forget the score of an answer that was taken back."""
    _set_score(tx, query, None, None)


def _set_score(tx: Tx, query: int, n_labels: int | None, n_right: int | None) -> None:
    tx.conn.execute(update(probes).where(probes.c.query_id == query).values(n_labels=n_labels, n_right=n_right))
