"""Recreates a finished run of another store from its records, in one transaction: all of it or nothing.

The rows go into the same tables, under the same constraints, as the rows of a run that was made here. Only the path is
another: the answers come with the assignments under which they were given, so nothing is leased and nothing is charged
anew. At the end the ledger must agree with the answers, and the run with its record.
"""

import json
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from itertools import groupby, islice
from typing import Any, TypeVar

from sqlalchemy import and_, func, insert, select
from sqlalchemy.exc import IntegrityError

from waypost import wire
from waypost.prices import to_micro
from waypost_server import errors
from waypost_server.db import canonical
from waypost_server.db.tables import answers, episodes, queries
from waypost_server.db.tables import ledger as ledger_table
from waypost_server.db.tables import runs as run_table
from waypost_server.db.transaction import Tx
from waypost_server.errors import Location, Unprocessable
from waypost_server.queries import checks, frames
from waypost_server.queries.service import has_key
from waypost_server.runs import events, ledger
from waypost_server.runs import service as runs
from waypost_server.watch.records.query_insertion import FindAnnotator, Target, insert_queries

AT_ONCE = 200  # records that are inserted with one statement
MOST_FRAME_BYTES = 2**23

R = TypeVar("R")


def restore(tx: Tx, records: Iterable[wire.Record], owner: int, find_annotator: FindAnnotator) -> wire.Run:
    """Recreate a run and return it. It stays finished, so it can spend nothing more.

    Args:
        tx: the transaction.
        records: the run first, then its queries (each after the frames that it shows), its ledger and its episodes.
        owner: the user who imports it.
        find_annotator: returns the id of an annotator by name; it may create a user.

    Raises:
        RunExists: the store has this run.
        Unprocessable: the run is not finished, a record is not valid, or the records contradict each other.
    """
    stream = iter(records)
    first = next(stream, None)
    if not isinstance(first, wire.RunRecord):
        raise Unprocessable(["records", 0], "is not the run: the first record must be the run")
    target = _create(tx, first.run, owner, find_annotator)
    try:
        for kind, some in groupby(stream, key=type):
            for batch in _batches(some):
                _store(tx, target, kind, batch)
    except IntegrityError as error:
        cause = str(error.orig).strip().partition("\n")[0]
        raise Unprocessable(["records"], f"contradict each other or come twice ({cause})") from error
    _check_ledger(tx, target)
    _check_run(tx, target)
    events.add(tx, target.run.id, "run", {"state": "finished", "imported": True})
    return target.run


def _batches(records: Iterator[R]) -> Iterator[list[R]]:
    while batch := list(islice(records, AT_ONCE)):
        yield batch


def _create(tx: Tx, run: wire.Run, owner: int, find_annotator: FindAnnotator) -> Target:
    if run.state != "finished":
        raise Unprocessable(["run", "state"], f"is {run.state}; finish the run and export it again")
    if tx.conn.execute(select(run_table.c.id).where(run_table.c.id == run.id)).one_or_none() is not None:
        raise errors.RunExists(f"The store already has run {run.id}; import it into another store, or keep this one.")
    tx.conn.execute(
        insert(run_table).values(
            id=run.id,
            user_id=owner,
            name=run.name,
            algorithm=run.algorithm,
            seed=run.seed,
            state=run.state,
            vocabulary=run.vocabulary.model_dump_json(),
            config=canonical.text(run.config),
            prices=run.prices.model_dump_json(),
            budget=None if run.budget is None else to_micro(run.budget),
            spent=0,
            reserved=0,
            episodes=run.episodes,
            priority=run.priority,
            result=None if run.result is None else canonical.text(run.result),
            created_at=run.created_at,
            finished_at=run.finished_at,
            gold_rate=run.gold_rate,
            second_answers=run.second_answers,
        )
    )
    return Target(run, checks.Names.of(run.vocabulary), find_annotator)


def _store(tx: Tx, target: Target, kind: type, batch: Sequence[Any]) -> None:
    if kind not in _PARTS:
        raise Unprocessable(["records"], "have the run twice; one file holds one run")
    _PARTS[kind](tx, target, batch)


def _frames(tx: Tx, _: Target, records: Sequence[wire.FrameRecord]) -> None:
    frames.store(tx, frames.decode((record.frame for record in records), MOST_FRAME_BYTES))


# --- ledger and episodes


def _ledger(tx: Tx, target: Target, records: Sequence[wire.LedgerRecord]) -> None:
    keys = {(record.episode, record.ordinal) for record in records}
    found = tx.conn.execute(
        select(
            queries.c.episode, queries.c.ordinal, queries.c.kind, answers.c.revision, answers.c.query_id, answers.c.id
        )
        .join(answers, answers.c.query_id == queries.c.id)
        .where(queries.c.run_id == target.run.id, has_key(keys))
    )
    known = {(row.episode, row.ordinal, row.kind, row.revision): row for row in found}
    rows = []
    for record in records:
        answer = known.get((record.episode, record.ordinal, record.kind, record.revision))
        if answer is None:
            at: Location = ["episode", record.episode, "query", record.ordinal, "ledger"]
            raise Unprocessable(at, f"has a {record.entry} of {record.units:g} units, but there is no such answer")
        rows.append(
            {
                "run_id": target.run.id,
                "query_id": answer.query_id,
                "answer_id": answer.id,
                "entry": record.entry,
                "kind": record.kind,
                "episode": record.episode,
                "units": to_micro(record.units),
                "lo_units": to_micro(record.lo_units),
                "seconds": record.seconds,
                "active_seconds": record.active_seconds,
                "created_at": record.at,
            }
        )
    ledger.restore(tx, target.run.id, rows)


def _episodes(tx: Tx, target: Target, records: Sequence[wire.EpisodeRecord]) -> None:
    rows = [
        {
            "run_id": target.run.id,
            "episode": record.result.episode,
            "test_success": record.result.test_success,
            "result": canonical.text(record.result.model_dump(mode="json")),
            "created_at": record.at,
        }
        for record in records
    ]
    tx.conn.execute(insert(episodes), rows)


_PARTS: Mapping[type, Callable[[Tx, Target, Any], None]] = {
    wire.FrameRecord: _frames,
    wire.QueryRecord: insert_queries,
    wire.LedgerRecord: _ledger,
    wire.EpisodeRecord: _episodes,
}


# --- checks of the whole run


def _check_ledger(tx: Tx, target: Target) -> None:
    """Require one charge for each answer that was in time, and a refund for each that no longer counts."""
    charge, refund = ledger_table.alias("charge"), ledger_table.alias("refund")
    counts = func.coalesce(queries.c.answer_id, 0) == answers.c.id
    unpaid = charge.c.id.is_(None) | (charge.c.units != answers.c.units)
    kept = refund.c.id.is_(None) | (refund.c.units != -answers.c.units)
    wrong = unpaid | (counts & refund.c.id.is_not(None)) | (~counts & kept)
    found = tx.conn.execute(
        select(queries.c.episode, queries.c.ordinal)
        .select_from(answers)
        .join(queries, queries.c.id == answers.c.query_id)
        .outerjoin(charge, and_(charge.c.answer_id == answers.c.id, charge.c.entry == "charge"))
        .outerjoin(refund, and_(refund.c.answer_id == answers.c.id, refund.c.entry == "refund"))
        .where(answers.c.run_id == target.run.id, answers.c.revision.is_not(None), wrong)
        .order_by(queries.c.episode, queries.c.ordinal)
        .limit(1)
    ).one_or_none()
    if found is not None:
        raise Unprocessable(["episode", found.episode, "query", found.ordinal], "the ledger disagrees with its answers")


def _check_run(tx: Tx, target: Target) -> None:
    """Require that the run looks as its record says. Otherwise records are missing."""
    made, told = (json.loads(run.model_dump_json()) for run in (runs.view(tx, target.run.id), target.run))
    for name, value in told.items():
        if made[name] != value:
            raise Unprocessable(["run", name], f"is {value}, but the records give {made[name]}; is the file complete?")
