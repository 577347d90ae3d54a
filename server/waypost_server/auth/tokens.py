"""Creates, lists and revokes API tokens."""

from sqlalchemy import select

from waypost import wire
from waypost_server import errors
from waypost_server.auth.credentials import issue, revoke, seconds_left, valid
from waypost_server.db.audit import COMMAND_LINE, Actor, Entry
from waypost_server.db.clock import DAY
from waypost_server.db.tables import credentials, users
from waypost_server.db.transaction import Tx


def create_token(
    tx: Tx,
    user: int,
    label: str,
    days: float | None = None,
    made_with: int | None = None,
    by: Actor = COMMAND_LINE,
) -> wire.NewToken:
    """Create an API token that is valid for `days`, or until it is revoked.

    It does not outlive `made_with`, the token with which it is made: a stolen one would otherwise never end.

    Raises:
        NotFound: there is no such user.
        NotActive: the user is deactivated.
    """
    wanted = None if days is None else days * DAY
    left = None if made_with is None else seconds_left(tx, made_with)
    issued = issue(tx, user, "api", label, min((one for one in (wanted, left) if one is not None), default=None))
    details = {"user": user, "name": issued.name, "label": label, "expires": issued.expires}
    tx.record(Entry(by, "token.created", f"token/{issued.id}", details))
    return wire.NewToken(id=issued.id, token=issued.secret)


def list_tokens(tx: Tx, user: int) -> wire.TokenList:
    """List a user's valid API tokens, oldest first.

    Raises:
        NotFound: there is no such user.
    """
    if tx.conn.execute(select(users.c.id).where(users.c.id == user)).one_or_none() is None:
        raise errors.NotFound(f"There is no user {user}.")
    rows = tx.conn.execute(valid(tx, user, "api"))
    return wire.TokenList(
        tokens=[
            wire.Token(
                id=row.id,
                label=row.label,
                created_at=row.created_at,
                last_used_at=row.last_used_at,
                expires_at=row.expires_at,
            )
            for row in rows
        ]
    )


def revoke_token(tx: Tx, token: int, owner: int | None = None, by: Actor = COMMAND_LINE) -> None:
    """Revoke an API token; with `owner`, only if it belongs to that user.

    Raises:
        NotFound: there is no such token, or it belongs to another user.
    """
    found = (
        select(credentials.c.user_id, credentials.c.label, users.c.name)
        .join(users, users.c.id == credentials.c.user_id)
        .where(credentials.c.id == token, credentials.c.kind == "api")
    )
    if owner is not None:
        found = found.where(credentials.c.user_id == owner)
    row = tx.conn.execute(found).one_or_none()
    if row is None:
        raise errors.NotFound(f"There is no token {token}.")
    if revoke(tx, token):
        details = {"user": row.user_id, "name": row.name, "label": row.label}
        tx.record(Entry(by, "token.revoked", f"token/{token}", details))
