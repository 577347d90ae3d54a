"""The table of a run's queries, without their trajectories."""

import json
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from sqlalchemy import ColumnElement, Row, Select, and_, exists, func, or_, select
from sqlalchemy.sql.selectable import FromClause

from waypost import wire
from waypost.prices import to_units
from waypost_server.db.functions import json_text
from waypost_server.db.tables import (
    DIFFERS,
    IS_LIVE,
    answers,
    assignments,
    comments,
    gold_showings,
    predictions,
    queries,
    users,
)
from waypost_server.db.transaction import Tx
from waypost_server.gold import second, shadow
from waypost_server.queries.service import ANSWER, place_of
from waypost_server.runs import service as runs
from waypost_server.watch.row_pages import RowPage


@dataclass(frozen=True)
class QueryFilter:
    """The filter of a run's queries."""

    state: wire.QueryState | None = None
    kind: wire.Kind | None = None
    episode: int | None = None
    annotator: str | None = None
    text: str = ""  # each of its words is in the question, a comment, a reason to skip, or the annotator's name
    disagrees: wire.Disagreement | None = None  # only answers that differ from this


_annotator = users.alias("annotator")
_holder = users.alias("holder")
_past = assignments.alias("past")


_FROM = (
    queries.outerjoin(answers, answers.c.id == queries.c.answer_id)
    .outerjoin(_annotator, _annotator.c.id == answers.c.user_id)
    .outerjoin(assignments, and_(assignments.c.query_id == queries.c.id, IS_LIVE))
    .outerjoin(_holder, _holder.c.id == assignments.c.user_id)
)
_ROWS: Select[Any] = select(
    queries,
    answers.c.content,
    answers.c.units,
    answers.c.seconds,
    answers.c.created_at.label("answered_at"),
    func.coalesce(_annotator.c.name, _holder.c.name).label("annotator"),
).select_from(_FROM)


def query_page(tx: Tx, run: str, chosen: QueryFilter, page: RowPage) -> wire.QueryPage:
    """Return one page of a run's queries, newest first."""
    runs.find(tx, run)
    # Gold queries are answered in the run's shadow, and no other filter finds them.
    conditions = _query_conditions(shadow.of(tx, run) if chosen.disagrees == "gold" else run, chosen)
    if chosen.disagrees == "second":
        conditions.append(queries.c.id.in_(second.disagreeing(tx, run)))
    counted = select(func.count(), func.max(queries.c.id), func.min(queries.c.id)).where(*conditions)
    joined: FromClause = _FROM if chosen.annotator is not None or chosen.text else queries
    total, newest, oldest = tx.conn.execute(counted.select_from(joined)).one()
    # Their ids alone at first: otherwise, all that fit would be read as a whole before they are sorted.
    chosen_ids = page.of(
        select(queries.c.id).select_from(joined).where(*conditions), place_of(chosen.state, chosen.episode)
    )
    ids = tx.conn.execute(chosen_ids).scalars().all()
    rows = {row.id: row for row in tx.conn.execute(_ROWS.where(queries.c.id.in_(ids)))}
    endings = _endings(tx, ids)
    shown = [_query_row(rows[one], endings) for one in page.in_order(ids)]
    return wire.QueryPage(rows=shown, total=total, newest=newest, oldest=oldest)


def _query_conditions(run: str | None, chosen: QueryFilter) -> list[ColumnElement[bool]]:
    conditions: list[ColumnElement[bool]] = [queries.c.run_id == run]
    if chosen.state is not None:
        conditions.append(queries.c.state == chosen.state)
    if chosen.kind is not None:
        conditions.append(queries.c.kind == chosen.kind)
    if chosen.episode is not None:
        conditions.append(queries.c.episode == chosen.episode)
    if chosen.annotator is not None:
        conditions.append(or_(_annotator.c.name == chosen.annotator, _holder.c.name == chosen.annotator))
    conditions.extend(_has_word(word) for word in chosen.text.lower().split())
    if chosen.disagrees == "suggestion":
        conditions.append(DIFFERS)
    if chosen.disagrees == "policy":
        unlike = select(predictions.c.query_id).where(predictions.c.run_id == run, predictions.c.differs)
        conditions.append(queries.c.id.in_(unlike))
    if chosen.disagrees == "gold":
        wrong = (gold_showings.c.query_id == queries.c.id, gold_showings.c.n_right < gold_showings.c.n_labels)
        conditions.append(exists().where(*wrong))
    return conditions


def _has_word(word: str) -> ColumnElement[bool]:
    def has(place: ColumnElement[Any]) -> ColumnElement[bool]:
        return func.lower(place).contains(word, autoescape=True)

    places = (json_text(queries.c.ask, "question"), _annotator.c.name, _holder.c.name)
    commented = exists().where(comments.c.query_id == queries.c.id, has(comments.c.text))
    skipped = exists().where(_past.c.query_id == queries.c.id, has(_past.c.reason))
    return or_(*map(has, places), commented, skipped)


def _endings(tx: Tx, ids: Sequence[int]) -> dict[tuple[int, str], int]:
    """Return how many assignments of these queries ended in each way."""
    counted = (
        select(assignments.c.query_id, assignments.c.state, func.count())
        .where(assignments.c.query_id.in_(ids))
        .group_by(assignments.c.query_id, assignments.c.state)
    )
    return {(row[0], row[1]): row[2] for row in tx.conn.execute(counted)}


def _query_row(row: Row[Any], endings: dict[tuple[int, str], int]) -> wire.QueryRow:
    return wire.QueryRow(
        id=row.id,
        episode=row.episode,
        ordinal=row.ordinal,
        kind=row.kind,
        state=row.state,
        priority=row.priority,
        question=json.loads(row.ask)["question"],
        created_at=row.created_at,
        answered_at=row.answered_at,
        answer=None if row.content is None else ANSWER.validate_json(row.content),
        used=row.used,
        annotator=row.annotator,
        units=None if row.units is None else to_units(row.units),
        seconds=row.seconds,
        skips=endings.get((row.id, "skipped"), 0),
        expiries=endings.get((row.id, "expired"), 0),
    )
