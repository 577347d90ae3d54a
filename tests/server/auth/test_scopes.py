"""Scopes of tokens: a token with scopes can do what they include and nothing else, whoever its user is."""

import json
from collections.abc import Iterator

import httpx2
import pytest
from tests.server.auth.test_access import ENDLESS, OPEN, OPERATIONS, PLACES, SOCKETS, Scene, callers, closed
from tests.server.kit import API, Caller, Json, Service, in_process, query
from typer.testing import CliRunner

from waypost.wire import Scope
from waypost_server.cli.main import app

READ: set[str] = {
    *("listRuns", "getRun", "getCurves", "getCosts", "getForecast", "getFrame", "listAtWork", "getOutlook"),
    *("streamEvents", "streamChanges", "listQueries", "getQuery", "getHistory", "listQueryRows", "listAnswers"),
    *("listStuck", "listLedger", "listRecords", "getAgreement", "exportRun", "metrics"),
    *("me", "logout", "myNumbers", "myReturned", "myTokens", "mySessions", "getPractice", "practice", "play"),
}
ANSWER = {
    *("lease", "leaseBatch", "answerBatch", "myAssignments", "leave"),
    *("answer", "renew", "release", "retract", "playTake"),
}
LEARN = {
    *("createRun", "patchRun", "deleteRun", "reportEpisodes", "ask", "useAnswer", "putFrames", "missingFrames"),
    *("addGold", "retireGold", "listGold", "putPractice", "putPredictions", "listReview", "comment", "sendBack"),
    "playOffer",
}
BY_SCOPE: dict[Scope, set[str]] = {
    "read": READ,
    "answer": READ | ANSWER,
    "learn": READ | LEARN,
    "manage": READ | (set(PLACES) - OPEN - ANSWER - LEARN),
}


def limited(service: Service, caller: Caller, *scopes: Scope) -> Caller:
    """The same user with a token that has scopes."""
    made = caller.post("/tokens", {"label": "limited", "scopes": scopes}, 201)
    return Caller(service.client, caller.name, made["token"])


@pytest.fixture
def hooked(sqlite_url: str) -> Iterator[Service]:
    """A service that allows webhooks for one host."""
    with in_process(sqlite_url, webhook_hosts=("hooks.example.org",)) as service:
        yield service


@pytest.mark.parametrize("scope", sorted(BY_SCOPE))
def test_a_token_calls_the_operations_of_its_scope_and_no_other(hooked: Service, scope: Scope) -> None:
    scene = Scene(hooked, callers(hooked))
    admin = limited(hooked, hooked.admin, scope)
    for name, (method, _) in PLACES.items():
        is_allowed = name in BY_SCOPE[scope]
        if name in OPEN or name == "revokeToken" or (is_allowed and (name in ENDLESS or method == "DELETE")):
            continue  # what is allowed and deletes would end what the others need
        reply = scene.send(name, admin)
        assert is_refused(reply) != is_allowed, f"{name}: {reply.text}"
    headers = admin.headers | {"Content-Type": "application/json"}
    assert is_refused(hooked.client.delete(f"{API}/tokens/1", headers=headers)) == (scope != "manage")


def is_refused(reply: httpx2.Response) -> bool:
    return reply.status_code == 403 and reply.json()["type"] == "/problems/out-of-scope"


def test_the_documentation_says_which_scope_an_operation_needs() -> None:
    for name in set(PLACES) - OPEN:
        needed = [scope for scope in ("answer", "learn", "manage") if name in BY_SCOPE[scope]]  # type: ignore[index]
        says = f"A token with scopes needs the scope {needed[0]}." in OPERATIONS[name]["description"]
        assert says == (name not in READ), name


def test_each_end_of_a_demonstration_needs_its_scope(lite: Service) -> None:
    run = lite.learner.create_run()
    (asked,) = lite.learner.ask(run, query("hier_demo"))
    held = lite.annotator.lease(run=run)
    messages: dict[str, Json] = {
        "playTake": {"type": "take", "assignment": held["id"], "token": held["token"]},
        "playOffer": {"type": "offer"},
    }
    users = {"playTake": lite.annotator, "playOffer": lite.learner}
    assert messages.keys() == SOCKETS.keys() - {"play"}
    for name, message in messages.items():
        for scope, operations in BY_SCOPE.items():
            caller = limited(lite, users[name], scope)
            expected = None if name in operations else 4403
            assert closed(lite, asked["id"], caller.headers, message) == expected, f"{name} with {scope}"


def test_a_token_makes_no_token_that_may_do_more(service: Service) -> None:
    manager = limited(service, service.admin, "manage", "answer")
    for scopes in (["learn"], ["manage", "learn"], ["read", "learn"]):
        said = manager.post("/tokens", {"label": "more", "scopes": scopes}, 403)
        assert said["type"] == "/problems/out-of-scope"
        assert said["detail"].endswith(": learn." if "read" not in scopes else ": learn, read.")
    for wish, got in (({"scopes": ["answer"]}, ["answer"]), ({}, ["answer", "manage"])):
        made = manager.post("/tokens", {"label": "as much"} | wish, 201)
        (listed,) = [one for one in service.admin.get("/me/tokens")["tokens"] if one["id"] == made["id"]]
        assert listed["scopes"] == got
    assert service.admin.get("/me/tokens")["tokens"][0]["scopes"] is None
    (first, *_) = [one for one in service.admin.get("/audit")["rows"] if one["action"] == "token.created"]
    assert first["details"]["scopes"] == "answer manage"


def test_scopes_add_nothing_to_a_role(service: Service) -> None:
    viewer = limited(service, service.viewer, "learn", "manage")
    viewer.post("/runs", {}, 403)
    assert viewer.get("/users", 403)["type"] == "/problems/forbidden"
    service.viewer.post("/tokens", {"label": "", "scopes": []}, 422)
    service.viewer.post("/tokens", {"label": "", "scopes": ["everything"]}, 422)


def test_a_command_makes_tokens_with_scopes(database_url: str) -> None:
    with in_process(database_url) as service:

        def run(*arguments: str, status: int = 0) -> str:
            done = CliRunner().invoke(app, ["token", *arguments, "--database", database_url])
            assert done.exit_code == status, done.output
            return done.output.strip()

        token = run("create", "lea", "--scope", "read", "--scope", "learn")
        learner = Caller(service.client, "lea", token)
        learner.create_run()
        assert learner.post("/tokens", {}, 403)["detail"] == (
            "This needs the scope manage; the token has only learn, read. Use another token."
        )
        assert "learn read" in run("list", "lea")
        assert [one["scopes"] for one in json.loads(run("list", "lea", "--json"))["tokens"]] == [
            None,
            ["learn", "read"],
        ]
        assert "'all' is not a scope" in run("create", "lea", "--scope", "all", status=2)
