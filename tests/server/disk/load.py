"""Annotators that answer a server's queries, and the proof that nothing of what it acknowledged is lost."""

import json
import random
import threading
import time
from collections import Counter
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import closing, suppress
from dataclasses import dataclass, field

import httpx2
from sqlalchemy import select
from tests.server.kit import API, Json, in_process, query

from waypost_server.db import audit, checking
from waypost_server.db.engine import BadDatabase, Database
from waypost_server.db.schema import WrongSchema
from waypost_server.db.tables import answers, ledger
from waypost_server.db.transaction import Tx
from waypost_server.errors import StorageFailed

BODY_BYTES = 8_000  # of a query: so large that the write-ahead log is checkpointed often
PATIENCE_SECONDS = 20


@dataclass(frozen=True)
class Team:
    """A run with queries, and the headers of those who answer them, of its learner and of an administrator."""

    run: str
    annotators: Sequence[dict[str, str]]
    admin: dict[str, str]


@dataclass
class Answer:
    """An answer as it was sent.

    Args:
        seen: the position of the disk's log when the reply came; None without a reply that acknowledges it.
    """

    assignment: int
    body: Json
    headers: dict[str, str]
    receipt: Json | None = None
    seen: int | None = None


@dataclass
class Told:
    """What clients were told: answers, heads of the audit log with the position at which each was read, statuses."""

    answers: list[Answer] = field(default_factory=list)
    heads: list[tuple[int, str]] = field(default_factory=list)
    statuses: Counter[int] = field(default_factory=Counter)

    def acknowledged(self, position: int | None = None) -> list[Answer]:
        """Return the answers that were acknowledged before a position, by default all."""
        seen = [one for one in self.answers if one.seen is not None]
        return [one for one in seen if position is None or (one.seen or 0) <= position]

    def so_far(self) -> "Told":
        """Return what clients were told until now."""
        return Told(self.acknowledged(), list(self.heads))

    def head(self, position: int | None) -> str | None:
        """Return the newest head of the audit log that was read before a position, by default of all."""
        return next((head for seen, head in reversed(self.heads) if position is None or seen <= position), None)


def team(url: str, n_queries: int, n_annotators: int) -> Team:
    """Create a store with a run and its queries."""
    with in_process(url) as service:
        run = service.learner.create_run()
        large = {"lava": ["x" * 1_000] * (BODY_BYTES // 1_000)}
        for start in range(0, n_queries, 50):
            some = range(start, min(start + 50, n_queries))
            service.learner.ask(run, *(query(ordinal=n, instance=large) for n in some))
        people = service.annotators(n_annotators)
        return Team(run, [one.headers for one in people], service.admin.headers)


def answer_all(address: str, team: Team, told: Told, position: Callable[[], int], seed: int, most: int) -> None:
    """Answer with all annotators at once, `most` answers each, until no query is left or the server is gone.

    Meanwhile an administrator makes tokens, which adds to the audit log, and reads its head.
    """
    done = threading.Event()

    def annotate(number: int) -> None:
        choose = random.Random(f"{seed} {number}")
        with _client(address, team.annotators[number]) as client:
            for _ in range(most):
                held = _persistently(client, told, "/assignments", {"run": team.run})
                if held is None:
                    return
                verdict = choose.choice(["pass", "fail"])
                body = {"token": held["token"], "answer": {"kind": "inspect_full", "verdict": verdict}}
                sent = Answer(held["id"], body, team.annotators[number])
                told.answers.append(sent)
                sent.receipt = _persistently(client, told, f"/assignments/{held['id']}/answer", body)
                if sent.receipt is not None:
                    sent.seen = position()

    def administer() -> None:
        with _client(address, team.admin) as client:
            while not done.wait(0.05) and _persistently(client, told, "/tokens", {"label": "a token"}):
                with suppress(httpx2.TransportError):
                    reply = client.get("/audit", params={"limit": 1})
                    if reply.is_success:  # a step of its clock makes PostgreSQL end statements
                        told.heads.append((position(), reply.json()["head"]))

    administrator = threading.Thread(target=administer)
    administrator.start()
    with ThreadPoolExecutor(len(team.annotators)) as pool:
        try:
            list(pool.map(annotate, range(len(team.annotators))))
        finally:
            done.set()
            administrator.join()


def take_and_vanish(address: str, team: Team) -> None:
    """Lease a query as an annotator who never answers it."""
    with _client(address, team.admin) as client:
        client.post("/assignments", json={"run": team.run}).raise_for_status()


def _client(address: str, headers: dict[str, str]) -> httpx2.Client:
    return httpx2.Client(base_url=address + API, headers=headers, timeout=30)


def _persistently(client: httpx2.Client, told: Told, path: str, body: Json) -> Json | None:
    """Send a request until it is not refused with 503, and return the reply; None without content or a server."""
    until = time.monotonic() + PATIENCE_SECONDS
    while True:
        try:
            reply = client.post(path, json=body)
        except httpx2.TransportError:
            return None
        told.statuses[reply.status_code] += 1
        if reply.status_code != 503:
            return reply.json() if reply.is_success and reply.content else None
        assert time.monotonic() < until, f"refused for {PATIENCE_SECONDS} seconds: {reply.text}"
        time.sleep(0.05)


def proof(url: str, told: Told, position: int | None = None) -> Counter[str]:
    """Open a store as a server does, and count what is wrong with it.

    Args:
        url: of the store, which is created if there is none.
        told: what clients were told by the server that wrote the store.
        position: where the disk's log ended for this store; by default, all has happened that clients were told.

    Returns:
        How many acknowledged answers are lost or charged twice, and the number of faults by fact of
        `waypost check`. If the store cannot be read, all are lost, and the fault is the error.
    """
    wrong: Counter[str] = Counter()
    head = told.head(position)
    noted = None if head is None else audit.Head(int(head.partition(":")[0]), head.partition(":")[2])
    stored: dict[int, list[str]] = {}
    try:
        with closing(Database(url)) as db:
            for result in db.read_now(lambda tx: checking.check(tx, noted)):
                wrong[result.fact] += result.n_faults
            stored = db.read_now(_charged)
    except (BadDatabase, WrongSchema, StorageFailed) as error:
        wrong[str(error)] += 1
    for answer in told.acknowledged(position):
        verdicts = stored.get(answer.assignment, [])
        wrong["lost"] += answer.body["answer"]["verdict"] not in verdicts
        wrong["charged twice"] += len(verdicts) > 1
    return +wrong


def _charged(tx: Tx) -> dict[int, list[str]]:
    """Return the verdict of each charge, by the assignment of its answer."""
    charged = select(answers.c.assignment_id, answers.c.content).join(ledger, ledger.c.answer_id == answers.c.id)
    found: dict[int, list[str]] = {}
    for row in tx.conn.execute(charged):
        found.setdefault(row.assignment_id, []).append(json.loads(row.content)["verdict"])
    return found


def send_again(url: str, told: Told) -> int:
    """Send all answers again, and return how many get another receipt than the first time."""
    with in_process(url) as service:
        differing = 0
        for one in told.acknowledged():
            path = f"{API}/assignments/{one.assignment}/answer"
            reply = service.client.post(path, json=one.body, headers=one.headers)
            differing += (reply.status_code, reply.json()) != (200, one.receipt)
        return differing
