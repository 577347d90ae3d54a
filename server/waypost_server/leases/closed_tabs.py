"""Closed browser tabs: they receive no new leases, even if a request for one is still on its way.

Leasing locks the user's row FOR SHARE (`auth.access.check_still`), closing a tab locks it FOR UPDATE, so they run one
after the other: the tab's last lease either exists already and is released, or it is refused.
"""

from sqlalchemy import bindparam, delete, exists, select

from waypost_server.db.tables import closed_tabs, users
from waypost_server.db.transaction import Tx

KEPT_SECONDS = 600.0  # longer than any request that a closed tab may have sent

_LOCK = select(users.c.id).where(users.c.id == bindparam("user")).with_for_update(key_share=True)
_OLD = delete(closed_tabs).where(closed_tabs.c.at < bindparam("before"))
_KNOWN = select(exists().where(closed_tabs.c.user_id == bindparam("user"), closed_tabs.c.tab == bindparam("tab")))


def record(tx: Tx, user: int, tab: str) -> None:
    """Record that a user closed a tab."""
    tx.conn.execute(_LOCK, {"user": user})
    tx.conn.execute(_OLD, {"before": tx.now - KEPT_SECONDS})
    tx.conn.execute(tx.upsert(closed_tabs).values(user_id=user, tab=tab, at=tx.now).on_conflict_do_nothing())


def is_closed(tx: Tx, user: int, tab: str) -> bool:
    """Return whether a user closed a tab."""
    return bool(tx.conn.execute(_KNOWN, {"user": user, "tab": tab}).scalar_one())
