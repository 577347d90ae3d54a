"""Who is calling: their numbers, tokens and sessions."""

from fastapi import APIRouter, Request, Response

from waypost import wire
from waypost_server.auth.permissions import COOKIE, AnyoneCalls
from waypost_server.http.context import Ctx
from waypost_server.http.jsonbody import JsonRoute
from waypost_server.users import accounts, performance
from waypost_server.users import service as users
from waypost_server.users.routes import set_session

router = APIRouter(prefix="/me", tags=["people"], route_class=JsonRoute)


@router.get("", operation_id="me")
async def me(request: Request, response: Response, context: Ctx, caller: AnyoneCalls) -> wire.Me:
    """Say who is calling, and what they have answered. A browser's session begins its length anew with this."""
    seconds = context.settings.session_seconds
    if caller.by_cookie and await context.db.write(lambda tx: accounts.renew_session(tx, caller.credential, seconds)):
        set_session(context, request, response, request.cookies[COOKIE])
    return await context.db.read(lambda tx: users.me(tx, caller.user))


@router.get("/numbers", operation_id="myNumbers")
async def my_numbers(context: Ctx, caller: AnyoneCalls) -> wire.Numbers:
    """Return what the caller has answered, how fast and how far right."""
    return await context.db.read(lambda tx: performance.of_user(tx, caller.user))


@router.get("/tokens", operation_id="myTokens")
async def my_tokens(context: Ctx, caller: AnyoneCalls) -> wire.TokenList:
    """List the caller's API tokens, without their secrets."""
    return await context.db.read(lambda tx: accounts.tokens(tx, caller.user))


@router.get("/sessions", operation_id="mySessions")
async def my_sessions(context: Ctx, caller: AnyoneCalls) -> wire.SessionList:
    """List the browsers the caller is signed in with."""
    return await context.db.read(lambda tx: accounts.sessions(tx, caller.user, caller.credential))


@router.delete("/sessions", status_code=204, operation_id="logoutEverywhere")
async def logout_everywhere(response: Response, context: Ctx, caller: AnyoneCalls) -> None:
    """Sign the caller out of every browser, this one too; tokens stay good."""
    await context.db.write(lambda tx: accounts.end_sessions(tx, caller.user))
    context.credentials.forget()
    response.delete_cookie(COOKIE, path="/")
