"""Checks, stores and charges an answer, and closes its query, in one transaction.

A late answer is refused but kept: it is stored without a revision, so it never counts and costs nothing. Its refusal is
returned, not raised, because an exception would roll back the transaction.
"""

from collections.abc import Mapping
from dataclasses import dataclass

from sqlalchemy import bindparam, select, update

from waypost import prices as pricing
from waypost import wire
from waypost.prices import Cost, to_units
from waypost_server import errors
from waypost_server.answers import following
from waypost_server.answers.following import Following
from waypost_server.db import canonical
from waypost_server.db.prepared import Prepared, Record
from waypost_server.db.sending import MustWait
from waypost_server.db.tables import answers, assignments
from waypost_server.db.tables import queries as query_table
from waypost_server.db.tables import runs as runs_table
from waypost_server.db.transaction import UPSERTS, Tx
from waypost_server.gold import schedule, scoring, second
from waypost_server.leases import active_time
from waypost_server.leases import service as leases
from waypost_server.leases.assignments import FIND, OwnAssignment, check_live, find, leased_after
from waypost_server.leases.request import LeaseRequest
from waypost_server.queries import checks, frame_uses
from waypost_server.queries import service as queries
from waypost_server.queries.checks import Outline
from waypost_server.runs import events, ledger
from waypost_server.runs import service as runs
from waypost_server.webhooks import outbox


@dataclass(frozen=True)
class Post:
    """An answer as it was sent."""

    assignment: int
    user: int
    token: str
    answer: wire.Answer
    key: str | None  # the Idempotency-Key
    idle_seconds: float


@dataclass(frozen=True)
class Outcome:
    """The result of posting an answer: a receipt or a refusal. Both are committed."""

    given: wire.Receipt | None
    refusal: errors.Refusal | None = None

    def receipt(self) -> wire.Receipt:
        """Return the receipt, or raise the refusal."""
        if self.refusal is not None or self.given is None:
            raise self.refusal or errors.StorageFailed("There is no receipt.")
        return self.given


@dataclass(frozen=True)
class Case:
    """An assignment with its run and query, both locked, and the canonical content of the answer."""

    assignment: OwnAssignment
    run: Record
    query: Record
    outline: Outline
    text: str
    digest: str


LOCK_QUERY = Prepared(select(query_table).where(query_table.c.id == bindparam("query")).with_for_update(key_share=True))
ANSWER_OF = Prepared(select(answers).where(answers.c.assignment_id == bindparam("assignment")))
_OF_ASSIGNMENT = select(assignments.c.query_id).where(assignments.c.id == bindparam("assignment")).scalar_subquery()
_ITS_RUN = (
    select(runs_table)
    .where(runs_table.c.id == select(query_table.c.run_id).where(query_table.c.id == _OF_ASSIGNMENT).scalar_subquery())
    .where(runs_table.c.deleted_at.is_(None))
)
_LOCK_ITS_RUN = Prepared(_ITS_RUN.with_for_update(key_share=True))
# With several servers a run is often locked. To find no row is cheaper than `MustWait` from the database, an error.
_LOCK_ITS_RUN_IF_FREE = Prepared(_ITS_RUN.with_for_update(key_share=True, skip_locked=True))
_LOCK_ITS_QUERY = Prepared(
    select(query_table).where(query_table.c.id == _OF_ASSIGNMENT).with_for_update(key_share=True)
)
# Answers of two runs lock different rows, so two of them can come here with the same Idempotency-Key. The second waits
# until the first is committed or undone.
_INSERT = Prepared(
    {
        name: insert(answers)
        .on_conflict_do_nothing(index_elements=[answers.c.user_id, answers.c.idempotency_key])
        .returning(answers)
        for name, insert in UPSERTS.items()
    },
    [column.name for column in answers.columns if not column.primary_key],
)
_END = Prepared(
    update(assignments)
    .where(assignments.c.id == bindparam("assignment"))
    .values(state="answered", ended_at=bindparam("now"))
)
_CLOSE = Prepared(
    update(query_table)
    .where(query_table.c.id == bindparam("query"))
    .values(state="answered", answer_id=bindparam("answer"), differs=bindparam("differs"))
)


def answer(tx: Tx, post: Post, wanted: LeaseRequest | None) -> Outcome:
    """Accept an answer, and lease the annotator's next query if `wanted` asks for one and there is one.

    Sending the same answer again returns the same receipt.

    Raises:
        NotFound, NotYours, WrongToken: the user does not have this assignment.
        KeyReused, DifferentContent, AnswerRetracted: another answer was sent before.
        Unprocessable: the answer does not fit the query.
    """
    case = _open(tx, post)
    _check_key(tx, post, case)
    if case.assignment.has_answer:
        return _repeat(tx, case, ANSWER_OF.one(tx.conn, {"assignment": post.assignment}), wanted)
    names = checks.Names.of(runs.vocabulary_of(case.run.vocabulary))
    checks.check_answer(case.outline, post.answer, names, ["body", "answer"])
    try:
        check_live(case.assignment, tx.now)
    except errors.Conflict as refusal:
        _store(tx, post, case, None, Cost(0))
        leases.expire(tx)
        return Outcome(None, refusal)
    return Outcome(_accept(tx, post, case, wanted))


def _open(tx: Tx, post: Post) -> Case:
    text = canonical.text(post.answer.model_dump(mode="json"))
    of = {"assignment": post.assignment}
    lock_run = _LOCK_ITS_RUN if tx.may_wait else _LOCK_ITS_RUN_IF_FREE
    _look_ahead(tx, post, of, lock_run)
    locked, query = lock_run.first(tx.conn, of), _LOCK_ITS_QUERY.first(tx.conn, of)
    assignment = find(tx, post.assignment, post.user, post.token)
    if locked is None and not tx.may_wait:
        raise MustWait
    run = runs.existing(assignment.run, locked)
    assert query is not None  # nobody deletes a query before its assignments
    return Case(assignment, run, query, Outline.model_validate_json(query.ask), text, canonical.digest(text))


def _look_ahead(tx: Tx, post: Post, of: Mapping[str, int], lock_run: Prepared) -> None:
    """Lock and read in one round trip: while the run is locked, its other answers wait."""
    if tx.one_writer:
        return  # there are no round trips
    for statement in (lock_run, _LOCK_ITS_QUERY, FIND):
        statement.ahead(tx.conn, of)
    active_time.FIND.ahead(tx.conn, {"user": post.user})
    outbox.ACTIVE.ahead(tx.conn, {})
    tx.read_time_ahead()  # when all is locked


def _check_key(tx: Tx, post: Post, case: Case) -> None:
    """Refuse an Idempotency-Key that came before with another answer."""
    if post.key is None:
        return
    same = (answers.c.user_id == post.user, answers.c.idempotency_key == post.key)
    row = tx.conn.execute(select(answers).where(*same)).one_or_none()
    if row is not None and (row.assignment_id, row.digest) != (post.assignment, case.digest):
        raise _key_reused()


def _key_reused() -> errors.KeyReused:
    return errors.KeyReused("This Idempotency-Key came before with another answer; use a new one.")


def _repeat(tx: Tx, case: Case, earlier: Record, wanted: LeaseRequest | None) -> Outcome:
    """Return the receipt of an answer that was sent before with the same content."""
    if earlier.revision is None:
        raise errors.LeaseExpired("The lease had expired when this arrived; the query is back in the queue.")
    if earlier.digest != case.digest:
        raise errors.DifferentContent("This assignment has another answer; retract that answer to correct it.")
    if case.query.answer_id != earlier.id:
        raise errors.AnswerRetracted("This answer was retracted.")
    leased = Following(leased_after(tx, case.assignment.id))
    return Outcome(_receipt(earlier, leased if leased.is_settled else _next(tx, wanted)))


def _next(tx: Tx, wanted: LeaseRequest | None) -> Following:
    return Following() if wanted is None else following.lease(tx, wanted)


def _accept(tx: Tx, post: Post, case: Case, wanted: LeaseRequest | None) -> wire.Receipt:
    """Store and charge the answer, and close the query."""
    cost = pricing.cost(post.answer, runs.prices_of(case.run.prices))
    stored = _store(tx, post, case, case.query.revision, cost)
    if case.run.gold_of is not None:
        if not second.settle(tx, case.query.id, done=True):
            schedule.score(tx, case.query.id, post.answer)
    else:
        entry = ledger.Entry(
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
    tx.trace(
        "answer",
        case.run.id,
        case.query.episode,
        since=case.assignment.leased_at,
        query=case.query.id,
        kind=case.query.kind,
        answer=stored.id,
    )
    _END.run(tx.conn, {"assignment": case.assignment.id, "now": tx.now})
    differs = scoring.differ(case.outline.suggestion, post.answer)
    _CLOSE.run(tx.conn, {"query": case.query.id, "answer": stored.id, "differs": differs})
    if case.run.second_answers > 0:
        second.want(tx, case.run, case.query)
    data = {
        "query": case.query.id,
        "answer": stored.id,
        "kind": case.query.kind,
        "episode": case.query.episode,
        "units": to_units(cost.units),
    }
    events.add(tx, case.run.id, "answered", data)
    if case.run.gold_of is None:
        events.announce(tx, "answer.accepted", case.run.id, data)
    tx.wake(queries.topic(case.query.id), runs.answers_topic(case.run.id))
    return _receipt(stored, _next(tx, wanted))


def _store(tx: Tx, post: Post, case: Case, revision: int | None, cost: Cost) -> Record:
    seconds = max(tx.now - case.assignment.leased_at, 0.0)
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
    stored = _INSERT.first(tx.conn, row)
    if stored is None:
        raise _key_reused()
    tx.count("answers", "late" if revision is None else "counted")
    if seen := frame_uses.of_answer(post.answer):
        frame_uses.show(tx, case.run.id, seen)
    return stored


def _receipt(stored: Record, leased: Following) -> wire.Receipt:
    return wire.Receipt(
        query=stored.query_id,
        answer=stored.id,
        units=to_units(stored.units),
        seconds=stored.seconds,
        active_seconds=stored.active_seconds,
        next=leased.assignment,
        next_problem=leased.problem,
    )
