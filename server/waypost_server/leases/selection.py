"""Which query an annotator gets next: by its run's priority, its own, the episode last answered, then age.

What follows up on somebody's answer is kept for them for a while, as long as they are at work.
"""

from dataclasses import dataclass
from functools import lru_cache
from typing import Any

from sqlalchemy import Select, and_, bindparam, exists, not_, or_, select
from sqlalchemy.sql.elements import ColumnElement

from waypost import wire
from waypost_server.db.engine import Tx
from waypost_server.db.tables import IS_OPEN, answers, queries, runs, skips
from waypost_server.db.tables import presence as present
from waypost_server.leases import presence

Kinds = tuple[wire.Kind, ...]


@dataclass(frozen=True)
class Taker:
    """An annotator and what it would take."""

    user: int
    kinds: Kinds | None
    run: str | None
    defer: float
    ahead: bool
    presence_seconds: float
    follow_up_seconds: float

    def known(self, now: float) -> dict[str, Any]:
        """Return what the statements are run with."""
        return {
            "user": self.user,
            "run": self.run,
            "now": now,
            "since": now - self.presence_seconds,
            "fresh": now - self.follow_up_seconds,
        }


@dataclass(frozen=True)
class Offer:
    """The statements that find the next query among those an annotator may have."""

    offered: Select[Any]
    first: Select[Any]
    follow_up: Select[Any]
    unlocked: Select[Any]

    @classmethod
    def among(cls, offered: Select[Any]) -> "Offer":
        """Return the statements over some choice of open queries, best first."""
        last = (
            queries.c.run_id == bindparam("last_run"),
            queries.c.episode == bindparam("last_episode"),
            queries.c.run_priority >= bindparam("run_priority"),
            queries.c.priority >= bindparam("priority"),
        )
        return cls(
            offered,
            offered.limit(1),
            offered.where(*last).limit(1),
            offered.limit(1).with_for_update(skip_locked=True, of=queries),
        )


_LAST_ANSWERED = (
    select(queries.c.run_id, queries.c.episode)
    .join(answers, answers.c.query_id == queries.c.id)
    .join(runs, runs.c.id == queries.c.run_id)
    .where(answers.c.user_id == bindparam("user"), runs.c.gold_of.is_(None))
    .order_by(answers.c.id.desc())
    .limit(1)
)
_LOCK_ONE = select(queries.c.id).where(queries.c.id == bindparam("query"), IS_OPEN).with_for_update(skip_locked=True)


def take(tx: Tx, taker: Taker) -> int | None:
    """Lock and return the next query: a follow-up if nothing has a higher priority, else the first."""
    n_others = presence.others(tx, taker.user, taker.run, taker.presence_seconds)
    offer = _offer(tx, taker, n_others > 0)
    known = taker.known(tx.now)
    if taker.ahead and not _is_enough(tx, offer, known, n_others):
        return None
    chosen = tx.conn.execute(offer.first, known).one_or_none()
    if chosen is None:
        return None
    last = tx.conn.execute(_LAST_ANSWERED, known).one_or_none()
    if last is not None:
        known |= {"last_run": last.run_id, "last_episode": last.episode}
        known |= {"run_priority": chosen.run_priority, "priority": chosen.priority}
        chosen = tx.conn.execute(offer.follow_up, known).one_or_none() or chosen
    if tx.one_writer:
        return int(chosen.id)
    # Others may be taking the same: lock it, or whichever is next and free.
    locked = tx.conn.execute(_LOCK_ONE, {"query": chosen.id}).one_or_none()
    if locked is None:
        locked = tx.conn.execute(offer.unlocked, known).one_or_none()
    return None if locked is None else int(locked.id)


def _is_enough(tx: Tx, offer: Offer, known: dict[str, Any], n_others: int) -> bool:
    """Return whether there is a query for everybody else at work, and one more."""
    return len(tx.conn.execute(offer.offered.limit(n_others + 1), known).all()) > n_others


def _offer(tx: Tx, taker: Taker, shared: bool) -> Offer:
    """Return what a taker may have; `shared` if others are at work."""
    if taker.defer == 0:
        return _plain_offer(taker.kinds, taker.run is not None, shared)
    others = presence.who_would_take(tx, taker.presence_seconds)
    old = queries.c.created_at <= tx.now - taker.defer
    return Offer.among(_offered(taker.kinds, taker.run is not None, shared).where(or_(old, not_(others))))


@lru_cache(maxsize=256)
def _plain_offer(kinds: Kinds | None, one_run: bool, shared: bool) -> Offer:
    return Offer.among(_offered(kinds, one_run, shared))


def _kept_for_another() -> ColumnElement[bool]:
    """Return the condition that a query is new, and was asked after an answer of somebody else who is at work."""
    other = exists().where(
        present.c.user_id == queries.c.follows_user_id,
        present.c.user_id != bindparam("user"),
        presence.AT_WORK,
        presence.takes(),
    )
    return and_(queries.c.created_at > bindparam("fresh"), other)


def _offered(kinds: Kinds | None, one_run: bool, shared: bool) -> Select[Any]:
    """Return the open queries an annotator may have, best first."""
    skipped = exists().where(skips.c.query_id == queries.c.id, skips.c.user_id == bindparam("user"))
    running = exists().where(runs.c.id == queries.c.run_id, runs.c.state == "running")
    offered = (
        select(queries.c.id, queries.c.run_priority, queries.c.priority)
        .where(IS_OPEN, running, ~skipped)
        .order_by(queries.c.run_priority.desc(), queries.c.priority.desc(), queries.c.id)
    )
    if shared:
        offered = offered.where(~_kept_for_another())
    if kinds is not None:
        offered = offered.where(queries.c.kind.in_(kinds))
    if one_run:
        offered = offered.where(queries.c.run_id == bindparam("run"))
    return offered
