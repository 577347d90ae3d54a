"""People and programs: login and logout, users, their tokens and login links."""

from typing import Annotated

from fastapi import APIRouter, Path, Request, Response

from waypost import wire
from waypost_server import errors
from waypost_server.auth.permissions import ADMINS, COOKIE, AdminCalls, AnyoneCalls, refuse_cross_site
from waypost_server.http.context import Context, Ctx
from waypost_server.http.jsonbody import JsonRoute
from waypost_server.http.problems import refusals
from waypost_server.users import accounts, performance
from waypost_server.users import service as users

router = APIRouter(tags=["people"], route_class=JsonRoute)

RowId = Annotated[int, Path(ge=1, le=2**63 - 1)]


def set_session(context: Context, request: Request, response: Response, secret: str) -> None:
    """Have the browser keep a session for as long as the server does."""
    response.set_cookie(
        COOKIE,
        secret,
        max_age=int(context.settings.session_seconds),
        path="/",
        httponly=True,
        samesite="strict",
        secure=context.settings.secure_cookies or request.url.scheme == "https",
    )


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
async def login(body: wire.Login, request: Request, response: Response, context: Ctx) -> wire.Me:
    """Trade the one-time code of a login link for a session cookie."""
    if "sec-fetch-site" in request.headers or "origin" in request.headers:
        refuse_cross_site(request)
    client = request.client.host if request.client else ""
    context.attempts.refuse_if_blocked(client)
    seconds = context.settings.session_seconds
    session = await context.db.write(lambda tx: users.redeem(tx, body.code, seconds))
    if session is None:
        context.attempts.failed(client)
        raise await context.db.read(lambda tx: users.why_not(tx, body.code))
    set_session(context, request, response, session.secret)
    return await context.db.read(lambda tx: users.me(tx, session.user))


@router.delete("/session", status_code=204, operation_id="logout")
async def logout(response: Response, context: Ctx, caller: AnyoneCalls) -> None:
    """End the browser's session; a token stays good until it is revoked."""
    if caller.by_cookie:
        await context.db.write(lambda tx: users.revoke(tx, caller.credential))
        context.credentials.forget()
    response.delete_cookie(COOKIE, path="/")


@router.get("/users", operation_id="listUsers")
async def list_users(context: Ctx, _: AdminCalls) -> wire.UserList:
    """List all users."""
    return await context.db.read(users.everyone)


@router.post("/users", status_code=201, operation_id="createUser", responses=refusals(errors.NameTaken))
async def create_user(body: wire.UserCreate, context: Ctx, _: AdminCalls) -> wire.User:
    """Create a user: a person or a program that may call."""
    return await context.db.write(lambda tx: users.create_user(tx, body.name, body.role))


@router.get("/users/{user}", operation_id="getUser", responses=refusals(errors.NotFound))
async def get_user(user: RowId, context: Ctx, _: AdminCalls) -> wire.User:
    """Return a user."""
    return await context.db.read(lambda tx: users.view(tx, user))


@router.patch("/users/{user}", operation_id="patchUser", responses=refusals(errors.NotFound, errors.LastAdministrator))
async def patch_user(user: RowId, body: wire.UserPatch, context: Ctx, _: AdminCalls) -> wire.User:
    """Change a user's role, deactivate or reactivate them.

    Who is deactivated is signed out, their tokens and links end for good, and what they hold goes back to the queue.
    """
    changed = await context.db.write(lambda tx: accounts.change(tx, user, body))
    context.credentials.forget()
    return changed


@router.post(
    "/users/{user}/login-links",
    status_code=201,
    operation_id="createLoginLink",
    responses=refusals(errors.NotFound, errors.NotActive),
)
async def create_login_link(
    user: RowId, context: Ctx, _: AdminCalls, body: wire.LoginLinkCreate | None = None
) -> wire.LoginLink:
    """Create a one-time login code; the link is `<this server>/login#<code>`."""
    seconds = (body and body.seconds) or context.settings.link_seconds
    return await context.db.write(lambda tx: users.create_login(tx, user, seconds))


@router.get("/users/{user}/tokens", operation_id="listTokens", responses=refusals(errors.NotFound))
async def list_tokens(user: RowId, context: Ctx, _: AdminCalls) -> wire.TokenList:
    """List a user's API tokens, without their secrets."""
    return await context.db.read(lambda tx: accounts.tokens(tx, user))


@router.get("/users/{user}/numbers", operation_id="getNumbers", responses=refusals(errors.NotFound))
async def get_numbers(user: RowId, context: Ctx, _: AdminCalls) -> wire.Numbers:
    """Return what a user has answered, how fast and how far right."""
    return await context.db.read(lambda tx: performance.of_user(tx, users.view(tx, user).id))


@router.get("/numbers", operation_id="listNumbers")
async def list_numbers(context: Ctx, _: AdminCalls) -> wire.NumbersList:
    """Return the numbers of all who ever answered."""
    return await context.db.read(performance.of_everyone)


@router.post(
    "/tokens",
    status_code=201,
    operation_id="createToken",
    responses=refusals(errors.Forbidden, errors.NotFound, errors.NotActive),
)
async def create_token(body: wire.TokenCreate, context: Ctx, caller: AnyoneCalls) -> wire.NewToken:
    """Create an API token, for oneself or, as an administrator, for anybody; it is shown this once."""
    user = caller.user if body.user is None else body.user
    if user != caller.user and caller.role not in ADMINS:
        raise errors.Forbidden("Only an administrator makes tokens for others.")
    return await context.db.write(lambda tx: users.create_token(tx, user, body.label))


@router.delete("/tokens/{token}", status_code=204, operation_id="revokeToken", responses=refusals(errors.NotFound))
async def revoke_token(token: RowId, context: Ctx, caller: AnyoneCalls) -> None:
    """Revoke one's own token, or, as an administrator, anybody's; at once and for good."""
    owner = None if caller.role in ADMINS else caller.user
    await context.db.write(lambda tx: accounts.revoke_token(tx, token, owner))
    context.credentials.forget()
