"""The commands: what they print, and what they say of wrong usage."""

import json
import re
import signal
import socket
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager

import httpx2
import pytest
from tests.server.kit import API, make_older_store, schema_of
from typer.testing import CliRunner

from waypost import wire
from waypost_server.cli.main import app
from waypost_server.db.engine import Database
from waypost_server.users import service as users


def run(*arguments: str, status: int = 0) -> str:
    done = CliRunner().invoke(app, list(arguments))
    assert done.exit_code == status, done.output
    return done.output.strip()


def test_users_and_tokens_are_made_on_the_command_line(sqlite_url: str) -> None:
    at = ("--database", sqlite_url)
    made = json.loads(run("user", "add", "zoe", "--role", "learner", "--json", *at))
    assert (made["name"], made["role"]) == ("zoe", "learner")
    assert "zoe" in run("user", "list", *at)
    token = json.loads(run("token", "create", "zoe", "--label", "laptop", "--json", *at))
    assert token["token"].startswith("wp_")
    assert run("token", "revoke", str(token["id"]), *at) == ""
    assert re.fullmatch(r"http://h/login#wp_[\w-]{43}", run("login-link", "zoe", "--base", "http://h/", *at))


def test_users_are_changed_on_the_command_line(sqlite_url: str) -> None:
    at = ("--database", sqlite_url)
    run("user", "add", "ann", "--role", "admin", *at)
    run("user", "add", "zoe", *at)
    run("token", "create", "zoe", "--label", "laptop", *at)
    assert "laptop" in run("token", "list", "zoe", *at)
    assert json.loads(run("token", "list", "zoe", "--json", *at))["tokens"][0]["last_used_at"] is None
    run("user", "role", "zoe", "viewer", *at)
    run("user", "deactivate", "zoe", *at)
    assert re.search(r"viewer +zoe +\(deactivated\)", run("user", "list", *at))
    assert run("token", "list", "zoe", *at) == ""
    assert "deactivated; reactivate" in run("login-link", "zoe", *at, status=2)
    run("user", "reactivate", "zoe", *at)
    assert "/login#wp_" in run("login-link", "zoe", "--hours", "24", *at)
    assert "only administrator" in run("user", "deactivate", "ann", *at, status=2)


def test_serve_lets_some_administrator_in_whoever_is_left(sqlite_url: str) -> None:
    db = Database(sqlite_url)
    for name in ("admin", "ann"):
        db.write_now(lambda tx, name=name: users.create_user(tx, name, "admin"))
    assert db.write_now(users.ensure_administrator).name == "admin"
    db.write_now(lambda tx: users.change(tx, 1, wire.UserPatch(active=False)))
    assert db.write_now(users.ensure_administrator).name == "ann"
    db.close()


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (
            ["user", "add", "x", "--role", "king"],
            "'king' is not a role; choose one of admin, learner, annotator, viewer.",
        ),
        (["user", "add", ""], "cannot be a user's name"),
        (["user", "list", "--database", "nonsense"], "'nonsense' is not a database URL"),
        (
            ["user", "list", "--database", "sqlite:////no/such/folder/x.db"],
            "Cannot open sqlite:////no/such/folder/x.db",
        ),
        (["token", "create", "nobody"], "There is no user named 'nobody'"),
        (["user", "role", "nobody", "viewer"], "There is no user named 'nobody'"),
        (["user", "role", "nobody", "king"], "'king' is not a role"),
        (["token", "revoke", "77"], "There is no token 77."),
        (["login-link", "nobody"], "There is no user named 'nobody'"),
        (["serve", "--lease", "-1"], "The setting lease_seconds is not valid"),
        (["serve", "--database", "mysql://x/y"], "use sqlite:///FILE or postgresql://"),
    ],
)
def test_wrong_usage_gets_one_sentence_and_status_2(sqlite_url: str, arguments: list[str], message: str) -> None:
    given = arguments if "--database" in arguments else [*arguments, "--database", sqlite_url]
    output = run(*given, status=2)
    assert message in output
    assert len(output.splitlines()) == 1


def test_a_port_in_use_is_explained(sqlite_url: str) -> None:
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        taken.listen()
        port = str(taken.getsockname()[1])
        assert f"Cannot listen on 127.0.0.1:{port}" in run("serve", "--port", port, "--database", sqlite_url, status=2)


def test_a_newer_store_is_explained(sqlite_url: str) -> None:
    db = Database(sqlite_url)
    db.write_now(lambda tx: tx.conn.exec_driver_sql("UPDATE alembic_version SET version_num = '9999'"))
    db.close()
    assert "does not know" in run("serve", "--port", "0", "--database", sqlite_url, status=2)


def test_no_command_but_migrate_and_serve_changes_the_schema_of_a_store(sqlite_url: str) -> None:
    at = ("--database", sqlite_url)
    make_older_store(sqlite_url)
    for arguments in (
        ["user", "add", "zoe"],
        ["user", "list"],
        ["user", "role", "ann", "admin"],
        ["user", "deactivate", "ann"],
        ["user", "reactivate", "ann"],
        ["token", "create", "ann"],
        ["token", "list", "ann"],
        ["token", "revoke", "1"],
        ["login-link", "ann"],
    ):
        assert f"run `waypost migrate --database {sqlite_url}`" in run(*arguments, *at, status=2), arguments
    assert schema_of(sqlite_url) == "0006"
    assert json.loads(run("migrate", "--json", *at))["before"] == "0006"
    assert "ann" in run("user", "list", *at)
    assert "already has" in run("migrate", *at)


def test_serve_migrates_an_older_store(sqlite_url: str) -> None:
    make_older_store(sqlite_url)
    with serving(sqlite_url) as line:
        log_in(line)
    assert schema_of(sqlite_url) > "0006"


@contextmanager
def serving(database: str, *options: str) -> Iterator[str]:
    """Serve in a process of its own; yields the second line that it prints."""
    command = [sys.executable, "-u", "-m", "waypost_server.cli", "serve", "--port", "0", "--database", database]
    with subprocess.Popen([*command, *options], stdout=subprocess.PIPE, text=True) as process:
        assert process.stdout is not None
        process.stdout.readline()
        yield process.stdout.readline().strip()
        stopping = time.monotonic()
        process.terminate()
        process.wait(60)
    assert time.monotonic() - stopping < 10
    assert process.returncode == -signal.SIGTERM


def log_in(line: str) -> None:
    """Open the login link at the end of a line, as an administrator."""
    base, _, code = line.split()[-1].partition("/login#")
    with httpx2.Client(base_url=base, timeout=30) as client:
        reply = client.post(f"{API}/session", json={"code": code}, headers={"Origin": base})
        assert (reply.status_code, reply.json()["role"]) == (200, "admin")
        assert client.get(f"{API}/users").status_code == 200


def test_serve_prints_a_link_for_an_administrator_until_one_has_logged_in(sqlite_url: str) -> None:
    with serving(sqlite_url) as line:
        assert "/login#" in line, "nobody has used it"
    with serving(sqlite_url) as line:
        log_in(line)
    with serving(sqlite_url) as line:
        assert line == "`waypost login-link admin` prints a login link."
    with serving(sqlite_url, "--login-link") as line:
        log_in(line)
