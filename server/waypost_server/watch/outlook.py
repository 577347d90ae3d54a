"""What an annotator without a query waits for: what the learner of each run does, and how long that usually takes.

Numbers of open queries are rounded up to tens. Exact ones would tell an annotator which query was gold: after its
answer, as many queries of the run are open as before.
"""

import json
import statistics
from collections.abc import Iterator, Sequence
from itertools import islice
from typing import Any

from sqlalchemy import Row, case, func, select

from waypost import wire
from waypost_server.db.tables import IS_UNANSWERED, events, queries, runs
from waypost_server.db.transaction import Tx
from waypost_server.runs.service import vocabulary_of

MOST_RUNS = 6
MOST_EVENTS = 1_000  # of a run, newest first, from which its waits and its kinds of query are known
MOST_WAITS = 20  # the newest ones, of which the median is taken
MOST_DEMONSTRATIONS = 20  # the newest ones, of which it is known how they were asked for
MOST_OPEN = 1_000  # more queries are not counted

_OF_LEARNER = ("asked", "used", "episode")  # changes that a learner makes; others end a run, or pause it
_ORDER = case((runs.c.state == "running", 0), (runs.c.state == "paused", 1), else_=2)


def outlook(tx: Tx, run: str | None) -> wire.Outlook:
    """Return the runs of this server, those first that may ask next; `run` comes before all others."""
    chosen = select(runs).where(runs.c.gold_of.is_(None), runs.c.deleted_at.is_(None)).limit(MOST_RUNS)
    order: list[Any] = [_ORDER, runs.c.created_at.desc()]
    if run is not None:
        order.insert(0, case((runs.c.id == run, 0), else_=1))
    return wire.Outlook(
        open=_tens(_count(tx, runs.c.state == "running", runs.c.gold_of.is_(None))),
        runs=[_of_run(tx, row) for row in tx.conn.execute(chosen.order_by(*order))],
    )


def _of_run(tx: Tx, row: Row[Any]) -> wire.RunOutlook:
    latest = select(events).where(events.c.run_id == row.id).order_by(events.c.id.desc()).limit(MOST_EVENTS)
    changes = tx.conn.execute(latest).all()
    n_open = _count(tx, runs.c.id == row.id)
    waits = list(islice(_waits(changes, n_open), MOST_WAITS))
    names = vocabulary_of(row.vocabulary)
    asked = [json.loads(change.data) for change in changes if change.event == "asked"]
    kinds = {one["kind"] for one in asked}
    demonstrations = [one["query"] for one in asked if one["kind"] == "hier_demo"][:MOST_DEMONSTRATIONS]
    return wire.RunOutlook(
        run=row.id,
        name=row.name,
        domain=names.domain,
        kinds=[kind for kind in wire.KINDS if kind in kinds],
        demonstrations=_forms(tx, demonstrations),
        doing=_doing(row.state, n_open, changes),
        seconds=max(0.0, tx.now - changes[0].created_at) if changes else 0.0,
        usual_seconds=statistics.median(waits) if waits else None,
        open=_tens(n_open),
    )


def _forms(tx: Tx, asked: Sequence[int]) -> list[wire.DemoForm]:
    """Return how demonstrations were asked for."""
    found = tx.conn.execute(select(queries.c.ask).where(queries.c.id.in_(asked))).scalars()
    forms = {_form(wire.AskHierDemo.model_validate_json(one)) for one in found}
    return [form for form in wire.DEMO_FORMS if form in forms]


def _form(ask: wire.AskHierDemo) -> wire.DemoForm:
    if ask.flat:
        return "flat_demo"
    return "play_on" if ask.context else "hier_demo"


def _count(tx: Tx, *conditions: Any) -> int:
    """Return how many queries are unanswered, leased ones included, in the runs that fit."""
    found = select(queries.c.id).join(runs, runs.c.id == queries.c.run_id).where(IS_UNANSWERED, *conditions)
    return int(tx.conn.execute(select(func.count()).select_from(found.limit(MOST_OPEN).subquery())).scalar_one())


def _tens(n: int) -> int:
    return -(-n // 10) * 10


def _doing(state: str, n_open: int, changes: Sequence[Row[Any]]) -> wire.Doing:
    """Return what a learner does, by the state of its run and the newest change."""
    if state != "running":
        return "finished" if state == "finished" else "paused"
    if n_open > 0:
        return "asking"
    if not any(change.event in _OF_LEARNER for change in changes):
        return "nothing_yet"
    return "training" if changes and changes[0].event in ("answered", "used") else "rolling_out"


def _waits(changes: Sequence[Row[Any]], n_open: int) -> Iterator[float]:
    """Yield how long annotators waited each time that no query was open, the last time first.

    The changes come newest first. `n_open` is the number of unanswered queries, at first now, then before each change.
    """
    asked_at: float | None = None  # when a query ended the wait whose begin is still sought
    for change in changes:
        if change.event == "asked":
            n_open = max(0, n_open - 1)
            asked_at = change.created_at if n_open == 0 else None
        elif change.event == "answered":
            if n_open == 0 and asked_at is not None:
                yield asked_at - change.created_at
            n_open, asked_at = n_open + 1, None
        elif change.event == "retracted":
            n_open = max(0, n_open - 1)
        elif change.event in ("run", "cancelled"):
            asked_at = None  # a pause is not the learner's work
            if change.event == "cancelled":
                n_open += json.loads(change.data)["queries"]
