"""Selects an annotator's next query: by run priority, query priority, the episode last answered, then age.

A query that follows an annotator's answer in the same episode (a follow-up) is reserved for this annotator for a
while, as long as the annotator is at work.
"""

from dataclasses import dataclass
from functools import lru_cache
from typing import Any

from sqlalchemy import Select, and_, bindparam, exists, false, not_, or_, select
from sqlalchemy.sql.elements import ColumnElement

from waypost_server.db.prepared import Prepared, Record
from waypost_server.db.tables import IS_OPEN, answers, queries, runs, skips
from waypost_server.db.tables import presence as present
from waypost_server.db.transaction import Tx
from waypost_server.gold import shadow
from waypost_server.leases import presence
from waypost_server.leases.request import Kinds, LeaseRequest


@dataclass(frozen=True)
class Candidates:
    """The statements that find the next query among those that an annotator may get."""

    some: Prepared
    first: Prepared
    follow_up: Prepared
    unlocked: Prepared
    some_unlocked: Prepared

    @classmethod
    def among(cls, offered: Select[Any]) -> "Candidates":
        """Return the statements that select from these open queries, best first."""
        last = (
            queries.c.run_id == bindparam("last_run"),
            queries.c.episode == bindparam("last_episode"),
        )
        return cls(
            Prepared(offered.limit(bindparam("most"))),
            Prepared(offered.limit(1)),
            Prepared(offered.where(*last).limit(1)),
            Prepared(offered.limit(1).with_for_update(skip_locked=True, key_share=True, of=queries)),
            Prepared(offered.limit(bindparam("most")).with_for_update(skip_locked=True, key_share=True, of=queries)),
        )


# Queries in queries, not joins: PostgreSQL plans this once, often while the tables are small, and would then begin with
# all queries of a run.
_GOLD_OF = select(runs.c.gold_of).where(runs.c.id == answers.c.run_id).scalar_subquery()
_LAST_QUERY = (
    select(answers.c.query_id)
    .where(answers.c.user_id == bindparam("user"), _GOLD_OF.is_(None))
    .order_by(answers.c.id.desc())
    .limit(1)
    .scalar_subquery()
)
LAST_ANSWERED = Prepared(select(queries.c.run_id, queries.c.episode).where(queries.c.id == _LAST_QUERY))
_SKIPPED = exists().where(skips.c.query_id == queries.c.id, skips.c.user_id == bindparam("user"))
# Since the query was selected, its annotator may have leased and skipped it in another request.
_LOCK_ONE = Prepared(
    select(queries.c.id)
    .where(queries.c.id == bindparam("query"), IS_OPEN, ~_SKIPPED)
    .with_for_update(skip_locked=True, key_share=True, of=queries)
)


def select_next(tx: Tx, request: LeaseRequest) -> int | None:
    """Return the next query, locked, or None: a follow-up if no query has a higher priority, else the first query."""
    n_others = presence.others(tx, request.user, request.run, request.presence_seconds)
    candidates = _candidates(request.kinds, request.run is not None, n_others > 0, request.defer > 0)
    parameters = request.parameters(tx.now)
    if request.ahead and not _leaves_enough(tx, candidates, parameters, n_others):
        return None
    last = LAST_ANSWERED.first(tx.conn, {"user": request.user})
    if last is not None:
        parameters |= {"last_run": last.run_id, "last_episode": last.episode}
        candidates.follow_up.ahead(tx.conn, parameters)
    chosen = candidates.first.first(tx.conn, parameters)
    if chosen is None:
        return None
    if last is not None:
        follow_up = candidates.follow_up.first(tx.conn, parameters)
        if follow_up is not None and _priorities(follow_up) >= _priorities(chosen):
            chosen = follow_up
    if tx.one_writer:
        return int(chosen.id)
    # Another transaction may be leasing the same query: lock it, or the next one that is free.
    shadow.DUE.ahead(tx.conn, {"query": chosen.id})
    locked = _LOCK_ONE.first(tx.conn, {"query": chosen.id, "user": request.user})
    if locked is None:
        locked = candidates.unlocked.first(tx.conn, parameters)
    return None if locked is None else int(locked.id)


def _priorities(candidate: Record) -> tuple[int, int]:
    return candidate.run_priority, candidate.priority


def select_several(tx: Tx, request: LeaseRequest, most: int) -> list[int]:
    """Return the next queries, locked, at most `most`; follow-ups do not come first here."""
    n_others = presence.others(tx, request.user, request.run, request.presence_seconds)
    candidates = _candidates(request.kinds, request.run is not None, n_others > 0, request.defer > 0)
    chosen = candidates.some if tx.one_writer else candidates.some_unlocked
    return [int(row.id) for row in chosen.rows(tx.conn, request.parameters(tx.now) | {"most": most})]


def _leaves_enough(tx: Tx, candidates: Candidates, parameters: dict[str, Any], n_others: int) -> bool:
    """Return whether there is a query for every other annotator at work, and one more."""
    return len(candidates.some.rows(tx.conn, {**parameters, "most": n_others + 1})) > n_others


@lru_cache(maxsize=256)
def _candidates(kinds: Kinds | None, one_run: bool, shared: bool, deferring: bool) -> Candidates:
    """Return the statements for the queries that an annotator may get; `shared` says that others are at work."""
    offered = _offered(kinds, one_run, shared)
    if deferring:
        old = queries.c.created_at <= bindparam("before")
        offered = offered.where(or_(old, not_(presence.somebody_would_take())))
    return Candidates.among(offered)


def _reserved_for_another() -> ColumnElement[bool]:
    """Return the condition that a query is a new follow-up of another annotator who is at work."""
    other = exists().where(
        present.c.user_id == queries.c.follows_user_id,
        present.c.user_id != bindparam("user"),
        presence.AT_WORK,
        presence.takes(),
    )
    return and_(queries.c.created_at > bindparam("fresh"), other)


def _offered(kinds: Kinds | None, one_run: bool, shared: bool) -> Select[Any]:
    """Return the statement that selects the open queries that an annotator may get, best first."""
    running = exists().where(runs.c.id == queries.c.run_id, runs.c.state == "running")
    offered = (
        select(queries.c.id, queries.c.run_priority, queries.c.priority)
        .where(IS_OPEN, running, ~_SKIPPED)
        .order_by(queries.c.run_priority.desc(), queries.c.priority.desc(), queries.c.id)
    )
    if shared:
        offered = offered.where(~_reserved_for_another())
    if kinds is not None:
        offered = offered.where(or_(false(), *(queries.c.kind == kind for kind in kinds)))
    if one_run:
        offered = offered.where(queries.c.run_id == bindparam("run"))
    return offered
