"""Annotators' results on gold queries: the scores of their first answers, by kind of query.

What annotators see of themselves grows by `STEP` gold queries at a time. If it grew with every gold query, it would
tell them which query was gold, and whether their answer was right.
"""

from collections import defaultdict
from collections.abc import Mapping
from dataclasses import dataclass

from sqlalchemy import Select, func, select

from waypost import wire
from waypost_server.db.tables import answers, gold_showings
from waypost_server.db.tables import queries as query_table
from waypost_server.db.transaction import Tx

STEP = 10


@dataclass(frozen=True)
class Result:
    """The result on some gold queries."""

    answers: int  # the number of answers
    right: int  # of these, the answers with only right labels
    n_labels: int
    n_right: int

    @property
    def agreement(self) -> float | None:
        """The share of right labels; None if there are none."""
        return self.n_right / self.n_labels if self.n_labels else None


NONE = Result(0, 0, 0, 0)
Results = Mapping[wire.Kind, Result]

# Revision 0 is the first answer to a query that was accepted.
_SCORED = (
    select(answers.c.id, answers.c.user_id, query_table.c.kind, gold_showings.c.n_labels, gold_showings.c.n_right)
    .join(gold_showings, gold_showings.c.query_id == answers.c.query_id)
    .join(query_table, query_table.c.id == answers.c.query_id)
    .where(answers.c.revision == 0, gold_showings.c.n_labels.is_not(None))
)


def of_user(tx: Tx, user: int) -> Results:
    """Return an annotator's results by kind of query, up to now."""
    return _by_user(tx, _SCORED.where(answers.c.user_id == user)).get(user, {})


def of_self(tx: Tx, user: int) -> Results:
    """Return the results that an annotator sees of himself: those on the first `STEP`, 2 `STEP`, ... gold queries."""
    mine = _SCORED.where(answers.c.user_id == user)
    n = int(tx.conn.execute(select(func.count()).select_from(mine.subquery())).scalar_one())
    return _by_user(tx, mine.order_by(answers.c.id).limit(n - n % STEP)).get(user, {})


def of_everyone(tx: Tx) -> Mapping[int, Results]:
    """Return the results of each annotator, by kind of query."""
    return _by_user(tx, _SCORED)


def total(results: Results) -> Result:
    """Return the result over all kinds of query."""
    found = results.values()
    return Result(
        sum(one.answers for one in found),
        sum(one.right for one in found),
        sum(one.n_labels for one in found),
        sum(one.n_right for one in found),
    )


def _by_user(tx: Tx, scored: Select[tuple[int, int, wire.Kind, int, int]]) -> Mapping[int, Results]:
    one = scored.subquery()
    rows = tx.conn.execute(
        select(
            one.c.user_id,
            one.c.kind,
            func.count().label("answers"),
            func.count().filter(one.c.n_right == one.c.n_labels).label("right"),
            func.sum(one.c.n_labels).label("n_labels"),
            func.sum(one.c.n_right).label("n_right"),
        ).group_by(one.c.user_id, one.c.kind)
    )
    found = defaultdict[int, dict[wire.Kind, Result]](dict)
    for row in rows:
        found[row.user_id][row.kind] = Result(row.answers, row.right, int(row.n_labels), int(row.n_right))
    return found
