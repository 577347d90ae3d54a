"""The oracle bot: an annotator program that leases queries and answers them with the oracle of their domain.

To simulate imperfect experts it can give wrong answers (`error_rate`) and answer slowly (`seconds`). A wrong answer is
valid: its labels are drawn at random.
"""

import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from waypost import wire
from waypost.client import Client, Refused
from waypost.domains import Domain, find_domain
from waypost_learner.experts.oracle import OracleExpert

_LOST = frozenset({"lease-expired", "lease-ended", "query-cancelled"})
"""Refusals that mean that the bot no longer holds the query. It continues with the next one."""

LONGEST_REASON = 500  # characters; the server refuses longer ones


@dataclass(frozen=True)
class BotSettings:
    """Which queries a bot answers, and how correctly and how fast."""

    run: str | None = None  # only this run
    kinds: tuple[wire.Kind, ...] | None = None  # only these kinds
    error_rate: float = 0.0  # share of answers with random labels
    seconds: float = 0.0  # to wait before each answer
    defer: float = 0.0  # seconds for which it leaves queries to people who are working
    seed: int = 0  # fixes its wrong answers


class Bot:
    """Answers queries with the oracle of their run's domain.

    Args:
        client: the client of a user who may answer.
        settings: which queries to answer, and how; if None, answer all queries, correctly and at once.
        domains: domains that are not installed; others are found by their names.
        on_failure: called with a query that the oracle could not answer, and the reason; the bot returns the query to
            the queue, for others. If None, the bot raises the error.
    """

    def __init__(
        self,
        client: Client,
        settings: BotSettings | None = None,
        domains: Sequence[Domain] = (),
        on_failure: Callable[[wire.Assignment, Exception], None] | None = None,
    ) -> None:
        self._on_failure = on_failure
        self._client, self._settings = client, settings or BotSettings()
        self._experts = {domain.name: OracleExpert(domain) for domain in domains}
        self._rng = np.random.default_rng(self._settings.seed)

    def work(self, wait: float = 20.0, on_answer: Callable[[wire.Receipt], None] = lambda _: None) -> None:
        """Answer queries until none arrives for `wait` seconds."""
        assignment = self._client.lease(self._lease(wait))
        while assignment is not None:
            receipt = self._answer(assignment, self._lease(0))
            if receipt is not None:
                on_answer(receipt)
            following = receipt.next if receipt is not None else None
            assignment = following or self._client.lease(self._lease(wait))

    def work_forever(self, on_answer: Callable[[wire.Receipt], None] = lambda _: None) -> None:
        """Answer queries until interrupted."""
        while True:
            self.work(on_answer=on_answer)

    def _lease(self, wait: float) -> wire.Lease:
        kinds = self._settings.kinds
        return wire.Lease(
            wait=wait,
            kinds=list(kinds) if kinds is not None else None,
            run=self._settings.run,
            defer=self._settings.defer,
        )

    def _answer(self, assignment: wire.Assignment, following: wire.Lease) -> wire.Receipt | None:
        if self._settings.seconds:
            time.sleep(self._settings.seconds)
        try:
            answer = self._expert(assignment.run.vocabulary.domain)(assignment.query.ask)
        except Exception as error:
            if self._on_failure is None:
                raise
            self._client.release(assignment, reason=str(error)[:LONGEST_REASON], skip=True)
            self._on_failure(assignment, error)
            return None
        if self._rng.random() < self._settings.error_rate:
            answer = self._mistaken(answer, assignment.run.vocabulary)
        try:
            return self._client.answer(assignment, answer, following)
        except Refused as refusal:
            if refusal.name in _LOST:
                return None
            raise

    def _expert(self, domain: str) -> OracleExpert:
        if domain not in self._experts:
            self._experts[domain] = OracleExpert(find_domain(domain))
        return self._experts[domain]

    def _mistaken(self, answer: wire.Answer, names: wire.Vocabulary) -> wire.Answer:
        match answer:
            case wire.InspectAnswer():
                return answer.model_copy(update={"verdict": "fail" if answer.verdict == "pass" else "pass"})
            case wire.LabelHiAnswer():
                return answer.model_copy(update={"subgoals": [self._any(names.subgoals) for _ in answer.subgoals]})
            case wire.LabelLoAnswer():
                actions = [None if a is None else self._any(names.actions) for a in answer.actions]
                return answer.model_copy(update={"actions": actions})
            case wire.LabelFullAnswer():
                return answer.model_copy(update={"actions": [self._any(names.actions) for _ in answer.actions]})
            case wire.HierDemoAnswer():
                return answer  # random actions would not be a demonstration

    def _any(self, names: list[str]) -> str:
        return names[int(self._rng.integers(len(names)))]
