"""The log of a server: one id for everything about a request, and no secret or answer in any line."""

import io
import json
import logging
import sqlite3
from pathlib import Path
from typing import Any

import httpx2
import pytest
from tests.server.kit import API, VOCABULARY, Caller, in_process, query
from tests.server.processes import serving

from waypost_server.auth import sessions, tokens
from waypost_server.db.engine import Database
from waypost_server.http import logs
from waypost_server.users import service as users

SAME = {"Sec-Fetch-Site": "same-origin"}
ANSWER = "only-the-annotator-may-know-this"


def lines_of(log: Path) -> list[dict[str, Any]]:
    return [json.loads(line) for line in log.read_text().splitlines()]


def prepare(url: str) -> dict[str, str]:
    """Create a learner and an annotator; return their tokens, and a login code of the annotator."""
    db = Database(url)
    secrets = {}
    for name, role in (("lea", "learner"), ("abe", "annotator")):
        user = db.write_now(lambda tx, name=name, role=role: users.ensure_user(tx, name, role))  # type: ignore[misc]
        secrets[name] = db.write_now(lambda tx, user=user: tokens.create_token(tx, user.id, "t")).token
        code = db.write_now(lambda tx, user=user: sessions.create_login_link(tx, user.id, 900)).code
    db.close()
    return secrets | {"code": code}


def test_the_log_of_a_whole_session_holds_no_secret_and_no_answer(sqlite_url: str, tmp_path: Path) -> None:
    known = prepare(sqlite_url)
    settings = {"log_format": "json", "log_requests": "true"}
    with serving(sqlite_url, tmp_path, settings) as server, httpx2.Client(base_url=server.address) as client:
        learner, annotator = Caller(client, "lea", known["lea"]), Caller(client, "abe", known["abe"])
        run = learner.create_run(vocabulary=VOCABULARY | {"subgoals": ["north", ANSWER]})
        learner.ask(run, query(), query("label_hi", ordinal=1))
        entered = client.post(f"{API}/session", json={"code": known["code"]}, headers=SAME)
        cookie = entered.cookies["waypost_session"]
        assert client.post(f"{API}/session", json={"code": known["code"]}, headers=SAME).status_code == 401
        assert client.get(f"{API}/me", headers={"Authorization": f"Bearer {known['lea'][:-1]}"}).status_code == 401
        assert client.get(f"/login/{known['code']}").status_code in (200, 404)
        assert client.get(f"{API}/me?token={known['abe']}").status_code == 200
        leased, second = annotator.lease(), annotator.lease()
        annotator.answer(leased)
        user = annotator.get("/me")["id"]
        made = client.post(f"{API}/tokens", json={"label": "mine"}, headers=SAME).json()["token"]
        store = sqlite3.connect(sqlite_url.removeprefix("sqlite:///"))
        store.executescript("ALTER TABLE answers RENAME TO away")  # the store is damaged: the answer cannot be stored
        store.close()
        answer = {"token": second["token"], "answer": {"kind": "label_hi", "subgoals": [ANSWER]}}
        path, ours = f"{API}/assignments/{second['id']}/answer", {"X-Request-ID": "from-the-proxy.1"}
        failed = client.post(path, json=answer, headers=annotator.headers | ours)
        server.process.terminate()
        server.process.wait(20)
    assert failed.status_code >= 500, failed.text
    assert failed.headers["x-request-id"] == failed.json()["request_id"] == "from-the-proxy.1"
    lines = lines_of(server.log)
    about = [line for line in lines if line["request_id"] == "from-the-proxy.1"]
    assert {line["level"] for line in about} > {"INFO"}  # why it failed, beside the line of the request
    (request,) = [line for line in about if line["logger"] == "waypost.requests"]
    assert (request["operation"], request["status"], request["user"]) == ("answer", failed.status_code, user)
    assert len({line["request_id"] for line in lines if line["logger"] == "waypost.requests"}) >= 10
    secret = [*known.values(), cookie, leased["token"], second["token"], made, ANSWER]
    text = server.log.read_text()
    assert [one for one in secret if one in text] == []


@pytest.fixture
def written() -> Any:
    """What the server logs in this process, as its lines are by default."""
    stream = io.StringIO()
    logs.install("text", with_requests=False)
    (handler,) = logging.getLogger().handlers
    assert isinstance(handler, logging.StreamHandler)
    handler.setStream(stream)
    yield stream
    logging.getLogger().removeHandler(handler)


def test_a_failure_is_logged_under_its_id_with_its_cause_but_without_the_values_in_it(
    sqlite_url: str, monkeypatch: pytest.MonkeyPatch, written: io.StringIO
) -> None:
    cause, failure = (f"the {name}\nDETAIL: Failing row contains ({ANSWER})" for name in ("cause", "failure"))

    def broken(*_: Any) -> None:
        try:
            raise RuntimeError(cause)
        except RuntimeError as error:
            raise ValueError(failure) from error

    monkeypatch.setattr("waypost_server.users.performance.me", broken)
    with in_process(sqlite_url) as service:
        service.client._transport.raise_server_exceptions = False  # type: ignore[attr-defined]
        replies = [service.client.get(f"{API}/me", headers=service.viewer.headers) for _ in range(2)]
        badly_named = service.client.get("/healthz", headers={"X-Request-ID": "two\twords"})
    assert {reply.status_code for reply in replies} == {500}
    first, second = (reply.json()["request_id"] for reply in replies)
    assert first != second
    assert badly_named.headers["x-request-id"] != "two\twords"
    assert f'ERROR {first} GET "{API}/me" failed' in written.getvalue()
    assert "ValueError: the failure" in written.getvalue()
    assert "RuntimeError: the cause" in written.getvalue()
    assert ANSWER not in written.getvalue()


def test_an_address_cannot_begin_a_line_of_the_log_nor_keep_a_login_code_in_it(
    sqlite_url: str, monkeypatch: pytest.MonkeyPatch, written: io.StringIO
) -> None:
    def broken(*_: Any) -> None:
        raise ValueError

    monkeypatch.setattr("waypost_server.http.guard.Guard._request", broken)
    with in_process(sqlite_url) as service:
        service.client._transport.raise_server_exceptions = False  # type: ignore[attr-defined]
        service.client.get("/a%0AERROR forged/wp_0123456789012345678901234567")
    assert '"/a\\nERROR forged/wp_..." failed' in written.getvalue()


def test_requests_have_no_line_unless_somebody_wants_them(sqlite_url: str, written: io.StringIO) -> None:
    with in_process(sqlite_url) as service:
        service.viewer.get("/me")
    assert written.getvalue() == ""
