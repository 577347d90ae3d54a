"""What a learner's policies would answer to queries that were answered earlier, beside those answers."""

from collections.abc import Mapping, Sequence

from sqlalchemy import select

from waypost import wire
from waypost_server.db.tables import answers, queries
from waypost_server.db.tables import predictions as table
from waypost_server.db.transaction import Tx
from waypost_server.errors import Location, Unprocessable
from waypost_server.gold import scoring
from waypost_server.queries.checks import Names, Outline, check_answer
from waypost_server.queries.service import ANSWER
from waypost_server.runs import service as runs


def put(tx: Tx, run: str, sent: wire.Predictions, user: int) -> None:
    """Store what the policies of a run would answer, in place of what was stored for the same queries before.

    Raises:
        NotFound: there is no such run.
        Unauthenticated, Forbidden: the user may not change the run.
        Unprocessable: a prediction does not fit its query, or its query has no answer that the learner has used.
    """
    row = runs.lock_own(tx, run, user)
    names = Names.of(runs.vocabulary_of(row.vocabulary))
    asked = (
        select(queries.c.id, queries.c.ask, answers.c.content)
        .join(answers, answers.c.id == queries.c.answer_id)
        # An answer that was used cannot be taken back, so what differs from it now always will.
        .where(queries.c.run_id == run, queries.c.used, queries.c.id.in_([one.query for one in sent.predictions]))
    )
    found = {one.id: one for one in tx.conn.execute(asked)}
    for place, one in enumerate(sent.predictions):
        at: Location = ["body", "predictions", place]
        # Popped, because a second prediction for the same query is as wrong as one for a query of another run.
        query = found.pop(one.query, None)
        if query is None:
            raise Unprocessable([*at, "query"], "is no query of this run with a used answer, or it is here twice")
        check_answer(Outline.model_validate_json(query.ask), one.answer, names, [*at, "answer"])
        differs = scoring.differ(one.answer, ANSWER.validate_json(query.content))
        if differs is None:
            raise Unprocessable([*at, "answer", "kind"], "is a demonstration; only labels can be compared")
        values = {"episode": sent.episode, "content": one.answer.model_dump_json(), "differs": differs}
        stored = tx.upsert(table).values(query_id=one.query, run_id=run, **values)
        tx.conn.execute(stored.on_conflict_do_update(index_elements=["query_id"], set_=values))


def of(tx: Tx, ids: Sequence[int]) -> Mapping[int, wire.Predicted]:
    """Return what the policies would answer to those of these queries for which the learner sent it."""
    sent = (
        select(table.c.query_id, table.c.episode, table.c.content, answers.c.content.label("answer"))
        .join(queries, queries.c.id == table.c.query_id)
        .join(answers, answers.c.id == queries.c.answer_id)
        .where(table.c.query_id.in_(ids))
    )
    return {row.query_id: _predicted(row.episode, row.answer, row.content) for row in tx.conn.execute(sent)}


def _predicted(episode: int, answer: str, content: str) -> wire.Predicted:
    policy = ANSWER.validate_json(content)
    differences = scoring.differences(ANSWER.validate_json(answer), policy)
    return wire.Predicted(episode=episode, answer=policy, differences=differences)
