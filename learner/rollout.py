"""Rolling out policies: the repeat-until loop of Algorithm 2 (lines 6-11), and its flat counterpart.

A rollout is a generator: it yields which policy it needs in which state and receives what that policy says. So one
rollout can run alone or many in step, the networks then seeing batches (`run_all`), with the same code.
"""

from collections.abc import Callable, Generator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from learner.policies import Outputs, Policy
from learner.simulator import Simulator
from learner.types import FLAT, META, PolicyKey, Segment, State, Trajectory

Policies = Mapping[PolicyKey, Policy]


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


Rollout = Generator[Consult, tuple[NDArray[np.float32], float], Trajectory]


def hierarchical_rollout(simulator: Simulator, instance: Any, choosing: Choosing, rng: np.random.Generator) -> Rollout:
    """Roll out mu and pi_g until the episode ends; return sigma."""
    sigma: list[Segment] = []
    state = simulator.reset(instance)
    while not simulator.ended:
        logits, _ = yield Consult(META, state)
        subgoal = choose(logits, choosing, rng)
        segment = yield from execute_subgoal(simulator, state, subgoal, choosing, rng)
        sigma.append(segment)
        state = segment.states[-1]
    return tuple(sigma)


def execute_subgoal(
    simulator: Simulator, state: State, subgoal: int, choosing: Choosing, rng: np.random.Generator
) -> Generator[Consult, tuple[NDArray[np.float32], float], Segment]:
    """Execute pi_g until beta_g fires, the horizon H_LO is spent or the episode ends; return (s, g, tau).

    beta_g is not asked in the first state: a subgoal's end is where the next one starts, so it would end the segment
    before its first step.
    """
    states, actions, terminated = [state], list[int](), False
    while not simulator.ended and len(actions) < simulator.domain.horizons.lo:
        logits, termination = yield Consult(subgoal, states[-1])
        if actions and termination > choosing.termination_threshold:
            terminated = True
            break
        actions.append(choose(logits, choosing, rng))
        states.append(simulator.step(actions[-1]))
    return Segment(subgoal, tuple(states), tuple(actions), terminated)


def flat_rollout(simulator: Simulator, instance: Any, choosing: Choosing, rng: np.random.Generator) -> Rollout:
    """Roll out a flat policy until the episode ends; return tau_FULL as one segment without a subgoal."""
    states, actions = [simulator.reset(instance)], list[int]()
    while not simulator.ended:
        logits, _ = yield Consult(FLAT, states[-1])
        actions.append(choose(logits, choosing, rng))
        states.append(simulator.step(actions[-1]))
    return (Segment(None, tuple(states), tuple(actions), False),)


def choose(logits: NDArray[np.float32], choosing: Choosing, rng: np.random.Generator) -> int:
    """Draw from the softmax of `logits` [n] at the temperature."""
    if choosing.temperature == 0:
        return int(np.argmax(logits))
    scaled = (logits - logits.max()) / choosing.temperature
    # Gumbel's trick: the largest of logits plus Gumbel noise is a draw from their softmax.
    return int(np.argmax(scaled + rng.gumbel(size=len(logits))))


def run_all(rollouts: Sequence[Rollout], policies: Policies) -> list[Trajectory]:
    """Run rollouts in step, each network seeing all the states it is asked about as one batch."""
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
    return [results[i] for i in range(len(rollouts))]


def run(rollout: Rollout, policies: Policies) -> Trajectory:
    """Run one rollout."""
    return run_all([rollout], policies)[0]
