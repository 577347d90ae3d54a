"""Who may do what: every operation, called validly by every role, by the owner of its object and by somebody else."""

import threading
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from typing import Any

import httpx2
import pytest
from sqlalchemy import update
from starlette.testclient import TestClient
from starlette.websockets import WebSocketDisconnect
from tests.server.gold.test_gold import known
from tests.server.kit import API, VOCABULARY, Caller, Json, Service, frame, in_process, png, query, right_answer

from waypost_server.app import create_app
from waypost_server.auth.access import ACCESS
from waypost_server.db.tables import users
from waypost_server.db.transaction import Tx
from waypost_server.runs import service as runs
from waypost_server.settings import Settings

HOOK = "https://hooks.example.org/waypost"
EPISODE = {"episode": 0, "warm_start": False, "train_success": True, "test_success": True, "train_steps": 1}
RESULT = EPISODE | {"test_steps": 1, "hi_labels": 0, "lo_labels": 0, "seconds": 0.5}
EXERCISE = {
    "ask": query("inspect_full"),
    "known": {"kind": "inspect_full", "verdict": "pass"},
    "reasons": ["accomplished"],
}

OPEN = {"healthz", "readyz", "login", "getSignIn", "beginSignIn", "endSignIn"}
# `owner` is the learner whose run it is, and `learner` another one; `holder` is the annotator who leased the query.
EVERYBODY = {"admin", "owner", "learner", "holder", "annotator", "viewer"}
WATCHERS = {"admin", "owner", "learner", "viewer"}  # an annotator could tell gold queries from others by single queries
LEARNERS = {"admin", "owner", "learner"}
OWNER = {"admin", "owner"}
ANNOTATORS = {"admin", "holder", "annotator"}
HOLDER = {"holder"}  # not even an administrator answers in the place of somebody else
ADMIN = {"admin"}

MATRIX: dict[str, set[str]] = {
    "createRun": LEARNERS,
    "patchRun": OWNER,
    "deleteRun": OWNER,
    "reportEpisodes": OWNER,
    "ask": OWNER,
    "useAnswer": OWNER,
    "addGold": OWNER,
    "retireGold": OWNER,
    "listGold": LEARNERS,
    "putPractice": OWNER,
    "putPredictions": OWNER,
    "listReview": OWNER,
    "comment": OWNER,
    "sendBack": OWNER,
    "putFrames": LEARNERS,
    "missingFrames": LEARNERS,
    "lease": ANNOTATORS,
    "leaseBatch": ANNOTATORS,
    "answerBatch": ANNOTATORS,  # test_batch says whose
    "myAssignments": ANNOTATORS,
    "leave": ANNOTATORS,
    "answer": HOLDER,
    "renew": HOLDER,
    "release": HOLDER,
    "retract": HOLDER,
    "listAudit": ADMIN,
    "exportAudit": ADMIN,
    "listUsers": ADMIN,
    "createUser": ADMIN,
    "createLoginLink": ADMIN,
    "getUser": ADMIN,
    "patchUser": ADMIN,
    "eraseUser": ADMIN,
    "listTokens": ADMIN,
    "getNumbers": ADMIN,
    "listNumbers": ADMIN,
    "createWebhook": ADMIN,
    "listWebhooks": ADMIN,
    "getWebhook": ADMIN,
    "patchWebhook": ADMIN,
    "deleteWebhook": ADMIN,
    "pingWebhook": ADMIN,
    "listDeliveries": ADMIN,
    "redeliver": ADMIN,
    "createToken": EVERYBODY,  # their own; test_users says whose
    "revokeToken": EVERYBODY,
    "me": EVERYBODY,
    "logout": EVERYBODY,
    "myNumbers": EVERYBODY,
    "myReturned": EVERYBODY,
    "myTokens": EVERYBODY,
    "mySessions": EVERYBODY,
    "logoutEverywhere": EVERYBODY,
    "getPractice": EVERYBODY,
    "practice": EVERYBODY,
    "getFrame": EVERYBODY,
    "listRuns": EVERYBODY,
    "getRun": EVERYBODY,
    "getCurves": EVERYBODY,
    "getCosts": EVERYBODY,
    "getForecast": EVERYBODY,
    "streamEvents": EVERYBODY,
    "streamChanges": EVERYBODY,
    "listAtWork": EVERYBODY,
    "getOutlook": EVERYBODY,
    "listQueryRows": WATCHERS,
    "listStuck": WATCHERS,
    "listLedger": WATCHERS,
    "listRecords": WATCHERS,
    "getAgreement": WATCHERS,
    "getHistory": WATCHERS,
    "exportRun": WATCHERS,
    "listQueries": WATCHERS,
    "getQuery": WATCHERS,
    "listAnswers": WATCHERS,
    "metrics": WATCHERS,
}
SOCKETS: dict[str, set[str]] = {"play": LEARNERS | ANNOTATORS, "playTake": HOLDER, "playOffer": OWNER}
ENDLESS = {"streamEvents", "streamChanges"}  # in process, a reply would have to end first; test_events.py reads them


class Scene:
    """New objects of all operations: a run with gold, answered and leased queries; a webhook; a user."""

    def __init__(self, service: Service, callers: dict[str, Caller]) -> None:
        self.service = service
        owner, holder = callers["owner"], callers["holder"]
        self.frame = frame(png())
        owner.call("PUT", "/frames", {"frames": [self.frame]}, 204)
        self.run = owner.create_run()
        gold = {"known": [{"ask": query(episode=9), "known": known("inspect_full")}]}
        self.item = owner.post(f"/runs/{self.run}/gold", gold)["gold"][0]["id"]
        owner.ask(self.run, query(), query("hier_demo", ordinal=1), query("label_hi", ordinal=2))
        self.answered = holder.lease(run=self.run, kinds=["inspect_full"])
        self.answer = holder.answer(self.answered)["answer"]
        self.held = holder.lease(run=self.run, kinds=["hier_demo"])
        self.practice = owner.get("/practice")["queries"][0]["ask"]
        self.user = service.admin.post("/users", {"name": f"somebody in {self.run}", "role": "viewer"}, 201)["id"]
        self.finished = owner.create_run()
        owner.patch(self.finished, state="finished")
        self.former = service.admin.post("/users", {"name": f"former in {self.run}", "role": "viewer"}, 201)["id"]
        service.admin.call("PATCH", f"/users/{self.former}", {"active": False})
        self.webhook = service.admin.post("/webhooks", {"url": HOOK, "topics": ["answer.retracted"]}, 201)["webhook"][
            "id"
        ]
        self.delivery = service.admin.post(f"/webhooks/{self.webhook}/ping", expect=202)["id"]

    def call(self, name: str, caller: Caller | None) -> int:
        """Call an operation with a valid request about an object of the scene, and return the status."""
        return self.send(name, caller).status_code

    def send(self, name: str, caller: Caller | None) -> httpx2.Response:
        """Call an operation with a valid request about an object of the scene."""
        method, path = PLACES[name]
        place = path.format(
            run=self.finished if name == "deleteRun" else self.run,
            query=0 if name == "practice" else self.answered["query"]["id"],
            assignment=self.answered["id"] if name == "retract" else self.held["id"],
            item=self.item,
            user=self.former if name == "eraseUser" else self.user,
            token=self.own_token(caller) if name == "revokeToken" else 1,
            frame=self.frame["hash"],
            webhook=self.webhook,
            delivery=self.delivery,
        )
        body: Any = {"json": BODIES[name](self)} if name in BODIES else {}
        params = {"part": "queries"} if name == "listRecords" else {}
        headers = {} if caller is None else caller.headers
        return self.service.client.request(method, place, headers=headers, params=params, **body)

    def own_token(self, caller: Caller | None) -> int:
        """A token of the caller, who may revoke it."""
        return 1 if caller is None else int(caller.post("/tokens", {"label": "own"}, 201)["id"])


Body = Callable[[Scene], Json]
BODIES: dict[str, Body] = {
    "createRun": lambda _: {"name": "new", "algorithm": "h-bc", "seed": 0, "vocabulary": VOCABULARY},
    "patchRun": lambda _: {"name": "another"},
    "reportEpisodes": lambda _: {"episodes": [RESULT]},
    "ask": lambda _: {"queries": [query(episode=3)]},
    "addGold": lambda scene: {"answered": [scene.answered["query"]["id"]]},
    "putPractice": lambda _: {"exercises": [EXERCISE], "demonstrations": []},
    "putPredictions": lambda _: {"episode": 3, "predictions": []},
    "comment": lambda _: {"text": "Why?"},
    "sendBack": lambda scene: {"answer": scene.answer, "text": "Look again."},
    "putFrames": lambda scene: {"frames": [scene.frame]},
    "missingFrames": lambda scene: {"hashes": [scene.frame["hash"]]},
    "lease": lambda _: {},
    "leaseBatch": lambda _: {"count": 1},
    "answerBatch": lambda scene: {
        "answers": [
            {
                "assignment": scene.held["id"],
                "token": scene.held["token"],
                "answer": right_answer(scene.held["query"]["ask"]),
            }
        ]
    },
    "leave": lambda _: {"tab": "a-tab", "keep": []},
    "answer": lambda scene: {"token": scene.held["token"], "answer": right_answer(scene.held["query"]["ask"])},
    "renew": lambda scene: {"token": scene.held["token"]},
    "release": lambda scene: {"token": scene.held["token"]},
    "retract": lambda scene: {"token": scene.answered["token"]},
    "createUser": lambda scene: {"name": f"new {scene.run}", "role": "viewer"},
    "patchUser": lambda _: {"role": "learner"},
    "createWebhook": lambda _: {"url": HOOK},
    "patchWebhook": lambda _: {"note": "another"},
    "createToken": lambda _: {"label": "new"},
    "practice": lambda scene: {"answer": right_answer(scene.practice)},
}


PATHS = create_app(Settings(database="sqlite:///never-opened.db")).openapi()["paths"]
OPERATIONS: dict[str, Json] = {one["operationId"]: one for item in PATHS.values() for one in item.values()}
PLACES: dict[str, tuple[str, str]] = {
    one["operationId"]: (method.upper(), path) for path, item in PATHS.items() for method, one in item.items()
}


@pytest.fixture
def hooked(sqlite_url: str) -> Iterator[Service]:
    """A service that allows webhooks for one host."""
    with in_process(sqlite_url, webhook_hosts=("hooks.example.org",)) as service:
        yield service


def callers(service: Service) -> dict[str, Caller]:
    """A user for each of the names in `EVERYBODY`."""
    others = {"learner": service.user("leo", "learner"), "annotator": service.user("ada", "annotator")}
    own = {"admin": service.admin, "owner": service.learner, "holder": service.annotator, "viewer": service.viewer}
    return own | others


def test_the_table_has_every_operation_and_says_what_is_promised_here() -> None:
    assert set(ACCESS) == set(PLACES) - OPEN | set(SOCKETS)
    roles = {name: name for name in EVERYBODY} | {"owner": "learner", "holder": "annotator"}
    owners = {None: EVERYBODY, "token": EVERYBODY, "run": OWNER, "assignment": HOLDER}
    for name, rule in ACCESS.items():
        stated = {one for one in owners[rule.own] if roles[one] in rule.roles}
        assert stated == (MATRIX | SOCKETS)[name], name


def test_the_documentation_of_the_api_says_who_may_call_each_operation() -> None:
    described = {name: operation["description"] for name, operation in OPERATIONS.items()}
    for name in set(PLACES) - OPEN:
        assert described[name].endswith(ACCESS[name].words), name
    assert described["patchRun"].endswith(
        "Needs the role admin or learner. The run must be the caller's own; administrators may do it for every run."
    )


def test_every_operation_is_open_to_these_callers_and_to_nobody_else(hooked: Service) -> None:
    who = callers(hooked)
    shared = Scene(hooked, who)
    for name, (method, _) in PLACES.items():
        if name in OPEN:
            continue
        assert shared.call(name, None) == 401, name
        for caller in who.keys() - MATRIX[name]:
            assert shared.call(name, who[caller]) == 403, f"{name} by {caller}"
        for caller in MATRIX[name] if name not in ENDLESS else ():
            scene = shared if method == "GET" else Scene(hooked, who)
            assert scene.call(name, who[caller]) in {200, 201, 202, 204}, f"{name} by {caller}"


def test_each_end_of_a_demonstration_is_open_to_these_callers_and_to_nobody_else(lite: Service) -> None:
    who = callers(lite)
    run = lite.learner.create_run()
    (asked,) = lite.learner.ask(run, query("hier_demo"))
    held = lite.annotator.lease(run=run)
    messages = {
        "playTake": {"type": "take", "assignment": held["id"], "token": held["token"]},
        "playOffer": {"type": "offer"},
    }
    for name, message in messages.items():
        for caller, one in who.items():
            expected = None if caller in SOCKETS[name] else 4403
            assert closed(lite, asked["id"], one.headers, message) == expected, f"{name} by {caller}"
        assert closed(lite, asked["id"], {}, message) == 4401


def closed(service: Service, query: int, headers: dict[str, str], message: Json) -> int | None:
    """Open the play socket with a first message; return the code that it is closed with, None if it stays open."""
    client = service.client
    assert isinstance(client, TestClient)
    with client.websocket_connect(f"{API}/queries/{query}/play", headers=headers) as socket:
        try:
            socket.send_json(message)
            socket.send_json({"type": "nonsense"})  # a caller who is let in is refused because of this message
            socket.receive_json()
            socket.receive_json()
        except WebSocketDisconnect as ending:
            return None if ending.code == 4422 else ending.code
    raise AssertionError("the socket was not closed")


def test_a_refused_learner_is_told_whose_run_it_is(service: Service) -> None:
    run = service.learner.create_run()
    said = service.user("leo", "learner").patch(run, 403, name="mine")
    assert said["type"].endswith("/forbidden")
    assert said["detail"] == (
        f"Run {run} belongs to lea. Only its owner and administrators may change it; create a run of your own."
    )
    assert said["owner"] == "lea"
    assert service.viewer.get(f"/runs/{run}")["name"] == "a run"


def test_who_lacks_a_role_is_told_which_roles_may_do_it(service: Service) -> None:
    run = service.learner.create_run()
    assert service.viewer.patch(run, 403, name="mine")["roles"] == ["admin", "learner"]
    assert service.viewer.get("/users", 403)["roles"] == ["admin"]
    other = service.admin.get("/me")["id"]
    assert service.learner.post("/tokens", {"user": other}, 403)["roles"] == ["admin"]


@pytest.mark.parametrize(
    ("change", "refused"),
    [({"role": "viewer"}, 403), ({"role": "annotator"}, 403), ({"deactivated_at": 1.0}, 401), ({"role": "admin"}, 200)],
)
def test_the_role_counts_at_the_moment_of_the_change(
    service: Service, monkeypatch: pytest.MonkeyPatch, change: Json, refused: int
) -> None:
    monkeypatch.setattr("waypost_server.auth.lookup.CACHE_SECONDS", 600.0)
    run = service.learner.create_run()
    service.db.write_now(lambda tx: tx.conn.execute(update(users).where(users.c.name == "lea").values(change)))
    service.learner.patch(run, refused, name="too late")
    service.learner.ask(run, query(), expect=refused)


def test_no_role_is_taken_away_in_the_middle_of_a_change(service: Service) -> None:
    run, lea = service.learner.create_run(), service.learner.get("/me")["id"]
    is_allowed, is_demoted = threading.Event(), threading.Event()

    def change(tx: Tx) -> bool:
        runs.lock_own(tx, run, lea)
        is_allowed.set()
        return is_demoted.wait(1)

    def demote() -> None:
        assert is_allowed.wait(10)
        service.admin.call("PATCH", f"/users/{lea}", {"role": "viewer"})
        is_demoted.set()

    with ThreadPoolExecutor() as pool:
        changed, demoted = pool.submit(service.db.write_now, change), pool.submit(demote)
        assert not changed.result()
        demoted.result()
    service.learner.patch(run, 403, name="too late")
