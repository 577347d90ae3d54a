"""A learner and an expert with scripts, which drive one episode of an algorithm by hand."""

from collections.abc import Generator
from typing import Any

from tests.learner.kit import TINY, state

from waypost.trajectory import Trajectory, n_steps
from waypost_learner.algorithms.queries import (
    HierDemo,
    InspectFull,
    InspectLo,
    LabelFull,
    LabelHi,
    LabelLo,
    Query,
)
from waypost_learner.policies.labels import Labels, LoLabels
from waypost_learner.rollout.simulator import Start

NO_SIMULATOR: Any = None
S = Start(state("s"), instance=None, draw=0, simulator=NO_SIMULATOR)


class ScriptedLearner:
    """Rolls out the trajectory it was given."""

    preset = TINY

    def __init__(self, sigma: Trajectory, drawn: int = 0) -> None:
        self.sigma, self.drawn = sigma, drawn
        self.started_from: list[Start] = []

    def roll_out(self, s: Start) -> Trajectory:
        self.started_from.append(s)
        return self.sigma

    def draw_one(self, s: Start, sigma: Trajectory) -> int:
        assert (s, sigma) == (S, self.sigma)
        return self.drawn

    def goes_on(self, s: Start, sigma: Trajectory) -> bool:
        assert s is S
        return not sigma[-1].final

    def first_visits(self, sigma: Trajectory) -> list[int]:
        assert sigma == self.sigma
        return [h for h in range(len(sigma)) if h != self.drawn]


class Expert:
    """Answers from a script and keeps what was asked.

    `lo_passes` says which segments pass, by place; Label_LO corrects each action to 1 and ends with the segment.
    """

    def __init__(
        self,
        sigma: Trajectory,
        passes: bool,
        good_subgoals: list[int],
        lo_passes: list[bool],
        shown: Trajectory | None = None,
    ) -> None:
        self.sigma, self.passes, self.good_subgoals, self.lo_passes = sigma, passes, good_subgoals, lo_passes
        self.shown = sigma if shown is None else shown
        self.asked: list[Query] = []

    def __call__(self, query: Query) -> Any:
        self.asked.append(query)
        match query:
            case InspectFull():
                return self.passes
            case HierDemo():
                return self.shown
            case LabelFull(sigma):
                return (1,) * n_steps(sigma)
            case LabelHi(sigma):
                return tuple(self.good_subgoals[self.sigma.index(one)] for one in sigma)
            case InspectLo(one):
                return self.lo_passes[self.sigma.index(one)]
            case LabelLo(one):
                return LoLabels((1,) * len(one.actions), (*(False for _ in one.actions), True))
        raise AssertionError(query)


def carried_out(episode: Generator[Query, Any, Labels], expert: Expert) -> Labels:
    answer = None
    while True:
        try:
            answer = expert(episode.send(answer))
        except StopIteration as over:
            return over.value
