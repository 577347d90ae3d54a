"""Pages that have gone: nothing more is leased to them, though what they asked for is still on its way.

Leasing locks the user against leaving, and leaving against leasing (`people.refuse_gone`, FOR SHARE; here, FOR UPDATE):
either the page's last query is there to be given back, or it is known to have gone.
"""

from sqlalchemy import bindparam, delete, exists, select

from waypost_server.db.engine import Tx
from waypost_server.db.tables import departures, users

KEPT_SECONDS = 600.0  # longer than any request of a page that has gone

_LOCK = select(users.c.id).where(users.c.id == bindparam("user")).with_for_update()
_OLD = delete(departures).where(departures.c.at < bindparam("before"))
_KNOWN = select(exists().where(departures.c.user_id == bindparam("user"), departures.c.tab == bindparam("tab")))


def note(tx: Tx, user: int, tab: str) -> None:
    """Remember that a page of a user has gone."""
    tx.conn.execute(_LOCK, {"user": user})
    tx.conn.execute(_OLD, {"before": tx.now - KEPT_SECONDS})
    tx.conn.execute(tx.upsert(departures).values(user_id=user, tab=tab, at=tx.now).on_conflict_do_nothing())


def known(tx: Tx, user: int, tab: str) -> bool:
    """Whether a page of a user has gone."""
    return bool(tx.conn.execute(_KNOWN, {"user": user, "tab": tab}).scalar_one())
