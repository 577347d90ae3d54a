"""Stores and reads queries, and marks answers as used. (run, episode, ordinal) identifies a query."""

from collections.abc import Collection, Sequence
from dataclasses import dataclass
from typing import Any

from pydantic import TypeAdapter
from sqlalchemy import Row, Select, and_, bindparam, func, insert, select, tuple_, update
from sqlalchemy.sql.elements import ColumnElement

from waypost import prices as pricing
from waypost import wire
from waypost.prices import to_units
from waypost_server import errors
from waypost_server.auth.access import LOCKED_USER
from waypost_server.db import canonical, wakeups
from waypost_server.db.functions import by_value
from waypost_server.db.tables import IS_LIVE, answers, assignments, queries, users
from waypost_server.db.tables import runs as run_table
from waypost_server.db.transaction import Tx
from waypost_server.queries import checks, frame_uses, quotas
from waypost_server.runs import events, ledger
from waypost_server.runs import service as runs

CLOSED = frozenset({"answered", "cancelled"})
ASK: TypeAdapter[wire.Ask] = TypeAdapter(wire.Ask)
ANSWER: TypeAdapter[wire.Answer] = TypeAdapter(wire.Answer)

_annotator = users.alias("annotator")
_holder = users.alias("holder")

QUERIES: Select[Any] = (
    select(
        queries,
        answers.c.content.label("answer"),
        answers.c.units,
        answers.c.seconds,
        answers.c.active_seconds,
        func.coalesce(_annotator.c.name, _holder.c.name).label("annotator"),
        func.coalesce(run_table.c.gold_of, run_table.c.id).label("shown_run"),  # a gold query looks like the others
    )
    .select_from(queries)
    .join(run_table, run_table.c.id == queries.c.run_id)
    .outerjoin(answers, answers.c.id == queries.c.answer_id)
    .outerjoin(_annotator, _annotator.c.id == answers.c.user_id)
    .outerjoin(assignments, and_(assignments.c.query_id == queries.c.id, IS_LIVE))
    .outerjoin(_holder, _holder.c.id == assignments.c.user_id)
    .where(run_table.c.deleted_at.is_(None))
)


_VIEW = QUERIES.where(queries.c.id == bindparam("query"))
_INSERT = insert(queries).returning(queries.c.id, sort_by_parameter_order=True)


@dataclass(frozen=True)
class Filter:
    """The filter of a list of a run's queries."""

    state: wire.QueryState | None
    kind: wire.Kind | None
    episode: int | None
    before: int | None
    limit: int


@dataclass(frozen=True)
class Content:
    """The content of a query, as it is stored and compared; `place` is its place among those asked together."""

    place: int
    ask: wire.Ask
    text: str
    digest: str

    @classmethod
    def of(cls, ask: wire.Ask, place: int = 0) -> "Content":
        """Return the canonical content of a query. Frames and landmarks are stored, but not compared."""
        content = ask.model_dump(mode="json")
        text = canonical.text(content)
        for segment in [*content.get("segments", []), *content["context"]]:
            for field in wire.Pictured.model_fields:
                del segment[field]
        return cls(place, ask, text, canonical.digest(canonical.text(content)))

    @property
    def key(self) -> tuple[int, int]:
        """The key of the query within its run."""
        return (self.ask.episode, self.ask.ordinal)


def has_key(keys: Collection[tuple[int, int]]) -> ColumnElement[bool]:
    """Return the condition that a query of a run has one of these keys.

    SQLite finds rows by an index of their episodes, but it would read the whole run for a list of pairs.
    """
    return and_(
        queries.c.episode.in_({episode for episode, _ in keys}), tuple_(queries.c.episode, queries.c.ordinal).in_(keys)
    )


def topic(query: int) -> str:
    """Return the topic that a change of a query wakes."""
    return f"query:{query}"


def of_row(row: Row[Any]) -> wire.Query:
    """Return the message for a row of `QUERIES`."""
    return wire.Query(
        id=row.id,
        run=row.shown_run,
        state=row.state,
        priority=row.priority,
        created_at=row.created_at,
        ask=ASK.validate_json(row.ask),
        answer=None if row.answer is None else ANSWER.validate_json(row.answer),
        answer_id=row.answer_id,
        used=row.used,
        annotator=row.annotator,
        units=None if row.units is None else to_units(row.units),
        seconds=row.seconds,
        active_seconds=row.active_seconds,
    )


def view(tx: Tx, query: int) -> wire.Query:
    """Return a query.

    Raises:
        NotFound: there is no such query.
    """
    row = tx.conn.execute(_VIEW, {"query": query}).one_or_none()
    if row is None:
        raise errors.NotFound(f"There is no query {query}.")
    return of_row(row)


def place_of(state: wire.QueryState | None, episode: int | None) -> ColumnElement[int]:
    """Return what sorts the queries of a run by age, for a filter by state and episode that may leave few of them."""
    leaves_few = episode is not None or state not in {None, "answered"}
    return by_value(queries.c.id) if leaves_few else queries.c.id


def newest(tx: Tx, run: str, chosen: Filter) -> wire.QueryList:
    """List a run's queries, newest first."""
    runs.find(tx, run)
    place = place_of(chosen.state, chosen.episode)
    # Their ids alone at first: otherwise, all that fit would be read as a whole before they are sorted.
    statement = select(queries.c.id).where(queries.c.run_id == run).order_by(place.desc()).limit(chosen.limit)
    if chosen.state is not None:
        statement = statement.where(queries.c.state == chosen.state)
    if chosen.kind is not None:
        statement = statement.where(queries.c.kind == chosen.kind)
    if chosen.episode is not None:
        statement = statement.where(queries.c.episode == chosen.episode)
    if chosen.before is not None:
        statement = statement.where(queries.c.id < chosen.before)
    ids = tx.conn.execute(statement).scalars().all()
    found = tx.conn.execute(QUERIES.where(queries.c.id.in_(ids)).order_by(queries.c.id.desc()))
    return wire.QueryList(queries=[of_row(row) for row in found])


def answered_after(tx: Tx, run: str, cursor: int, limit: int) -> wire.AnswerPage:
    """Return the queries answered after a cursor, in the order of their answers."""
    runs.find(tx, run)
    statement = (
        QUERIES.where(queries.c.run_id == run, answers.c.run_id == run, answers.c.id > cursor)
        .order_by(answers.c.id)
        .limit(limit)
    )
    found = [of_row(row) for row in tx.conn.execute(statement)]
    last = found[-1].answer_id if found else None
    return wire.AnswerPage(queries=found, cursor=cursor if last is None else last)


def ask(
    tx: Tx, run: str, contents: Sequence[Content], priority: int, most: quotas.OpenQueries, user: int
) -> wire.Asked:
    """Ask all of the queries or none. Queries that were asked before are returned in their present state.

    Raises:
        Forbidden: the user may not change the run.
        DifferentContent: a key was used before with other content.
        RunFinished, TooManyQueries, BudgetExhausted: the run cannot ask new queries.
        Unprocessable: a query is not valid in this run.
    """
    _look_ahead(tx, run, user)
    run_row = runs.lock_own(tx, run, user)
    known = _known(tx, run, contents)
    new = _new(contents, known)
    asked = _asked_before(tx, known)
    if new:
        _check_new(tx, run_row, new)
        prices = runs.prices_of(run_row.prices)
        reserves = [pricing.highest_cost(one.ask, prices).units for one in new]
        ledger.reserve(tx, runs.account(run_row), sum(reserves))
        quotas.check_open(tx, run_row, len(new), most)
        ids = _insert(tx, run_row, new, priority, reserves)
        asked |= {one.key: _open(query, run, priority, tx.now, one.ask) for query, one in zip(ids, new, strict=True)}
        tx.wake(wakeups.QUEUE)
    return wire.Asked(queries=[asked[one.key] for one in contents])


def _look_ahead(tx: Tx, run: str, user: int) -> None:
    """Lock and read in one round trip what every ask needs."""
    if tx.one_writer or not runs.is_id(run):
        return  # there are no round trips, or there is no such run
    LOCKED_USER.ahead(tx.conn, {"user": user})
    runs.LOCK.ahead(tx.conn, {"run": run})
    tx.read_time_ahead()


def _known(tx: Tx, run: str, contents: Sequence[Content]) -> dict[tuple[int, int], tuple[int, str]]:
    keys = [one.key for one in contents]
    rows = tx.conn.execute(
        select(queries.c.id, queries.c.episode, queries.c.ordinal, queries.c.digest).where(
            queries.c.run_id == run, has_key(keys)
        )
    )
    return {(row.episode, row.ordinal): (row.id, row.digest) for row in rows}


def _asked_before(tx: Tx, known: dict[tuple[int, int], tuple[int, str]]) -> dict[tuple[int, int], wire.Query]:
    """Return the present state of queries by their keys."""
    if not known:
        return {}
    ids = [query for query, _ in known.values()]
    found = map(of_row, tx.conn.execute(QUERIES.where(queries.c.id.in_(ids))))
    return {(query.ask.episode, query.ask.ordinal): query for query in found}


def _open(query: int, run: str, priority: int, created_at: float, ask: wire.Ask) -> wire.Query:
    """Return the message for a new query."""
    return wire.Query(
        id=query,
        run=run,
        state="open",
        priority=priority,
        created_at=created_at,
        ask=ask,
        answer=None,
        answer_id=None,
        used=False,
        annotator=None,
        units=None,
        seconds=None,
        active_seconds=None,
    )


def _new(contents: Sequence[Content], known: dict[tuple[int, int], tuple[int, str]]) -> list[Content]:
    """Return the queries that were not asked before; refuse a key that was used before with other content."""
    new: dict[tuple[int, int], Content] = {}
    for one in contents:
        earlier = known[one.key][1] if one.key in known else None
        if one.key in new:
            earlier = new[one.key].digest
        if earlier is None:
            new[one.key] = one
        elif earlier != one.digest:
            raise errors.DifferentContent(
                f"queries.{one.place}: episode {one.ask.episode} has already asked query {one.ask.ordinal} "
                "with other content."
            )
    return list(new.values())


def _check_new(tx: Tx, run_row: Row[Any], new: Sequence[Content]) -> None:
    if run_row.state == "finished":
        raise errors.RunFinished("The run is finished, so it cannot ask new queries.")
    names = checks.Names.of(runs.vocabulary_of(run_row.vocabulary))
    for one in new:
        checks.check_ask(one.ask, names, ["body", "queries", one.place])
    frame_uses.check_stored(tx, run_row.id, [one.ask for one in new])


def _insert(tx: Tx, run_row: Row[Any], new: Sequence[Content], priority: int, reserves: Sequence[int]) -> list[int]:
    """Insert new queries and their events; return the ids in the same order."""
    answered_last = _answered_last(tx, run_row.id, {one.ask.episode for one in new})
    rows = [
        {
            "run_id": run_row.id,
            "episode": one.ask.episode,
            "ordinal": one.ask.ordinal,
            "kind": one.ask.kind,
            "state": "open",
            "priority": priority,
            "run_priority": run_row.priority,
            "ask": one.text,
            "digest": one.digest,
            "reserve": reserve,
            "revision": 0,
            "used": False,
            "created_at": tx.now,
            "follows_user_id": answered_last.get(one.ask.episode),
        }
        for one, reserve in zip(new, reserves, strict=True)
    ]
    ids = [int(query) for query in tx.conn.execute(_INSERT, rows).scalars()]
    for query, one in zip(ids, new, strict=True):
        data = {"query": query, "kind": one.ask.kind, "episode": one.ask.episode, "ordinal": one.ask.ordinal}
        events.add(tx, run_row.id, "asked", data)
        tx.trace("ask", run_row.id, one.ask.episode, query=query, kind=one.ask.kind)
    return ids


def _answered_last(tx: Tx, run: str, episodes: Collection[int]) -> dict[int, int]:
    """Return the user who gave the last answer in each of these episodes, if there is one."""
    newest = (
        select(func.max(queries.c.answer_id))
        .where(queries.c.run_id == run, queries.c.state == "answered", queries.c.episode.in_(episodes))
        .group_by(queries.c.episode)
    )
    rows = tx.conn.execute(
        select(queries.c.episode, answers.c.user_id)
        .join(answers, answers.c.id == queries.c.answer_id)
        .where(answers.c.id.in_(newest))
    )
    return {row.episode: row.user_id for row in rows}


def use(tx: Tx, query: int, user: int) -> wire.Query:
    """Mark the answer as used, so that it can no longer be retracted.

    Raises:
        Forbidden: the user may not change the run.
        NotAnswered: there is no answer, for example because it was retracted in the meantime.
    """
    found = view(tx, query)
    runs.lock_own(tx, found.run, user)
    changed = tx.conn.execute(
        update(queries)
        .where(queries.c.id == query, queries.c.run_id == found.run, queries.c.state == "answered", ~queries.c.used)
        .values(used=True)
    )
    now = view(tx, query)
    if not now.used:
        raise errors.NotAnswered(f"Query {query} is {now.state}; wait for its answer.")
    if changed.rowcount:
        events.add(tx, now.run, "used", {"query": query, "answer": now.answer_id})
        tx.trace("use", now.run, now.ask.episode, query=query, kind=now.ask.kind)
    return now
