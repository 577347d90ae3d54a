"""Checks a store: its file, and every fact that it holds twice. It only reads, from one moment, beside running servers.

A check is a statement that selects what is wrong, so a sound store selects nothing.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from alembic.autogenerate import compare_metadata
from alembic.runtime.migration import MigrationContext
from sqlalchemy import Column, Connection, Select, and_, case, create_engine, exists, func, or_, select, text, union_all

from waypost_server.db import audit
from waypost_server.db.engine import parse
from waypost_server.db.tables import (
    IS_LIVE,
    IS_UNANSWERED,
    answers,
    assignments,
    comments,
    credentials,
    episodes,
    events,
    frame_uses,
    frames,
    gold,
    gold_showings,
    ledger,
    ledger_sums,
    metadata,
    presence,
    queries,
    runs,
    second_answers,
    users,
)
from waypost_server.db.transaction import Tx

APPEND_ONLY = ("answers", "audit", "ledger", "events", "comments")  # tables whose rows triggers keep as they are
SHOWN = 5  # faults that a result names


@dataclass(frozen=True)
class Result:
    """The result of one check.

    Args:
        fact: what should hold, as a sentence.
        faults: what does not hold, at most `SHOWN`; empty if all is well.
        n_faults: how many there are in all.
        head: of the audit log: its newest row, to be written down elsewhere; None if it has none.
    """

    fact: str
    faults: tuple[str, ...]
    n_faults: int
    head: str | None = None


def _sum(column: Column[Any]) -> Select[Any]:
    return select(func.coalesce(func.sum(column), 0))


def _units(*conditions: Any) -> Any:
    return _sum(ledger.c.units).where(*conditions).scalar_subquery()


_counting = answers.c.id == queries.c.answer_id
_of_run = queries.c.run_id == runs.c.id
_reserved = _sum(queries.c.reserve).where(_of_run, IS_UNANSWERED).correlate(runs).scalar_subquery()
_answered_units = (
    _sum(answers.c.units).select_from(queries.join(answers, _counting)).where(_of_run).correlate(runs).scalar_subquery()
)
_live = select(func.count()).where(assignments.c.query_id == queries.c.id, IS_LIVE).correlate(queries).scalar_subquery()
_charges = (
    select(func.count())
    .where(ledger.c.answer_id == answers.c.id, ledger.c.entry == "charge")
    .correlate(answers)
    .scalar_subquery()
)
_uploaded = (
    select(func.coalesce(func.sum(func.length(frames.c.png)), 0))
    .where(frames.c.user_id == users.c.id)
    .correlate(users)
    .scalar_subquery()
)
_keys = ("run_id", "episode", "kind")
_amounts = ("units", "lo_units", "seconds", "active_seconds")
_booked_less_summed = union_all(
    select(
        *(ledger.c[name] for name in (*_keys, *_amounts)),
        case((ledger.c.entry == "charge", 1), else_=-1).label("queries"),
    ),
    select(
        *(ledger_sums.c[name] for name in _keys),
        *((-ledger_sums.c[name]).label(name) for name in (*_amounts, "queries")),
    ),
).subquery()
_own = runs.alias("own")
_shadow = runs.alias("shadow")

CHECKS: Sequence[tuple[str, str, Select[Any]]] = (
    (
        "What a run has spent is what the ledger says.",
        "run",
        select(runs.c.id).where(runs.c.spent != _units(ledger.c.run_id == runs.c.id)),
    ),
    (
        "The sums of a run's ledger are those of its entries.",
        "run",
        select(_booked_less_summed.c.run_id.label("id"))
        .distinct()
        .group_by(*(_booked_less_summed.c[name] for name in _keys))
        .having(
            or_(
                *(func.sum(_booked_less_summed.c[name]) != 0 for name in ("queries", "units", "lo_units")),
                # Seconds are fractions, whose sums depend on the order a little.
                *(func.abs(func.sum(_booked_less_summed.c[name])) > 0.001 for name in ("seconds", "active_seconds")),
            )
        ),
    ),
    (
        "What a run has spent is the cost of the answers that count.",
        "run",
        select(runs.c.id).where(runs.c.gold_of.is_(None), runs.c.spent != _answered_units),
    ),
    (
        "A run has spent and reserved no more than its budget.",
        "run",
        select(runs.c.id).where(runs.c.spent + runs.c.reserved > runs.c.budget),
    ),
    (
        "What a run has reserved is for its queries without an answer.",
        "run",
        select(runs.c.id).where(runs.c.reserved != _reserved),
    ),
    (
        "An answer is charged once, and refunded if it is retracted. Late and gold answers cost nothing.",
        "answer",
        select(answers.c.id)
        .join(queries, queries.c.id == answers.c.query_id)
        .join(runs, runs.c.id == queries.c.run_id)
        .where(
            or_(
                _units(ledger.c.answer_id == answers.c.id)
                != case((and_(_counting, runs.c.gold_of.is_(None)), answers.c.units), else_=0),
                _charges != case((or_(answers.c.revision.is_(None), runs.c.gold_of.is_not(None)), 0), else_=1),
            )
        ),
    ),
    (
        "An entry of the ledger has the run, query, kind and episode of its answer.",
        "entry",
        select(ledger.c.id)
        .join(answers, answers.c.id == ledger.c.answer_id)
        .join(queries, queries.c.id == answers.c.query_id)
        .where(
            or_(
                ledger.c.run_id != queries.c.run_id,
                ledger.c.query_id != queries.c.id,
                ledger.c.kind != queries.c.kind,
                ledger.c.episode != queries.c.episode,
            )
        ),
    ),
    (
        "The answer that counts for a query was given to that query, in its present revision.",
        "query",
        select(queries.c.id)
        .join(answers, _counting)
        .where(
            or_(
                answers.c.query_id != queries.c.id,
                answers.c.run_id != queries.c.run_id,
                answers.c.revision.is_distinct_from(queries.c.revision),
            )
        ),
    ),
    (
        "A query is leased exactly as long as one assignment of it is live.",
        "query",
        select(queries.c.id).where(_live != case((queries.c.state == "leased", 1), else_=0)),
    ),
    (
        "An assignment has ended with an answer if it has one that was in time.",
        "assignment",
        select(assignments.c.id)
        .outerjoin(answers, and_(answers.c.assignment_id == assignments.c.id, answers.c.revision.is_not(None)))
        .where((assignments.c.state == "answered") != answers.c.id.is_not(None)),
    ),
    (
        "A finished run has no query without an answer.",
        "run",
        select(runs.c.id)
        .distinct()
        .join(queries, queries.c.run_id == runs.c.id)
        .where(runs.c.state == "finished", IS_UNANSWERED),
    ),
    (
        "A query without an answer has the priority of its run.",
        "query",
        select(queries.c.id)
        .join(runs, runs.c.id == queries.c.run_id)
        .where(IS_UNANSWERED, runs.c.gold_of.is_(None), queries.c.run_priority != runs.c.priority),
    ),
    (
        "An answer that was sent back belongs to the query of the comment, and counts no more.",
        "comment",
        select(comments.c.id)
        .join(answers, answers.c.id == comments.c.answer_id)
        .join(queries, queries.c.id == answers.c.query_id)
        .where(or_(queries.c.id != comments.c.query_id, _counting)),
    ),
    (
        "A deleted run has no content.",
        "run",
        select(runs.c.id).where(
            runs.c.deleted_at.is_not(None),
            or_(
                exists().where(_of_run, queries.c.ask != ""),
                exists().where(answers.c.run_id == runs.c.id, answers.c.content != ""),
                exists().where(comments.c.query_id == queries.c.id, _of_run),
                *(exists().where(table.c.run_id == runs.c.id) for table in (events, episodes, frame_uses)),
            ),
        ),
    ),
    (
        "The pictures that a user has uploaded have the size that the user's quota counts.",
        "user",
        select(users.c.id).where(users.c.frame_bytes != _uploaded),
    ),
    (
        "A user whose personal data were deleted has no credentials and wrote no comments.",
        "user",
        select(users.c.id).where(
            users.c.erased_at.is_not(None),
            or_(*(exists().where(table.c.user_id == users.c.id) for table in (credentials, comments, presence))),
        ),
    ),
    (
        "A gold query is shown in the shadow of its run.",
        "query",
        select(gold_showings.c.query_id.label("id"))
        .join(gold, gold.c.id == gold_showings.c.gold_id)
        .join(queries, queries.c.id == gold_showings.c.query_id)
        .join(_shadow, _shadow.c.id == queries.c.run_id)
        .where(_shadow.c.gold_of.is_distinct_from(gold.c.run_id)),
    ),
    (
        "A second answer is given in the shadow of its query's run.",
        "query",
        select(second_answers.c.query_id.label("id"))
        .join(queries, queries.c.id == second_answers.c.query_id)
        .join(_shadow, _shadow.c.id == queries.c.run_id)
        .where(_shadow.c.gold_of.is_distinct_from(second_answers.c.run_id)),
    ),
)


def check(tx: Tx, noted: audit.Head | None = None) -> list[Result]:
    """Check the whole store, as it was when the transaction began.

    Args:
        tx: reads the store.
        noted: a head of the audit log that was written down earlier.
    """
    of_the_file = _file(tx.conn) if tx.one_writer else []  # PostgreSQL checks its own files and foreign keys
    return [*of_the_file, *_schema(tx.conn), *(_result(tx, *one) for one in CHECKS), _chain(tx.conn, noted)]


def check_file(url: str) -> list[Result]:
    """Return what is wrong with an SQLite file of any version; nothing for PostgreSQL, which checks its own files."""
    store = parse(url)
    if store.get_backend_name() != "sqlite":
        return []
    engine = create_engine(store)
    try:
        with engine.connect() as conn:
            return [one for one in _file(conn) if one.n_faults]
    finally:
        engine.dispose()


def _result(tx: Tx, fact: str, what: str, wrong: Select[Any]) -> Result:
    every = wrong.subquery()
    n = int(tx.conn.execute(select(func.count()).select_from(every)).scalar_one())
    shown = tx.conn.execute(select(every.c.id).order_by(every.c.id).limit(SHOWN)).scalars() if n else ()
    return Result(fact, tuple(f"{what} {one}" for one in shown), n)


def _file(conn: Connection) -> list[Result]:
    damage = [row[0] for row in conn.execute(text("PRAGMA integrity_check")) if row[0] != "ok"]
    lost = [f"{row[0]} {row[1]} has no {row[2]}" for row in conn.execute(text("PRAGMA foreign_key_check"))]
    return [_told("The file is sound.", damage), _told("What a row refers to exists.", lost)]


def _schema(conn: Connection) -> list[Result]:
    context = MigrationContext.configure(conn, opts={"compare_type": True})
    differing = [str(one) for one in compare_metadata(context, metadata)]
    if conn.dialect.name == "sqlite":
        names = "SELECT name FROM sqlite_master WHERE type = 'trigger'"
        guards = {f"{table}_no_{verb}" for table in APPEND_ONLY for verb in ("update", "delete")}
    else:
        names = "SELECT tgname FROM pg_trigger WHERE NOT tgisinternal AND tgenabled = 'O'"
        guards = {f"{table}_append_only" for table in APPEND_ONLY}
    missing = sorted(guards - set(conn.execute(text(names)).scalars()))
    return [
        _told("The tables, columns and indexes are those of this version.", differing),
        _told(
            "No statement can change an answer, an entry of the ledger, an event, a comment or a row of the audit log.",
            missing,
        ),
    ]


def _chain(conn: Connection, noted: audit.Head | None) -> Result:
    """Check the audit log up to the first row that does not fit: after it, every row follows a row that is wrong."""
    fault, newest = audit.first_fault(conn, noted), audit.head(conn)
    faults = () if fault is None else (fault,)
    fact = "The audit log is one chain: no row was changed, removed or inserted."
    return Result(fact, faults, len(faults), None if newest is None else str(newest))


def _told(fact: str, faults: list[str]) -> Result:
    return Result(fact, tuple(faults[:SHOWN]), len(faults))
