"""The pictures that go with a run: those that no other run shows. Pictures that nobody ever showed go, too."""

from collections import Counter
from collections.abc import Sequence

from sqlalchemy import ColumnElement, and_, delete, exists, func, or_, select, update

from waypost_server.db.functions import DAY
from waypost_server.db.tables import frame_uses, frames, users
from waypost_server.db.transaction import Tx

AT_ONCE = 500  # pictures deleted in one statement
UNUSED_SECONDS = DAY  # a learner uploads pictures before it asks about them


def count(tx: Tx, runs: Sequence[str]) -> tuple[int, int]:
    """Return how many pictures would go with these runs, and how many bytes they have."""
    elsewhere = exists().where(frame_uses.c.hash == frames.c.hash, frame_uses.c.run_id.not_in(runs))
    found = select(func.count(), func.coalesce(func.sum(func.length(frames.c.png)), 0))
    n, size = tx.conn.execute(found.where(_candidate(tx, runs), ~elsewhere)).one()
    return int(n), int(size)


def take(tx: Tx, runs: Sequence[str]) -> tuple[int, int]:
    """Delete the pictures that only these runs show; return how many, and how many bytes they had.

    The candidates are locked before it is known which of them another run shows. Otherwise another run could begin to
    show one in between (`queries.frames.show`).
    """
    candidates = select(frames.c.hash).where(_candidate(tx, runs)).order_by(frames.c.hash).with_for_update()
    hashes = tx.conn.execute(candidates).scalars().all()
    tx.conn.execute(delete(frame_uses).where(frame_uses.c.run_id.in_(runs)))
    n, size, freed = 0, 0, Counter[int | None]()
    for first in range(0, len(hashes), AT_ONCE):
        shown = exists().where(frame_uses.c.hash == frames.c.hash)
        gone = delete(frames).where(frames.c.hash.in_(hashes[first : first + AT_ONCE]), ~shown)
        rows = tx.conn.execute(gone.returning(frames.c.user_id, func.length(frames.c.png).label("size"))).all()
        n, size = n + len(rows), size + sum(row.size for row in rows)
        for row in rows:
            freed[row.user_id] += row.size
    for user in sorted(one for one in freed if one is not None):
        tx.conn.execute(update(users).where(users.c.id == user).values(frame_bytes=users.c.frame_bytes - freed[user]))
    return n, size


def _candidate(tx: Tx, runs: Sequence[str]) -> ColumnElement[bool]:
    here = exists().where(frame_uses.c.hash == frames.c.hash, frame_uses.c.run_id.in_(runs))
    anywhere = exists().where(frame_uses.c.hash == frames.c.hash)
    return and_(~frames.c.pinned, or_(here, and_(~anywhere, frames.c.created_at < tx.now - UNUSED_SECONDS)))
