"""What the current policies would answer to earlier queries, so that reviewers see where they differ from an answer."""

from collections import OrderedDict
from collections.abc import Sequence

import numpy as np

from waypost import wire
from waypost.client import Client
from waypost.trajectory import State
from waypost_learner.algorithms.learner import Learner
from waypost_learner.algorithms.queries import LabelFull, LabelHi, LabelLo, Query
from waypost_learner.rollout.policy_keys import FLAT, META, PolicyKey, pi
from waypost_learner.rollout.rollout import Outputs, Policies

MOST = 300  # queries, the newest ones: their observations stay in memory
AT_ONCE = 12  # of them after each episode, in turn: people wait until that is done


class Predicting:
    """Keeps the newest queries that ask for labels, and sends what the policies would answer to them.

    Each policy answers in each state by itself: it does not remember what it chose before.

    Args:
        learner: the learner of the run.
        client: the learner's client.
        run: the run.
    """

    def __init__(self, learner: Learner, client: Client, run: str) -> None:
        self._learner, self._domain, self._client, self._run = learner, learner.domain, client, run
        self._asked = OrderedDict[int, LabelHi | LabelLo | LabelFull]()
        self._first = 0  # the place of the next query in turn

    def keep(self, query_id: int, query: Query) -> None:
        """Keep a query whose answer was used, if it asks for labels."""
        if isinstance(query, LabelHi | LabelLo | LabelFull):
            self._asked[query_id] = query
            if len(self._asked) > MOST:
                self._asked.popitem(last=False)

    def after(self, episode: int) -> None:
        """Send what the policies would answer now to the next few queries, having learned from this episode last."""
        self._send(episode, [*self._asked.items()][self._first : self._first + AT_ONCE])
        self._first += AT_ONCE
        if self._first >= len(self._asked):
            self._first = 0

    def now(self, episode: int) -> None:
        """Send what the policies would answer now to all queries, having learned from this episode last."""
        self._send(episode, [*self._asked.items()])

    def _send(self, episode: int, asked: Sequence[tuple[int, LabelHi | LabelLo | LabelFull]]) -> None:
        if asked:
            policies = self._learner.policies
            predictions = [wire.Prediction(query=id_, answer=self._answer(policies, query)) for id_, query in asked]
            self._client.put_predictions(self._run, episode, predictions)

    def _answer(self, policies: Policies, query: LabelHi | LabelLo | LabelFull) -> wire.Answer:
        match query:
            case LabelHi(sigma):
                outputs = _outputs(policies, META, [segment.start for segment in sigma])
                return wire.LabelHiAnswer(kind="label_hi", subgoals=_names(outputs, self._domain.subgoals))
            case LabelLo(segment):
                assert segment.subgoal is not None
                outputs = _outputs(policies, pi(segment.subgoal), segment.states)
                ends = outputs.termination > self._learner.preset.rollouts.choosing.termination_threshold
                return wire.LabelLoAnswer(
                    kind="label_lo",
                    actions=[*_names(outputs, self._domain.actions)[:-1]],
                    terminations=[False, *ends[1:].tolist()],  # a segment has at least one action
                )
            case LabelFull(sigma):
                states = [state for segment in sigma for state in segment.states[:-1]]
                outputs = _outputs(policies, FLAT, states)
                return wire.LabelFullAnswer(kind="label_full", actions=_names(outputs, self._domain.actions))


def _outputs(policies: Policies, key: PolicyKey, states: Sequence[State]) -> Outputs:
    return policies[key](np.stack([state.observation for state in states]))


def _names(outputs: Outputs, names: Sequence[str]) -> list[str]:
    return [names[choice] for choice in outputs.logits.argmax(1)]
