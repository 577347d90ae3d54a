"""Routes for administrators (users, their tokens, login links and performance), and for the caller's own tokens."""

from typing import Annotated

from fastapi import APIRouter, Path

from waypost import wire
from waypost_server import errors
from waypost_server.auth import sessions, tokens
from waypost_server.auth.lookup import Cached
from waypost_server.auth.permissions import Allowed
from waypost_server.auth.roles import ADMINS
from waypost_server.http.context import Ctx
from waypost_server.http.jsonbody import JsonRoute
from waypost_server.http.parameters import DryRun
from waypost_server.http.problems import refusals
from waypost_server.users import erasure, performance
from waypost_server.users import service as users

router = APIRouter(tags=["people"], route_class=JsonRoute)

RowId = Annotated[int, Path(ge=1, le=2**63 - 1)]


@router.get("/users", operation_id="listUsers")
async def list_users(context: Ctx, _: Allowed) -> wire.UserList:
    """List all users."""
    return await context.db.read(users.list_users)


@router.post("/users", status_code=201, operation_id="createUser", responses=refusals(errors.NameTaken))
async def create_user(body: wire.UserCreate, context: Ctx, caller: Allowed) -> wire.User:
    """Create a user: a person or a program that may call the server."""
    return await context.db.write(lambda tx: users.create_user(tx, body.name, body.role, caller.actor))


@router.get("/users/{user}", operation_id="getUser", responses=refusals(errors.NotFound))
async def get_user(user: RowId, context: Ctx, _: Allowed) -> wire.User:
    """Return a user."""
    return await context.db.read(lambda tx: users.view(tx, user))


@router.patch(
    "/users/{user}",
    operation_id="patchUser",
    responses=refusals(errors.NotFound, errors.UserErased, errors.LastAdministrator),
)
async def patch_user(user: RowId, body: wire.UserPatch, context: Ctx, cache: Cached, caller: Allowed) -> wire.User:
    """Change a user's role; deactivate or reactivate a user.

    Deactivation revokes sessions, tokens and login links, and releases leases, all immediately. Answers stay.
    """
    changed = await context.db.write(lambda tx: users.change(tx, user, body, caller.actor))
    cache.clear()
    return changed


@router.delete(
    "/users/{user}",
    operation_id="eraseUser",
    responses=refusals(errors.NotFound, errors.StillActive, errors.UserErased),
)
async def erase_user(user: RowId, context: Ctx, caller: Allowed, dry_run: DryRun = False) -> wire.UserErasure:
    """Delete the personal data of a deactivated user, for good. Answers and their costs stay, without a name."""
    if dry_run:
        return await context.db.read(lambda tx: erasure.preview(tx, user))
    return await context.db.write(lambda tx: erasure.erase(tx, user, caller.actor))


@router.post(
    "/users/{user}/login-links",
    status_code=201,
    operation_id="createLoginLink",
    responses=refusals(errors.NotFound, errors.NotActive),
)
async def create_login_link(
    user: RowId, context: Ctx, caller: Allowed, body: wire.LoginLinkCreate | None = None
) -> wire.LoginLink:
    """Create a one-time login code; the link is `<this server>/login#<code>`."""
    seconds = (body and body.seconds) or context.settings.link_seconds
    return await context.db.write(lambda tx: sessions.create_login_link(tx, user, seconds, caller.actor))


@router.get("/users/{user}/tokens", operation_id="listTokens", responses=refusals(errors.NotFound))
async def list_tokens(user: RowId, context: Ctx, _: Allowed) -> wire.TokenList:
    """List a user's API tokens, without their secrets."""
    return await context.db.read(lambda tx: tokens.list_tokens(tx, user))


@router.get("/users/{user}/numbers", operation_id="getNumbers", responses=refusals(errors.NotFound))
async def get_numbers(user: RowId, context: Ctx, _: Allowed) -> wire.Numbers:
    """Return a user's performance: number of answers, speed, accuracy on gold queries."""
    return await context.db.read(lambda tx: performance.of_user(tx, users.view(tx, user).id))


@router.get("/numbers", operation_id="listNumbers")
async def list_numbers(context: Ctx, _: Allowed) -> wire.NumbersList:
    """Return the performance of every annotator who ever answered."""
    return await context.db.read(performance.of_everyone)


@router.post(
    "/tokens",
    status_code=201,
    operation_id="createToken",
    responses=refusals(errors.Forbidden, errors.NotFound, errors.NotActive),
)
async def create_token(body: wire.TokenCreate, context: Ctx, caller: Allowed) -> wire.NewToken:
    """Create an API token for the caller; an administrator may create one for any user. It is shown only once.

    A token that is made with a token does not outlive it, and has no scope that it lacks.
    """
    user = caller.user if body.user is None else body.user
    if user != caller.user and caller.role not in ADMINS:
        raise errors.Forbidden("Only an administrator may create tokens for other users.", roles=["admin"])
    made_with = None if caller.by_cookie else caller.credential
    return await context.db.write(
        lambda tx: tokens.create_token(tx, user, body.label, body.days, body.scopes, made_with, caller.actor)
    )


@router.delete("/tokens/{token}", status_code=204, operation_id="revokeToken", responses=refusals(errors.NotFound))
async def revoke_token(token: RowId, context: Ctx, cache: Cached, caller: Allowed) -> None:
    """Revoke one of the caller's tokens; an administrator may revoke any. It takes effect immediately."""
    owner = None if caller.role in ADMINS else caller.user
    await context.db.write(lambda tx: tokens.revoke_token(tx, token, owner, caller.actor))
    cache.clear()
