"""Stores several answers in one transaction. Each is accepted or refused by itself, as if it had been sent alone."""

from collections.abc import Sequence

from waypost import wire
from waypost_server import errors
from waypost_server.answers import service as answers
from waypost_server.db.transaction import Tx
from waypost_server.http import problems


def answer_all(tx: Tx, posts: Sequence[answers.Post]) -> wire.BatchReceipt:
    """Accept answers in their order. One that is refused changes nothing, and the others stay."""
    try:
        with tx.part():  # one for all: a batch without a refusal is the rule
            results = [_accepted(tx, post) for post in posts]
    except errors.Refusal:
        results = [_answer(tx, post) for post in posts]
    return wire.BatchReceipt(results=results)


def _answer(tx: Tx, post: answers.Post) -> wire.BatchResult:
    try:
        with tx.part():
            outcome = answers.answer(tx, post, None)
        return wire.BatchResult(receipt=outcome.receipt(), problem=None)
    except errors.Refusal as refusal:
        return wire.BatchResult(receipt=None, problem=problems.problem(refusal))


def _accepted(tx: Tx, post: answers.Post) -> wire.BatchResult:
    return wire.BatchResult(receipt=answers.answer(tx, post, None).receipt(), problem=None)
