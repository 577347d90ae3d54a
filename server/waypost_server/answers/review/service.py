"""Review: comments on queries, and answers that a reviewer sends back. A reviewer owns the run or is an administrator.

To send an answer back is to retract it on the reviewer's authority. So the same rules hold: the answer keeps its row,
it is refunded, its query gets a new revision, and an answer that the learner has used stays.
"""

from sqlalchemy import select

from waypost import wire
from waypost_server import errors
from waypost_server.answers.retraction import take_back
from waypost_server.answers.service import LOCK_QUERY
from waypost_server.db import wakeups
from waypost_server.db.functions import by_value
from waypost_server.db.tables import answers, comments, runs, users
from waypost_server.db.tables import queries as query_table
from waypost_server.db.transaction import Tx
from waypost_server.queries import comments as written
from waypost_server.queries import service as queries
from waypost_server.runs.service import lock_own

MOST_RETURNED = 100


def comment(tx: Tx, query: int, body: wire.CommentPost, user: int) -> wire.Comment:
    """Store a comment on a query.

    Raises:
        NotFound: there is no such query.
        Forbidden: the user may not change the run.
    """
    lock_own(tx, queries.view(tx, query).run, user)
    return written.add(tx, query, user, body.text)


def send_back(tx: Tx, query: int, body: wire.SendBack, user: int) -> wire.Comment:
    """Retract the answer that counts, and open its query again for every annotator, also for the one who answered.

    Raises:
        NotFound: there is no such query.
        Forbidden: the user may not change the run.
        CannotSendBack: it is the answer to a gold query, or a second answer.
        AnswerRetracted: this answer does not count, or no longer.
        AnswerUsed: the learner has used the answer.
        RunFinished: the run is finished.
        BudgetExhausted: the budget has too few units left for another answer.
    """
    run = lock_own(tx, queries.view(tx, query).run, user)
    found = LOCK_QUERY.one(tx.conn, {"query": query})
    if found.run_id != run.id:
        raise errors.CannotSendBack("This answer is to a gold query or a second one: it is not the learner's.")
    if found.answer_id != body.answer:
        raise errors.AnswerRetracted("This answer does not count: it was taken back or sent back. Reload the query.")
    if found.used:
        raise errors.AnswerUsed("The learner has used this answer, so it can no longer be sent back; comment on it.")
    if run.state == "finished":
        raise errors.RunFinished("The run is finished, so nobody would answer the query again.")
    given = tx.conn.execute(select(answers).where(answers.c.id == body.answer)).one()
    take_back(tx, run, found, given, "open")
    tx.wake(wakeups.QUEUE)
    return written.add(tx, query, user, body.text, body.answer)


def returned(tx: Tx, user: int) -> wire.ReturnedList:
    """Return the answers of an annotator that were sent back, newest first."""
    rows = tx.conn.execute(
        select(comments, users.c.name.label("by"), answers.c.content, answers.c.created_at.label("answered_at"))
        .add_columns(query_table.c.run_id, runs.c.name, query_table.c.ask)
        .join(users, users.c.id == comments.c.user_id)
        .join(answers, answers.c.id == comments.c.answer_id)
        .join(query_table, query_table.c.id == comments.c.query_id)
        .join(runs, runs.c.id == query_table.c.run_id)
        .where(by_value(answers.c.user_id) == user)  # an annotator has more answers than there are comments
        .order_by(comments.c.id.desc())
        .limit(MOST_RETURNED)
    )
    found = []
    for row in rows:
        ask = queries.ASK.validate_json(row.ask)
        found.append(
            wire.Returned(
                query=row.query_id,
                run=row.run_id,
                run_name=row.name,
                kind=ask.kind,
                episode=ask.episode,
                question=ask.question,
                answer=queries.ANSWER.validate_json(row.content),
                answered_at=row.answered_at,
                comment=written.of_row(row),
            )
        )
    return wire.ReturnedList(returned=found)
