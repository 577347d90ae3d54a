"""Creates, lists and revokes API tokens."""

from collections.abc import Iterable

from sqlalchemy import select

from waypost import wire
from waypost_server import errors
from waypost_server.auth.credentials import Limits, issue, limits_of, revoke, scopes_of, valid
from waypost_server.db.audit import COMMAND_LINE, Actor, Entry
from waypost_server.db.functions import DAY
from waypost_server.db.tables import credentials, users
from waypost_server.db.transaction import Tx


def create_token(
    tx: Tx,
    user: int,
    label: str,
    days: float | None = None,
    scopes: Iterable[wire.Scope] | None = None,
    made_with: int | None = None,
    by: Actor = COMMAND_LINE,
) -> wire.NewToken:
    """Create an API token that is valid for `days`, or until it is revoked, for everything or with scopes.

    It does not outlive `made_with`, the token with which it is made, and has no other scopes: whoever has stolen a
    token could otherwise make a better one.

    Raises:
        OutOfScope: it would have a scope that `made_with` lacks.
        NotFound: there is no such user.
        NotActive: the user is deactivated.
    """
    wanted = None if days is None else days * DAY
    limits = Limits() if made_with is None else limits_of(tx, made_with)
    seconds = min((one for one in (wanted, limits.seconds) if one is not None), default=None)
    chosen = limits.scopes if scopes is None else frozenset(scopes)
    if limits.scopes is not None and chosen is not None and not chosen <= limits.scopes:
        lacking = ", ".join(sorted(chosen - limits.scopes))
        raise errors.OutOfScope(f"A token cannot make one with a scope that it lacks: {lacking}.")
    issued = issue(tx, user, "api", label, seconds, chosen)
    details = {"user": user, "name": issued.name, "label": label, "expires": issued.expires}
    if chosen is not None:
        details["scopes"] = " ".join(sorted(chosen))
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
                scopes=_listed(scopes_of(row.scopes)),
            )
            for row in rows
        ]
    )


def _listed(scopes: frozenset[wire.Scope] | None) -> list[wire.Scope] | None:
    return None if scopes is None else sorted(scopes)


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
