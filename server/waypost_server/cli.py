"""The server's commands: `serve`, and the schema, users, tokens and login links of a store."""

import json
import re
import socket
from collections.abc import Iterator
from contextlib import closing, contextmanager
from dataclasses import asdict
from datetime import UTC, datetime
from pathlib import Path
from typing import Annotated, NoReturn, get_args

import typer
from pydantic import ValidationError

from waypost import wire
from waypost_server import errors, serving
from waypost_server.app import create_app
from waypost_server.auth import sessions, tokens
from waypost_server.db import audit, backup, checking, migration
from waypost_server.db.engine import BadDatabase, Database
from waypost_server.db.schema import NewerStore, WrongSchema
from waypost_server.gold.practice import BadPractice
from waypost_server.http import spa
from waypost_server.settings import Settings
from waypost_server.users import service as users

app = typer.Typer(no_args_is_help=True, help="The Waypost server and its users.")
user_app = typer.Typer(no_args_is_help=True, help="Users: people and programs that may call the server.")
token_app = typer.Typer(no_args_is_help=True, help="API tokens.")
app.add_typer(user_app, name="user")
app.add_typer(token_app, name="token")

DatabaseOption = Annotated[
    str, typer.Option("--database", envvar="WAYPOST_DATABASE", help="sqlite:///FILE or postgresql://USER@HOST/NAME.")
]
NoBackupOption = Annotated[bool, typer.Option("--no-backup", help="Migrate an older store without a backup.")]
JsonOption = Annotated[bool, typer.Option("--json", help="Print the result as one line of JSON.")]

DEFAULT_DATABASE = "sqlite:///waypost.db"


def refuse(message: str) -> NoReturn:
    """Print what was wrong and exit with the status for wrong usage."""
    typer.echo(message, err=True)
    raise typer.Exit(2)


@contextmanager
def opened(url: str, *, create: bool = True) -> Iterator[Database]:
    """Open a store for one command; an error ends the command with a message of one sentence."""
    try:
        db = Database(url, create=create)
    except (BadDatabase, WrongSchema) as error:
        refuse(str(error))
    try:
        yield db
    except errors.Refusal as refusal:
        refuse(refusal.detail)
    finally:
        db.close()


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


def serve_app(settings: Settings, host: str, port: int, *, login_link: bool, with_backup: bool = True) -> None:
    """Migrate the store after a backup, and serve it until told to stop.

    Print a login link for an administrator if `login_link` is true or if none has ever logged in.

    Raises:
        CannotServe, BadDatabase, NewerStore, CannotBackUp: with one sentence for the user.
    """
    with closing(serving.bind(host, port)) as bound:
        _serve(settings, host, bound, login_link, with_backup)


def _serve(settings: Settings, host: str, bound: socket.socket, login_link: bool, with_backup: bool) -> None:
    named = () if host in {"0.0.0.0", "::"} else (host,)  # noqa: S104 - compared, not bound
    chosen = settings.model_copy(update={"hosts": (*settings.hosts, *named)})
    done = migration.migrate(chosen.database, with_backup=with_backup)
    with closing(Database(chosen.database)) as db:
        welcome = _welcome(db, serving.url_of(bound), chosen.link_seconds, login_link)
    app = create_app(chosen)  # before the link is printed: while it runs, pydantic sometimes swallows a Ctrl-C
    typer.echo(f"Waypost serves {db.url.render_as_string()} at {serving.url_of(bound)}")
    typer.echo(welcome)
    if done.backup is not None:
        typer.echo(f"The store was of an earlier version: it was backed up to {done.backup}, and migrated.")
    if chosen.page is None and spa.find() is None:
        typer.echo("The web app is not built; `make web` builds it.")
    serving.foreground(app, bound)


def _welcome(db: Database, base: str, seconds: float, login_link: bool) -> str:
    """Return how to log in. The output of a server is often kept, so a link is in it only if it is needed."""
    name = db.write_now(users.ensure_administrator).name
    if not login_link and db.read_now(sessions.administrator_has_logged_in):
        return f"`waypost login-link {name}` prints a login link."
    link = login_url(db, base, name, "admin", seconds)
    return f"Log in with this link (it works once, for {seconds / 60:.0f} minutes): {link}"


@app.command()
def serve(
    host: Annotated[str, typer.Option(help="The address to listen on.")] = "127.0.0.1",
    port: Annotated[int, typer.Option(min=0, max=65_535, help="The port; 0 for any free port.")] = 8000,
    database: DatabaseOption = DEFAULT_DATABASE,
    lease: Annotated[float | None, typer.Option(help="How long a lease lasts without a renewal, in seconds.")] = None,
    login_link: Annotated[
        bool, typer.Option("--login-link", help="Print a login link even if an administrator has logged in before.")
    ] = False,
    no_backup: NoBackupOption = False,
) -> None:
    """Serve the API and the web app. Until an administrator has logged in, print a one-time login link."""
    given = {"database": database} | ({} if lease is None else {"lease_seconds": lease})
    try:
        settings = Settings.model_validate(Settings().model_dump() | given)
        serve_app(settings, host, port, login_link=login_link, with_backup=not no_backup)
    except ValidationError as error:
        first = error.errors()[0]
        refuse(f"The setting {'.'.join(map(str, first['loc']))} is not valid: {first['msg']}.")
    except (serving.CannotServe, BadDatabase, NewerStore, BadPractice, backup.CannotBackUp) as error:
        refuse(str(error))


@app.command()
def migrate(
    database: DatabaseOption = DEFAULT_DATABASE, no_backup: NoBackupOption = False, as_json: JsonOption = False
) -> None:
    """Bring a store up to this version's schema, after a backup: there is no way back."""
    try:
        found = migration.migrate(database, with_backup=not no_backup)
    except (BadDatabase, NewerStore, backup.CannotBackUp) as error:
        refuse(str(error))
    done = found.migrated
    if found.backup is not None and not as_json:
        typer.echo(f"Backed up to {found.backup}.")
    if as_json:
        typer.echo(json.dumps(asdict(done) | {"backup": str(found.backup) if found.backup else None}))
    elif done.before == done.after:
        typer.echo(f"The store already has schema {done.after}.")
    else:
        typer.echo(f"The store has schema {done.after} now; before, it {_had(done.before)}.")


@app.command()
def check(
    database: DatabaseOption = DEFAULT_DATABASE,
    audit_head: Annotated[
        str | None,
        typer.Option(metavar="NUMBER:HASH", help="A row of the audit log that was noted earlier: it must be there."),
    ] = None,
    as_json: JsonOption = False,
) -> None:
    """Check a store: file, ledger, leases, audit log. It only reads, so servers may use the store meanwhile."""
    noted = None if audit_head is None else _head(audit_head)
    with opened(database, create=False) as db:
        results = db.read_now(lambda tx: checking.check(tx, noted))
    if as_json:
        typer.echo(json.dumps([asdict(result) for result in results]))
    else:
        for result in results:
            typer.echo(_line(result))
    if any(result.n_faults for result in results):
        raise typer.Exit(1)


def _head(text: str) -> audit.Head:
    number, _, digest = text.partition(":")
    if not re.fullmatch(r"[1-9]\d{0,17}:[0-9a-f]{64}", text):
        refuse(f"{text!r} is not a row of the audit log; `waypost check` prints one as NUMBER:HASH.")
    return audit.Head(int(number), digest)


def _line(result: checking.Result) -> str:
    if not result.n_faults:
        return f"ok    {result.fact}{f' Its newest row: {result.head}' if result.head else ''}"
    more = result.n_faults - len(result.faults)
    return f"WRONG {result.fact} Not so: {', '.join(result.faults)}{f' and {more} more' if more else ''}."


@app.command("backup")
def back_up(file: Path, database: DatabaseOption = DEFAULT_DATABASE) -> None:
    """Back up a store to a new file. Servers may use the store meanwhile."""
    try:
        backup.back_up(database, file)
    except (BadDatabase, backup.CannotBackUp) as error:
        refuse(str(error))
    typer.echo(f"Backed up to {file}. `waypost restore {file}` restores it.")


@app.command()
def restore(
    file: Path,
    database: DatabaseOption = DEFAULT_DATABASE,
    anyway: Annotated[bool, typer.Option("--anyway", help="Restore a store that does not pass the checks.")] = False,
) -> None:
    """Restore a backup as a new SQLite file, or in an empty PostgreSQL database, and check it."""
    try:
        found = backup.restore(file, database, anyway=anyway)
    except (BadDatabase, WrongSchema, backup.CannotBackUp, errors.StorageFailed) as error:
        refuse(str(error))
    if found.older:
        typer.echo("Restored. An earlier version wrote it: `waypost migrate` migrates it.")
    for result in found.wrong:
        typer.echo(_line(result))
    if found.wrong:
        typer.echo("Restored, with these faults.")
        raise typer.Exit(1)
    if not found.older:
        typer.echo("Restored and checked.")


def _had(schema: str | None) -> str:
    return "was empty" if schema is None else f"had {schema}"


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
        away = "" if user.deactivated_at is None else "  (deactivated)"
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


def _change(database: str, name: str, wanted: wire.UserPatch) -> None:
    with opened(database) as db:
        user = db.read_now(lambda tx: users.find_by_name(tx, name))
        db.write_now(lambda tx: users.change(tx, user.id, wanted))


@token_app.command("create")
def create_token(
    user: str,
    label: Annotated[str, typer.Option(help="The purpose of the token.")] = "",
    days: Annotated[
        float | None, typer.Option(min=0.01, max=3_650, help="For how many days it is valid; without, until revoked.")
    ] = None,
    database: DatabaseOption = DEFAULT_DATABASE,
    as_json: JsonOption = False,
) -> None:
    """Create an API token for a user. It is shown only once."""
    with opened(database) as db:
        owner = db.read_now(lambda tx: users.find_by_name(tx, user))
        token = db.write_now(lambda tx: tokens.create_token(tx, owner.id, label, days))
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
            f"expires {_day(token.expires_at)}  {token.label}"
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


if __name__ == "__main__":
    app()
