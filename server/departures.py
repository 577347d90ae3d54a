"""Pages that have gone: nothing more is leased to them, though what they asked for is still on its way."""

from sqlalchemy import delete, exists, insert, select

from server.database import Tx
from server.tables import departures

KEPT_SECONDS = 600.0  # longer than any request of a page that has gone


def note(tx: Tx, user: int, tab: str) -> None:
    """Remember that a page of a user has gone."""
    tx.conn.execute(delete(departures).where(departures.c.at < tx.now - KEPT_SECONDS))
    if not known(tx, user, tab):
        tx.conn.execute(insert(departures).values(user_id=user, tab=tab, at=tx.now))


def known(tx: Tx, user: int, tab: str) -> bool:
    """Whether a page of a user has gone."""
    here = exists().where(departures.c.user_id == user, departures.c.tab == tab)
    return bool(tx.conn.execute(select(here)).scalar_one())
