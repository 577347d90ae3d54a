"""Roles: the groups of roles that routes allow, and the check that a user may still answer."""

from sqlalchemy import bindparam, select

from waypost.wire import Role
from waypost_server import errors
from waypost_server.db.tables import users
from waypost_server.db.transaction import Tx

ANYONE: frozenset[Role] = frozenset({"admin", "learner", "annotator", "viewer"})
# Who may see single queries of runs. Annotators may not, because they could then tell gold queries from others.
WATCHERS: frozenset[Role] = frozenset({"admin", "learner", "viewer"})
LEARNERS: frozenset[Role] = frozenset({"admin", "learner"})
ANNOTATORS: frozenset[Role] = frozenset({"admin", "annotator"})
ADMINS: frozenset[Role] = frozenset({"admin"})

_LOCKED_USER = (
    select(users.c.role, users.c.deactivated_at).where(users.c.id == bindparam("user")).with_for_update(read=True)
)


def check_may_answer(tx: Tx, user: int) -> None:
    """Refuse a user who was deactivated, or lost the role of an annotator, while they waited for a query.

    The user's row stays locked FOR SHARE until the end of the transaction. Closing a tab locks it FOR UPDATE
    (`leases.closed_tabs`), so leasing and closing a tab run one after the other.

    Raises:
        Unauthenticated: the user was deactivated.
        Forbidden: the user's role may not answer queries.
    """
    row = tx.conn.execute(_LOCKED_USER, {"user": user}).one()
    if row.deactivated_at is not None:
        raise errors.Unauthenticated("This account was deactivated.")
    if row.role not in ANNOTATORS:
        raise errors.Forbidden(f"The role {row.role} does not answer queries.")
