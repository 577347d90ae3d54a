"""The commands about users, their tokens and login links."""

import json
from datetime import UTC, datetime
from typing import Annotated, get_args

import typer
from pydantic import ValidationError

from waypost import wire
from waypost_server.auth import tokens
from waypost_server.cli.login import login_url
from waypost_server.cli.shared import DEFAULT_DATABASE, DatabaseOption, DryRunOption, JsonOption, opened, refuse
from waypost_server.settings import Settings
from waypost_server.users import erasure, sign_in
from waypost_server.users import service as users

app = typer.Typer()
user_app = typer.Typer(no_args_is_help=True, help="Users: people and programs that may call the server.")
token_app = typer.Typer(no_args_is_help=True, help="API tokens.")
app.add_typer(user_app, name="user")
app.add_typer(token_app, name="token")


def _check_role(role: str) -> None:
    if role not in get_args(wire.Role):
        refuse(f"{role!r} is not a role; choose one of {', '.join(get_args(wire.Role))}.")


@user_app.command("add")
def add_user(
    name: str,
    role: Annotated[str, typer.Option(help="admin, learner, annotator or viewer.")] = "annotator",
    database: DatabaseOption = DEFAULT_DATABASE,
    as_json: JsonOption = False,
) -> None:
    """Create a user."""
    _check_role(role)
    try:
        wanted = wire.UserCreate.model_validate({"name": name, "role": role})
    except ValidationError as error:
        refuse(f"{name!r} cannot be a user's name: {error.errors()[0]['msg']}.")
    with opened(database) as db:
        user = db.write_now(lambda tx: users.create_user(tx, wanted.name, wanted.role))
    typer.echo(user.model_dump_json() if as_json else f"User {user.id}: {user.name} ({user.role})")


@user_app.command("list")
def list_users(database: DatabaseOption = DEFAULT_DATABASE, as_json: JsonOption = False) -> None:
    """List all users."""
    with opened(database) as db:
        found = db.read_now(users.list_users)
    if as_json:
        typer.echo(found.model_dump_json())
        return
    for user in found.users:
        away = "" if user.deactivated_at is None else "  (deactivated)" if user.erased_at is None else "  (erased)"
        typer.echo(f"{user.id:>6}  {user.role:<10} {user.name}{away}")


@user_app.command("role")
def set_role(name: str, role: str, database: DatabaseOption = DEFAULT_DATABASE) -> None:
    """Change the role of a user."""
    _check_role(role)
    _change(database, name, wire.UserPatch.model_validate({"role": role}))


@user_app.command("deactivate")
def deactivate_user(name: str, database: DatabaseOption = DEFAULT_DATABASE) -> None:
    """Deactivate a user: revoke sessions, tokens and login links, and release leases. Answers stay."""
    _change(database, name, wire.UserPatch(active=False))


@user_app.command("reactivate")
def reactivate_user(name: str, database: DatabaseOption = DEFAULT_DATABASE) -> None:
    """Reactivate a user, who then needs a new login link or token."""
    _change(database, name, wire.UserPatch(active=True))


@user_app.command("erase")
def erase_user(
    name: str, dry_run: DryRunOption = False, database: DatabaseOption = DEFAULT_DATABASE, as_json: JsonOption = False
) -> None:
    """Delete the personal data of a deactivated user, for good. Answers and their costs stay, without a name."""
    with opened(database, create=False) as db:
        user = db.read_now(lambda tx: users.find_by_name(tx, name)).id
        if dry_run:
            done = db.read_now(lambda tx: erasure.preview(tx, user))
        else:
            done = db.write_now(lambda tx: erasure.erase(tx, user))
    if as_json:
        typer.echo(done.model_dump_json())
        return
    typer.echo(
        f"{'Would delete' if dry_run else 'Deleted'} the name, {done.credentials} credentials, {done.comments} "
        f"comments and {done.reasons} reasons of user {user}. Without a name stay {done.kept_answers} answers "
        f"({done.kept_units:g} units)."
    )


@user_app.command("identify")
def identify_user(
    name: str,
    subject: str,
    issuer: Annotated[str | None, typer.Option(help="The provider; the default is WAYPOST_OIDC_ISSUER.")] = None,
    database: DatabaseOption = DEFAULT_DATABASE,
) -> None:
    """Let somebody of the OpenID provider sign in as an existing user. SUBJECT is the person's id there."""
    provider = issuer or Settings().oidc_issuer
    if provider is None:
        refuse("Which provider? Set WAYPOST_OIDC_ISSUER, as for the server, or give --issuer.")
    with opened(database) as db:
        user = db.read_now(lambda tx: users.find_by_name(tx, name))
        db.write_now(lambda tx: sign_in.identify(tx, user.id, provider, subject))


def _change(database: str, name: str, wanted: wire.UserPatch) -> None:
    with opened(database) as db:
        user = db.read_now(lambda tx: users.find_by_name(tx, name))
        db.write_now(lambda tx: users.change(tx, user.id, wanted))


def _scope(scope: str) -> wire.Scope:
    known: dict[str, wire.Scope] = {one: one for one in get_args(wire.Scope)}
    if scope not in known:
        refuse(f"{scope!r} is not a scope; choose one of {', '.join(known)}.")
    return known[scope]


@token_app.command("create")
def create_token(
    user: str,
    label: Annotated[str, typer.Option(help="The purpose of the token.")] = "",
    days: Annotated[
        float | None, typer.Option(min=0.01, max=3_650, help="For how many days it is valid; without, until revoked.")
    ] = None,
    scope: Annotated[
        list[str] | None,
        typer.Option(help="What it may be used for: read, answer, learn or manage; can be repeated. Without: all."),
    ] = None,
    database: DatabaseOption = DEFAULT_DATABASE,
    as_json: JsonOption = False,
) -> None:
    """Create an API token for a user. It is shown only once."""
    scopes = [_scope(one) for one in scope] if scope else None
    with opened(database) as db:
        owner = db.read_now(lambda tx: users.find_by_name(tx, user))
        token = db.write_now(lambda tx: tokens.create_token(tx, owner.id, label, days, scopes))
    typer.echo(token.model_dump_json() if as_json else token.token)


@token_app.command("list")
def list_tokens(user: str, database: DatabaseOption = DEFAULT_DATABASE, as_json: JsonOption = False) -> None:
    """List a user's API tokens, without their secrets."""
    with opened(database) as db:
        owner = db.read_now(lambda tx: users.find_by_name(tx, user))
        found = db.read_now(lambda tx: tokens.list_tokens(tx, owner.id))
    if as_json:
        typer.echo(found.model_dump_json())
        return
    for token in found.tokens:
        typer.echo(
            f"{token.id:>6}  created {_day(token.created_at)}  last used {_day(token.last_used_at)}  "
            f"expires {_day(token.expires_at)}  {' '.join(token.scopes or ['all']):<12} {token.label}"
        )


def _day(seconds: float | None) -> str:
    return "never     " if seconds is None else f"{datetime.fromtimestamp(seconds, UTC):%Y-%m-%d}"


@token_app.command("revoke")
def revoke_token(token: int, database: DatabaseOption = DEFAULT_DATABASE) -> None:
    """Revoke an API token by its id."""
    with opened(database) as db:
        db.write_now(lambda tx: tokens.revoke_token(tx, token))


@app.command("login-link")
def login_link(
    user: str,
    base: Annotated[str, typer.Option(help="The server's address.")] = "http://127.0.0.1:8000",
    hours: Annotated[float | None, typer.Option(min=0.1, max=168, help="How long the link is valid, in hours.")] = None,
    database: DatabaseOption = DEFAULT_DATABASE,
    as_json: JsonOption = False,
) -> None:
    """Print a one-time link that logs in a user."""
    with opened(database) as db:
        owner = db.read_now(lambda tx: users.find_by_name(tx, user))
        seconds = Settings().link_seconds if hours is None else hours * 3_600
        url = login_url(db, base, owner.name, owner.role, seconds)
    typer.echo(json.dumps({"url": url}) if as_json else url)
