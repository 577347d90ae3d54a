"""What the server's tests are written with: a service with one user per role, and short ways to call it."""

import asyncio
import base64
import hashlib
import threading
import zlib
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import AsyncExitStack, contextmanager
from typing import Any, Protocol

import httpx2
from alembic import command
from fastapi.testclient import TestClient
from sqlalchemy import create_engine, text

from waypost import wire
from waypost_server.app import create_app
from waypost_server.auth import tokens
from waypost_server.db import schema
from waypost_server.db.engine import Database, parse
from waypost_server.settings import Settings
from waypost_server.users import service as users

API = "/api/v1"
VOCABULARY = {"domain": "maze", "subgoals": ["north", "south"], "actions": ["up", "down"], "renderer": "maze"}
Json = dict[str, Any]


def segment(n_actions: int = 2, subgoal: str | None = "north") -> Json:
    """A segment of the learner's trajectory."""
    return {"subgoal": subgoal, "states": list(range(n_actions + 1)), "actions": ["up"] * n_actions}


def query(kind: str = "inspect_full", episode: int = 0, ordinal: int = 0, n_actions: int = 2, **more: Any) -> Json:
    """A query of any kind."""
    base = {"kind": kind, "episode": episode, "ordinal": ordinal, "question": "Well?", "instance": {"lava": []}}
    if kind == "hier_demo":
        return base | {"state": [1, 2], "max_segments": 3, "max_actions": 4} | more
    return base | {"segments": [segment(n_actions)]} | more


def right_answer(ask: Json) -> Json:
    """An answer that fits a query."""
    kind = ask["kind"]
    segments = ask.get("segments", [])
    lengths = [len(one["actions"]) for one in segments]
    if kind == "hier_demo":
        return {"kind": kind, "segments": [{"subgoal": "south", "actions": ["up", "down"]}], "replay": None}
    if kind == "label_hi":
        return {"kind": kind, "subgoals": ["south"] * len(segments)}
    if kind == "label_lo":
        return {"kind": kind, "actions": ["down"] * lengths[0], "terminations": [False] * lengths[0] + [True]}
    if kind == "label_full":
        return {"kind": kind, "actions": ["down"] * sum(lengths)}
    return {"kind": kind, "verdict": "pass"}


class Requests(Protocol):
    """What a caller needs of an HTTP client."""

    def request(self, method: str, url: str, **more: Any) -> httpx2.Response: ...


class Caller:
    """One user's way to the API."""

    def __init__(self, client: Requests, name: str, token: str) -> None:
        self.client = client
        self.name = name
        self.token = token
        self.headers = {"Authorization": f"Bearer {token}"}

    def call(self, method: str, path: str, body: Any = None, expect: int = 200, **more: Any) -> Any:
        """Call the API and return the JSON of the reply, whose status must be as expected."""
        headers = self.headers | more.pop("headers", {})
        given = {} if body is None else {"json": body}
        reply = self.client.request(method, API + path, headers=headers, **given, **more)
        assert reply.status_code == expect, f"{reply.status_code} instead of {expect}: {reply.text[:500]}"
        if expect >= 400:
            assert reply.headers["content-type"] == "application/problem+json", reply.headers
            assert reply.json()["status"] == expect
        return reply.json() if reply.content else None

    def get(self, path: str, expect: int = 200, **more: Any) -> Any:
        return self.call("GET", path, expect=expect, **more)

    def post(self, path: str, body: Any = None, expect: int = 200, **more: Any) -> Any:
        return self.call("POST", path, body, expect, **more)

    # --- the learner's side

    def create_run(self, **more: Any) -> str:
        body = {"name": "a run", "algorithm": "hg-dagger", "seed": 0, "vocabulary": VOCABULARY} | more
        return str(self.post("/runs", body, 201)["id"])

    def ask(self, run: str, *asks: Json, expect: int = 200, **more: Any) -> Any:
        reply = self.post(f"/runs/{run}/queries", {"queries": list(asks)} | more, expect)
        return reply["queries"] if expect == 200 else reply

    def costs(self, run: str) -> Json:
        return dict(self.get(f"/runs/{run}/costs"))

    def patch(self, run: str, expect: int = 200, **changes: Any) -> Any:
        return self.call("PATCH", f"/runs/{run}", changes, expect)

    # --- the administrator's side

    def change(self, other: "Caller", **changes: Any) -> Any:
        """Change another user: their role, or whether they are active."""
        return self.call("PATCH", f"/users/{other.get('/me')['id']}", changes)

    # --- the annotator's side

    def lease(self, expect: int = 201, **wish: Any) -> Any:
        return self.post("/assignments", wish, expect)

    def answer(self, assignment: Json, content: Json | None = None, expect: int = 200, **more: Any) -> Any:
        body = {"token": assignment["token"], "answer": content or right_answer(assignment["query"]["ask"])}
        headers = more.pop("headers", {})
        return self.post(f"/assignments/{assignment['id']}/answer", body | more, expect, headers=headers)

    def retract(self, assignment: Json, expect: int = 200, **more: Any) -> Any:
        return self.post(f"/assignments/{assignment['id']}/retract", {"token": assignment["token"]} | more, expect)

    def leave(self, tab: str, *keep: Json, expect: int = 204) -> Any:
        """Say that a page goes, and which assignments it still answers."""
        return self.post("/assignments/leave", {"tab": tab, "keep": [one["id"] for one in keep]}, expect)

    def release(self, assignment: Json, expect: int = 204, **more: Any) -> Any:
        return self.post(f"/assignments/{assignment['id']}/release", {"token": assignment["token"]} | more, expect)

    def renew(self, assignment: Json, expect: int = 200, **more: Any) -> Any:
        return self.post(f"/assignments/{assignment['id']}/renew", {"token": assignment["token"]} | more, expect)


class Service:
    """A server and its users."""

    def __init__(self, client: Requests, db: Database) -> None:
        self.client = client
        self.db = db
        self.admin = self.user("ann", "admin")
        self.learner = self.user("lea", "learner")
        self.annotator = self.user("abe", "annotator")
        self.viewer = self.user("vic", "viewer")

    def user(self, name: str, role: wire.Role) -> Caller:
        """Create a user with a token."""
        made = self.db.write_now(lambda tx: users.ensure_user(tx, name, role))
        token = self.db.write_now(lambda tx: tokens.create_token(tx, made.id, "test")).token
        return Caller(self.client, name, token)

    def annotators(self, n: int) -> list[Caller]:
        """Create annotators."""
        return [self.user(f"annotator{number}", "annotator") for number in range(n)]


@contextmanager
def in_process(url: str, **settings: Any) -> Iterator[Service]:
    """Run the app without a socket."""
    app = create_app(Settings(database=url, hosts=("testserver",), **settings))
    with TestClient(app) as client:
        yield Service(client, app.state.context.db)


@contextmanager
def in_one_thread(url: str, **settings: Any) -> Iterator[Service]:
    """Run the app in its caller's thread: half the CPU of `in_process`, but its own tasks stand still between calls."""
    app = create_app(Settings(database=url, hosts=("testserver",), **settings))
    with asyncio.Runner() as runner:
        client = httpx2.AsyncClient(transport=httpx2.ASGITransport(app), base_url="http://testserver")

        class InLoop:
            def request(self, method: str, url: str, **more: Any) -> httpx2.Response:
                return runner.get_loop().run_until_complete(client.request(method, url, **more))

        stack = AsyncExitStack()
        runner.run(stack.enter_async_context(app.router.lifespan_context(app)))
        try:
            yield Service(InLoop(), app.state.context.db)
        finally:
            runner.run(stack.aclose())


def make_older_store(url: str, schema_then: str = "0006") -> None:
    """Create a store as an earlier version left it (by default, one before webhooks), with one administrator."""
    engine = create_engine(parse(url))
    settings = schema.config()
    with engine.begin() as conn:
        settings.attributes["connection"] = conn
        command.upgrade(settings, schema_then)
        conn.execute(text("INSERT INTO users (name, role, created_at) VALUES ('ann', 'admin', 1.5)"))
    engine.dispose()


def schema_of(url: str) -> str:
    """Return the schema of a store, without opening it as one."""
    engine = create_engine(parse(url))
    with engine.connect() as conn:
        found = str(conn.execute(text("SELECT version_num FROM alembic_version")).scalar_one())
    engine.dispose()
    return found


def together(work: Callable[[int], Any], n: int) -> list[Any]:
    """Do the same from n threads that start at the same moment; returns what each got."""
    barrier = threading.Barrier(n)

    def one(number: int) -> Any:
        barrier.wait()
        return work(number)

    with ThreadPoolExecutor(n) as pool:
        return list(pool.map(one, range(n)))


def png(shade: int = 0, width: int = 2, height: int = 2) -> bytes:
    """A PNG of one gray."""

    def chunk(name: bytes, data: bytes) -> bytes:
        return len(data).to_bytes(4) + name + data + zlib.crc32(name + data).to_bytes(4)

    header = width.to_bytes(4) + height.to_bytes(4) + bytes([8, 0, 0, 0, 0])
    rows = (b"\x00" + bytes([shade]) * width) * height
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b"")


def frame(file: bytes) -> Json:
    """A file as it is uploaded."""
    return {"hash": hashlib.sha256(file).hexdigest(), "png": base64.b64encode(file).decode()}
