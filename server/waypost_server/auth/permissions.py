"""Authenticates callers, and checks that their role may call the operation (`auth.access`)."""

from dataclasses import dataclass
from typing import Annotated, Any

from fastapi import Depends, Request
from fastapi.security import APIKeyCookie, HTTPBearer
from starlette.requests import HTTPConnection

from waypost.wire import Role, Scope
from waypost_server import errors
from waypost_server.auth.access import ACCESS, check_role, check_scope
from waypost_server.auth.credentials import CredentialKind, hash_of
from waypost_server.auth.lookup import Cached, CredentialCache
from waypost_server.db.audit import Actor

COOKIE = "waypost_session"
HOST_ONLY = "__Host-"  # with it, a browser lets neither another host nor a page over http set the cookie

_bearer = HTTPBearer(auto_error=False, scheme_name="token", description="An API token, `wp_...`.")
_cookie = APIKeyCookie(name=COOKIE, auto_error=False, scheme_name="session", description="A browser's session.")


@dataclass(frozen=True)
class Caller:
    """The user who sent a request, and the credential that the request carried."""

    user: int
    name: str
    role: Role
    credential: int
    scopes: frozenset[Scope] | None
    by_cookie: bool
    address: str | None

    @property
    def actor(self) -> Actor:
        """The caller as the audit log names them."""
        return Actor(self.name, self.user, self.address)


def address_of(connection: HTTPConnection) -> str | None:
    """Return the address that a request came from: the proxy's, unless the settings trust the proxy's headers."""
    return connection.client.host if connection.client else None


def is_secure(connection: HTTPConnection) -> bool:
    """Return whether browsers reach this server over https."""
    return connection.app.state.context.settings.secure_cookies or connection.url.scheme in {"https", "wss"}


def cookie_of(connection: HTTPConnection) -> str:
    """Return the name of the session cookie. Over https, a cookie of another name is no session."""
    return HOST_ONLY + COOKIE if is_secure(connection) else COOKIE


async def authenticate(connection: HTTPConnection, cache: CredentialCache) -> Caller:
    """Return the caller, identified by a bearer token or by a session cookie.

    Raises:
        Unauthenticated: the request carries no valid credential.
    """
    scheme, _, token = connection.headers.get("authorization", "").partition(" ")
    by_cookie = scheme.lower() != "bearer"
    secret = connection.cookies.get(cookie_of(connection)) if by_cookie else token.strip()
    if not secret:
        raise errors.Unauthenticated("Send `Authorization: Bearer <token>`, or open a login link (waypost login-link).")
    kind: CredentialKind = "session" if by_cookie else "api"
    owner = await cache.find(secret, kind)
    if owner is None:
        connection.state.rejected = (kind, hash_of(secret))  # for the audit log, as the caller below (`auth.refusals`)
        raise errors.Unauthenticated("The token or session is unknown, expired or revoked; get a new one.")
    address = address_of(connection)
    caller = Caller(owner.user, owner.name, owner.role, owner.credential, owner.scopes, by_cookie, address)
    connection.state.caller = caller
    return caller


async def admit(
    request: Request,
    cache: Cached,
    _token: Annotated[Any, Depends(_bearer)],
    _session: Annotated[Any, Depends(_cookie)],
) -> Caller:
    """Return the caller of an operation, if the table of `auth.access` allows it to the caller's role.

    A request with a session cookie that changes something must also come from this server's own web app.

    Raises:
        Unauthenticated, CrossSite, Forbidden: the caller may not call the operation.
    """
    caller = await authenticate(request, cache)
    if caller.by_cookie and request.method not in {"GET", "HEAD"}:
        refuse_cross_site(request)
    check_call(caller, request.scope["route"].operation_id)
    return caller


Allowed = Annotated[Caller, Depends(admit)]


async def readmit(request: Request, cache: CredentialCache) -> Caller:
    """Admit the caller of a long request again.

    Raises:
        Unauthenticated, Forbidden: the caller may no longer call the operation.
    """
    return await admit(request, cache, None, None)


async def authenticate_socket(socket: HTTPConnection, cache: CredentialCache) -> Caller:
    """Return the caller who opens a play socket. With a cookie, the socket must come from this server's own web app.

    Raises:
        Unauthenticated, CrossSite, Forbidden: the caller may not open a play socket.
    """
    caller = await authenticate(socket, cache)
    if caller.by_cookie:
        refuse_cross_site(socket)
    check_call(caller, "play")
    return caller


def check_call(caller: Caller, operation: str) -> None:
    """Refuse a caller whose role, or whose token, is not for an operation of `auth.access`.

    Raises:
        Forbidden, OutOfScope: naming what would be allowed.
    """
    check_role(ACCESS[operation], caller.name, caller.role)
    check_scope(ACCESS[operation], caller.scopes)


def refuse_cross_site(connection: HTTPConnection) -> None:
    """Refuse a request unless the browser says that this server's own web app sent it.

    Raises:
        CrossSite: another site may have sent it.
    """
    site = connection.headers.get("sec-fetch-site")
    if site is not None:
        if site in {"same-origin", "none"}:
            return
        raise errors.CrossSite(f"The request did not come from this server's own web app (Sec-Fetch-Site: {site}).")
    origin = connection.headers.get("origin", "")
    if origin.partition("://")[2] != connection.headers.get("host"):
        raise errors.CrossSite("With a session cookie, the Origin must be this server's; a program should use a token.")
