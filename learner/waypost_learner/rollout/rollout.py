"""Rolling out policies: the repeat-until loop of Algorithm 2 (lines 6-11), and its flat counterpart.

A rollout is a generator: it yields which policy it needs in which state and receives what that policy says. So one
rollout can run alone or many in step, the networks then seeing batches (`run_all`), with the same code.
"""

from collections import Counter
from collections.abc import Callable, Generator, Hashable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from waypost.trajectory import Segment, State, Subgoal, Trajectory
from waypost_learner.rollout.policy_keys import FLAT, META, PolicyKey
from waypost_learner.rollout.simulator import Simulator


@dataclass(frozen=True)
class Outputs:
    """What a policy says of a batch of states."""

    logits: NDArray[np.float32]  # [B, n]
    termination: NDArray[np.float32]  # [B], the probability that beta_g is true; 0 without a termination head


Policies = Mapping[PolicyKey, Callable[[NDArray[np.float32]], Outputs]]
"""What is asked about batches of states: a `Policy` or a `QFunction` each."""


@dataclass(frozen=True)
class Consult:
    """Ask one policy about one state."""

    policy: PolicyKey
    state: State


@dataclass(frozen=True)
class Choosing:
    """How a policy's outputs become choices."""

    temperature: float = 0.1  # of the softmax that choices are drawn from, in training and in test; 0: the best
    termination_threshold: float = 0.9  # beta_g fires above it


def nowhere_twice(_: Any) -> Hashable:
    """Be no place that another state is in: the place of a state in a domain that knows of none."""
    return object()


@dataclass(frozen=True)
class Manner:
    """How one rollout chooses."""

    choosing: Choosing
    rng: np.random.Generator
    h_hi: int  # most subgoals of an episode
    epsilons: Mapping[PolicyKey, float] = field(default_factory=dict)  # policies in it choose epsilon-greedily
    terminations_given: bool = False  # terminal(s; g) is the domain's (Algorithm 3), not beta_g's
    repeat_penalty: float = 0.0  # off the logit of a subgoal, for each time it was chosen in the same place before
    place: Callable[[Any], Hashable] = nowhere_twice  # where a state is, by its JSON view

    def choose(self, policy: PolicyKey, logits: NDArray[np.float32]) -> int:
        """Choose by the outputs of a policy, float32[n]: from their softmax at the temperature, or epsilon-greedily."""
        epsilon = self.epsilons.get(policy)
        if epsilon is None:
            return choose(logits, self.choosing, self.rng)
        if self.rng.random() < epsilon:
            return int(self.rng.integers(len(logits)))
        return int(np.argmax(logits))


Rollout = Generator[Consult, tuple[NDArray[np.float32], float], Trajectory]


def hierarchical_rollout(simulator: Simulator, instance: Any, manner: Manner) -> Rollout:
    """Roll out mu and pi_g until the episode ends or the horizon H_HI is spent; return sigma."""
    sigma: list[Segment] = []
    state = simulator.reset(instance)
    chosen: Counter[tuple[Hashable, Subgoal]] = Counter()
    while not simulator.ended and len(sigma) < manner.h_hi:
        logits, _ = yield Consult(META, state)
        here = manner.place(state.view)
        before = np.array([chosen[here, subgoal] for subgoal in range(len(logits))], np.float32)
        subgoal = manner.choose(META, logits - manner.repeat_penalty * before)
        chosen[here, subgoal] += 1
        segment = yield from execute_subgoal(simulator, state, subgoal, manner)
        sigma.append(segment)
        state = segment.states[-1]
    return tuple(sigma)


def execute_subgoal(
    simulator: Simulator, state: State, subgoal: Subgoal, manner: Manner
) -> Generator[Consult, tuple[NDArray[np.float32], float], Segment]:
    """Execute pi_g until its subgoal has ended, the horizon H_LO is spent or the episode ends; return (s, g, tau).

    beta_g is not asked in the first state: a subgoal's end is where the next one starts, so it would end the segment
    before its first step.
    """
    states, actions, rewards = [state], list[int](), list[float]()
    terminated, outcome = False, None
    while not terminated and not simulator.ended and len(actions) < simulator.domain.horizons.lo:
        logits, termination = yield Consult(subgoal, states[-1])
        if not manner.terminations_given and actions and termination > manner.choosing.termination_threshold:
            terminated = True
            break
        actions.append(manner.choose(subgoal, logits))
        states.append(simulator.step(actions[-1]))
        rewards.append(simulator.reward)
        if manner.terminations_given:
            outcome = simulator.outcome(state, subgoal)
            if outcome is None and len(actions) == simulator.domain.horizons.lo:
                outcome = "failed"  # a subpolicy that goes to and fro must not find that harmless
            terminated = outcome is not None
    return Segment(subgoal, tuple(states), tuple(actions), terminated, tuple(rewards), outcome, simulator.final)


def flat_rollout(simulator: Simulator, instance: Any, manner: Manner) -> Rollout:
    """Roll out a flat policy until the episode ends; return tau_FULL as one segment without a subgoal."""
    states, actions, rewards = [simulator.reset(instance)], list[int](), list[float]()
    while not simulator.ended:
        logits, _ = yield Consult(FLAT, states[-1])
        actions.append(manner.choose(FLAT, logits))
        states.append(simulator.step(actions[-1]))
        rewards.append(simulator.reward)
    return (Segment(None, tuple(states), tuple(actions), False, tuple(rewards), final=simulator.final),)


def choose(logits: NDArray[np.float32], choosing: Choosing, rng: np.random.Generator) -> int:
    """Draw from the softmax of `logits` [n] at the temperature."""
    if choosing.temperature == 0:
        return int(np.argmax(logits))
    scaled = (logits - logits.max()) / choosing.temperature
    # Gumbel's trick: the largest of logits plus Gumbel noise is a draw from their softmax.
    return int(np.argmax(scaled + rng.gumbel(size=len(logits))))


def run_all(
    rollouts: Sequence[Rollout], policies: Policies, stepped: Callable[[PolicyKey], None] = lambda _: None
) -> list[Trajectory]:
    """Run rollouts in step, each network seeing all the states it is asked about as one batch.

    `stepped` is called after each choice with the policy that made it, which may learn then.
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
        for key, policy in policies.items():
            asked = [i for i, consult in waiting.items() if consult.policy == key]
            if not asked:
                continue
            outputs: Outputs = policy(np.stack([waiting[i].state.observation for i in asked]))
            for row, i in enumerate(asked):
                says = (outputs.logits[row], float(outputs.termination[row]))
                advance(i, partial(rollouts[i].send, says))
                stepped(key)
    return [results[i] for i in range(len(rollouts))]


def run(rollout: Rollout, policies: Policies, stepped: Callable[[PolicyKey], None] = lambda _: None) -> Trajectory:
    """Run one rollout."""
    return run_all([rollout], policies, stepped)[0]
