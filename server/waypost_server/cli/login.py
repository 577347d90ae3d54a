"""Login links, as commands print them."""

from waypost import wire
from waypost_server.auth import sessions
from waypost_server.db.engine import Database
from waypost_server.users import service as users


def login_url(
    db: Database, base: str, name: str, role: wire.Role, seconds: float, without: wire.Kind | None = None
) -> str:
    """Return a one-time link that logs in the user with this name; create the user if there is none.

    The web app that the link opens does not ask for queries of the kind `without`.
    """
    user = db.write_now(lambda tx: users.ensure_user(tx, name, role))
    link = db.write_now(lambda tx: sessions.create_login_link(tx, user.id, seconds))
    search = "" if without is None else f"?without={without}"
    return f"{base.rstrip('/')}/login{search}#{link.code}"
