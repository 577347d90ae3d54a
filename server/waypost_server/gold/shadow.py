"""The shadow of a run: a row of `runs` that no API call shows, where answers are given that must not touch the run.

Gold queries are answered there, and second answers are given there. The ledger, answers, events and curves belong to
one run each, so those of the run itself contain nothing from its shadow.
"""

import secrets
from typing import Any

from sqlalchemy import Row, bindparam, func, insert, or_, select

from waypost import wire
from waypost_server.db import canonical
from waypost_server.db.prepared import Prepared, Record
from waypost_server.db.tables import queries as query_table
from waypost_server.db.tables import runs as run_table
from waypost_server.db.transaction import Tx

_COPIED = ("user_id", "name", "algorithm", "seed", "vocabulary", "prices")

_own = run_table.alias("own")
_shadow = run_table.alias("shadow")
DUE = Prepared(
    select(_own.c.id.label("run"), _own.c.gold_rate, _own.c.second_answers, _shadow.c.id.label("shadow"))
    .add_columns(query_table.c.episode, query_table.c.ordinal, query_table.c.priority, query_table.c.created_at)
    .join(_own, _own.c.id == query_table.c.run_id)
    .join(_shadow, _shadow.c.gold_of == _own.c.id)
    .where(query_table.c.id == bindparam("query"), or_(_own.c.gold_rate > 0, _own.c.second_answers > 0))
)


def due(tx: Tx, query: int) -> Record | None:
    """Return what the run of a query wants beside answers, its shadow, and the query's place; None if it wants nothing.

    A run without a shadow has no gold query, and no query that waits for a second answer.
    """
    return DUE.first(tx.conn, {"query": query})


def of(tx: Tx, run: str) -> str | None:
    """Return the id of a run's shadow; None if the run never needed one."""
    return tx.conn.execute(select(run_table.c.id).where(run_table.c.gold_of == run)).scalar_one_or_none()


def ensure(tx: Tx, row: Record) -> None:
    """Create the shadow of a locked run, unless there is one."""
    if of(tx, row.id) is not None:
        return
    copied = {name: getattr(row, name) for name in _COPIED}
    # Paused, so that its queries are not handed out like those of a run.
    state = {"state": "finished", "finished_at": tx.now} if row.state == "finished" else {"state": "paused"}
    tx.conn.execute(
        insert(run_table).values(
            id=secrets.token_hex(6),
            gold_of=row.id,
            config="{}",
            spent=0,
            reserved=0,
            created_at=tx.now,
            **copied,
            **state,
        )
    )


def open_query(tx: Tx, shadow: str, ask: wire.Ask, like: Row[Any] | Record) -> int:
    """Create an open query in a locked shadow, and return its id.

    Args:
        tx: the transaction.
        shadow: the id of the shadow.
        ask: the content of the query.
        like: has the priority and the time of the query.
    """
    text = canonical.text(ask.model_dump(mode="json"))
    ordinal = select(func.count()).where(query_table.c.run_id == shadow)
    row = {
        "run_id": shadow,
        "episode": 0,
        "ordinal": tx.conn.execute(ordinal).scalar_one(),
        "kind": ask.kind,
        "state": "open",
        "priority": like.priority,
        "ask": text,
        "digest": canonical.digest(text),
        "reserve": 0,
        "revision": 0,
        "used": False,
        "created_at": like.created_at,
    }
    return int(tx.conn.execute(insert(query_table).values(row).returning(query_table.c.id)).scalar_one())
