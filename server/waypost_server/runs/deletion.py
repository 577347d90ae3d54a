"""Deletes what a finished run contains. Its account, its ledger and the numbers of its answers stay.

So all sums stay true: of the run, of its annotators, of the ledger. What goes is what was asked and answered: states,
pictures, questions, answers, comments, reasons, results, events, and the name and the configuration of the run.
"""

from collections.abc import Sequence

from sqlalchemy import Text, cast, func, select, update

from waypost import wire
from waypost.prices import to_units
from waypost_server import errors
from waypost_server.db.audit import COMMAND_LINE, Actor, Entry
from waypost_server.db.functions import DAY
from waypost_server.db.prepared import Record
from waypost_server.db.steps import Step, count, take, take_time
from waypost_server.db.tables import (
    IS_PENDING,
    answers,
    assignments,
    comments,
    deliveries,
    episodes,
    events,
    gold,
    ledger,
    practices,
    predictions,
    queries,
    runs,
)
from waypost_server.db.transaction import Tx
from waypost_server.runs import pictures

_NAMELESS = {"name": "", "config": "{}", "vocabulary": "{}", "result": None}


def preview(tx: Tx, run: Record) -> wire.RunDeletion:
    """Return what the deletion of a run would delete.

    Raises:
        NotFinished: the run is not finished.
    """
    _check_finished(run)
    own = _with_shadow(tx, run.id)
    return _told(tx, run.id, count(tx, _steps(own)), pictures.count(tx, own), dry_run=True)


def delete(tx: Tx, run: Record, by: Actor = COMMAND_LINE) -> wire.RunDeletion:
    """Delete what a locked run and its shadow contain, for good; return what was deleted.

    Raises:
        NotFinished: the run is not finished.
    """
    _check_finished(run)
    take_time(tx)
    own = _with_shadow(tx, run.id)
    # First, because the triggers of answers, events and comments let go only what belongs to a deleted run.
    tx.conn.execute(update(runs).where(runs.c.id.in_(own)).values(deleted_at=tx.now, **_NAMELESS))
    for table in (practices, predictions):
        tx.conn.execute(table.delete().where(table.c.run_id == run.id))
    deleted = _told(tx, run.id, take(tx, _steps(own)), pictures.take(tx, own), dry_run=False)
    sums = {"queries": deleted.queries, "answers": deleted.answers}
    tx.record(Entry(by, "run.deleted", f"run/{run.id}", sums))
    return deleted


def finished_before(tx: Tx, days: float) -> list[str]:
    """Return the runs that finished more than so many days ago and were not deleted, oldest first."""
    old = (runs.c.finished_at < tx.now - days * DAY, runs.c.gold_of.is_(None), runs.c.deleted_at.is_(None))
    return list(tx.conn.execute(select(runs.c.id).where(*old).order_by(runs.c.finished_at)).scalars())


def _check_finished(run: Record) -> None:
    if run.state != "finished":
        raise errors.NotFinished(f"Run {run.id} is {run.state}; finish it before you delete it.")


def _with_shadow(tx: Tx, run: str) -> list[str]:
    shadow = select(runs.c.id).where(runs.c.gold_of == run)
    return [run, *tx.conn.execute(shadow).scalars()]


def _steps(own: Sequence[str]) -> list[Step]:
    of_query = select(queries.c.id).where(queries.c.run_id.in_(own))
    told = assignments.c.reason.is_not(None) | assignments.c.tab.is_not(None)
    known = {"ask": "", "accepted": "", "digest": cast(gold.c.id, Text)}  # the digests of a run are unique
    return [
        Step("queries", queries, queries.c.run_id.in_(own), {"ask": "", "digest": ""}),
        Step("answers", answers, answers.c.run_id.in_(own), {"content": "", "digest": "", "idempotency_key": None}),
        Step("gold", gold, gold.c.run_id.in_(own), known),
        Step("reasons", assignments, assignments.c.query_id.in_(of_query) & told, {"reason": None, "tab": None}),
        Step("comments", comments, comments.c.query_id.in_(of_query)),
        Step("events", events, events.c.run_id.in_(own)),
        Step("episodes", episodes, episodes.c.run_id.in_(own)),
        # Those that wait are still delivered, and forgotten after a while like all others.
        Step("messages", deliveries, deliveries.c.run_id.in_(own) & ~IS_PENDING),
    ]


def _told(tx: Tx, run: str, gone: dict[str, int], shown: tuple[int, int], *, dry_run: bool) -> wire.RunDeletion:
    of_run = select(func.count(), func.coalesce(func.sum(ledger.c.units), 0)).where(ledger.c.run_id == run)
    entries, units = tx.conn.execute(of_run).one()
    frames, frame_bytes = shown
    return wire.RunDeletion(
        run=run,
        dry_run=dry_run,
        frames=frames,
        frame_bytes=frame_bytes,
        kept_entries=entries,
        kept_units=to_units(int(units)),
        **gone,
    )
