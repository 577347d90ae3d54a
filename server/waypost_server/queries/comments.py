"""Stores and reads reviewers' comments on queries. A comment is never changed."""

from typing import Any

from sqlalchemy import Row, Select, insert, select

from waypost import wire
from waypost_server.db.tables import comments, users
from waypost_server.db.transaction import Tx

COMMENTS: Select[Any] = (
    select(comments, users.c.name.label("by")).join(users, users.c.id == comments.c.user_id).order_by(comments.c.id)
)


def add(tx: Tx, query: int, user: int, text: str, answer: int | None = None) -> wire.Comment:
    """Store a comment, and the answer that is sent back with it, if there is one; return the comment."""
    row = {"query_id": query, "user_id": user, "text": text, "answer_id": answer, "created_at": tx.now}
    stored = tx.conn.execute(insert(comments).values(row).returning(comments.c.id)).scalar_one()
    return of_row(tx.conn.execute(COMMENTS.where(comments.c.id == stored)).one())


def of_query(tx: Tx, query: int) -> list[wire.Comment]:
    """Return all comments on a query, oldest first."""
    return [of_row(row) for row in tx.conn.execute(COMMENTS.where(comments.c.query_id == query))]


def sent_back(tx: Tx, query: int) -> list[wire.Comment]:
    """Return the comments with which answers to a query were sent back, oldest first."""
    found = COMMENTS.where(comments.c.query_id == query, comments.c.answer_id.is_not(None))
    return [of_row(row) for row in tx.conn.execute(found)]


def of_row(row: Row[Any]) -> wire.Comment:
    """Return the message for a row of `COMMENTS`."""
    return wire.Comment(id=row.id, by=row.by, at=row.created_at, text=row.text, answer=row.answer_id)
