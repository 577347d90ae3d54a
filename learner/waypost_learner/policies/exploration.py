"""Exploration of a subgoal that random actions do not reach, by places.

Until the first success, an attempt repeats the actions of an earlier one up to a place that was seldom chosen, then
acts at random (Go-Explore, Ecoffet et al. 2021). Places that attempts seldom outlive, such as those of a deadly fall,
are chosen less often. After the first success, some attempts begin with a part of a success, until the policy succeeds
often by itself (Jump-Start RL, Uchendu et al. 2023). The shortest successes are imitated, without their detours.
"""

import json
from collections.abc import Collection, Hashable, Sequence
from dataclasses import dataclass, field

import numpy as np

from waypost.trajectory import Action
from waypost_learner.rollout.lead import NO_LEAD, Lead

Way = tuple[Action, ...]
"""Actions that led from the place where a subgoal was chosen to another place."""


@dataclass(frozen=True)
class ExplorationSpec:
    """How attempts at a subgoal explore."""

    wander: int = 0  # random actions after the way to a place; no exploration if 0
    repeat: float = 0.75  # the probability that a random action repeats the one before
    focus: float = 3.0  # a place that was chosen n times is chosen in proportion to (1 + n) ** -focus
    outlived: int = 25  # steps after which an attempt has outlived a place
    caution: float = 2.0  # a place that a share s of the attempts outlived is chosen in proportion to s ** caution
    guided: float = 0.5  # the share of attempts that begin with a part of a success ...
    until: float = 0.5  # ... while less than this share of the policy's own last attempts succeed
    kept: int = 10  # successes, the shortest ones


@dataclass
class Known:
    """What is known of the subgoal where it is chosen in one place."""

    ways: dict[str, Way] = field(default_factory=dict)  # the shortest way to each place
    chosen: dict[str, int] = field(default_factory=dict)  # how often the place was chosen since it was found
    ended: dict[str, int] = field(default_factory=dict)  # how many attempts did not outlive the place
    outlived: dict[str, int] = field(default_factory=dict)  # how many did
    successes: list[Way] = field(default_factory=list)  # the shortest first


class Exploration:
    """Explores one subgoal.

    Ways begin where the subgoal was chosen, so what is known is kept by that place.

    Args:
        spec: how attempts explore.
        n_actions: the number of actions.
    """

    def __init__(self, spec: ExplorationSpec, n_actions: int) -> None:
        self.spec, self._n_actions = spec, n_actions
        self.known: dict[str, Known] = {}  # by the place where the subgoal was chosen

    def lead(self, origin: Hashable, success: float, rng: np.random.Generator) -> Lead:
        """Return how an attempt begins.

        Args:
            origin: the place where the subgoal was chosen.
            success: the share of the policy's own last attempts that succeeded.
            rng: draws the place and the random actions.
        """
        known = self._at(origin)
        if success >= self.spec.until:
            return NO_LEAD
        if not known.successes:
            return Lead(self._way_to_explore(known, rng) + self._random_actions(rng), whole=True)
        if rng.random() >= self.spec.guided:
            return NO_LEAD
        way = known.successes[rng.integers(len(known.successes))]
        return Lead(way[: rng.integers(len(way))])

    def learn(
        self, actions: Sequence[Action], places: Sequence[Hashable], reached: bool, ended: bool
    ) -> Collection[int]:
        """Learn from an attempt, and return the steps whose actions should be imitated.

        These are the steps of one of the shortest successes with which it left a place for good. What it did before in
        that place may have been a detour or mere waiting, which a policy that imitates it would never end.

        Args:
            actions: the H actions of the attempt.
            places: the H + 1 places before, between and after them.
            reached: whether the attempt reached the subgoal.
            ended: whether the attempt ended the episode.
        """
        known = self._at(places[0])
        last = {str(place): step for step, place in enumerate(places[:-1])}  # the last step in each place
        for place, step in last.items():
            if reached or len(actions) - step >= self.spec.outlived:
                known.outlived[place] = known.outlived.get(place, 0) + 1
            elif ended:
                known.ended[place] = known.ended.get(place, 0) + 1
        for step, place in enumerate(map(str, places[:-1])):
            if place not in known.ways or step < len(known.ways[place]):
                known.ways[place] = tuple(actions[:step])
                known.chosen.setdefault(place, 0)
        if not reached:
            return ()
        known.successes.append(tuple(actions))
        known.successes.sort(key=len)
        del known.successes[self.spec.kept :]
        return frozenset(last.values()) if len(actions) <= len(known.successes[-1]) else ()

    def to_json(self) -> str:
        """Return what is known as JSON, for a checkpoint."""
        return json.dumps({origin: vars(known) for origin, known in self.known.items()})

    def load(self, text: str) -> None:
        """Replace what is known by what `to_json` returned."""
        self.known = {
            origin: Known(
                {place: tuple(way) for place, way in known["ways"].items()},
                known["chosen"],
                known["ended"],
                known["outlived"],
                [tuple(way) for way in known["successes"]],
            )
            for origin, known in json.loads(text).items()
        }

    def _at(self, origin: Hashable) -> Known:
        return self.known.setdefault(str(origin), Known())

    def _way_to_explore(self, known: Known, rng: np.random.Generator) -> Way:
        if not known.ways:
            return ()
        places = list(known.ways)
        chosen, ended, outlived = (
            np.array([counts.get(place, 0) for place in places])
            for counts in (known.chosen, known.ended, known.outlived)
        )
        safe = (1.0 + outlived) / (1.0 + outlived + ended)
        weights = (1.0 + chosen) ** -self.spec.focus * safe**self.spec.caution
        place = places[rng.choice(len(places), p=weights / weights.sum())]
        known.chosen[place] += 1
        return known.ways[place]

    def _random_actions(self, rng: np.random.Generator) -> Way:
        actions = [int(rng.integers(self._n_actions))]
        while len(actions) < self.spec.wander:
            repeats = rng.random() < self.spec.repeat
            actions.append(actions[-1] if repeats else int(rng.integers(self._n_actions)))
        return tuple(actions)
