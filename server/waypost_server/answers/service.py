"""Answering: check, store, charge and close in one unit of work; and taking an answer back.

A late answer is refused, but kept: it is stored without a revision, so it never counts and costs nothing. The refusal
is therefore part of the outcome rather than an exception, which would undo the storing.
"""

from dataclasses import dataclass
from typing import Any

from sqlalchemy import Row, bindparam, insert, select, update

from waypost import prices as pricing
from waypost import wire
from waypost.prices import Cost, to_units
from waypost_server import errors
from waypost_server.db import canonical
from waypost_server.db.engine import Tx
from waypost_server.db.tables import IS_LIVE, answers, assignments
from waypost_server.db.tables import ledger as ledger_table
from waypost_server.db.tables import queries as query_table
from waypost_server.gold import schedule
from waypost_server.leases import active_time
from waypost_server.leases import service as leases
from waypost_server.queries import checks
from waypost_server.queries import service as queries
from waypost_server.runs import events, ledger
from waypost_server.runs import service as runs
from waypost_server.runs.ledger import Entry
from waypost_server.settings import Settings


@dataclass(frozen=True)
class Post:
    """An answer as it was sent."""

    assignment: int
    user: int
    token: str
    answer: wire.Answer
    key: str | None
    idle_seconds: float


@dataclass(frozen=True)
class Outcome:
    """What became of an answer."""

    given: wire.Receipt | None
    refusal: errors.Refusal | None = None

    def receipt(self) -> wire.Receipt:
        """Return the receipt, or raise the refusal that was committed."""
        if self.refusal is not None or self.given is None:
            raise self.refusal or errors.StorageFailed("There is no receipt.")
        return self.given


@dataclass(frozen=True)
class Case:
    """Everything an answer is judged by, with its run and query locked."""

    held: leases.Held
    run: Row[Any]
    query: Row[Any]
    ask: wire.Ask
    text: str
    digest: str


_LOCK_QUERY = select(query_table).where(query_table.c.id == bindparam("query")).with_for_update()
_GIVEN = select(answers).where(answers.c.assignment_id == bindparam("assignment"))
_INSERT = insert(answers).returning(answers)
_END = (
    update(assignments)
    .where(assignments.c.id == bindparam("assignment"))
    .values(state="answered", ended_at=bindparam("now"))
)
_CLOSE = (
    update(query_table)
    .where(query_table.c.id == bindparam("query"))
    .values(state="answered", answer_id=bindparam("answer"))
)


def answer(tx: Tx, post: Post, wish: leases.Wish | None) -> Outcome:
    """Take an answer, and lease the annotator's next query if there is one now."""
    case = _open(tx, post)
    _refuse_reused_key(tx, post, case)
    earlier = tx.conn.execute(_GIVEN, {"assignment": post.assignment}).one_or_none()
    if earlier is not None:
        return _again(tx, case, earlier, wish)
    names = checks.Names.of(wire.Vocabulary.model_validate_json(case.run.vocabulary))
    checks.check_answer(case.ask, post.answer, names, ["body", "answer"])
    try:
        leases.refuse_ended(case.held, tx.now)
    except errors.Conflict as refusal:
        _store(tx, post, case, None, Cost(0))
        leases.expire(tx)
        return Outcome(None, refusal)
    return Outcome(_accept(tx, post, case, wish))


def _open(tx: Tx, post: Post) -> Case:
    held = leases.find(tx, post.assignment, post.user, post.token)
    run = runs.lock(tx, held.run)
    query = tx.conn.execute(_LOCK_QUERY, {"query": held.query}).one()
    if not tx.one_writer:
        held = leases.find(tx, post.assignment, post.user, post.token)
    text = canonical.text(post.answer.model_dump(mode="json"))
    return Case(held, run, query, queries.ASK.validate_json(query.ask), text, canonical.digest(text))


def _refuse_reused_key(tx: Tx, post: Post, case: Case) -> None:
    if post.key is None:
        return
    same = (answers.c.user_id == post.user, answers.c.idempotency_key == post.key)
    row = tx.conn.execute(select(answers).where(*same)).one_or_none()
    if row is not None and (row.assignment_id, row.digest) != (post.assignment, case.digest):
        raise errors.KeyReused("This Idempotency-Key came before with another answer; use a new one.")


def _again(tx: Tx, case: Case, earlier: Row[Any], wish: leases.Wish | None) -> Outcome:
    """Answer an answer that came before: the same receipt for the same content."""
    if earlier.revision is None:
        raise errors.LeaseExpired("The lease ended before this came; the query is back in the queue.")
    if earlier.digest != case.digest:
        raise errors.DifferentContent("This assignment was answered otherwise; take that answer back to correct it.")
    if case.query.answer_id != earlier.id:
        raise errors.AnswerRetracted("This answer was taken back.")
    following = leases.granted_after(tx, case.held.id)
    if following is None and wish is not None:
        following = leases.lease(tx, wish)
    return Outcome(_receipt(earlier, following))


def _accept(tx: Tx, post: Post, case: Case, wish: leases.Wish | None) -> wire.Receipt:
    """Store, charge and close."""
    cost = pricing.cost(post.answer, wire.Prices.model_validate_json(case.run.prices))
    stored = _store(tx, post, case, case.query.revision, cost)
    if case.run.gold_of is not None:
        schedule.score(tx, case.query.id, post.answer)
    else:
        entry = Entry(
            case.run.id,
            case.query.id,
            stored.id,
            case.query.kind,
            case.query.episode,
            cost,
            stored.seconds,
            stored.active_seconds,
        )
        ledger.charge(tx, entry, case.query.reserve)
    tx.conn.execute(_END, {"assignment": case.held.id, "now": tx.now})
    tx.conn.execute(_CLOSE, {"query": case.query.id, "answer": stored.id})
    data = {
        "query": case.query.id,
        "answer": stored.id,
        "kind": case.query.kind,
        "episode": case.query.episode,
        "units": to_units(cost.units),
    }
    events.add(tx, case.run.id, "answered", data)
    tx.wake(queries.topic(case.query.id), runs.answers_topic(case.run.id))
    return _receipt(stored, None if wish is None else leases.lease(tx, wish))


def _store(tx: Tx, post: Post, case: Case, revision: int | None, cost: Cost) -> Row[Any]:
    seconds = max(tx.now - case.held.leased_at, 0.0)
    row = {
        "run_id": case.run.id,
        "query_id": case.query.id,
        "assignment_id": post.assignment,
        "user_id": post.user,
        "content": case.text,
        "digest": case.digest,
        "idempotency_key": post.key,
        "revision": revision,
        "units": cost.units,
        "seconds": seconds,
        "active_seconds": min(active_time.take(tx, post.user, post.idle_seconds), seconds),
        "created_at": tx.now,
    }
    return tx.conn.execute(_INSERT, row).one()


def _receipt(stored: Row[Any], following: wire.Assignment | None) -> wire.Receipt:
    return wire.Receipt(
        query=stored.query_id,
        answer=stored.id,
        units=to_units(stored.units),
        seconds=stored.seconds,
        active_seconds=stored.active_seconds,
        next=following,
    )


def retract(tx: Tx, assignment: int, user: int, body: wire.Retract, settings: Settings) -> wire.Assignment:
    """Take an answer back and lease its query to the same annotator again; what it cost is refunded."""
    held = leases.find(tx, assignment, user, body.token)
    run = runs.lock(tx, held.run)
    query = tx.conn.execute(_LOCK_QUERY, {"query": held.query}).one()
    given = tx.conn.execute(_GIVEN, {"assignment": assignment}).one_or_none()
    if given is None or given.revision is None:
        raise errors.LeaseEnded("This assignment has no answer that counts.")
    if query.answer_id != given.id:
        return _retracted_before(tx, query.id, user)
    if query.used:
        raise errors.AnswerUsed("The learner has trained on this answer; it can be taken back no more.")
    if run.state == "finished":
        raise errors.RunFinished("The run is finished; its answers stay.")
    if run.gold_of is not None:
        schedule.unscore(tx, query.id)
    else:
        _refund(tx, run, query, given)
    tx.conn.execute(
        update(query_table)
        .where(query_table.c.id == query.id)
        .values(state="leased", answer_id=None, revision=query.revision + 1)
    )
    events.add(tx, run.id, "retracted", {"query": query.id, "answer": given.id, "units": to_units(given.units)})
    tx.wake(queries.topic(query.id))
    again = leases.grant(tx, query.id, user, leases.Terms(settings.lease_seconds, tab=body.tab))
    return leases.view(tx, again)


def _refund(tx: Tx, run: Row[Any], query: Row[Any], given: Row[Any]) -> None:
    charged = tx.conn.execute(
        select(ledger_table).where(ledger_table.c.answer_id == given.id, ledger_table.c.entry == "charge")
    ).one()
    cost = Cost(charged.units, charged.lo_units)
    entry = Entry(run.id, query.id, given.id, query.kind, query.episode, cost, charged.seconds, charged.active_seconds)
    ledger.refund(tx, entry, runs.account(run), query.reserve)


def _retracted_before(tx: Tx, query: int, user: int) -> wire.Assignment:
    """Return the assignment an earlier retraction gave, if it is still live."""
    live_now = select(assignments.c.id).where(
        assignments.c.query_id == query,
        assignments.c.user_id == user,
        IS_LIVE,
        assignments.c.expires_at > tx.now,
    )
    one = tx.conn.execute(live_now).scalar_one_or_none()
    if one is None:
        raise errors.AnswerRetracted("This answer was taken back before.")
    return leases.view(tx, one)
