"""The run of a training script: ask queries, read answers, report episodes, finish.

run = waypost.start_run("taxi", actions=["north", "south"])
query = run.ask(waypost.InspectFull([waypost.Segment(states, actions)], episode=0))
succeeded = query.answer()
"""

import time
from collections.abc import Iterator, Mapping, Sequence
from types import TracebackType
from typing import Any, Self, TypeVar

from pydantic import JsonValue

from waypost import wire
from waypost.client import Client
from waypost.runs.asked import POLL_SECONDS, AskedQuery
from waypost.runs.asking import Asker
from waypost.runs.progress import progress
from waypost.runs.queries import Query, check_names

A = TypeVar("A")


class Run:
    """A run of a training script. `start_run` makes it; several threads may ask and wait at the same time.

    As a context manager it finishes the run at the end of the block. After an exception or Ctrl-C the run stays open,
    so that the script can resume it.

    Args:
        client: the client of a user with the role learner or admin.
        created: an existing run, such as `client.run(id)`.

    Attributes:
        client: the client, for calls that a run has no method for.
        cursor: the number of the last answer that `answers` has yielded. Save it with a checkpoint; set it to continue.
    """

    def __init__(self, client: Client, created: wire.Run) -> None:
        self.client, self.cursor = client, 0
        self._created = created
        self._asker = Asker(client, created.id)

    @property
    def id(self) -> str:
        """The id of the run, as in the web app and on the command line."""
        return self._created.id

    # --- queries

    def ask(self, query: Query[A]) -> AskedQuery[A]:
        """Ask one query, and return at once. An equal query about the same episode is not asked again.

        Raises:
            BudgetExhausted: the budget has too few units left for the query.
            ValueError: the run does not declare a name in the query, or JSON cannot express a value.
            Refused, Unreachable: as in `Client`.
        """
        return self.ask_all([query])[0]

    def ask_all(self, queries: Sequence[Query[A]]) -> list[AskedQuery[A]]:
        """Ask several queries in few requests, and return them in the same order. Otherwise like `ask`.

        If it fails, some of the queries may have been asked. Asking all of them again asks only the others.
        """
        for query in queries:
            check_names(query, self._created.vocabulary)
        self.client.upload({name: png for query in queries for name, png in query.frames().items()})
        return [AskedQuery[A](self.client, asked) for asked in self._asker.ask(queries)]

    def answers(self, wait: float | None = None) -> Iterator[tuple[AskedQuery[Any], Any]]:
        """Yield each query of the run with its answer, in the order in which the answers are given.

        Each answer is yielded once. A resumed run yields its earlier answers again, unless you set `cursor`. The
        annotator can no longer retract an answer that was yielded.

        Args:
            wait: end when no answer has come for this many seconds; None to end when no query is open.
        """
        ends_at = 0.0 if wait is None else time.monotonic() + wait
        while True:
            if wait is not None:
                left = max(0.0, ends_at - time.monotonic())
            else:
                left = POLL_SECONDS if self.client.run(self.id).open_queries else 0.0
            page = self.client.answers(self.id, self.cursor, wait=min(left, POLL_SECONDS))
            for query in page.queries:
                answered = AskedQuery[Any](self.client, query)
                assert query.answer_id is not None
                self.cursor = query.answer_id
                if answered.use() and answered.latest.answer_id == query.answer_id:  # it was not retracted meanwhile
                    yield answered, answered.answer()
            if page.queries and wait is not None:
                ends_at = time.monotonic() + wait
            elif not page.queries and left <= 0:
                return

    def wait(self, queries: Sequence[AskedQuery[A]], timeout: float | None = None) -> list[A]:
        """Wait for the answers to several queries, and return them in the same order.

        It shows a progress bar in a terminal, and in a notebook if the package ipywidgets is installed.

        Args:
            queries: the queries.
            timeout: how long to wait at most for all of them, in seconds; None for no limit.

        Raises:
            TimeoutError, QueryCancelled, Unreachable: as in `AskedQuery.answer`.
        """
        ends_at = None if timeout is None else time.monotonic() + timeout
        return [
            query.answer(None if ends_at is None else ends_at - time.monotonic())
            for query in progress(queries, "Waiting for answers")
        ]

    # --- the account and the episodes

    def costs(self) -> wire.Costs:
        """Return the sums of the ledger: `total` and `by_kind` in units, the annotators' `seconds`, the `budget`."""
        return self.client.costs(self.id)

    def set_budget(self, units: float | None) -> None:
        """Set the highest total cost, in units; None for no limit.

        Raises:
            Refused: `budget-too-low` if more is spent, or reserved for open queries.
        """
        self.client.patch_run(self.id, wire.RunPatch(budget=units))

    def report(
        self,
        episode: int,
        success: bool | None = None,
        *,
        train_success: bool | None = None,
        train_steps: int = 0,
        test_steps: int = 0,
        hi_labels: int = 0,
        lo_labels: int = 0,
        seconds: float = 0.0,
    ) -> None:
        """Report the result of an episode, for the curves in the web app. Reporting it again changes nothing.

        Args:
            episode: the number of the episode, from 0.
            success: whether the policy succeeded in a test rollout after this episode; None if there was none. The
                success curve shows it.
            train_success: whether the training rollout of the episode succeeded.
            train_steps: the number of steps in the training rollout.
            test_steps: the number of steps in the test rollout.
            hi_labels: the number of HI labels that the learner has so far.
            lo_labels: the number of LO labels that the learner has so far.
            seconds: the learner's wall time for the episode.

        Raises:
            Refused: `different-content` if the episode was reported with another result.
        """
        result = wire.EpisodeResult(
            episode=episode,
            warm_start=False,
            train_success=train_success,
            test_success=success,
            train_steps=train_steps,
            test_steps=test_steps,
            hi_labels=hi_labels,
            lo_labels=lo_labels,
            seconds=seconds,
        )
        self.client.report(self.id, [result])

    def finish(self, result: Mapping[str, JsonValue] | None = None) -> None:
        """Finish the run. Its open queries are cancelled and the units reserved for them are released.

        Args:
            result: what the run achieved, as JSON values; the web app shows it.
        """
        patch = (
            wire.RunPatch(state="finished") if result is None else wire.RunPatch(state="finished", result={**result})
        )
        self.client.patch_run(self.id, patch)

    def close(self) -> None:
        """Close the connections. The run stays open at the server."""
        self.client.close()

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, traceback: TracebackType | None
    ) -> None:
        if kind is None:
            self.finish()
        self.close()

    def __repr__(self) -> str:
        return f"<run {self.id}: {self._created.name}>"
