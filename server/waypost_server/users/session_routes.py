"""Routes of login and logout, and of the caller's own account: performance, tokens, sessions."""

from fastapi import APIRouter, Request, Response

from waypost import wire
from waypost_server import errors
from waypost_server.auth import credentials, sessions, tokens
from waypost_server.auth.attempts import Counted
from waypost_server.auth.lookup import Cached
from waypost_server.auth.permissions import Allowed, address_of, cookie_of, is_secure, refuse_cross_site
from waypost_server.http.context import Context, Ctx
from waypost_server.http.jsonbody import JsonRoute
from waypost_server.http.problems import refusals
from waypost_server.users import performance

router = APIRouter(tags=["people"], route_class=JsonRoute)


def set_cookie(context: Context, request: Request, response: Response, secret: str) -> None:
    """Set the session cookie. The browser keeps it for as long as the session lasts."""
    response.set_cookie(
        cookie_of(request),
        secret,
        max_age=int(context.settings.session_seconds),
        path="/",
        httponly=True,
        samesite="strict",
        secure=is_secure(request),
    )


def _delete_cookie(request: Request, response: Response) -> None:
    response.delete_cookie(cookie_of(request), path="/", httponly=True, samesite="strict", secure=is_secure(request))


@router.post(
    "/session",
    operation_id="login",
    responses=refusals(
        errors.Unauthenticated,
        errors.LoginUsed,
        errors.LoginExpired,
        errors.Deactivated,
        errors.CrossSite,
        errors.TooManyAttempts,
    ),
)
async def login(body: wire.Login, request: Request, response: Response, context: Ctx, attempts: Counted) -> wire.Me:
    """Exchange the one-time code of a login link for a session cookie."""
    if "sec-fetch-site" in request.headers or "origin" in request.headers:
        refuse_cross_site(request)
    address, code, seconds = address_of(request), credentials.hash_of(body.code), context.settings.session_seconds
    session = None
    if await context.db.read(lambda tx: credentials.find(tx, code, "login")):  # wrong codes cost no change of the store
        session = await context.db.write(lambda tx: sessions.redeem(tx, body.code, seconds, address))
    if session is None:
        attempts.failed(address)
        request.state.rejected = ("login", code)
        raise await context.db.read(lambda tx: sessions.why_refused(tx, body.code))
    set_cookie(context, request, response, session.secret)
    return await context.db.read(lambda tx: performance.me(tx, session.user))


@router.delete("/session", status_code=204, operation_id="logout")
async def logout(request: Request, response: Response, context: Ctx, cache: Cached, caller: Allowed) -> None:
    """End the browser's session. API tokens stay valid."""
    if caller.by_cookie:
        await context.db.write(lambda tx: sessions.end_session(tx, caller.credential, caller.actor))
        cache.clear()
    _delete_cookie(request, response)


@router.get("/me", operation_id="me")
async def me(request: Request, response: Response, context: Ctx, caller: Allowed) -> wire.Me:
    """Return the caller and the totals of their answers. This call also renews a browser's session."""
    seconds, most = context.settings.session_seconds, context.settings.session_max_seconds
    if caller.by_cookie and await context.db.write(
        lambda tx: sessions.renew_session(tx, caller.credential, seconds, most)
    ):
        set_cookie(context, request, response, request.cookies[cookie_of(request)])
    return await context.db.read(lambda tx: performance.me(tx, caller.user))


@router.get("/me/numbers", operation_id="myNumbers")
async def my_numbers(context: Ctx, caller: Allowed) -> wire.Numbers:
    """Return the caller's performance: number of answers, speed, accuracy on gold queries, ten at a time."""
    return await context.db.read(lambda tx: performance.of_self(tx, caller.user))


@router.get("/me/tokens", operation_id="myTokens")
async def my_tokens(context: Ctx, caller: Allowed) -> wire.TokenList:
    """List the caller's API tokens, without their secrets."""
    return await context.db.read(lambda tx: tokens.list_tokens(tx, caller.user))


@router.get("/me/sessions", operation_id="mySessions")
async def my_sessions(context: Ctx, caller: Allowed) -> wire.SessionList:
    """List the caller's browser sessions."""
    return await context.db.read(lambda tx: sessions.list_sessions(tx, caller.user, caller.credential))


@router.delete("/me/sessions", status_code=204, operation_id="logoutEverywhere")
async def logout_everywhere(request: Request, response: Response, context: Ctx, cache: Cached, caller: Allowed) -> None:
    """End all of the caller's browser sessions, including this one. API tokens stay valid."""
    await context.db.write(lambda tx: sessions.end_all_sessions(tx, caller.user, caller.actor))
    cache.clear()
    _delete_cookie(request, response)
