"""The computed expert: answers to the paper's six verbs (section 3), from a domain's oracle.

It needs only the content of a wire query, so the in-process expert and the oracle bot are the same code. If the
learner's own choice is right, this choice becomes the label: a tie counts as agreement.
"""

import json
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

from waypost import wire
from waypost.domains import Domain, Predicting, Reopened, oracle_of
from waypost.trajectory import Action
from waypost_learner.experts.solutions import solve
from waypost_learner.rollout.simulator import Simulator


@dataclass(frozen=True)
class Most:
    """Where a demonstration ends at the latest."""

    segments: int | None  # None if there is no limit
    actions: int


class OracleExpert:
    """Answers queries with mu*, pi*_g and beta*_g of a domain.

    Args:
        domain: the domain; its oracle answers.

    Raises:
        ValueError: the domain has no oracle.
    """

    def __init__(self, domain: Domain) -> None:
        oracle = oracle_of(domain)
        if oracle is None:
            raise ValueError(f"the domain {domain.name!r} has no oracle: its queries need people (--expert queue)")
        self._domain, self._oracle = domain, oracle

    def __call__(self, ask: wire.Ask) -> wire.Answer:
        """Answer one query."""
        if isinstance(ask, wire.AskHierDemo):
            most = Most(None if ask.flat else ask.max_segments, ask.max_actions)
            demonstration = self.demonstrate(ask.instance, ask.state, ask.context, most)
            return _flattened(demonstration) if ask.flat else demonstration
        return _preferred(ask, solve(self._domain, ask).known)

    def demonstrate(
        self, instance: Any, state: Any, context: Sequence[wire.Segment] = (), most: Most | None = None
    ) -> wire.HierDemoAnswer:
        """Return the oracle's demonstration from a state, given by its JSON view, until the task is accomplished.

        An oracle that does not predict the next state acts in the domain's environment, after the actions of `context`;
        then a demonstration may also end with the episode. It ends too where no action is good anymore.

        Args:
            instance: the instance, as a JSON view.
            state: the first state.
            context: the segments from the start of the instance to `state`.
            most: where the demonstration ends at the latest; after H_FULL actions if None.

        Raises:
            ValueError: the oracle cannot demonstrate; the message says what is missing.
        """
        most = most or Most(None, self._domain.horizons.full)
        follow, segments = self._follow(instance, state, context), list[wire.DemoSegment]()
        if self._oracle.succeeded(instance, state):
            raise ValueError(f"the task is accomplished in the state {state}, so there is nothing to demonstrate")
        ended, steps = False, 0
        while not ended and len(segments) != most.segments:
            subgoal = self._first(self._oracle.good_subgoals(instance, state), "good_subgoals", state)
            origin, actions = state, list[Action]()
            while not ended and (not actions or not self._oracle.reached(instance, origin, state, subgoal)):
                good = self._oracle.good_actions(instance, origin, state, subgoal)
                if steps and not good:  # what the environment did on the way cannot be undone
                    ended = True
                    break
                actions.append(self._first(good, "good_actions", state))
                state, over = follow(state, actions[-1])
                steps += 1
                ended = over or steps == most.actions or self._oracle.succeeded(instance, state)
            names = [self._domain.actions[action] for action in actions]
            if names:
                segments.append(wire.DemoSegment(subgoal=self._domain.subgoals[subgoal], actions=names))
        return wire.HierDemoAnswer(kind="hier_demo", segments=segments)

    def _first(self, good: Sequence[int], function: str, state: Any) -> int:
        if not good:
            raise ValueError(f"the oracle of {self._domain.name!r} is stuck: {function} is empty in the state {state}")
        return good[0]

    def _follow(
        self, instance: Any, state: Any, context: Sequence[wire.Segment]
    ) -> Callable[[Any, Action], tuple[Any, bool]]:
        """Return a function that carries out an action in a state: the next state, and whether the episode is over."""
        if isinstance(self._oracle, Predicting):
            successor = self._oracle.successor
            return lambda state, action: (successor(instance, state, action), False)
        if not isinstance(self._domain, Reopened):
            raise ValueError(
                f"the oracle of {self._domain.name!r} cannot demonstrate: it needs successor(instance, state, action), "
                "or the domain needs instance_from(view)"
            )
        simulator = Simulator(self._domain)
        view = simulator.reset(self._domain.instance_from(instance)).view
        for action in (action for segment in context for action in segment.actions):
            if simulator.ended:
                break
            view = simulator.step(self._domain.actions.index(action)).view
        if context and (simulator.ended or _plain(view) != _plain(state)):
            raise ValueError(
                f"the oracle of {self._domain.name!r} cannot play on: the actions so far do not lead to the state "
                f"{state} again; give it successor(instance, state, action)"
            )
        return lambda _, action: (simulator.step(action).view, simulator.ended)


def _preferred(ask: Any, known: wire.Known) -> wire.Answer:
    """Return a right answer: for each label the learner's own choice if it is right, else the oracle's preferred one.

    Args:
        ask: the query, of any kind except `hier_demo`.
        known: its right answers.
    """
    match known:
        case wire.KnownVerdict():
            return wire.InspectAnswer(kind=known.kind, verdict=known.verdict)
        case wire.KnownSubgoals():
            own = [segment.subgoal for segment in ask.segments]
            return wire.LabelHiAnswer(kind="label_hi", subgoals=_choices(own, known.subgoals))
        case wire.KnownActions():
            own = [action for segment in ask.segments for action in segment.actions]
            return wire.LabelFullAnswer(kind="label_full", actions=_choices(own, known.actions))
        case wire.KnownSegment():
            (segment,) = ask.segments
            unlabeled = [None] * (len(segment.actions) - len(known.actions))  # after the segment should end
            return wire.LabelLoAnswer(
                kind="label_lo",
                actions=[*_choices(segment.actions, known.actions), *unlabeled],
                # Only the first true termination counts. The web app sends the same, so equal labels are equal answers.
                terminations=[step == known.end for step in range(len(segment.states))],
            )


def _choices(own: Sequence[str | None], right: Sequence[Sequence[str]]) -> list[str]:
    """Return the learner's own choice of each label if it is right, else the first right one."""
    return [mine if mine is not None and mine in good else good[0] for mine, good in zip(own, right, strict=False)]


def _plain(view: Any) -> Any:
    """Return a JSON view as it comes in a message: with lists for tuples."""
    return json.loads(json.dumps(view))


def _flattened(demonstration: wire.HierDemoAnswer) -> wire.HierDemoAnswer:
    actions = [action for segment in demonstration.segments for action in segment.actions]
    return wire.HierDemoAnswer(kind="hier_demo", segments=[wire.DemoSegment(subgoal=None, actions=actions)])
