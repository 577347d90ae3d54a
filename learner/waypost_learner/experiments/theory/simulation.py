"""Simulates T rounds of hg-DAgger or flat DAgger on finite classes, with the code of real runs.

The episodes come from `waypost_learner.algorithms`. Queries become wire messages, the oracle expert answers them, and
`waypost.prices` computes the costs. Only the learner is different: it uses halving instead of networks.
"""

from collections import Counter
from collections.abc import Generator
from dataclasses import dataclass
from itertools import count
from typing import Any, Literal, cast

import numpy as np

from waypost import prices as pricing
from waypost import wire
from waypost.domains import Domain
from waypost.prices import to_units
from waypost.trajectory import Segment, State, Trajectory
from waypost_learner.algorithms.flat_dagger import flat_dagger
from waypost_learner.algorithms.hg_dagger import hg_dagger
from waypost_learner.algorithms.learner import Learner
from waypost_learner.algorithms.queries import Answer, Query
from waypost_learner.experiments.theory.adversary import worst_instance
from waypost_learner.experiments.theory.bounds import Expense, operation_costs, theorem_1, theorem_2
from waypost_learner.experiments.theory.classes import N_ACTIONS, Cell, Classes, draw_classes
from waypost_learner.experiments.theory.halving import Product, Simple, VersionSpace
from waypost_learner.experiments.theory.task import Task, observed
from waypost_learner.experts.oracle import OracleExpert
from waypost_learner.policies.labels import Labels, rows_of
from waypost_learner.remote.translation import Translator
from waypost_learner.rollout.policy_keys import FLAT, META, PolicyKey, pi
from waypost_learner.rollout.simulator import Start

Episodes = Literal["worst", "random"]
"""The source of the episodes: an adversary who knows the learner ("worst"), or chance ("random")."""


@dataclass(frozen=True)
class Result:
    """The cost of one run and its bound."""

    spent: Expense
    bound: Expense
    asked: Counter[str]  # queries by kind
    mistakes: dict[PolicyKey, int]  # by policy


@dataclass(frozen=True, eq=False)
class TaskStart:
    """The start state of an episode. The task has no simulator, as `Start` has."""

    state: State
    instance: Any


class HalvingLearner:
    """A replacement for `Learner` whose policies (mu and all pi_g, or the flat policy) are version spaces."""

    def __init__(self, task: Task, classes: Classes, flat: bool) -> None:
        self._task, self._flat = task, flat
        n_subgoals = len(task.subgoals)
        subpolicies = {pi(g): Simple(classes.pi, N_ACTIONS) for g in range(n_subgoals)}
        self.policies: dict[PolicyKey, VersionSpace] = (
            {FLAT: Product(classes)} if flat else {META: Simple(classes.mu, n_subgoals), **subpolicies}
        )

    def start(self, instance: Any) -> "TaskStart":
        """Return the start state s of an instance."""
        return TaskStart(observed(self._task.first_state(instance)), instance)

    def roll_out(self, s: "TaskStart") -> Trajectory:
        """Return the trajectory of the current policies from s."""
        horizons, sigma, state = self._task.horizons, list[Segment](), s.state
        if self._flat:
            return (self._execute(None, s.instance, state, horizons.full),)
        for _ in range(horizons.hi):
            sigma.append(self._execute(self.policies[META].choose(state.observation), s.instance, state, horizons.lo))
            state = sigma[-1].states[-1]
        return tuple(sigma)

    def _execute(self, subgoal: int | None, instance: Any, state: State, n_steps: int) -> Segment:
        policy = self.policies[FLAT if subgoal is None else pi(subgoal)]
        states, actions = [state], list[int]()
        for _ in range(n_steps):
            actions.append(policy.choose(states[-1].observation))
            states.append(observed(self._task.successor(instance, states[-1].view, actions[-1])))
        return Segment(subgoal, tuple(states), tuple(actions), terminated=False)

    def learn(self, labels: Labels) -> None:
        """Remove the policies that contradict the labels."""
        for key, rows in rows_of(labels).items():
            self.policies[key].learn(rows)


class PricedExpert:
    """The task's oracle, which also records the costs of its answers."""

    def __init__(self, task: Task, prices: wire.Prices) -> None:
        # The task has no environment, but everything else that queries and answers need from a domain.
        self._domain, self._prices = cast(Domain, task), prices
        self._expert = OracleExpert(self._domain)
        self.spent, self.asked = Counter[str](), Counter[str]()  # micro-units and queries, by kind

    def carry_out(self, episode: Generator[Query, Any, Labels], instance: Any, number: int) -> Labels:
        """Answer all queries of an episode and return its labels; `number` is the episode's number."""
        translator = Translator(self._domain, instance)
        answer: Answer | None = None
        try:
            for ordinal in count():
                ask = translator.ask(episode.send(answer), number, ordinal)
                said = self._expert(ask)
                self.asked[ask.kind] += 1
                self.spent[ask.kind] += pricing.cost(said, self._prices).units
                answer = translator.answer(said)
        except StopIteration as over:
            labels: Labels = over.value
        return labels


def simulate(cell: Cell, seed: int, rounds: int, flat: bool, episodes: Episodes) -> Result:
    """Simulate one learner for `rounds` episodes, and return its cost and its bound.

    Task, expert and random episodes depend only on the cell and the seed, so they are the same for both learners.
    """
    rng = np.random.default_rng([seed, cell.h_hi, cell.h_lo, cell.n_mu, cell.n_pi, cell.n_subgoals])
    classes = draw_classes(cell, rng)
    task, prices = Task(cell, classes, rng), wire.Prices()  # the paper's prices
    learner, expert = HalvingLearner(task, classes, flat), PricedExpert(task, prices)
    for t in range(rounds):
        hard = worst_instance(task, classes, learner.policies) if episodes == "worst" else None
        instance = hard or task.draw_instance(rng)
        s, stand_in = cast(Start, learner.start(instance)), cast(Learner, learner)
        episode = flat_dagger(s, stand_in) if flat else hg_dagger(s, stand_in)
        learner.learn(expert.carry_out(episode, instance, t))
    costs = operation_costs(cell, prices)
    monitoring = to_units(expert.spent["inspect_full"])
    return Result(
        spent=Expense(monitoring, to_units(expert.spent.total()) - monitoring),
        bound=theorem_2(cell, rounds, costs) if flat else theorem_1(cell, classes.n_used, rounds, costs),
        asked=expert.asked,
        mistakes={key: policy.mistakes for key, policy in learner.policies.items()},
    )
