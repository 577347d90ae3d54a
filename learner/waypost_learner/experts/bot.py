"""The oracle bot: a REST client that leases queries and answers them with a domain's oracle.

To rehearse with imperfect experts it can err at a rate (`error_rate`) and take its time (`seconds`). An erring answer
is a valid one, drawn at random from the answers of that kind.
"""

import time
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from waypost import wire
from waypost.client import Client, Refused
from waypost.domain import Domain, find_domain
from waypost_learner.experts.oracle import OracleExpert

_LOST = frozenset({"lease-expired", "lease-ended", "query-cancelled"})
"""Refusals that mean: somebody else has this query now, go on with the next."""


@dataclass(frozen=True)
class BotSettings:
    """How a bot works."""

    run: str | None = None  # only this run
    kinds: tuple[wire.Kind, ...] | None = None  # only these kinds
    error_rate: float = 0.0  # share of answers that are random ones
    seconds: float = 0.0  # how long it thinks about each answer
    defer: float = 0.0  # leaves queries this long to people who are at work
    seed: int = 0  # of its errors


class Bot:
    """Answers with the oracle of whatever domain a run has."""

    def __init__(self, client: Client, settings: BotSettings | None = None) -> None:
        self._client, self._settings = client, settings or BotSettings()
        self._experts: dict[str, OracleExpert] = {}
        self._domains: dict[str, Domain] = {}
        self._rng = np.random.default_rng(self._settings.seed)

    def work(self, wait: float = 20.0, on_answer: Callable[[wire.Receipt], None] = lambda _: None) -> None:
        """Answer queries until there has been none for `wait` seconds."""
        assignment = self._client.lease(self._wish(wait))
        while assignment is not None:
            receipt = self._answer(assignment, self._wish(0))
            if receipt is not None:
                on_answer(receipt)
            following = receipt.next if receipt is not None else None
            assignment = following or self._client.lease(self._wish(wait))

    def work_forever(self, on_answer: Callable[[wire.Receipt], None] = lambda _: None) -> None:
        """Answer queries until interrupted."""
        while True:
            self.work(on_answer=on_answer)

    def _wish(self, wait: float) -> wire.Lease:
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
        answer = self._expert(assignment.run.vocabulary.domain)(assignment.query.ask)
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
                return answer  # a demonstration is carried out in the environment, which leaves no room for slips

    def _any(self, names: list[str]) -> str:
        return names[int(self._rng.integers(len(names)))]
