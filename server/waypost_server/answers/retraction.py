"""Retraction: an answer that the learner has not used is taken back, by its annotator or by a reviewer."""

from sqlalchemy import select, update

from waypost import wire
from waypost.prices import Cost, to_units
from waypost_server import errors
from waypost_server.answers.service import ANSWER_OF, LOCK_QUERY
from waypost_server.db.prepared import Record
from waypost_server.db.tables import IS_LIVE, assignments
from waypost_server.db.tables import ledger as ledger_table
from waypost_server.db.tables import queries as query_table
from waypost_server.db.transaction import Tx
from waypost_server.gold import second
from waypost_server.leases.assignments import find, view, view_of_query
from waypost_server.leases.service import grant
from waypost_server.queries import service as queries
from waypost_server.runs import events, ledger
from waypost_server.runs import service as runs
from waypost_server.settings import Settings


def retract(tx: Tx, assignment: int, user: int, body: wire.Retract, settings: Settings) -> wire.Assignment:
    """Retract an answer: refund it, and lease its query to the same annotator again.

    The answer keeps its row. The query gets a new revision; the next answer belongs to it.

    Raises:
        NotFound, NotYours, WrongToken: the user does not have this assignment.
        LeaseEnded: the assignment has no answer that counts.
        AnswerUsed: the learner has used the answer.
        AnswerRetracted: the answer was retracted before, and its new lease is over.
        RunFinished: the run is finished.
        BudgetExhausted: the budget has too few units left for another answer.
    """
    found = find(tx, assignment, user, body.token)
    run = runs.lock(tx, found.run)
    query = LOCK_QUERY.one(tx.conn, {"query": found.query})
    given = ANSWER_OF.first(tx.conn, {"assignment": assignment})
    if given is None or given.revision is None:
        raise errors.LeaseEnded("This assignment has no answer that counts.")
    if query.answer_id != given.id:
        return _retracted_before(tx, query.id, user)
    if query.used:
        raise errors.AnswerUsed("The learner has used this answer, so it can no longer be retracted.")
    if run.state == "finished":
        raise errors.RunFinished("The run is finished, so its answers can no longer be retracted.")
    take_back(tx, run, query, given, "leased")
    grant(tx, query.id, user, settings.lease_seconds, tab=body.tab)
    return view_of_query(tx, query.id)


def take_back(tx: Tx, run: Record, query: Record, given: Record, state: wire.QueryState) -> None:
    """Refund the answer that counts, and give its query, which must be locked like its run, a new revision and state.

    Raises:
        BudgetExhausted: the budget has too few units left for another answer.
    """
    priority = query.run_priority
    if run.gold_of is None:
        _refund(tx, run, query, given)
        priority = run.priority  # it may have changed since the answer
    else:
        second.settle(tx, query.id, done=False)
    tx.conn.execute(
        update(query_table)
        .where(query_table.c.id == query.id)
        .values(state=state, answer_id=None, differs=None, revision=query.revision + 1, run_priority=priority)
    )
    data = {"query": query.id, "answer": given.id, "units": to_units(given.units)}
    events.add(tx, run.id, "retracted", data)
    if run.gold_of is None:
        more = {"kind": query.kind, "episode": query.episode}
        events.announce(tx, "answer.retracted", run.id, data | more)
    tx.wake(queries.topic(query.id))


def _refund(tx: Tx, run: Record, query: Record, given: Record) -> None:
    of_answer = (ledger_table.c.answer_id == given.id, ledger_table.c.entry == "charge")
    charged = tx.conn.execute(select(ledger_table).where(*of_answer)).one()
    cost = Cost(charged.units, charged.lo_units)
    entry = ledger.Entry(
        run.id, query.id, given.id, query.kind, query.episode, cost, charged.seconds, charged.active_seconds
    )
    ledger.refund(tx, entry, runs.account(run), query.reserve)


def _retracted_before(tx: Tx, query: int, user: int) -> wire.Assignment:
    """Return the assignment that an earlier retraction created, if it is still live."""
    live_now = select(assignments.c.id).where(
        assignments.c.query_id == query,
        assignments.c.user_id == user,
        IS_LIVE,
        assignments.c.expires_at > tx.now,
    )
    one = tx.conn.execute(live_now).scalar_one_or_none()
    if one is None:
        raise errors.AnswerRetracted("This answer was retracted before.")
    return view(tx, one)
