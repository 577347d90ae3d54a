"""Between the learner's queries (numbers, states) and the wire's (names, JSON views), both ways."""

from collections.abc import Sequence
from typing import Any

from waypost import wire
from waypost.domain import Domain
from waypost.trajectory import Segment, Trajectory
from waypost_learner.algorithms.queries import (
    Answer,
    HierDemo,
    InspectFull,
    InspectLo,
    LabelFull,
    LabelHi,
    LabelLo,
    Query,
)
from waypost_learner.policies.datasets import LoLabels
from waypost_learner.remote.camera import Camera
from waypost_learner.rollout.simulator import Simulator


def vocabulary(domain: Domain) -> wire.Vocabulary:
    """Return a domain's names as a run declares them."""
    return wire.Vocabulary(
        domain=domain.name, subgoals=list(domain.subgoals), actions=list(domain.actions), renderer=domain.renderer
    )


class Translator:
    """Translates for one domain and one environment instance; with a camera, queries carry pictures of their states."""

    def __init__(self, domain: Domain, instance: Any, camera: Camera | None = None) -> None:
        self.domain, self.instance, self.camera = domain, instance, camera

    def ask(self, query: Query, episode: int, ordinal: int) -> wire.Ask:
        """Return a query as it goes over the wire."""
        common: dict[str, Any] = {
            "episode": episode,
            "ordinal": ordinal,
            "instance": self.domain.instance_view(self.instance),
        }
        match query:
            case HierDemo(state, flat):
                horizons = self.domain.horizons
                how = "." if flat else ", one subgoal after the other."
                return wire.AskHierDemo(
                    kind="hier_demo",
                    question=f"Carry out the whole task{how}",
                    state=state.view,
                    flat=flat,
                    max_segments=horizons.hi,
                    max_actions=horizons.full,
                    **common,
                )
            case InspectFull(sigma):
                return wire.AskInspectFull(
                    kind="inspect_full",
                    question="Was the whole task accomplished?",
                    segments=self._segments(sigma),
                    **common,
                )
            case LabelHi(sigma, before):
                return wire.AskLabelHi(
                    kind="label_hi",
                    question=f"Which subgoal was right at the start of {'each' if len(sigma) > 1 else 'this'} segment?",
                    **self._parted(before, sigma),
                    suggestion=wire.LabelHiAnswer(kind="label_hi", subgoals=[self._subgoal(s) for s in sigma]),
                    **common,
                )
            case InspectLo(segment, before):
                return wire.AskInspectLo(
                    kind="inspect_lo",
                    question=f"Did this segment accomplish “{self._words(segment)}”?",
                    **self._parted(before, (segment,)),
                    **common,
                )
            case LabelLo(segment, before):
                return wire.AskLabelLo(
                    kind="label_lo",
                    question=f"Which action was right in each state toward “{self._words(segment)}”?",
                    **self._parted(before, (segment,)),
                    suggestion=wire.LabelLoAnswer(
                        kind="label_lo",
                        actions=list(self._actions(segment.actions)),
                        terminations=[*(False for _ in segment.actions), segment.terminated],
                    ),
                    **common,
                )
            case LabelFull(sigma):
                return wire.AskLabelFull(
                    kind="label_full",
                    question="Which action was right in each state?",
                    segments=self._segments(sigma),
                    suggestion=wire.LabelFullAnswer(
                        kind="label_full", actions=[a for s in sigma for a in self._actions(s.actions)]
                    ),
                    **common,
                )

    def answer(self, answer: wire.Answer) -> Answer:
        """Return an answer off the wire in the form that `learner.queries` promises the algorithm."""
        match answer:
            case wire.HierDemoAnswer():
                return self._replay(answer.segments)
            case wire.InspectAnswer():
                return answer.verdict == "pass"
            case wire.LabelHiAnswer():
                return tuple(self.domain.subgoals.index(g) for g in answer.subgoals)
            case wire.LabelLoAnswer():
                actions = tuple(None if a is None else self.domain.actions.index(a) for a in answer.actions)
                return LoLabels(actions, tuple(answer.terminations))
            case wire.LabelFullAnswer():
                return tuple(self.domain.actions.index(a) for a in answer.actions)

    def _replay(self, segments: Sequence[wire.DemoSegment]) -> Trajectory:
        """Carry a demonstration out again, to see what the networks would have seen.

        Actions after the end of the episode have no state and are left out.
        """
        simulator = Simulator(self.domain)
        state = simulator.reset(self.instance)
        sigma = []
        for segment in segments:
            states, actions = [state], list[int]()
            for action in segment.actions:
                if simulator.ended:
                    break
                actions.append(self.domain.actions.index(action))
                states.append(simulator.step(actions[-1]))
            if actions:
                subgoal = None if segment.subgoal is None else self.domain.subgoals.index(segment.subgoal)
                sigma.append(Segment(subgoal, tuple(states), tuple(actions), terminated=subgoal is not None))
            state = states[-1]
        return tuple(sigma)

    def _parted(self, before: Trajectory, asked: Trajectory) -> dict[str, Any]:
        """Return the segments to ask about, and what came before them."""
        segments = self._segments([*before, *asked])
        return {"segments": segments[len(before) :], "context": segments[: len(before)]}

    def _segments(self, segments: Sequence[Segment]) -> list[wire.Segment]:
        """Return segments that follow each other from the start of the episode."""
        frames = self.camera.frames(segments) if self.camera else [[] for _ in segments]
        return [
            wire.Segment(
                subgoal=None if s.subgoal is None else self._subgoal(s),
                states=[state.view for state in s.states],
                actions=list(self._actions(s.actions)),
                frames=pictures,
            )
            for s, pictures in zip(segments, frames, strict=True)
        ]

    def _subgoal(self, segment: Segment) -> str:
        assert segment.subgoal is not None
        return self.domain.subgoals[segment.subgoal]

    def _words(self, segment: Segment) -> str:
        return self._subgoal(segment).replace("_", " ")

    def _actions(self, actions: Sequence[int]) -> Sequence[str]:
        return [self.domain.actions[a] for a in actions]
