"""People and programs: sessions, users, tokens and login links."""

from typing import Annotated

from fastapi import APIRouter, Path, Request, Response

from server import errors, people, wire
from server.access import COOKIE, AdminCalls, AnyoneCalls, refuse_cross_site
from server.context import Ctx
from server.jsonbody import JsonRoute
from server.problems import refusals

router = APIRouter(tags=["people"], route_class=JsonRoute)

RowId = Annotated[int, Path(ge=1, le=2**63 - 1)]


@router.post(
    "/session",
    operation_id="login",
    responses=refusals(errors.Unauthenticated, errors.CrossSite, errors.TooManyAttempts),
)
async def login(body: wire.Login, request: Request, response: Response, context: Ctx) -> wire.Me:
    """Trade the one-time code of a login link for a session cookie."""
    if "sec-fetch-site" in request.headers or "origin" in request.headers:
        refuse_cross_site(request)
    client = request.client.host if request.client else ""
    context.attempts.refuse_if_blocked(client)
    seconds = context.settings.session_seconds
    session = await context.db.write(lambda tx: people.redeem(tx, body.code, seconds))
    if session is None:
        context.attempts.failed(client)
        raise errors.Unauthenticated("The login code is wrong, used or too old; ask for a new login link.")
    secure = context.settings.secure_cookies or request.url.scheme == "https"
    response.set_cookie(
        COOKIE, session.secret, max_age=int(seconds), path="/", httponly=True, samesite="strict", secure=secure
    )
    return await context.db.read(lambda tx: people.me(tx, session.user))


@router.delete("/session", status_code=204, operation_id="logout")
async def logout(response: Response, context: Ctx, caller: AnyoneCalls) -> None:
    """End the browser's session; a token stays good until it is revoked."""
    if caller.by_cookie:
        await context.db.write(lambda tx: people.revoke(tx, caller.credential))
        context.credentials.forget()
    response.delete_cookie(COOKIE, path="/")


@router.get("/me", operation_id="me")
async def me(context: Ctx, caller: AnyoneCalls) -> wire.Me:
    """Say who is calling, and what they have answered."""
    return await context.db.read(lambda tx: people.me(tx, caller.user))


@router.get("/users", operation_id="listUsers")
async def list_users(context: Ctx, _: AdminCalls) -> wire.UserList:
    """List all users."""
    return await context.db.read(people.everyone)


@router.post("/users", status_code=201, operation_id="createUser", responses=refusals(errors.NameTaken))
async def create_user(body: wire.UserCreate, context: Ctx, _: AdminCalls) -> wire.User:
    """Create a user: a person or a program that may call."""
    return await context.db.write(lambda tx: people.create_user(tx, body.name, body.role))


@router.post(
    "/users/{user}/login-links", status_code=201, operation_id="createLoginLink", responses=refusals(errors.NotFound)
)
async def create_login_link(user: RowId, context: Ctx, _: AdminCalls) -> wire.LoginLink:
    """Create a one-time login code; the link is `<this server>/login#<code>`."""
    seconds = context.settings.link_seconds
    return await context.db.write(lambda tx: people.create_login(tx, user, seconds))


@router.post("/tokens", status_code=201, operation_id="createToken", responses=refusals(errors.NotFound))
async def create_token(body: wire.TokenCreate, context: Ctx, _: AdminCalls) -> wire.NewToken:
    """Create an API token; it is shown this once."""
    return await context.db.write(lambda tx: people.create_token(tx, body.user, body.label))


@router.delete("/tokens/{token}", status_code=204, operation_id="revokeToken", responses=refusals(errors.NotFound))
async def revoke_token(token: RowId, context: Ctx, _: AdminCalls) -> None:
    """Revoke a token, at once and for good."""
    await context.db.write(lambda tx: people.revoke_token(tx, token))
    context.credentials.forget()
