"""Stores several answers in one transaction. Each is accepted or refused by itself, as if it had been sent alone."""

from collections.abc import Sequence

from waypost import wire
from waypost_server import errors
from waypost_server.answers import service as answers
from waypost_server.db.transaction import Tx
from waypost_server.http import problems


def answer_all(tx: Tx, posts: Sequence[answers.Post]) -> wire.BatchReceipt:
    """Accept answers in their order. One that is refused changes nothing, and the others stay."""
    return wire.BatchReceipt(results=[_answer(tx, post) for post in posts])


def _answer(tx: Tx, post: answers.Post) -> wire.BatchResult:
    try:
        with tx.part():
            outcome = answers.answer(tx, post, None)
        return wire.BatchResult(receipt=outcome.receipt(), problem=None)
    except errors.Refusal as refusal:
        return wire.BatchResult(receipt=None, problem=problems.problem(refusal))
