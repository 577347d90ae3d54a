"""Collect the labels and the experience of one episode, and turn them into rows and transitions for the data buffers.

An algorithm appends to `Labels` in the order of the paper's lines. `rows_of` turns labels into rows by policy;
`transformed_rows` and `transformed_experience` apply a symmetry of the domain.
"""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Literal

import numpy as np

from waypost.domains import FlatRelabeling, Relabeling, Retracing, Symmetry
from waypost.trajectory import Action, Segment, Subgoal, Trajectory
from waypost_learner.policies.datasets import UNLABELED, Row
from waypost_learner.rollout.experience import Experience
from waypost_learner.rollout.policy_keys import FLAT, META, PolicyKey, pi

Rows = dict[PolicyKey, list[Row]]


@dataclass(frozen=True)
class LoLabels:
    """a*_1 .. a*_H (None where the segment should have ended) and omega*_1 .. omega*_{H+1}."""

    actions: tuple[Action | None, ...]
    terminations: tuple[bool, ...]


@dataclass
class Labels:
    """The results of one episode: the expert's labels and demonstrations, and the learner's own experience."""

    hi: list[tuple[Trajectory, tuple[Subgoal, ...]]] = field(default_factory=list)
    lo: list[tuple[Segment, LoLabels, bool]] = field(default_factory=list)  # whether the subgoal was right
    demonstrations: list[Trajectory] = field(default_factory=list)  # their labels are in `hi` and `lo` too
    flat: list[tuple[Trajectory, tuple[Action, ...]]] = field(default_factory=list)
    experience: list[tuple[PolicyKey, Trajectory]] = field(default_factory=list)
    # Of rollouts: the learner's own segments that the expert passed, and whether their subgoals were right.
    passed: list[tuple[Segment, bool]] = field(default_factory=list)
    judged: dict[Literal["hi", "lo"], list[Row]] = field(default_factory=dict)  # what a gate learns from a rollout

    def append_hi(self, trajectory: Trajectory, good_subgoals: Sequence[Subgoal]) -> None:
        """D_HI <- D_HI + {(s_h, g*_h)}."""
        self.hi.append((trajectory, tuple(good_subgoals)))

    def append_lo(self, segment: Segment, labels: LoLabels, right_subgoal: bool = True) -> None:
        """D_g <- D_g + {(s, a*, omega*)}, up to the state where the segment should have ended.

        Algorithm 2 asks only where the expert found the subgoal right. Other algorithms must say whether it was.
        """
        self.lo.append((segment, labels, right_subgoal))

    def append_demonstration(self, demonstration: Trajectory) -> None:
        """Lines 5-7 of Algorithm 1: the expert's own subgoals, actions and terminations are the labels."""
        self.demonstrations.append(demonstration)
        for segment in demonstration:
            self.append_lo(segment, _demonstrated(segment))
        self.append_hi(demonstration, [s.subgoal for s in demonstration if s.subgoal is not None])

    def append_flat(self, trajectory: Trajectory, good_actions: Sequence[Action]) -> None:
        """D <- D + {(s, a*)} over the full trajectory."""
        self.flat.append((trajectory, tuple(good_actions)))

    def append_passed(self, *segments: Segment, right_subgoal: bool = True) -> None:
        """Note that the expert passed segments of a rollout: what the learner did in them was right.

        A subgoal's segment that the horizon cut off is left out: nobody said whether it should have ended there.
        """
        finished = [one for one in segments if one.subgoal is None or one.terminated or one.final]
        self.passed.extend((one, right_subgoal) for one in finished)

    def append_experience(self, key: PolicyKey, trajectory: Trajectory) -> None:
        """D_g <- D_g + tau_h (Algorithm 3, lines 20 and 22), or the same for another Q-function."""
        self.experience.append((key, trajectory))


Derives = Relabeling | Retracing | FlatRelabeling
"""A domain that derives labels for other tasks from given ones."""


def ends_of(labels: Labels) -> Iterator[Row]:
    """Yield the observations where a subgoal was chosen and where it ended, as labels say, and the subgoal."""
    for segment, lo, _ in labels.lo:
        if segment.subgoal is not None and True in lo.terminations:
            ended = segment.states[lo.terminations.index(True)]
            yield Row(np.stack([segment.start.observation, ended.observation]), segment.subgoal)


def rows_of(labels: Labels, relabeling: Derives | None = None, from_passed: bool = False) -> Rows:
    """Return the rows that labels add to each policy's buffer, in the order in which the labels were appended.

    Args:
        labels: the labels of one episode.
        relabeling: the domain that derives labels for other tasks from these (docs/lean.md); no relabeling if None.
        from_passed: whether subpolicies and flat policies imitate what they did themselves where the expert passed it.
    """
    rows: Rows = {}
    for sigma, good in labels.hi:
        rows.setdefault(META, []).extend(
            Row(segment.start.observation, g) for segment, g in zip(sigma, good, strict=True)
        )
    for segment, lo, right in labels.lo:
        _extend(rows, segment, lo, right)
    for tau, actions in labels.flat:
        rows.setdefault(FLAT, []).extend(_flat_rows(tau, actions))
    for segment, right in labels.passed if from_passed else ():
        if segment.subgoal is None:
            rows.setdefault(FLAT, []).extend(_flat_rows((segment,), segment.actions))
        else:
            _extend(rows, segment, _demonstrated(segment), right)
    if isinstance(relabeling, Relabeling):
        for sigma, good in labels.hi:
            rows[META] += [Row(observation, g) for observation, g in relabeling.relabeled(sigma, good)]
    if isinstance(relabeling, FlatRelabeling):
        for tau, actions in labels.flat:
            rows[FLAT] += [Row(observation, a) for observation, a in relabeling.relabeled_actions(tau, actions)]
    if isinstance(relabeling, Retracing):
        for demonstration in labels.demonstrations:
            for segment in relabeling.retraced(demonstration):
                _extend(rows, segment, _demonstrated(segment))
    return rows


def transformed_rows(rows: Mapping[PolicyKey, Sequence[Row]], symmetry: Symmetry) -> Rows:
    """Return the rows with observations, choices and policies transformed by a symmetry of the domain."""

    def transformed(key: PolicyKey, row: Row) -> Row:
        choice = UNLABELED if row.choice == UNLABELED else _choices(symmetry, key)[row.choice]
        return replace(row, observation=symmetry.observe(row.observation), choice=choice)

    return {_key(symmetry, key): [transformed(key, row) for row in found] for key, found in rows.items()}


def transformed_experience(key: PolicyKey, experience: Experience, symmetry: Symmetry) -> tuple[PolicyKey, Experience]:
    """Return experience and its policy, transformed by a symmetry of the domain."""
    return _key(symmetry, key), experience.observed(symmetry.observe).chosen(_choices(symmetry, key))


def _extend(rows: Rows, segment: Segment, labels: LoLabels, right: bool = True) -> None:
    """Add the rows of one labeled segment to the rows of its subgoal's policy."""
    assert segment.subgoal is not None
    into = rows.setdefault(pi(segment.subgoal), [])
    steps = zip(segment.states, (*labels.actions, None), labels.terminations, strict=True)
    for step, (state, action, ends) in enumerate(steps):
        choice = UNLABELED if ends or action is None else action
        termination = UNLABELED if step == 0 else int(ends)
        if choice != UNLABELED or termination != UNLABELED:
            into.append(Row(state.observation, choice, termination, right))
        if ends:
            break


def _flat_rows(trajectory: Trajectory, good_actions: Sequence[Action]) -> Iterable[Row]:
    """Return one row for each different pair of observation and action. Learners that go in circles repeat pairs."""
    states = [state for segment in trajectory for state in segment.states[:-1]]
    pairs = zip((state.observation for state in states), good_actions, strict=True)
    return {(observation.tobytes(), action): Row(observation, action) for observation, action in pairs}.values()


def _demonstrated(segment: Segment) -> LoLabels:
    """Return the labels of a segment that an expert carried out or passed: its actions, and where it ended."""
    return LoLabels(segment.actions, (*(False for _ in segment.actions), segment.terminated or segment.final))


def _key(symmetry: Symmetry, key: PolicyKey) -> PolicyKey:
    return key if key.subgoal is None else pi(symmetry.subgoals[key.subgoal])


def _choices(symmetry: Symmetry, key: PolicyKey) -> tuple[int, ...]:
    """Return, for each choice of a policy, the transformed choice."""
    return symmetry.subgoals if key == META else symmetry.actions
