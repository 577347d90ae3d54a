"""Turn the segments of a rollout into transitions, from which Q-functions learn."""

from collections.abc import Callable
from dataclasses import dataclass, replace

from waypost.trajectory import Observation, Segment, Trajectory


@dataclass(frozen=True)
class Transition:
    """(s, choice, r, s~): the choice is an action, or a subgoal with all steps that carried it out."""

    observation: Observation
    choice: int
    reward: float  # the sum over its steps, discounted to the first step
    next_observation: Observation
    steps: int  # the number of steps of the choice; 0 if s~ is terminal

    def observed(self, observe: Callable[[Observation], Observation]) -> "Transition":
        """Return the same transition with both observations mapped by `observe`."""
        return replace(self, observation=observe(self.observation), next_observation=observe(self.next_observation))


@dataclass(frozen=True)
class PseudoReward:
    """pseudo(s; g) of Algorithm 3 (line 10): the rewards for carrying out a subgoal."""

    reached: float = 1.0
    failed: float = -0.5
    step: float = -0.02  # -kappa


def of_subgoal(segment: Segment, pseudo: PseudoReward) -> list[Transition]:
    """Return the transitions (s, a, r~, s~) of a segment, for Q_g. The end of the subgoal or episode is terminal."""
    transitions = []
    for step, action in enumerate(segment.actions):
        last = step == len(segment.actions) - 1
        ends = last and (segment.outcome is not None or segment.final)
        reward = getattr(pseudo, segment.outcome) if last and segment.outcome else pseudo.step
        transitions.append(_transition(segment, step, action, reward, ends))
    return transitions


def of_actions(segment: Segment) -> list[Transition]:
    """Return the transitions (s, a, r, s') of a flat trajectory, for a flat Q-function."""
    last = len(segment.actions) - 1
    return [
        _transition(segment, step, action, reward, segment.final and step == last)
        for step, (action, reward) in enumerate(zip(segment.actions, segment.rewards, strict=True))
    ]


def of_subgoals(sigma: Trajectory, discount: float) -> list[Transition]:
    """Return the transitions (s_h, g_h, R_h, s_{h+1}) of sigma, for a meta-controller's Q (Kulkarni et al. 2016)."""
    return [
        Transition(
            segment.start.observation,
            segment.subgoal,
            sum(discount**step * reward for step, reward in enumerate(segment.rewards)),
            segment.states[-1].observation,
            0 if segment.final else len(segment.actions),
        )
        for segment in sigma
        if segment.subgoal is not None
    ]


def _transition(segment: Segment, step: int, action: int, reward: float, ends: bool) -> Transition:
    before, after = segment.states[step].observation, segment.states[step + 1].observation
    return Transition(before, action, reward, after, 0 if ends else 1)
