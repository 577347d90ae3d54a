"""The six verbs of the paper (section 3), derived once from a domain's oracle.

It answers wire queries from what is on the wire, so it is the in-process expert and the oracle bot alike. Where the
learner's own choice is as good as any, that choice is the label: a tie counts as agreement.
"""

from collections.abc import Sequence
from typing import Any

from waypost import wire
from waypost.domain import Domain
from waypost.trajectory import Action, Subgoal


class OracleExpert:
    """mu*, pi*_g and beta*_g of a domain, as answers to queries."""

    def __init__(self, domain: Domain) -> None:
        """Take the oracle of `domain`.

        Raises:
            ValueError: the domain has none.
        """
        if domain.oracle is None:
            raise ValueError(f"the domain {domain.name!r} has no oracle: its queries need people (--expert queue)")
        self._domain, self._oracle = domain, domain.oracle

    def __call__(self, ask: wire.Ask) -> wire.Answer:
        """Answer one query."""
        match ask:
            case wire.AskHierDemo():
                demonstration = self.demonstrate(ask.instance, ask.state)
                return _flattened(demonstration) if ask.flat else demonstration
            case wire.AskInspectFull():
                succeeded = self._oracle.succeeded(ask.instance, ask.segments[-1].states[-1])
                return _verdict(ask.kind, succeeded)
            case wire.AskLabelHi():
                return self._label_hi(ask)
            case wire.AskInspectLo():
                (segment,) = ask.segments
                reached = self._oracle.reached(
                    ask.instance, segment.states[0], segment.states[-1], self._subgoal(segment.subgoal)
                )
                return _verdict(ask.kind, reached)
            case wire.AskLabelLo():
                return self._label_lo(ask)
            case wire.AskLabelFull():
                return self._label_full(ask)

    def demonstrate(self, instance: Any, state: Any) -> wire.HierDemoAnswer:
        """Carry the task out from a state."""
        segments = []
        while not self._oracle.succeeded(instance, state):
            subgoal = self._oracle.good_subgoals(instance, state)[0]
            origin, actions = state, list[Action]()
            while not actions or not self._oracle.reached(instance, origin, state, subgoal):
                actions.append(self._oracle.good_actions(instance, origin, state, subgoal)[0])
                state = self._oracle.successor(instance, state, actions[-1])
            segments.append(
                wire.DemoSegment(
                    subgoal=self._domain.subgoals[subgoal], actions=[self._domain.actions[a] for a in actions]
                )
            )
        return wire.HierDemoAnswer(kind="hier_demo", segments=segments)

    def _label_hi(self, ask: wire.AskLabelHi) -> wire.LabelHiAnswer:
        subgoals = [
            self._domain.subgoals[
                _preferring(self._subgoal(segment.subgoal), self._oracle.good_subgoals(ask.instance, segment.states[0]))
            ]
            for segment in ask.segments
        ]
        return wire.LabelHiAnswer(kind="label_hi", subgoals=subgoals)

    def _label_lo(self, ask: wire.AskLabelLo) -> wire.LabelLoAnswer:
        (segment,) = ask.segments
        subgoal, origin = self._subgoal(segment.subgoal), segment.states[0]
        terminations = [self._oracle.reached(ask.instance, origin, state, subgoal) for state in segment.states]
        over, actions = False, list[str | None]()
        for step, (state, own) in enumerate(zip(segment.states, segment.actions, strict=False)):
            over = over or terminations[step]
            good = [] if over else self._oracle.good_actions(ask.instance, origin, state, subgoal)
            if not good and not over:  # a subgoal that is not valid here is over before it begins
                terminations[step] = over = True
            actions.append(self._domain.actions[_preferring(self._action(own), good)] if good else None)
        # Only the first counts; what comes after is answered as the page does, so that equal labels are equal answers.
        end = terminations.index(True) if True in terminations else None
        terminations = [step == end for step in range(len(terminations))]
        return wire.LabelLoAnswer(kind="label_lo", actions=actions, terminations=terminations)

    def _label_full(self, ask: wire.AskLabelFull) -> wire.LabelFullAnswer:
        actions = []
        for segment in ask.segments:
            for state, own in zip(segment.states, segment.actions, strict=False):
                # On a shortest way to the target are just the good actions toward each of the good subgoals.
                good = [
                    action
                    for subgoal in self._oracle.good_subgoals(ask.instance, state)
                    for action in self._oracle.good_actions(ask.instance, state, state, subgoal)
                ]
                actions.append(self._domain.actions[_preferring(self._action(own), good)])
        return wire.LabelFullAnswer(kind="label_full", actions=actions)

    def _subgoal(self, name: str | None) -> Subgoal:
        return self._domain.subgoals.index(name or "")

    def _action(self, name: str) -> Action:
        return self._domain.actions.index(name)


def _preferring(own: int, good: Sequence[int]) -> int:
    """Return the learner's own choice if it is among the good ones, else the best."""
    return own if own in good else good[0]


def _flattened(demonstration: wire.HierDemoAnswer) -> wire.HierDemoAnswer:
    actions = [action for segment in demonstration.segments for action in segment.actions]
    return wire.HierDemoAnswer(kind="hier_demo", segments=[wire.DemoSegment(subgoal=None, actions=actions)])


def _verdict(kind: Any, passed: bool) -> wire.InspectAnswer:
    return wire.InspectAnswer(kind=kind, verdict="pass" if passed else "fail")
