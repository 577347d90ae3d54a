"""Roll out policies: the repeat-until loop of Algorithm 2 (lines 6-11), and the loop of a flat policy.

A rollout is a generator: it yields which policy it needs in which state, and receives that policy's outputs. The same
code therefore runs one rollout alone (`run`) or many in parallel, where each network evaluates batches (`run_all`).
"""

from collections import Counter
from collections.abc import Callable, Generator, Hashable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from waypost.trajectory import Observation, Segment, State, Subgoal, Trajectory
from waypost_learner.rollout.lead import NO_LEAD, Lead
from waypost_learner.rollout.policy_keys import FLAT, META, PolicyKey, pi
from waypost_learner.rollout.simulator import Simulator


@dataclass(frozen=True)
class Outputs:
    """A policy's outputs for a batch of states."""

    logits: NDArray[np.float32]  # [B, n]
    termination: NDArray[np.float32]  # [B], the probability of beta_g; 0 without a termination head


Policies = Mapping[PolicyKey, Callable[[Observation], Outputs]]
"""Each policy as a function of a batch float32 or uint8[B, observation shape], such as a `Policy` or a `QFunction`."""


@dataclass(frozen=True)
class Consult:
    """A rollout's request for the outputs of one policy in one state."""

    policy: PolicyKey
    state: State


@dataclass(frozen=True)
class SelectionSpec:
    """How a policy's outputs become choices, in training and test rollouts."""

    temperature: float = 0.1  # of the softmax from which choices are drawn; 0 takes the highest logit
    termination_threshold: float = 0.9  # beta_g is true above it


@dataclass(frozen=True)
class RolloutSpec:
    """The values of a preset that determine how policies are rolled out."""

    choosing: SelectionSpec
    h_hi: int | None = None  # the most subgoals in an episode; the domain's horizon if None
    h_hi_tests: int | None = None  # instead of h_hi in test episodes; h_hi if None
    h_lo: int | None = None  # the most actions in a segment; the domain's horizon if None
    h_lo_hybrid: int | None = None  # instead of h_lo if a Q-function chooses the actions; h_lo if None
    repeat_penalty: float = 0.0  # subtracted from a subgoal's logit for each earlier choice of it in the same place
    loop_penalty: float = 0.0  # likewise, where the observation was equal; also of the actions of a flat policy


def unique_place(_: Any) -> Hashable:
    """Return a place that no other state shares. Domains that declare no places use it."""
    return object()


def no_lead(_policy: PolicyKey, _state: State) -> Lead:
    """Return no actions, so that the policy chooses from the start."""
    return NO_LEAD


@dataclass(frozen=True)
class Behavior:
    """The behavior policy of one rollout: how it turns outputs into choices, and when it ends subgoals."""

    choosing: SelectionSpec
    rng: np.random.Generator
    h_hi: int  # the most subgoals in an episode
    h_lo: int  # the most actions in a segment
    epsilons: Mapping[PolicyKey, float] = field(default_factory=dict)  # the policies that choose epsilon-greedily
    terminations_given: bool = False  # whether the domain gives terminal(s; g) (Algorithm 3), instead of beta_g
    repeat_penalty: float = 0.0  # subtracted from a subgoal's logit for each earlier choice of it in the same place
    loop_penalty: float = 0.0  # likewise, where the observation was equal; also of the actions of a flat policy
    place: Callable[[Any], Hashable] = unique_place  # maps a state's JSON view to its place
    lead: Callable[[PolicyKey, State], Lead] = no_lead  # how an attempt at a subgoal begins in a state

    def choose(self, policy: PolicyKey, logits: NDArray[np.float32]) -> int:
        """Return a choice given a policy's logits float32[n]: drawn from their softmax, or epsilon-greedy."""
        epsilon = self.epsilons.get(policy)
        if epsilon is None:
            return choose(logits, self.choosing, self.rng)
        if self.rng.random() < epsilon:
            return int(self.rng.integers(len(logits)))
        return int(np.argmax(logits))


class Earlier:
    """The earlier choices of one rollout, by where they were made. Each makes the same choice less likely there."""

    def __init__(self, penalty: float) -> None:
        self._penalty = penalty
        self._counts: Counter[tuple[Hashable, int]] = Counter()

    def add(self, where: Hashable, choice: int) -> None:
        """Count a choice."""
        self._counts[where, choice] += 1

    def lowered(self, where: Hashable, logits: NDArray[np.float32]) -> NDArray[np.float32]:
        """Return the logits float32[n], each less the penalty of its choice."""
        counts = np.array([self._counts[where, choice] for choice in range(len(logits))], np.float32)
        return logits - self._penalty * counts


Rollout = Generator[Consult, tuple[NDArray[np.float32], float], Trajectory]


def hierarchical_rollout(simulator: Simulator, instance: Any, behavior: Behavior) -> Rollout:
    """Roll out mu and pi_g from the start of an instance, until the episode or H_HI ends; return sigma.

    It also ends when an attempt that began with given actions fails: mu would not come there by itself, so the expert
    should not be asked what to do there.
    """
    sigma: list[Segment] = []
    state = simulator.reset(instance)
    in_place, in_observation = Earlier(behavior.repeat_penalty), Earlier(behavior.loop_penalty)
    while not simulator.ended and len(sigma) < behavior.h_hi and not (sigma and _misled(sigma[-1])):
        logits, _ = yield Consult(META, state)
        place, observation = behavior.place(state.view), state.observation.tobytes()
        subgoal = behavior.choose(META, in_observation.lowered(observation, in_place.lowered(place, logits)))
        in_place.add(place, subgoal)
        in_observation.add(observation, subgoal)
        segment = yield from execute_subgoal(simulator, state, subgoal, behavior)
        sigma.append(segment)
        state = segment.states[-1]
    return tuple(sigma)


def _misled(segment: Segment) -> bool:
    return segment.led and segment.outcome == "failed"


def execute_subgoal(
    simulator: Simulator, state: State, subgoal: Subgoal, behavior: Behavior
) -> Generator[Consult, tuple[NDArray[np.float32], float], Segment]:
    """Execute pi_g until the subgoal, H_LO or the episode ends; return the segment (s, g, tau).

    beta_g is not used in the segment's first state, because it could end the segment before its first action.
    """
    key, states, actions, rewards = pi(subgoal), [state], list[int](), list[float]()
    terminated, outcome = False, None
    lead = behavior.lead(key, state)
    most = min(behavior.h_lo, len(lead.actions)) if lead.whole else behavior.h_lo
    while not terminated and not simulator.ended and len(actions) < most:
        if len(actions) < len(lead.actions):
            action = lead.actions[len(actions)]
        else:
            logits, termination = yield Consult(key, states[-1])
            if not behavior.terminations_given and actions and termination > behavior.choosing.termination_threshold:
                terminated = True
                break
            action = behavior.choose(key, logits)
        actions.append(action)
        states.append(simulator.step(action))
        rewards.append(simulator.reward)
        if behavior.terminations_given:
            outcome = simulator.outcome(state, subgoal)
            if outcome is None and len(actions) == most:
                outcome = "failed"  # otherwise a subpolicy could go back and forth without a failure
            terminated = outcome is not None
    return Segment(
        subgoal,
        tuple(states),
        tuple(actions),
        terminated,
        tuple(rewards),
        outcome,
        simulator.final,
        led=bool(lead.actions),
    )


def flat_rollout(simulator: Simulator, instance: Any, behavior: Behavior) -> Rollout:
    """Roll out a flat policy from the start of an instance until the episode ends.

    Return tau_FULL as one segment without a subgoal.
    """
    states, actions, rewards = [simulator.reset(instance)], list[int](), list[float]()
    in_observation = Earlier(behavior.loop_penalty)
    while not simulator.ended:
        logits, _ = yield Consult(FLAT, states[-1])
        observation = states[-1].observation.tobytes()
        actions.append(behavior.choose(FLAT, in_observation.lowered(observation, logits)))
        in_observation.add(observation, actions[-1])
        states.append(simulator.step(actions[-1]))
        rewards.append(simulator.reward)
    return (Segment(None, tuple(states), tuple(actions), False, tuple(rewards), final=simulator.final),)


def choose(logits: NDArray[np.float32], choosing: SelectionSpec, rng: np.random.Generator) -> int:
    """Return a choice drawn from the softmax of `logits` float32[n] at the temperature."""
    if choosing.temperature == 0:
        return int(np.argmax(logits))
    scaled = (logits - logits.max()) / choosing.temperature
    # The Gumbel-max trick: the argmax of logits plus Gumbel noise is a draw from their softmax.
    return int(np.argmax(scaled + rng.gumbel(size=len(logits))))


def run_all(
    rollouts: Sequence[Rollout], policies: Policies, stepped: Callable[[PolicyKey], None] = lambda _: None
) -> list[Trajectory]:
    """Run rollouts in parallel, so that each network evaluates all states that wait for it as one batch.

    Args:
        rollouts: the rollouts to run.
        policies: every policy that they consult.
        stepped: called with a policy's key after each of its choices; it can update a Q-function.

    Returns:
        the trajectories, in the order of `rollouts`.

    Raises:
        KeyError: a rollout consults a policy that is not in `policies`.
    """
    results: dict[int, Trajectory] = {}
    waiting: dict[int, Consult] = {}

    def advance(i: int, resume: Callable[[], Consult]) -> None:
        try:
            waiting[i] = resume()
        except StopIteration as stop:
            results[i] = stop.value
            waiting.pop(i, None)

    for i, rollout in enumerate(rollouts):
        advance(i, partial(next, rollout))
    while waiting:
        unknown = {consult.policy for consult in waiting.values()} - policies.keys()
        if unknown:
            raise KeyError(f"rollouts consult policies that are not given: {unknown}")
        for key, policy in policies.items():
            due = [i for i, consult in waiting.items() if consult.policy == key]
            if not due:
                continue
            outputs: Outputs = policy(np.stack([waiting[i].state.observation for i in due]))
            for row, i in enumerate(due):
                received = (outputs.logits[row], float(outputs.termination[row]))
                advance(i, partial(rollouts[i].send, received))
                stepped(key)
    return [results[i] for i in range(len(rollouts))]


def run(rollout: Rollout, policies: Policies, stepped: Callable[[PolicyKey], None] = lambda _: None) -> Trajectory:
    """Run one rollout and return its trajectory."""
    return run_all([rollout], policies, stepped)[0]
