"""Who may call what: each route depends on one of these."""

from collections.abc import Callable, Coroutine
from dataclasses import dataclass
from typing import Annotated, Any

from fastapi import Depends, Request
from fastapi.security import APIKeyCookie, HTTPBearer
from starlette.requests import HTTPConnection

from waypost.wire import Role
from waypost_server import errors
from waypost_server.http.context import Context, Ctx
from waypost_server.users.service import ANSWERING

COOKIE = "waypost_session"

_bearer = HTTPBearer(auto_error=False, scheme_name="token", description="An API token, `wp_...`.")
_cookie = APIKeyCookie(name=COOKIE, auto_error=False, scheme_name="session", description="A browser's session.")

ANYONE: frozenset[Role] = frozenset({"admin", "learner", "annotator", "viewer"})
LEARNERS: frozenset[Role] = frozenset({"admin", "learner"})
ANNOTATORS: frozenset[Role] = ANSWERING
ADMINS: frozenset[Role] = frozenset({"admin"})


@dataclass(frozen=True)
class Caller:
    """The user behind a request and the credential it came with."""

    user: int
    name: str
    role: Role
    credential: int
    by_cookie: bool


async def authenticate(connection: HTTPConnection, context: Ctx) -> Caller:
    """Return who calls, by bearer token or by session cookie."""
    scheme, _, token = connection.headers.get("authorization", "").partition(" ")
    secret, by_cookie = (token.strip(), False) if scheme.lower() == "bearer" else (connection.cookies.get(COOKIE), True)
    if not secret:
        raise errors.Unauthenticated("Send `Authorization: Bearer <token>`, or open a login link (waypost login-link).")
    caller = await _lookup(context, secret, by_cookie)
    if caller is None:
        raise errors.Unauthenticated("The token or session is unknown, expired or revoked; get a new one.")
    return caller


async def _lookup(context: Context, secret: str, by_cookie: bool) -> Caller | None:
    found = await context.credentials.find(secret, "session" if by_cookie else "api")
    if found is None:
        return None
    return Caller(found.user, found.name, found.role, found.credential, by_cookie)


def allow(roles: frozenset[Role]) -> Callable[..., Coroutine[Any, Any, Caller]]:
    """Return a dependency that lets only these roles in; a cookie also needs a request from the page itself."""

    async def check(
        request: Request,
        context: Ctx,
        _token: Annotated[Any, Depends(_bearer)],
        _session: Annotated[Any, Depends(_cookie)],
    ) -> Caller:
        caller = await authenticate(request, context)
        if caller.by_cookie and request.method not in {"GET", "HEAD"}:
            refuse_cross_site(request)
        refuse_role(caller, roles)
        return caller

    return check


async def on_socket(socket: HTTPConnection, context: Context) -> Caller:
    """Return who opens a socket: whoever can do something there, with a cookie only from the page itself."""
    caller = await authenticate(socket, context)
    if caller.by_cookie:
        refuse_cross_site(socket)
    refuse_role(caller, ANNOTATORS | LEARNERS)
    return caller


def refuse_role(caller: Caller, roles: frozenset[Role]) -> None:
    """Refuse a caller whose role is none of these."""
    if caller.role not in roles:
        raise errors.Forbidden(f"This needs the role {' or '.join(sorted(roles))}; {caller.name} is {caller.role}.")


def refuse_cross_site(connection: HTTPConnection) -> None:
    """Refuse an unsafe request unless the browser says that this server's own page caused it."""
    site = connection.headers.get("sec-fetch-site")
    if site is not None:
        if site in {"same-origin", "none"}:
            return
        raise errors.CrossSite(f"The request came from a {site} page.")
    origin = connection.headers.get("origin", "")
    if origin.partition("://")[2] != connection.headers.get("host"):
        raise errors.CrossSite("With a session cookie, send the page's Origin; a program should use a token instead.")


AnyoneCalls = Annotated[Caller, Depends(allow(ANYONE))]
LearnerCalls = Annotated[Caller, Depends(allow(LEARNERS))]
AnnotatorCalls = Annotated[Caller, Depends(allow(ANNOTATORS))]
AdminCalls = Annotated[Caller, Depends(allow(ADMINS))]
