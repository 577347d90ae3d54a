"""Gold queries: queries of a run with known answers. They come from answered queries of the run or from a client.

They are answered in the run's shadow (`gold/shadow.py`), so the run itself contains nothing from them.
"""

from dataclasses import dataclass
from typing import Any

from sqlalchemy import ColumnElement, Row, case, func, insert, select, update

from waypost import wire
from waypost_server import errors
from waypost_server.db import canonical
from waypost_server.db.tables import answers, gold, gold_showings, users
from waypost_server.db.tables import queries as query_table
from waypost_server.db.transaction import Tx
from waypost_server.gold import scoring, shadow
from waypost_server.queries import checks, frame_uses
from waypost_server.queries import service as queries
from waypost_server.runs import service as runs


@dataclass(frozen=True)
class Item:
    """A query to make gold, with its known answer, and the query and author that the known answer comes from."""

    ask: wire.Ask
    known: wire.Known
    query: int | None = None
    author: int | None = None


def agreement() -> ColumnElement[float | None]:
    """Return the SQL for the share of right labels in a group of showings; it is null if nothing was answered."""
    n_labels = func.sum(gold_showings.c.n_labels)
    return case((n_labels > 0, func.sum(gold_showings.c.n_right) * 1.0 / n_labels), else_=None)


def add(tx: Tx, run: str, wanted: wire.GoldPost, user: int) -> wire.GoldList:
    """Make queries gold. A query that is already gold stays gold; a retired gold query becomes active again.

    Raises:
        Forbidden: the user may not change the run.
        NotFound, NotAnswered, Unprocessable: a query is not of this run, has no answer, or cannot be gold.
    """
    row = runs.lock_own(tx, run, user)
    names = checks.Names.of(runs.vocabulary_of(row.vocabulary))
    items = [_answered(tx, run, query) for query in wanted.answered]
    for place, one in enumerate(wanted.known):
        at: list[str | int] = ["body", "known", place]
        checks.check_ask(one.ask, names, [*at, "ask"])
        scoring.check(one.ask, one.known, names, [*at, "known"])
        items.append(Item(one.ask, one.known))
    shadow.ensure(tx, row)
    for item in items:
        _store(tx, run, item)
    return of_run(tx, run)


def _answered(tx: Tx, run: str, query: int) -> Item:
    found = tx.conn.execute(
        select(query_table.c.run_id, query_table.c.ask, answers.c.content, answers.c.user_id)
        .outerjoin(answers, answers.c.id == query_table.c.answer_id)
        .where(query_table.c.id == query)
    ).one_or_none()
    if found is None or found.run_id != run:
        raise errors.NotFound(f"The run has no query {query}.")
    if found.content is None:
        raise errors.NotAnswered(f"Query {query} has no answer, so it cannot be gold.")
    known = scoring.exactly(queries.ANSWER.validate_json(found.content))
    return Item(queries.ASK.validate_json(found.ask), known, query, found.user_id)


def _store(tx: Tx, run: str, item: Item) -> None:
    frame_uses.show(tx, run, frame_uses.of_asks([item.ask]))
    ask = canonical.text(item.ask.model_dump(mode="json"))
    digest = canonical.digest(ask)
    same = (gold.c.run_id == run, gold.c.digest == digest)
    if tx.conn.execute(select(gold.c.id).where(*same)).one_or_none() is not None:
        tx.conn.execute(update(gold).where(*same).values(retired_at=None))
        return
    row = {
        "run_id": run,
        "kind": item.ask.kind,
        "ask": ask,
        "accepted": item.known.model_dump_json(),
        "digest": digest,
        "query_id": item.query,
        "author_id": item.author,
        "created_at": tx.now,
    }
    tx.conn.execute(insert(gold).values(row))


def of_run(tx: Tx, run: str) -> wire.GoldList:
    """List a run's gold queries, newest first."""
    runs.find(tx, run)
    rows = tx.conn.execute(
        select(
            gold,
            users.c.name.label("author"),
            func.count(gold_showings.c.n_labels).label("given"),
            agreement().label("agreed"),
        )
        .outerjoin(users, users.c.id == gold.c.author_id)
        .outerjoin(gold_showings, gold_showings.c.gold_id == gold.c.id)
        .where(gold.c.run_id == run, gold.c.retired_at.is_(None))
        .group_by(gold.c.id, users.c.name)
        .order_by(gold.c.id.desc())
    )
    return wire.GoldList(gold=[_of_row(row) for row in rows])


def _of_row(row: Row[Any]) -> wire.Gold:
    ask = queries.ASK.validate_json(row.ask)
    return wire.Gold(
        id=row.id,
        kind=ask.kind,
        question=ask.question,
        known=scoring.KNOWN.validate_json(row.accepted),
        query=row.query_id,
        author=row.author,
        answers=row.given,
        agreement=None if row.agreed is None else float(row.agreed),
        created_at=row.created_at,
    )


def retire(tx: Tx, run: str, item: int, user: int) -> None:
    """Retire a gold query: no annotator gets it any more. Answers to it stay.

    Raises:
        Forbidden: the user may not change the run.
        NotFound: the run has no such gold query.
    """
    runs.lock_own(tx, run, user)
    retired = tx.conn.execute(
        update(gold)
        .where(gold.c.id == item, gold.c.run_id == run, gold.c.retired_at.is_(None))
        .values(retired_at=tx.now)
    )
    if not retired.rowcount:
        raise errors.NotFound(f"The run has no gold query {item}.")
