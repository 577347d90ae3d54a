"""Creates, changes and finishes runs. A run is one learner's training, with its state and its account."""

import json
import re
import secrets
from functools import lru_cache
from typing import Any

from sqlalchemy import Float, Select, bindparam, cast, func, insert, select, update

from waypost import wire
from waypost.prices import to_micro, to_units
from waypost_server import errors
from waypost_server.auth import access
from waypost_server.db import canonical, wakeups
from waypost_server.db.prepared import Prepared, Record
from waypost_server.db.tables import IS_LIVE, IS_UNANSWERED, assignments, episodes, queries, runs
from waypost_server.db.transaction import Tx
from waypost_server.runs import events, ledger
from waypost_server.runs.ledger import Account

TRAILING = 100  # the success rate is over this many test episodes
_ID = re.compile(r"[0-9a-f]{12}", re.ASCII)

_recent = (
    select(cast(episodes.c.test_success.cast(runs.c.episodes.type), Float).label("passed"))
    .where(episodes.c.run_id == runs.c.id, episodes.c.test_success.is_not(None))
    .order_by(episodes.c.episode.desc())
    .limit(TRAILING)
    .correlate(runs)
    .subquery()
)
_success_rate = select(func.avg(_recent.c.passed)).scalar_subquery()
_episodes_done = select(func.count()).where(episodes.c.run_id == runs.c.id).correlate(runs).scalar_subquery()
_open_queries = (
    select(func.count()).where(queries.c.run_id == runs.c.id, IS_UNANSWERED).correlate(runs).scalar_subquery()
)

RUNS: Select[Any] = select(
    runs,
    _success_rate.label("success_rate"),
    _episodes_done.label("episodes_done"),
    _open_queries.label("open_queries"),
).where(runs.c.gold_of.is_(None), runs.c.deleted_at.is_(None))


def answers_topic(run: str) -> str:
    """Return the topic that a new answer in a run wakes."""
    return f"answers:{run}"


@lru_cache(maxsize=256)
def vocabulary_of(stored: str) -> wire.Vocabulary:
    """Return a stored vocabulary. Callers share it, so nobody changes it."""
    return wire.Vocabulary.model_validate_json(stored)


@lru_cache(maxsize=256)
def prices_of(stored: str) -> wire.Prices:
    """Return stored prices. Callers share them, so nobody changes them."""
    return wire.Prices.model_validate_json(stored)


def of_row(row: Record) -> wire.Run:
    """Return the message for a row of `RUNS`."""
    return wire.Run(
        id=row.id,
        name=row.name,
        algorithm=row.algorithm,
        seed=row.seed,
        state=row.state,
        vocabulary=vocabulary_of(row.vocabulary),
        config=json.loads(row.config),
        prices=prices_of(row.prices),
        budget=None if row.budget is None else to_units(row.budget),
        reserved=to_units(row.reserved),
        spent=to_units(row.spent),
        episodes=row.episodes,
        priority=row.priority,
        episodes_done=row.episodes_done,
        success_rate=row.success_rate,
        open_queries=row.open_queries,
        gold_rate=row.gold_rate,
        second_answers=row.second_answers,
        result=None if row.result is None else json.loads(row.result),
        created_at=row.created_at,
        finished_at=row.finished_at,
    )


_OF_ID = select(runs).where(runs.c.id == bindparam("run"), runs.c.deleted_at.is_(None))
FIND = Prepared(_OF_ID)
_FIND_ACCOUNT = Prepared(select(runs).where(runs.c.id == bindparam("run")))
# With `key_share`, whoever inserts a row that refers to this one does not have to wait (decision 43).
LOCK = Prepared(_OF_ID.with_for_update(key_share=True))
_VIEW = Prepared(RUNS.where(runs.c.id == bindparam("run")))


def is_id(text: str) -> bool:
    """Return whether a text that a client sent can be the id of a run. PostgreSQL does not take every text."""
    return _ID.fullmatch(text) is not None


def _one(tx: Tx, statement: Prepared, run: str) -> Record:
    return existing(run, statement.first(tx.conn, {"run": run}) if is_id(run) else None)


def existing(run: str, row: Record | None) -> Record:
    """Return the row of a run, which is None if it was deleted or never existed.

    Raises:
        NotFound: there is no such run.
    """
    if row is None:
        raise errors.NotFound(f"There is no run {run!r}.")
    return row


def find(tx: Tx, run: str) -> Record:
    """Return a run's row.

    Raises:
        NotFound: there is no such run.
    """
    return _one(tx, FIND, run)


def find_account(tx: Tx, run: str) -> Record:
    """Return a run's row, also of a deleted run, of which only the account and the ledger are left.

    Raises:
        NotFound: there is no such run.
    """
    return _one(tx, _FIND_ACCOUNT, run)


def lock(tx: Tx, run: str) -> Record:
    """Return a run's row, locked, so that its account, answers and events change in one transaction at a time."""
    return _one(tx, LOCK, run)


def lock_own(tx: Tx, run: str, user: int) -> Record:
    """Return a run's row, locked, to a user who may change the run: its owner or an administrator.

    Raises:
        NotFound: there is no such run.
        Unauthenticated, Forbidden: the user may not change the run, or no longer.
    """
    role = access.check_still(tx, access.OWN_RUN, user)
    row = lock(tx, run)
    access.check_owner(tx, run, row.user_id, user, role)
    return row


def find_own(tx: Tx, run: str, user: int, role: wire.Role) -> Record:
    """Return a run's row to a user who may change the run, without locking it: for operations that only read.

    Raises:
        NotFound: there is no such run.
        Forbidden: the user may not change the run.
    """
    row = find(tx, run)
    access.check_owner(tx, run, row.user_id, user, role)
    return row


def account(row: Record) -> Account:
    """Return the account of a locked run."""
    return Account(row.id, row.budget, row.spent, row.reserved)


def view(tx: Tx, run: str) -> wire.Run:
    """Return a run.

    Raises:
        NotFound: there is no such run.
    """
    return of_row(_one(tx, _VIEW, run))


def create(tx: Tx, wanted: wire.RunCreate, user: int) -> wire.Run:
    """Create a run.

    Raises:
        Unprocessable: a subgoal or an action is named twice.
    """
    for field in ("subgoals", "actions"):
        names = getattr(wanted.vocabulary, field)
        if len(set(names)) != len(names):
            raise errors.Unprocessable(["body", "vocabulary", field], "has the same name twice")
    run = secrets.token_hex(6)
    tx.conn.execute(
        insert(runs).values(
            id=run,
            user_id=user,
            name=wanted.name,
            algorithm=wanted.algorithm,
            seed=wanted.seed,
            state="running",
            vocabulary=wanted.vocabulary.model_dump_json(),
            config=canonical.text(wanted.config),
            prices=wanted.prices.model_dump_json(),
            budget=None if wanted.budget is None else to_micro(wanted.budget),
            spent=0,
            reserved=0,
            episodes=wanted.episodes,
            second_answers=wanted.second_answers,
            created_at=tx.now,
        )
    )
    events.add(tx, run, "run", {"state": "running"})
    events.announce(tx, "run.state", run, {"name": wanted.name, "state": "running"})
    return view(tx, run)


def patch(tx: Tx, run: str, wanted: wire.RunPatch, user: int) -> wire.Run:
    """Change a run. Absent fields change nothing; an explicit null removes the budget or the result.

    Raises:
        NotFound: there is no such run.
        Forbidden: the user may not change the run.
        RunFinished: a finished run cannot be resumed.
        BudgetTooLow: the budget is below the units spent and reserved.
    """
    row = lock_own(tx, run, user)
    sent = wanted.model_fields_set
    changes: dict[str, Any] = {}
    if wanted.name is not None:
        changes["name"] = wanted.name
    if "result" in sent:
        changes["result"] = None if wanted.result is None else canonical.text(wanted.result)
    if wanted.priority is not None and wanted.priority != row.priority:
        changes["priority"] = wanted.priority
        unanswered = (queries.c.run_id == run, IS_UNANSWERED)  # others get it if they reopen
        tx.conn.execute(update(queries).where(*unanswered).values(run_priority=wanted.priority))
    if "budget" in sent:
        changes["budget"] = _checked_budget(row, wanted.budget)
    if wanted.gold_rate is not None:
        changes["gold_rate"] = wanted.gold_rate
    if wanted.second_answers is not None:
        changes["second_answers"] = wanted.second_answers
    if wanted.state is not None and wanted.state != row.state:
        changes |= _new_state(tx, row, wanted.state)
    if changes:
        tx.conn.execute(update(runs).where(runs.c.id == run).values(**changes))
        events.add(tx, run, "run", {"state": changes.get("state", row.state)})
        if "state" in changes:
            name = changes.get("name", row.name)
            events.announce(tx, "run.state", run, {"name": name, "state": changes["state"]})
    return view(tx, run)


def _checked_budget(row: Record, budget: float | None) -> int | None:
    if budget is None:
        return None
    committed = row.spent + row.reserved
    if to_micro(budget) < committed:
        spent, reserved = to_units(row.spent), to_units(row.reserved)
        raise errors.BudgetTooLow(
            f"{spent:g} units are spent and {reserved:g} reserved for open queries; the budget cannot be less than "
            f"{to_units(committed):g}. Finish the run to release the reserved units.",
            spent=spent,
            reserved=reserved,
        )
    return to_micro(budget)


def _new_state(tx: Tx, row: Record, state: wire.RunState) -> dict[str, Any]:
    if row.state == "finished":
        raise errors.RunFinished("A finished run cannot be resumed; start a new run.")
    if state == "finished":
        _cancel_open(tx, row.id)
        _finish_shadow(tx, row.id)
        return {"state": state, "finished_at": tx.now}
    tx.wake(wakeups.QUEUE)
    return {"state": state}


def _finish_shadow(tx: Tx, run: str) -> None:
    """Finish the run's shadow too, and cancel its open gold queries."""
    row = tx.conn.execute(select(runs.c.id).where(runs.c.gold_of == run).with_for_update(key_share=True)).one_or_none()
    if row is not None:
        _cancel_open(tx, row.id)
        tx.conn.execute(update(runs).where(runs.c.id == row.id).values(state="finished", finished_at=tx.now))


def _cancel_open(tx: Tx, run: str) -> None:
    """Cancel the queries without an answer and release the units reserved for them."""
    waiting = select(queries.c.id, queries.c.reserve).where(queries.c.run_id == run, IS_UNANSWERED)
    rows = tx.conn.execute(waiting.with_for_update(key_share=True)).all()
    if not rows:
        return
    ids = select(queries.c.id).where(queries.c.run_id == run, queries.c.state == "cancelled")
    tx.conn.execute(update(queries).where(queries.c.run_id == run, IS_UNANSWERED).values(state="cancelled"))
    tx.conn.execute(
        update(assignments).where(assignments.c.query_id.in_(ids), IS_LIVE).values(state="cancelled", ended_at=tx.now)
    )
    ledger.release(tx, run, sum(row.reserve for row in rows))
    events.add(tx, run, "cancelled", {"queries": len(rows)})
    tx.wake(answers_topic(run), *(f"query:{row.id}" for row in rows))
