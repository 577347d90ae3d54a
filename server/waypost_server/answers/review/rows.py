"""The answers of a run under review: the table of its answered queries, with what each answer is compared with."""

from collections.abc import Mapping, Sequence
from dataclasses import replace

from sqlalchemy import select

from waypost import wire
from waypost.prices import to_units
from waypost_server.answers.review import predictions
from waypost_server.db.tables import gold, gold_showings, queries
from waypost_server.db.transaction import Tx
from waypost_server.gold import scoring
from waypost_server.gold.second import PAIRS
from waypost_server.queries.service import ANSWER
from waypost_server.watch.query_rows import QueryFilter, query_page
from waypost_server.watch.row_pages import RowPage


def review_page(tx: Tx, run: str, chosen: QueryFilter, page: RowPage) -> wire.ReviewPage:
    """Return one page of a run's answered queries, newest first."""
    found = query_page(tx, run, replace(chosen, state="answered"), page)
    ids = [row.id for row in found.rows]
    differing, known, twice = _differing(tx, ids), _known(tx, ids), _second(tx, ids)
    predicted = predictions.of(tx, ids)
    rows = [
        wire.ReviewRow(
            query=row,
            differs=differing[row.id],
            policy=predicted.get(row.id),
            gold=None if row.id not in known or row.answer is None else scoring.marks(known[row.id], row.answer),
            second=twice.get(row.id),
        )
        for row in found.rows
    ]
    return wire.ReviewPage(rows=rows, total=found.total, newest=found.newest, oldest=found.oldest)


def _differing(tx: Tx, ids: Sequence[int]) -> Mapping[int, bool | None]:
    rows = tx.conn.execute(select(queries.c.id, queries.c.differs).where(queries.c.id.in_(ids)))
    return {row.id: row.differs for row in rows}


def _known(tx: Tx, ids: Sequence[int]) -> Mapping[int, wire.Known]:
    """Return the known answers of those queries that are gold."""
    accepted = (
        select(gold_showings.c.query_id, gold.c.accepted)
        .join(gold, gold.c.id == gold_showings.c.gold_id)
        .where(gold_showings.c.query_id.in_(ids))
    )
    return {row.query_id: scoring.KNOWN.validate_json(row.accepted) for row in tx.conn.execute(accepted)}


def _second(tx: Tx, ids: Sequence[int]) -> Mapping[int, wire.SecondAnswer]:
    """Return the second answers to those queries that have one."""
    return {
        row.id: wire.SecondAnswer(
            annotator=row.annotator,
            answer=ANSWER.validate_json(row.second),
            units=to_units(row.units),
            seconds=row.seconds,
        )
        for row in tx.conn.execute(PAIRS.where(queries.c.id.in_(ids)))
    }
