"""Turn the segments of a rollout into experience, from which Q-functions learn."""

from collections.abc import Callable, Collection, Sequence
from dataclasses import dataclass, replace
from typing import Literal

from waypost.trajectory import Observation, Outcome, Segment, Trajectory
from waypost_learner.rollout.policy_keys import PolicyKey


@dataclass(frozen=True)
class Transition:
    """(s, choice, r, s~): the choice is an action, or a subgoal with all steps that carried it out.

    States are numbers: their places among the observations of an `Experience`.
    """

    state: int
    choice: int
    reward: float  # the sum over its steps, discounted to the first step
    next_state: int
    steps: int  # by how many the value of s~ is discounted: those from s to s~; 0 if s~ is terminal


@dataclass(frozen=True)
class Experience:
    """The observations along a trajectory, and the transitions between them."""

    observations: tuple[Observation, ...]
    transitions: tuple[Transition, ...]
    outcome: Outcome | None = None  # of the subgoal; None if it was cut off, or for other experience
    alone: bool = True  # whether only the policy chose, so that it is an attempt of its own
    demonstrated: Collection[int] = ()  # the states whose choices should be imitated

    def observed(self, observe: Callable[[Observation], Observation]) -> "Experience":
        """Return the same experience with each observation mapped by `observe`."""
        return replace(self, observations=tuple(observe(one) for one in self.observations))

    def chosen(self, choices: Sequence[int]) -> "Experience":
        """Return the same experience with each choice replaced by `choices[choice]`."""
        return replace(self, transitions=tuple(replace(one, choice=choices[one.choice]) for one in self.transitions))


@dataclass(frozen=True)
class PseudoReward:
    """pseudo(s; g) of Algorithm 3 (line 10): the rewards for carrying out a subgoal."""

    reached: float = 1.0
    failed: float = -0.5
    step: float = -0.02  # -kappa


@dataclass(frozen=True)
class Returns:
    """How rewards are summed up: over `ahead` steps, before the value of the state after them (n-step returns)."""

    discount: float  # gamma
    ahead: int = 1
    # Whose end is terminal in a subgoal's experience. With "episode", as in the authors' code for Montezuma's Revenge,
    # a reached subgoal is rewarded but goes on in the state after it, and one that runs out of time has not failed.
    terminal: Literal["subgoal", "episode"] = "subgoal"
    # What a meta-controller discounts: each step, or each choice of a subgoal, as Kulkarni et al. (2016) do.
    per: Literal["step", "choice"] = "step"


def experience_of(key: PolicyKey, trajectory: Trajectory, pseudo: PseudoReward, returns: Returns) -> Experience:
    """Return what a Q-function learns from a trajectory: of one segment, unless it is a meta-controller's."""
    if key.level == "hi":
        return of_subgoals(trajectory, returns)
    (segment,) = trajectory
    return of_subgoal(segment, pseudo, returns) if key.level == "lo" else of_actions(segment, returns)


def of_subgoal(segment: Segment, pseudo: PseudoReward, returns: Returns) -> Experience:
    """Return the transitions (s, a, r~, s~) of a segment, for Q_g; `returns.terminal` says which ends are terminal."""
    rewards = [pseudo.step] * len(segment.actions)
    ends = segment.final or (segment.outcome is not None and returns.terminal == "subgoal")
    if segment.outcome == "reached" or (segment.outcome == "failed" and ends):
        rewards[-1] = getattr(pseudo, segment.outcome)
    experience = _experience(segment, rewards, ends, returns)
    return replace(experience, outcome=segment.outcome, alone=not segment.led)


def of_actions(segment: Segment, returns: Returns) -> Experience:
    """Return the transitions (s, a, r, s') of a flat trajectory, for a flat Q-function."""
    return _experience(segment, segment.rewards, segment.final, returns)


def of_subgoals(sigma: Trajectory, returns: Returns) -> Experience:
    """Return the transitions (s_h, g_h, R_h, s_{h+1}) of sigma, for a meta-controller's Q (Kulkarni et al. 2016)."""
    per_step = returns.per == "step"
    within = returns.discount if per_step else 1.0  # the discount between the steps of one choice
    transitions = tuple(
        Transition(
            h,
            segment.subgoal,
            sum(within**step * reward for step, reward in enumerate(segment.rewards)),
            h + 1,
            0 if segment.final else len(segment.actions) if per_step else 1,
        )
        for h, segment in enumerate(sigma)
        if segment.subgoal is not None
    )
    states = [*(segment.start for segment in sigma), *(segment.states[-1] for segment in sigma[-1:])]
    return Experience(tuple(state.observation for state in states), transitions)


def _experience(segment: Segment, rewards: Sequence[float], ends: bool, returns: Returns) -> Experience:
    """Return a segment's experience. `ends` says whether its last state is terminal."""
    length, transitions = len(segment.actions), list[Transition]()
    for first, action in enumerate(segment.actions):
        last = min(first + returns.ahead, length)
        reward = sum(returns.discount**step * one for step, one in enumerate(rewards[first:last]))
        steps = 0 if ends and last == length else last - first
        transitions.append(Transition(first, action, reward, last, steps))
    return Experience(tuple(state.observation for state in segment.states), tuple(transitions))
