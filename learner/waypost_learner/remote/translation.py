"""Translate queries to wire messages, and wire messages to answers.

The learner uses numbers and states; wire messages use names and JSON views.
"""

from collections.abc import Mapping, Sequence
from typing import Any

from waypost import wire
from waypost.domains import ActionLandmarked, Box, Domain, Landmarked, renderer_of, replay_of
from waypost.trajectory import Segment, State, Trajectory, n_steps
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
from waypost_learner.policies.labels import LoLabels
from waypost_learner.remote.camera import Camera
from waypost_learner.rollout.demonstrations import judged
from waypost_learner.rollout.simulator import Simulator


def vocabulary(domain: Domain) -> wire.Vocabulary:
    """Return the names of a domain, as a run declares them to the server."""
    return wire.Vocabulary(
        domain=domain.name, subgoals=list(domain.subgoals), actions=list(domain.actions), renderer=renderer_of(domain)
    )


class Translator:
    """Translates the queries and answers of one episode.

    Args:
        domain: the domain; its names and views are used.
        instance: the instance of the episode.
        camera: takes the pictures in queries; if None, queries have no pictures.
    """

    def __init__(self, domain: Domain, instance: Any, camera: Camera | None = None) -> None:
        self.domain, self.instance, self.camera = domain, instance, camera
        self.before: Trajectory = ()  # the segments before the demonstration that was asked for last
        # The actions and states of a demonstration that was played here; another thread sets both at once.
        self.played: tuple[tuple[int, ...], tuple[State, ...]] = ((), ())

    def ask(self, query: Query, episode: int, ordinal: int) -> wire.Ask:
        """Return a query in its wire form. `episode` and `ordinal` identify it in its run."""
        common: dict[str, Any] = {
            "episode": episode,
            "ordinal": ordinal,
            "instance": self.domain.instance_view(self.instance),
        }
        match query:
            case HierDemo():
                return self._ask_for_demonstration(query, common)
            case InspectFull(sigma):
                return wire.AskInspectFull(
                    kind="inspect_full",
                    question="Did it do the whole task?",
                    segments=self._segments(sigma),
                    **common,
                )
            case LabelHi(sigma, before):
                return wire.AskLabelHi(
                    kind="label_hi",
                    question=f"Which subgoal should it have chosen for {'each' if len(sigma) > 1 else 'this'} segment?",
                    **self._with_context(before, sigma),
                    suggestion=wire.LabelHiAnswer(kind="label_hi", subgoals=[self._subgoal(s) for s in sigma]),
                    **common,
                )
            case InspectLo(segment, before):
                return wire.AskInspectLo(
                    kind="inspect_lo",
                    question=f"It tried “{self._words(segment)}”. Did that work?",
                    **self._with_context(before, (segment,)),
                    **common,
                )
            case LabelLo(segment, before):
                return wire.AskLabelLo(
                    kind="label_lo",
                    question=f"It tried “{self._words(segment)}”. What should it have done at each step?",
                    **self._with_context(before, (segment,)),
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
                    question="What should it have done at each step?",
                    segments=self._segments(sigma),
                    suggestion=wire.LabelFullAnswer(
                        kind="label_full", actions=[a for s in sigma for a in self._actions(s.actions)]
                    ),
                    **common,
                )

    def _ask_for_demonstration(self, query: HierDemo, common: Mapping[str, Any]) -> wire.AskHierDemo:
        self.before, self.played = query.before, ((), ())
        horizons = self.domain.horizons
        left, question = horizons.full - n_steps(query.before), "Do the whole task yourself"
        if query.max_segments is not None:
            left = min(left, query.max_segments * horizons.lo)
        if query.before:
            Simulator(self.domain).go_to_end(self.instance, query.before)  # nobody should answer in vain
            question = f"It failed at “{self._words(query.before[-1])}”. Play on from here"
        one, several = "until a subgoal is reached", "one subgoal after the other"
        how = "" if query.flat else f", {one if query.max_segments == 1 else several}"
        return wire.AskHierDemo(
            kind="hier_demo",
            question=f"{question}{how}.",
            state=query.state.view,
            flat=query.flat,
            max_segments=query.max_segments or horizons.hi,
            max_actions=left,
            context=self._segments(query.before) if query.before else [],
            **common,
        )

    def answer(self, answer: wire.Answer) -> Answer:
        """Return an answer in the type that the query's docstring in `algorithms/queries.py` names."""
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

    def landmarks(self, states: Sequence[State]) -> dict[str, wire.Landmarks]:
        """Return the fields `landmarks` and `action_landmarks` of a message with pictures of states.

        They have an entry per state, or one if all are the same; none if the domain does not know the places.
        """
        if not states:
            return {}
        domain, instance = self.domain, self.domain.instance_view(self.instance)
        fields: dict[str, wire.Landmarks] = {}
        if isinstance(domain, Landmarked):
            found = [domain.landmarks(instance, state.view) for state in states]
            fields["landmarks"] = _named(found, domain.subgoals)
        if isinstance(domain, ActionLandmarked):
            found = [domain.action_landmarks(instance, state.view) for state in states]
            fields["action_landmarks"] = _named(found, domain.actions)
        return fields

    def _replay(self, segments: Sequence[wire.DemoSegment]) -> Trajectory:
        """Return a demonstration with the observations along it, from the start that was asked for last.

        Actions after the end of the episode are ignored.
        """
        states = self._states([self.domain.actions.index(action) for one in segments for action in one.actions])
        sigma, first = list[Segment](), 0
        for segment in segments:
            actions = [self.domain.actions.index(action) for action in segment.actions][: len(states) - 1 - first]
            if actions:
                subgoal = None if segment.subgoal is None else self.domain.subgoals.index(segment.subgoal)
                along = tuple(states[first : first + len(actions) + 1])
                sigma.append(Segment(subgoal, along, tuple(actions), terminated=subgoal is not None))
            first += len(actions)
        return judged(self.domain, self.instance, tuple(sigma))

    def _states(self, actions: Sequence[int]) -> Sequence[State]:
        """Return the states along actions from the start of the demonstration, until the episode ends.

        They are carried out here. If the environment may be random and somebody played these actions, the states are
        those that were seen then.
        """
        played, seen = self.played
        if seen and replay_of(self.domain) != "actions" and tuple(actions[: len(played)]) == played[: len(actions)]:
            return seen[: len(actions) + 1]
        simulator = Simulator(self.domain)
        states = [simulator.go_to_end(self.instance, self.before)]
        for action in actions:
            if simulator.ended:
                break
            states.append(simulator.step(action))
        return states

    def _with_context(self, before: Trajectory, asked: Trajectory) -> dict[str, Any]:
        """Return the fields `segments` and `context` of a query: the segments that it asks about, and earlier ones."""
        segments = self._segments([*before, *asked])
        return {"segments": segments[len(before) :], "context": segments[: len(before)]}

    def _segments(self, segments: Sequence[Segment]) -> list[wire.Segment]:
        """Return the wire form of an episode's segments, from its start."""
        frames = self.camera.frames(segments) if self.camera else [[] for _ in segments]
        return [
            wire.Segment(
                subgoal=None if s.subgoal is None else self._subgoal(s),
                states=[state.view for state in s.states],
                actions=list(self._actions(s.actions)),
                frames=pictures,
                **self.landmarks(s.states if pictures else ()),
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


def _named(found: Sequence[Mapping[int, Box]], names: Sequence[str]) -> wire.Landmarks:
    boxes = [{names[choice]: _box(box) for choice, box in one.items()} for one in found]
    return boxes[:1] if all(one == boxes[0] for one in boxes) else boxes


def _box(box: Box) -> wire.Box:
    left, top, right, bottom = box
    return wire.Box(left=left, top=top, right=right, bottom=bottom)
