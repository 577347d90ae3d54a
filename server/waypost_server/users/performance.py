"""Annotators' performance: number of answers, speed, and accuracy on gold queries. Computed in SQL.

Answers that were retracted do not count, except on gold queries: there the first answer counts, whatever became of it.
"""

import statistics
from collections import defaultdict
from collections.abc import Sequence
from typing import Any

from sqlalchemy import Row, Select, and_, case, func, select

from waypost import wire
from waypost.prices import to_units
from waypost_server.db.functions import DAY
from waypost_server.db.tables import IS_LIVE, answers, assignments, queries, users
from waypost_server.db.transaction import Tx
from waypost_server.gold import results
from waypost_server.gold.results import Results

WEEK_DAYS = 7
RECENT_ANSWERS = 1_000  # in `me`, the median time is over this many newest answers


def me(tx: Tx, user: int) -> wire.Me:
    """Return a user and the totals of their answers."""
    who = tx.conn.execute(select(users).where(users.c.id == user)).one()
    counted = (
        select(answers).join(queries, queries.c.answer_id == answers.c.id).where(answers.c.user_id == user).subquery()
    )
    today = counted.c.created_at >= _midnight(tx)
    total = tx.conn.execute(
        select(
            func.count(),
            func.coalesce(func.sum(counted.c.units), 0),
            func.count().filter(today),
            func.coalesce(func.sum(counted.c.active_seconds).filter(today), 0.0),
        ).select_from(counted)
    ).one()
    newest = select(counted.c.active_seconds).order_by(counted.c.id.desc()).limit(RECENT_ANSWERS)
    recent = tx.conn.execute(newest).scalars().all()
    own = case((assignments.c.user_id == user, 1))
    held, everybody, ends_at = tx.conn.execute(
        select(func.count(own), func.count(), func.min(case((own == 1, assignments.c.expires_at)))).where(
            IS_LIVE, assignments.c.expires_at > tx.now
        )
    ).one()
    return wire.Me(
        id=who.id,
        name=who.name,
        role=who.role,
        answers=total[0],
        answers_today=total[2],
        active_seconds_today=total[3],
        median_seconds=statistics.median(recent) if recent else None,
        units=to_units(int(total[1])),
        held=held,
        held_seconds=None if ends_at is None else ends_at - tx.now,
        held_by_others=everybody - held,
    )


def _by_kind(midnight: float) -> Select[Any]:
    """Return the statement with one row per annotator and kind; `midnight` is when today began (UTC)."""
    mine = (answers.c.user_id, queries.c.kind)
    given = (
        select(answers.c.user_id, queries.c.kind, answers.c.units, answers.c.seconds, answers.c.created_at)
        .add_columns(func.row_number().over(order_by=answers.c.seconds, partition_by=mine).label("rank"))
        .add_columns(func.count().over(partition_by=mine).label("n"))
        .join(queries, queries.c.answer_id == answers.c.id)
        .subquery()
    )
    today, week = given.c.created_at >= midnight, given.c.created_at >= midnight - (WEEK_DAYS - 1) * DAY
    # The median is the mean of these rows: one if the count is odd, two if it is even.
    in_the_middle = and_(2 * given.c.rank >= given.c.n, 2 * given.c.rank <= given.c.n + 2)
    return (
        select(
            given.c.user_id, users.c.name, given.c.kind, func.count().label("n"), func.sum(given.c.units).label("units")
        )
        .add_columns(func.count().filter(today).label("n_today"), _units_where(given, today).label("units_today"))
        .add_columns(func.count().filter(week).label("n_week"), _units_where(given, week).label("units_week"))
        .add_columns(func.avg(case((in_the_middle, given.c.seconds))).label("median"))
        .join(users, users.c.id == given.c.user_id)
        .group_by(given.c.user_id, users.c.name, given.c.kind)
        .order_by(users.c.name, given.c.kind)
    )


def _units_where(given: Any, condition: Any) -> Any:
    return func.coalesce(func.sum(case((condition, given.c.units), else_=0)), 0)


def of_user(tx: Tx, user: int) -> wire.Numbers:
    """Return one annotator's performance; all numbers are 0 before the first answer."""
    return _of_user(tx, user, results.of_user(tx, user))


def of_self(tx: Tx, user: int) -> wire.Numbers:
    """Return the performance that an annotator sees of himself: gold queries are added several at a time."""
    return _of_user(tx, user, results.of_self(tx, user))


def _of_user(tx: Tx, user: int, gold: Results) -> wire.Numbers:
    name = tx.conn.execute(select(users.c.name).where(users.c.id == user)).scalar_one()
    rows = tx.conn.execute(_by_kind(_midnight(tx)).where(users.c.id == user)).all()
    return _numbers(user, name, rows, gold)


def of_everyone(tx: Tx) -> wire.NumbersList:
    """Return the performance of every annotator who ever answered, by name."""
    by_annotator: dict[tuple[int, str], list[Row[Any]]] = defaultdict(list)
    for row in tx.conn.execute(_by_kind(_midnight(tx))):
        by_annotator[row.user_id, row.name].append(row)
    gold = results.of_everyone(tx)
    return wire.NumbersList(
        annotators=[_numbers(user, name, rows, gold.get(user, {})) for (user, name), rows in by_annotator.items()]
    )


def _midnight(tx: Tx) -> float:
    return tx.now - tx.now % DAY


def _numbers(user: int, name: str, rows: Sequence[Row[Any]], gold: Results) -> wire.Numbers:
    in_all = results.total(gold)
    return wire.Numbers(
        user=user,
        name=name,
        total=_tally(rows, "n", "units"),
        today=_tally(rows, "n_today", "units_today"),
        week=_tally(rows, "n_week", "units_week"),
        gold=in_all.answers,
        agreement=in_all.agreement,
        by_kind=[_of_kind(row, gold.get(row.kind, results.NONE)) for row in rows],
    )


def _of_kind(row: Row[Any], gold: results.Result) -> wire.NumbersOfKind:
    return wire.NumbersOfKind(
        kind=row.kind,
        total=_tally([row], "n", "units"),
        median_seconds=row.median,
        gold=gold.answers,
        gold_right=gold.right,
        agreement=gold.agreement,
    )


def _tally(rows: Sequence[Row[Any]], n: str, units: str) -> wire.Tally:
    micro = sum(int(row._mapping[units]) for row in rows)
    return wire.Tally(answers=sum(row._mapping[n] for row in rows), units=to_units(micro))
