"""The audit log: one row for each action, no secret in any, few rows of refusals, and a chain that anybody verifies."""

import asyncio
import csv
import hashlib
import io
import json
import re
import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import cast

import pytest
from sqlalchemy.exc import OperationalError
from starlette.testclient import TestClient
from tests.server.kit import API, Json, Service, in_process, query, right_answer
from typer.testing import CliRunner

from waypost_server.auth import refusals
from waypost_server.cli.main import app
from waypost_server.db.audit import Entry, nobody
from waypost_server.db.engine import Database
from waypost_server.db.transaction import Tx
from waypost_server.errors import StorageFailed
from waypost_server.users import service as users

OPERATOR = Path(__file__).parents[3] / "docs" / "operator.md"
SAME = {"Sec-Fetch-Site": "same-origin"}
# Every kind of text with which a secret could be found again: the secret itself, and the hash that the store keeps.
SECRETS = re.compile(r"wp_[\w-]{43}")


def command(url: str, *arguments: str, status: int = 0) -> str:
    done = CliRunner().invoke(app, [*arguments, "--database", url])
    assert done.exit_code == status, done.output
    return done.output.strip()


def check(url: str, *arguments: str, status: int = 0) -> Json:
    """The result of `waypost check` about the audit log."""
    results: list[Json] = json.loads(command(url, "check", "--json", *arguments, status=status))
    (found,) = [one for one in results if one["fact"].startswith("The audit log is one chain")]
    return found


def export(service: Service, form: str = "jsonl") -> str:
    reply = service.client.get(f"{API}/audit/export?format={form}", headers=service.admin.headers)
    assert reply.status_code == 200, reply.text
    return reply.text


def log_of(service: Service) -> list[Json]:
    return [json.loads(line) for line in export(service).splitlines()]


def id_of(service: Service, name: str) -> int:
    return service.db.read_now(lambda tx: users.find_by_name(tx, name)).id


class Story:
    """Everything that the log records, done one after the other; `done` says what row each is expected to make."""

    def __init__(self, service: Service, url: str) -> None:
        self.service, self.url = service, url
        self.secrets: set[str] = {one.token for one in (service.admin, service.learner, service.viewer)}
        self.ann, self.abe, self.lea = (id_of(service, name) for name in ("ann", "abe", "lea"))
        self.run = service.learner.create_run()

    def keep(self, secret: object) -> str:
        self.secrets.add(str(secret))
        return str(secret)

    def link(self) -> str:
        return self.keep(self.service.admin.post(f"/users/{self.abe}/login-links", expect=201)["code"])

    def log_in(self, code: str, expect: int = 200) -> None:
        reply = self.service.client.post(f"{API}/session", json={"code": code}, headers=SAME)
        assert reply.status_code == expect
        for value in self.service.client.cookies.values():
            self.keep(value)

    def with_token(self, token: str, method: str, path: str) -> int:
        headers = {"Authorization": f"Bearer {token}", "X-Forwarded-For": "203.0.113.7"}
        return self.service.client.request(method, API + path, headers=headers).status_code

    def by_the_api(self) -> Iterator[tuple[str, str, str | None, Json]]:
        """Act over HTTP, and yield the action, the actor, the object and a part of the details of each row."""
        admin, client = self.service.admin, self.service.client
        zoe = admin.post("/users", {"name": "zoe", "role": "viewer"}, 201)["id"]
        yield "user.created", "ann", f"user/{zoe}", {"name": "zoe", "role": "viewer"}
        admin.call("PATCH", f"/users/{zoe}", {"role": "learner"})
        yield "user.role_changed", "ann", f"user/{zoe}", {"from": "viewer", "to": "learner"}
        made = admin.post("/tokens", {"user": zoe, "label": "laptop", "days": 7}, 201)
        yield "token.created", "ann", f"token/{made['id']}", {"user": zoe, "name": "zoe", "label": "laptop"}
        admin.call("DELETE", f"/tokens/{made['id']}", expect=204)
        yield "token.revoked", "ann", f"token/{made['id']}", {"user": zoe, "label": "laptop"}
        assert self.with_token(self.keep(made["token"]), "GET", "/me") == 401
        rejected = {"operation": "me", "by": "token", "token": made["id"], "reason": "revoked"}
        yield "login.refused", "nobody", f"user/{zoe}", rejected
        assert self.with_token(self.keep("wp_" + "x" * 43), "GET", "/runs") == 401
        yield "login.refused", "nobody", None, {"operation": "listRuns", "by": "token", "reason": "unknown"}
        admin.call("PATCH", f"/users/{zoe}", {"active": False})
        yield "user.deactivated", "ann", f"user/{zoe}", {"name": "zoe"}
        admin.call("PATCH", f"/users/{zoe}", {"active": True})
        yield "user.reactivated", "ann", f"user/{zoe}", {"name": "zoe"}
        code = self.link()
        yield "link.created", "ann", f"user/{self.abe}", {"name": "abe"}
        self.log_in(code)
        yield "login", "abe", f"user/{self.abe}", {}
        self.log_in(code, 401)
        yield "login.refused", "nobody", f"user/{self.abe}", {"operation": "login", "by": "link", "reason": "revoked"}
        assert client.get(f"{API}/users").status_code == 403
        yield "permission.refused", "abe", None, {"operation": "listUsers", "reason": "forbidden"}
        assert client.delete(f"{API}/session", headers={"Origin": "https://evil.example"}).status_code == 403
        yield "permission.refused", "abe", None, {"operation": "logout", "reason": "cross-site"}
        assert client.delete(f"{API}/session", headers=SAME).status_code == 204
        yield "logout", "abe", f"user/{self.abe}", {}
        code = self.link()
        yield "link.created", "ann", f"user/{self.abe}", {"name": "abe"}
        self.log_in(code)
        yield "login", "abe", f"user/{self.abe}", {}
        assert client.delete(f"{API}/me/sessions", headers=SAME).status_code == 204
        yield "logout", "abe", f"user/{self.abe}", {"sessions": 1}
        client.cookies.clear()
        self.service.user("leo", "learner")
        yield "user.created", "command line", f"user/{id_of(self.service, 'leo')}", {"name": "leo"}

    def of_objects(self) -> Iterator[tuple[str, str, str | None, Json]]:
        """Be refused an object of somebody else: a run, an assignment, an answer of a batch, a play socket."""
        service, query_id = self.service, self.held["query"]["id"]
        service.viewer.patch(self.run, 403, name="mine")
        yield "permission.refused", "vic", f"run/{self.run}", {"operation": "patchRun", "reason": "forbidden"}
        held = self.held["id"]
        service.admin.renew(self.held, 403)
        yield "permission.refused", "ann", f"assignment/{held}", {"operation": "renew", "reason": "not-yours"}
        one = {"assignment": held, "token": self.held["token"], "answer": right_answer(self.held["query"]["ask"])}
        service.admin.post("/assignments/answers", {"answers": [one]})
        yield "permission.refused", "ann", None, {"operation": "answerBatch", "reason": "not-yours"}
        assert isinstance(service.client, TestClient)
        path = f"{API}/queries/{query_id}/play"
        with service.client.websocket_connect(path, headers=service.viewer.headers) as socket:
            assert socket.receive()["code"] == 4403
        yield "permission.refused", "vic", f"query/{query_id}", {"operation": "play", "reason": "forbidden"}

    def by_commands(self) -> Iterator[tuple[str, str, str | None, Json]]:
        """Act at the command line."""
        zed = json.loads(command(self.url, "user", "add", "zed", "--json"))["id"]
        yield "user.created", "command line", f"user/{zed}", {"name": "zed", "role": "annotator"}
        command(self.url, "user", "role", "zed", "viewer")
        yield "user.role_changed", "command line", f"user/{zed}", {"from": "annotator", "to": "viewer"}
        made = json.loads(command(self.url, "token", "create", "zed", "--label", "=1", "--json"))
        self.keep(made["token"])
        yield "token.created", "command line", f"token/{made['id']}", {"label": "=1", "expires": None}
        command(self.url, "token", "revoke", str(made["id"]))
        yield "token.revoked", "command line", f"token/{made['id']}", {"label": "=1"}
        command(self.url, "user", "deactivate", "zed")
        yield "user.deactivated", "command line", f"user/{zed}", {}
        command(self.url, "user", "reactivate", "zed")
        yield "user.reactivated", "command line", f"user/{zed}", {}
        self.keep(json.loads(command(self.url, "login-link", "zed", "--json"))["url"].partition("#")[2])
        yield "link.created", "command line", f"user/{zed}", {}

    @property
    def held(self) -> Json:
        """A query that the annotator has leased."""
        if not hasattr(self, "_held"):
            self.service.learner.ask(self.run, query(), query(ordinal=1))
            self._held: Json = self.service.annotator.lease()
        return self._held

    def without_a_row(self) -> None:
        """Lease, answer, ask who one is without a credential, and repeat changes that change nothing."""
        service, abe = self.service, self.abe
        service.annotator.answer(self.held)
        service.annotator.lease()
        service.client.cookies.clear()
        assert service.client.get(f"{API}/me").status_code == 401
        service.admin.call("PATCH", f"/users/{abe}", {"role": "annotator", "active": True})
        service.admin.post("/users", {"name": "abe", "role": "viewer"}, 409)
        service.admin.call("DELETE", "/tokens/999", expect=404)


def test_each_action_makes_exactly_one_row_without_a_secret(service: Service, database_url: str) -> None:
    story, number = Story(service, database_url), len(log_of(service))
    assert story.held
    for part in (story.by_the_api(), story.of_objects(), story.by_commands()):
        for action, actor, about, details in part:
            rows = log_of(service)[number:]
            number += 1
            if details == {"name": "leo"}:  # the kit's user also gets a token
                assert rows.pop()["action"] == "token.created"
                number += 1
            (row,) = rows
            assert (row["action"], row["actor"], row["object"]) == (action, actor, about)
            assert row["details"].items() >= details.items(), row
            is_command = actor == "command line"
            assert row["address"] == (None if is_command else "testclient"), "a header of the client proves nothing"
            assert (row["user"] is None) == (is_command or actor == "nobody")
    story.without_a_row()
    assert len(log_of(service)) == number
    written = export(service) + export(service, "csv")
    assert SECRETS.findall(written) == []
    for secret in story.secrets:
        assert secret not in written
        assert hashlib.sha256(secret.encode()).hexdigest() not in written


def test_an_exported_log_is_verified_with_nothing_but_sha_256(
    service: Service, database_url: str, tmp_path: Path
) -> None:
    service.admin.post("/users", {"name": "=zoé", "role": "viewer"}, 201)
    before = "0" * 64
    for number, row in enumerate(log_of(service), start=1):
        own = row.pop("hash")
        said = json.dumps(row, sort_keys=True, separators=(",", ":")).encode()
        assert (row["number"], row["previous"], own) == (number, before, hashlib.sha256(said).hexdigest())
        before = own
    assert check(database_url)["head"] == f"{number}:{before}" == service.admin.get("/audit")["head"]
    (tmp_path / "audit.jsonl").write_text(export(service))
    (program,) = re.findall(r"```python\n(.*?)```", OPERATOR.read_text(), re.DOTALL)
    printed = subprocess.run([sys.executable, "-c", program], cwd=tmp_path, capture_output=True, text=True, check=True)
    assert printed.stdout == f"{number}:{before}\n", "the program in the document for operators verifies it, too"
    rows = list(csv.DictReader(io.StringIO(export(service, "csv"), newline="")))
    assert [(row["number"], row["hash"]) for row in rows][-1] == (str(number), before)
    assert json.loads(rows[-1]["details"])["name"] == "=zoé"


def test_administrators_read_the_log_page_by_page_and_filtered(lite: Service) -> None:
    lite.viewer.get("/users", 403)
    everything = log_of(lite)[::-1]
    page = lite.admin.get("/audit?limit=3")
    assert page["rows"] == everything[:3]
    assert (page["total"], page["newest"], page["oldest"]) == (len(everything), len(everything), 1)
    assert lite.admin.get(f"/audit?limit=2&before={everything[2]['number']}")["rows"] == everything[3:5]
    assert lite.admin.get(f"/audit?limit=2&after={everything[4]['number']}")["rows"] == everything[2:4]
    (refused,) = lite.admin.get("/audit?actor=vic")["rows"]
    assert refused == everything[0]
    created = lite.admin.get("/audit?action=user.created&actor=command%20line")
    assert [row["details"]["name"] for row in created["rows"]] == ["vic", "abe", "lea", "ann"]
    assert created["head"] == page["head"]
    assert lite.admin.get("/audit?since=0&until=4102444800")["total"] == len(everything)
    assert lite.admin.get("/audit?until=1000000000")["rows"] == lite.admin.get("/audit?since=4102444800")["rows"] == []
    lite.admin.get("/audit?action=nothing", 422)


def test_being_refused_again_and_again_makes_few_rows_and_every_refusal_is_counted(
    database_url: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(refusals, "WINDOW_SECONDS", 1e9)  # a window that no slow machine leaves
    monkeypatch.setattr(refusals, "MOST_ROWS", 3)
    with in_process(database_url) as service:
        number = len(log_of(service))
        for _ in range(5):
            service.viewer.get("/users", 403)
            service.learner.get("/users", 403)
            assert service.client.get(f"{API}/me", headers={"Authorization": "Bearer nonsense"}).status_code == 401
        assert [row["actor"] for row in log_of(service)[number:]] == ["vic", "lea", "nobody"]
        for path in ("/numbers", "/webhooks", "/users/1", "/users/1/tokens"):
            service.viewer.get(path, 403)
        rows = [row["details"]["operation"] for row in log_of(service)[number:] if row["actor"] == "vic"]
        assert rows == ["listUsers", "listNumbers", "listWebhooks"], "no more than three rows"
    with in_process(database_url) as service:  # when it stopped, the server wrote what it had left out
        counts = {row["actor"]: row["details"]["left_out"] for row in log_of(service) if "left_out" in row["details"]}
        assert counts["lea"] == {"listUsers": 4}
        assert counts["nobody"] == {"me": 4}
        assert counts["vic"] == {"listUsers": 4, "getUser": 1, "listTokens": 1}


def test_after_a_minute_the_counts_are_written_and_a_refusal_has_a_row_again(lite: Service) -> None:
    now = 0.0
    recorded = refusals.Refusals(lite.db, lambda: now)
    actor, number = nobody("192.0.2.1"), len(log_of(lite))
    entry = Entry(actor, "login.refused", None, {})
    one = refusals.Refused(actor, "login.refused", "me", lambda _: entry)

    async def scene() -> None:
        nonlocal now
        for _ in range(3):
            await recorded.record(one)
        await recorded.sweep()
        assert [row["details"] for row in log_of(lite)[number:]] == [{}], "the minute is not over"
        now = 61.0
        await recorded.sweep()
        await recorded.sweep()
        await recorded.record(one)

    asyncio.run(scene())
    assert [row["details"] for row in log_of(lite)[number:]] == [{}, {"left_out": {"me": 2}}, {}]


def test_counts_that_cannot_be_written_are_written_with_those_of_the_next_minute(lite: Service) -> None:
    now, entry = 0.0, Entry(nobody(None), "login.refused", None, {})
    one = refusals.Refused(entry.actor, "login.refused", "me", lambda _: entry)
    number = len(log_of(lite))

    class FailsOnce:
        fails = False

        async def write(self, work: Callable[[Tx], None]) -> None:
            if self.fails:
                self.fails = False
                await recorded.record(one)  # somebody is refused while the store fails
                raise StorageFailed("disk full")
            await lite.db.write(work)

    store = FailsOnce()
    recorded = refusals.Refusals(cast(Database, store), lambda: now)

    async def scene() -> None:
        nonlocal now
        for _ in range(3):
            await recorded.record(one)
        now, store.fails = 61.0, True
        await recorded.sweep()
        now = 122.0
        await recorded.sweep()

    asyncio.run(scene())
    assert [row["details"] for row in log_of(lite)[number:]] == [{}, {}, {"left_out": {"me": 2}}]


def test_a_refusal_that_cannot_be_recorded_stays_a_refusal(
    lite: Service, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    def fail(*_: object) -> None:
        raise OperationalError("INSERT", None, Exception("disk full"))

    with monkeypatch.context() as patched:
        patched.setattr("waypost_server.db.audit.append", fail)
        lite.viewer.get("/users", 403)
        lite.admin.post("/users", {"name": "zoe", "role": "viewer"}, 503)
    assert "could not be recorded" in caplog.text
    assert "zoe" not in {user["name"] for user in lite.admin.get("/users")["users"]}, "no change without its row"
