"""The client of the REST API (`/api/v1`): one method per call, for learners and for annotator programs.

A call that gets no reply, or status 429, 502, 503 or 504, is repeated until `patience` is over. On the server, asking,
answering, using and reporting are idempotent, so repeating them changes nothing, even after a restart of the server.
"""

import base64
import time
from collections.abc import Iterator, Mapping, Sequence
from contextlib import AbstractContextManager
from typing import Any, TypeVar

import httpx2
from pydantic import BaseModel
from websockets.sync.client import ClientConnection, connect

from waypost import wire
from waypost.wire.review import MOST_PREDICTIONS

M = TypeVar("M", bound=BaseModel)

PATIENCE_SECONDS = 300.0
_FIRST_PAUSE, _LONGEST_PAUSE = 0.05, 2.0
_HASHES_AT_ONCE = 1_000
_QUERIES_AT_ONCE = 500
_UPLOAD_BYTES = 2 * 2**20  # of frames in one request body; a single larger frame is sent alone
_CONNECT_SECONDS = 5.0
_LARGEST_MESSAGE = 4 * 2**20  # on a play socket; the server has the same limit
_TRANSIENT = frozenset({429, 502, 503, 504})


class Refused(Exception):
    """The server refused a call. `problem` says why."""

    def __init__(self, problem: wire.Problem) -> None:
        super().__init__(f"{problem.title}: {problem.detail}")
        self.problem = problem

    @property
    def name(self) -> str:
        """The stable name of the problem, such as `lease-expired`."""
        return self.problem.type.rsplit("/", 1)[-1]


class BudgetExhausted(Refused):
    """The run's budget has too few units left for the queries. Raise the budget, or ask less."""


class Unreachable(Exception):
    """The server was not available within `patience`."""


class Client:
    """Calls one server as one user.

    Args:
        server: the server's base URL, such as http://127.0.0.1:8000.
        token: an API token.
        transport: replaces the network, for example with an app in the same process.
        patience: how long to repeat a call when the server is not available, in seconds.
    """

    def __init__(
        self,
        server: str,
        token: str,
        transport: httpx2.BaseTransport | None = None,
        patience: float = PATIENCE_SECONDS,
    ) -> None:
        self._patience = patience
        self._uploaded: set[str] = set()  # hashes of frames that the server has
        self._http = httpx2.Client(
            base_url=f"{server.rstrip('/')}/api/v1",
            headers={"Authorization": f"Bearer {token}"},
            transport=transport,
            timeout=httpx2.Timeout(90.0, connect=_CONNECT_SECONDS),  # long polls last up to 60 s
        )

    def close(self) -> None:
        """Close the connections."""
        self._http.close()

    # --- the learner's calls

    def create_run(self, run: wire.RunCreate) -> wire.Run:
        """Create a run."""
        return self._call(wire.Run, "POST", "/runs", run)

    def runs(self, text: str = "", mine: bool = False) -> list[wire.Run]:
        """Return at most a thousand runs, newest first, with these words in the name, algorithm, domain or id.

        Args:
            text: the words; none for all runs.
            mine: whether to return only the runs of this client's user, which it may change.
        """
        return self._call(wire.RunList, "GET", "/runs", params={"limit": 1_000, "text": text, "mine": mine}).runs

    def run(self, run: str) -> wire.Run:
        """Return a run."""
        return self._call(wire.Run, "GET", f"/runs/{run}")

    def patch_run(self, run: str, patch: wire.RunPatch) -> wire.Run:
        """Change the name, state, budget, priority, gold rate or result of a run."""
        return self._call(wire.Run, "PATCH", f"/runs/{run}", patch)

    def upload(self, frames: Mapping[str, bytes]) -> None:
        """Upload frames (PNG files by their SHA-256) that the server does not have yet."""
        wanted = [frame for frame in frames if frame not in self._uploaded]
        for start in range(0, len(wanted), _HASHES_AT_ONCE):
            hashes = wire.FrameHashes(hashes=wanted[start : start + _HASHES_AT_ONCE])
            missing = self._call(wire.FrameHashes, "POST", "/frames/missing", hashes).hashes
            for batch in _batches(missing, frames):
                self._send("PUT", "/frames", wire.FrameUpload(frames=batch))
            self._uploaded.update(hashes.hashes)

    def ask(self, run: str, queries: Sequence[wire.Ask]) -> list[wire.Query]:
        """Ask queries. A query that was asked before is returned with its answer, if it has one."""
        return self._call(wire.Asked, "POST", f"/runs/{run}/queries", wire.AskList(queries=list(queries))).queries

    def queries(self, run: str, episode: int) -> list[wire.Query]:
        """Return all queries about an episode, newest first."""
        found, params = list[wire.Query](), {"episode": episode, "limit": _QUERIES_AT_ONCE}
        while True:
            page = self._call(wire.QueryList, "GET", f"/runs/{run}/queries", params=params).queries
            found += page
            if len(page) < _QUERIES_AT_ONCE:
                return found
            params["before"] = page[-1].id

    def query(self, query: int, wait: float = 0) -> wire.Query:
        """Return a query; wait up to `wait` seconds (at most 60) for its answer."""
        return self._call(wire.Query, "GET", f"/queries/{query}", params={"wait": wait})

    def answers(self, run: str, after: int, wait: float = 0) -> wire.AnswerPage:
        """Return the answers after a cursor; wait up to `wait` seconds (at most 60) for the first."""
        return self._call(wire.AnswerPage, "GET", f"/runs/{run}/answers", params={"after": after, "wait": wait})

    def use(self, query: int) -> wire.Query:
        """Mark the answer as used. From then on it cannot be retracted."""
        return self._call(wire.Query, "POST", f"/queries/{query}/use")

    def play(self, query: int) -> AbstractContextManager[ClientConnection]:
        """Open the play socket of a demonstration.

        Raises:
            OSError, WebSocketException: the server cannot be reached, or refuses the connection.
        """
        server = str(self._http.base_url).removeprefix("http")
        return connect(
            f"ws{server}queries/{query}/play",
            additional_headers={"Authorization": self._http.headers["Authorization"]},
            open_timeout=_CONNECT_SECONDS,
            max_size=_LARGEST_MESSAGE,
        )

    def report(self, run: str, episodes: Sequence[wire.EpisodeResult]) -> wire.Run:
        """Report the results of episodes."""
        return self._call(wire.Run, "POST", f"/runs/{run}/episodes", wire.EpisodeList(episodes=list(episodes)))

    def add_gold(self, run: str, gold: wire.GoldPost) -> list[wire.Gold]:
        """Make queries gold; return all gold queries of the run, newest first."""
        return self._call(wire.GoldList, "POST", f"/runs/{run}/gold", gold).gold

    def practice(self, domain: str) -> wire.Practice:
        """Return the practice queries of a domain."""
        return self._call(wire.Practice, "GET", "/practice", params={"domain": domain})

    def put_practice(self, run: str, practice: wire.PracticePut) -> None:
        """Send practice queries of the run's domain. Their pictures were uploaded before."""
        self._send("PUT", f"/runs/{run}/practice", practice)

    def put_predictions(self, run: str, episode: int, predictions: Sequence[wire.Prediction]) -> None:
        """Send what the policies that learned from `episode` last would answer to queries whose answers were used.

        Whoever reviews the run sees where an answer differs from it. It replaces what was sent before.
        """
        for start in range(0, len(predictions), MOST_PREDICTIONS):
            part = list(predictions[start : start + MOST_PREDICTIONS])
            self._send("PUT", f"/runs/{run}/predictions", wire.Predictions(episode=episode, predictions=part))

    def costs(self, run: str) -> wire.Costs:
        """Return the sums of the ledger."""
        return self._call(wire.Costs, "GET", f"/runs/{run}/costs")

    def curves(self, run: str) -> wire.Curves:
        """Return success and cost by episode."""
        return self._call(wire.Curves, "GET", f"/runs/{run}/curves")

    def forecast(self, run: str, target: wire.SuccessLevel = "0.9") -> wire.Forecast:
        """Return how many more units a run needs to reach a success rate."""
        return self._call(wire.Forecast, "GET", f"/runs/{run}/forecast", params={"target": target})

    def records(self, run: str, part: wire.RecordPart, after: int | None = None) -> wire.RecordPage:
        """Return one page of a part of a run's records; `after` is the cursor of the page before."""
        place = {} if after is None else {"after": after}
        return self._call(wire.RecordPage, "GET", f"/runs/{run}/records", params={"part": part, **place})

    def frame(self, frame: str) -> bytes:
        """Return a picture as a PNG file, by its SHA-256."""
        return self._send("GET", f"/frames/{frame}").content

    # --- the annotator's calls

    def lease(self, lease: wire.Lease) -> wire.Assignment | None:
        """Lease the next query; return None if there is none within `lease.wait` seconds."""
        response = self._send("POST", "/assignments", lease)
        return None if response.status_code == 204 else _read(wire.Assignment, response)

    def lease_batch(self, lease: wire.LeaseBatch) -> list[wire.Assignment]:
        """Lease several queries at once; wait up to `lease.wait` seconds for the first."""
        return self._call(wire.AssignmentList, "POST", "/assignments/batch", lease).assignments

    def answer_batch(self, answers: Sequence[tuple[wire.Assignment, wire.Answer]]) -> list[wire.BatchResult]:
        """Answer several queries at once, stored by one commit. One that is refused does not affect the others."""
        posted = [wire.BatchedAnswer(assignment=held.id, token=held.token, answer=answer) for held, answer in answers]
        body = wire.AnswerBatch(answers=posted)
        return self._call(wire.BatchReceipt, "POST", "/assignments/answers", body).results

    def assignments(self) -> list[wire.Assignment]:
        """Return this user's live assignments, oldest first."""
        return self._call(wire.AssignmentList, "GET", "/assignments").assignments

    def answer(
        self, assignment: wire.Assignment, answer: wire.Answer, following: wire.Lease | None = None
    ) -> wire.Receipt:
        """Answer a query. With `following`, the receipt has the next assignment, or the problem that prevented it."""
        post = wire.AnswerPost(token=assignment.token, answer=answer, next=following)
        return self._call(wire.Receipt, "POST", f"/assignments/{assignment.id}/answer", post)

    def release(self, assignment: wire.Assignment, reason: str = "", skip: bool = False) -> None:
        """Return a query to the queue without an answer. With `skip`, this user does not get it again."""
        self._send(
            "POST",
            f"/assignments/{assignment.id}/release",
            wire.Release(token=assignment.token, reason=reason, skip=skip),
        )

    # --- how calls are made

    def _call(self, reply: type[M], method: str, path: str, body: BaseModel | None = None, params: Any = None) -> M:
        return _read(reply, self._send(method, path, body, params))

    def _send(self, method: str, path: str, body: BaseModel | None = None, params: Any = None) -> httpx2.Response:
        content = body.model_dump_json(exclude_unset=True) if body is not None else None
        headers = {"Content-Type": "application/json"} if body is not None else {}
        give_up_at, pause, trouble = time.monotonic() + self._patience, _FIRST_PAUSE, ""
        while True:
            try:
                response = self._http.request(method, path, content=content, headers=headers, params=params)
                if response.status_code not in _TRANSIENT:
                    break
                trouble = f"status {response.status_code}"
            except httpx2.TransportError as error:
                trouble = repr(error)
            if time.monotonic() + pause > give_up_at:
                raise Unreachable(f"the server at {self._http.base_url} does not answer ({trouble}): is it running?")
            time.sleep(pause)
            pause = min(2 * pause, _LONGEST_PAUSE)
        if response.is_error:
            problem = _problem(response)
            raise (BudgetExhausted if problem.type.endswith("/budget-exhausted") else Refused)(problem)
        return response


def _batches(hashes: Sequence[str], frames: Mapping[str, bytes]) -> Iterator[list[wire.Frame]]:
    """Yield batches of frames; each batch fits into one request body."""
    batch, size = list[wire.Frame](), 0
    for one in hashes:
        png = base64.b64encode(frames[one]).decode()
        if batch and (size + len(png) > _UPLOAD_BYTES or len(batch) == _HASHES_AT_ONCE):
            yield batch
            batch, size = [], 0
        batch.append(wire.Frame(hash=one, png=png))
        size += len(png)
    if batch:
        yield batch


def _read(reply: type[M], response: httpx2.Response) -> M:
    return reply.model_validate_json(response.content)


def _problem(response: httpx2.Response) -> wire.Problem:
    try:
        return wire.Problem.model_validate_json(response.content)
    except ValueError:
        return wire.Problem(
            type="/problems/unknown",
            title=f"Status {response.status_code}",
            status=response.status_code,
            detail=response.text[:200] or "no explanation; is this a Waypost server?",
        )
