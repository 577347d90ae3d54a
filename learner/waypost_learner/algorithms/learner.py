"""A learner: its policies, the data buffers they learn from, and rollouts under them."""

import math
import os
import time
from collections.abc import Collection, Hashable, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from functools import partial
from itertools import chain, pairwise
from typing import Any

import numpy as np
import torch
from numpy.typing import NDArray

from waypost.domains import Domain, Placed, Symmetric, Symmetry, symmetries_of
from waypost.trajectory import Observation, Segment, State, Trajectory, n_steps
from waypost_learner.gates import make_gate
from waypost_learner.gates.gate import Doubts
from waypost_learner.gates.views import seen_in
from waypost_learner.policies.datasets import Dataset, Row
from waypost_learner.policies.domain_use import DomainUse
from waypost_learner.policies.dqn import DqnSpec, QFunction
from waypost_learner.policies.exploration import Exploration
from waypost_learner.policies.fields.shared_policy import SharedPolicy
from waypost_learner.policies.imitation import Policy
from waypost_learner.policies.labels import (
    Derives,
    Labels,
    Rows,
    ends_of,
    rows_of,
    transformed_experience,
    transformed_rows,
)
from waypost_learner.policies.levels import HIERARCHY, Levels
from waypost_learner.policies.views import PolicyView, policy_view, shared_view
from waypost_learner.presets.base import Preset
from waypost_learner.rollout import streams
from waypost_learner.rollout.experience import Experience, experience_of
from waypost_learner.rollout.lead import NO_LEAD, Lead
from waypost_learner.rollout.policy_keys import META, PolicyKey, pi
from waypost_learner.rollout.rollout import (
    Behavior,
    Policies,
    Rollout,
    flat_rollout,
    hierarchical_rollout,
    no_lead,
    run,
    run_all,
    unique_place,
)
from waypost_learner.rollout.simulator import HeadStart, Simulator, Start


class Learner:
    """mu and one pi_g with beta_g per subgoal, or one flat policy, with their data buffers.

    Args:
        domain: the domain to act in.
        preset: the learning parameters.
        seed: fixes every random choice.
        levels: which policies there are, and how each level learns.
        threads: CPU threads to train with; one per core if None.
        head_start: returns the actions that are carried out before the learner begins; no actions if None.
    """

    def __init__(
        self,
        domain: Domain,
        preset: Preset,
        seed: int,
        levels: Levels = HIERARCHY,
        threads: int | None = None,
        head_start: HeadStart | None = None,
    ) -> None:
        self.domain, self.preset, self.seed, self.levels = domain, preset, seed, levels
        self._head_start = head_start
        keys = levels.keys(len(domain.subgoals))
        self.shared = self._shared(keys[0])
        self.views = {key: self._view(key, keys[0]) for key in keys}
        owners = [key for key in keys if self.views[key].owner == key]
        self.q = {key: self._q_function(key) for key in owners if levels.is_q_function(key)}
        self.imitators: dict[PolicyKey, Policy | SharedPolicy] = {
            key: self.shared or self._policy(key) for key in owners if key not in self.q
        }
        self.learned: dict[PolicyKey, Policy | SharedPolicy | QFunction] = {**self.imitators, **self.q}
        self._keys = keys
        self.data = {key: Dataset(self.views[key].view.shape) for key in (keys if self.shared else self.imitators)}
        self.gate = make_gate(preset.gate, seed)
        self.explorations = dict(self._explorations(keys))
        self._together: Sequence[Start] = ()  # whose rollouts `roll_out` makes when it is given the first of them
        self._rolled_out: dict[Start, Trajectory] = {}  # their rollouts that were not returned yet
        self.due: list[PolicyKey] = []  # the policies that `train_idle` trains
        self._begun: list[Iterator[None]] = []  # their updates, once it has begun
        # One thread per policy: small networks gain nothing from threads within one operation. What a policy learns
        # depends on its own data and generator alone, so the number of threads changes nothing but the time.
        torch.set_num_threads(1)
        self._threads = ThreadPoolExecutor(threads or os.cpu_count(), initializer=torch.set_num_threads, initargs=(1,))

    @property
    def policies(self) -> Policies:
        """All policies as functions of observations. Take them again after they have learned."""
        if self._begun:  # else what they choose would depend on how soon the expert answered
            self.train_idle()
        if self.shared is not None:
            return self.shared.parts(self._keys)
        return {key: self.views[key].wrap(self._own(key)) for key in self._keys}

    @property
    def use(self) -> DomainUse:
        """What the policies use of the domain's declarations."""
        return self.preset.use if self.shared is None else self.preset.use.without_views

    def _shared(self, owner: PolicyKey) -> SharedPolicy | None:
        """Return the network that all policies share, if the preset has one, all imitate and they see pictures."""
        training, domain = self.preset.training, self.domain
        if training.fields is None or self.levels.reinforced or len(domain.observation_shape) != 3:
            return None
        sizes = len(domain.subgoals), len(domain.actions)
        told = self.preset.use.symmetries and isinstance(domain, Symmetric)
        symmetries = symmetries_of(domain) if told else None
        shape, seed = domain.observation_shape, self._seed(owner)
        return SharedPolicy(shape, *sizes, training.fields, training.train_shared, seed, symmetries)

    def _view(self, key: PolicyKey, owner: PolicyKey) -> PolicyView:
        if self.shared is not None:
            return shared_view(self.domain, owner)
        return policy_view(self.domain, self._use(key), self.preset.training.network, key)

    def _own(self, key: PolicyKey) -> Policy | QFunction:
        learned = self.learned[self.views[key].owner]
        assert not isinstance(learned, SharedPolicy)
        return learned

    def _use(self, key: PolicyKey) -> DomainUse:
        use = self.preset.use
        return replace(use, centered=False) if use.views and self.levels.is_q_function(key) else use

    def _policy(self, key: PolicyKey) -> Policy:
        training, view = self.preset.training, self.views[key]
        hi = training.train_hi_hybrid if self.levels.q_lo else training.train_hi
        train = {"hi": hi, "lo": training.train_lo, "flat": training.train_flat}[key.level]
        terminates = key.subgoal is not None
        assert view.network is not None
        return Policy(view.view.shape, self._n_choices(key), terminates, view.network, train, self._seed(key))

    def _q_function(self, key: PolicyKey) -> QFunction:
        view = self.views[key]
        assert view.network is not None
        return QFunction(view.view.shape, self._n_choices(key), view.network, self._dqn(key), self._seed(key))

    def _dqn(self, key: PolicyKey) -> DqnSpec:
        return self.preset.training.dqn_for(None if key.subgoal is None else self.domain.subgoals[key.subgoal])

    def _explorations(self, keys: Sequence[PolicyKey]) -> Iterator[tuple[PolicyKey, Exploration]]:
        """Yield the exploration of each subgoal that is explored. It needs a domain that declares places."""
        for key in keys if isinstance(self.domain, Placed) else ():
            if key.level == "lo" and self.levels.is_q_function(key) and self._dqn(key).exploration.wander:
                yield key, Exploration(self._dqn(key).exploration, len(self.domain.actions))

    def _n_choices(self, key: PolicyKey) -> int:
        return len(self.domain.subgoals if key == META else self.domain.actions)

    def _seed(self, key: PolicyKey) -> int:
        # The numbers of policies begin at -2, but a seed sequence takes no negative numbers.
        return int(np.random.SeedSequence([self.seed, key.number + 2]).generate_state(1)[0])

    # --- rollouts

    def make_simulator(self, pictures: bool = False) -> Simulator:
        """Return a new simulator, with this learner's head start; `pictures` as in `Simulator`."""
        return Simulator(self.domain, self._head_start, pictures)

    def start(self, instance: Any, draw: int, pictures: bool = False) -> Start:
        """Return the start state s of an instance; `draw` is the number of this instance in the run."""
        simulator = self.make_simulator(pictures)
        return Start(simulator.reset(instance), instance, draw, simulator)

    def roll_out(self, s: Start) -> Trajectory:
        """Roll out the current policies from s.

        Q-functions explore, and are updated after their choices (Algorithm 3, lines 9 to 11).
        """
        if s in self._together:
            starts, self._together = self._together, ()
            rollouts = [self.rollout(one.simulator, one.instance, streams.TRAIN, one.draw) for one in starts]
            self._rolled_out |= zip(starts, run_all(rollouts, self.policies, self._stepped), strict=True)
        if s in self._rolled_out:
            return self._rolled_out.pop(s)
        return run(self.rollout(s.simulator, s.instance, streams.TRAIN, s.draw), self.policies, self._stepped)

    def roll_out_together(self, starts: Sequence[Start]) -> None:
        """Let the rollouts from these start states step together, so that networks evaluate their states in batches.

        The first `roll_out` from one of them makes all the rollouts.
        """
        self._together = starts

    def draw_one(self, s: Start, sigma: Trajectory) -> int:
        """Return the position of a random segment of sigma, a rollout from s. All segments are equally likely."""
        return int(np.random.default_rng([self.seed, streams.SEGMENT, s.draw]).integers(len(sigma)))

    def goes_on(self, s: Start, sigma: Trajectory) -> bool:
        """Return whether an action can follow on sigma, a rollout from s or the first segments of it."""
        is_all = n_steps(sigma) == s.simulator.steps
        return not (sigma[-1].final or (is_all and s.simulator.ended) or n_steps(sigma) >= self.domain.horizons.full)

    def doubts(self, sigma: Trajectory) -> Doubts:
        """Return what the gate doubts in sigma, a rollout of the current policies."""
        return self.gate.doubts(seen_in(sigma, self.policies, self._disagreement))

    def _disagreement(self, key: PolicyKey, observations: Observation) -> NDArray[np.float32]:
        if self.shared is None:
            return np.zeros(len(observations), np.float32)
        return self.shared.disagreement(key, observations)

    def first_visits(self, sigma: Trajectory) -> Sequence[int]:
        """Return the positions of the segments that began in a place where no earlier segment of sigma began.

        In a domain that declares no places, these are all segments.
        """
        first: dict[Hashable, int] = {}
        for h, segment in enumerate(sigma):
            first.setdefault(self._place(segment.start.view), h)
        return list(first.values())

    def _stepped(self, key: PolicyKey) -> None:
        owner = self.views[key].owner
        if owner in self.q:
            self.q[owner].step()

    def rollout(self, simulator: Simulator, instance: Any, stream: int, number: int) -> Rollout:
        """Return a rollout of the current policies, ready to be run.

        Args:
            simulator: the environment to use.
            instance: the instance to start.
            stream: `streams.TRAIN`, where Q-functions explore, or `streams.TEST`.
            number: the rollout's number in its stream. Seed, stream and number fix every random choice.
        """
        exploring = {key: self.q[view.owner] for key, view in self.views.items() if view.owner in self.q}
        rollouts = self.preset.rollouts
        h_hi = rollouts.h_hi_tests if stream == streams.TEST and rollouts.h_hi_tests else rollouts.h_hi
        h_lo = rollouts.h_lo_hybrid if self.levels.q_lo and rollouts.h_lo_hybrid else rollouts.h_lo
        rng = np.random.default_rng([self.seed, stream, number])
        behavior = Behavior(
            rollouts.choosing,
            rng,
            h_hi or self.domain.horizons.hi,
            h_lo or self.domain.horizons.lo,
            {key: q.epsilon if stream == streams.TRAIN else 0.0 for key, q in exploring.items()},
            self.levels.q_lo,
            rollouts.repeat_penalty,
            rollouts.loop_penalty,
            self._place if rollouts.repeat_penalty else unique_place,
            partial(self._lead, rng) if stream == streams.TRAIN else no_lead,
        )
        roll_out = flat_rollout if self.levels.flat else hierarchical_rollout
        return roll_out(simulator, instance, behavior)

    def _lead(self, rng: np.random.Generator, key: PolicyKey, state: State) -> Lead:
        """Return how an attempt at a subgoal begins in training."""
        if key not in self.explorations:
            return NO_LEAD
        return self.explorations[key].lead(self._place(state.view), self.q[self.views[key].owner].success, rng)

    def _place(self, view: Any) -> Hashable:
        return self.domain.place(view) if isinstance(self.domain, Placed) else unique_place(view)

    # --- learning

    def learn(self, labels: Labels) -> None:
        """Append labels to the data buffers, then Train policies (docs/paper.md, deviation 6).

        Train each policy that has new rows or that trains after every episode.
        """
        sizes = {key: len(data) for key, data in self.data.items()}
        use = self.preset.use
        relabeling = self.domain if isinstance(self.domain, Derives) else None
        rows = rows_of(labels, relabeling if use.relabeling else None, self.preset.training.from_passed)
        several = use.symmetries and self.shared is None  # a shared network transforms rows itself
        self._append_rows(rows, symmetries_of(self.domain) if several else ())
        self.gate.learn(labels.judged)
        if self.q:
            self._remember(list(self._experience_of(labels)))
        if self.shared is not None:
            self.shared.see(list(self._transitions_of(labels)), list(ends_of(labels)))
        grown = {self.views[key].owner for key, data in self.data.items() if len(data) > sizes[key]}
        self.due = [key for key, policy in self.imitators.items() if policy.spec.every_episode or key in grown]
        list(self._threads.map(self._train, self.due))

    def train_idle(self, seconds: float = math.inf) -> bool:
        """Train the policies that the last `learn` trained again, each on the `idle` rows of its specification.

        Args:
            seconds: how long to train; the next call goes on. What is learned does not depend on it.

        Returns:
            Whether all of it is done.
        """
        if not self._begun:
            self._begun = [self._idle_updates(key) for key in self.due]
        goes_on = self._threads.map(partial(_advance, until=time.monotonic() + seconds), self._begun)
        self._begun = [updates for updates, more in zip(self._begun, goes_on, strict=True) if more]
        if not self._begun:
            self.due = []
        return not self._begun

    def _train(self, key: PolicyKey) -> None:
        policy = self.imitators[key]
        if isinstance(policy, SharedPolicy):
            policy.train(self.data)
        else:
            policy.train(self.data[key])

    def _idle_updates(self, key: PolicyKey) -> Iterator[None]:
        policy = self.imitators[key]
        if isinstance(policy, SharedPolicy):
            return policy.idle_updates(self.data)
        return policy.idle_updates(self.data[key])

    def _transitions_of(self, labels: Labels) -> Iterator[Row]:
        """Yield the observations before and after each action that changed them, of all trajectories with labels.

        Who acted does not matter here: each action shows where it moves the agent. Where the environment ended a
        rollout, its last action does not show it: the agent may be gone. Demonstrations of a flat policy are treated
        as rollouts, since labels do not tell them apart.
        """
        symmetries = symmetries_of(self.domain) if self.preset.use.symmetries else ()
        for trajectory, _ in (*labels.hi, *labels.flat):
            steps = [
                step for segment in trajectory for step in zip(pairwise(segment.states), segment.actions, strict=True)
            ]
            if trajectory[-1].final and not any(trajectory is one for one in labels.demonstrations):
                del steps[-1]
            for (before, after), action in steps:
                pair = before.observation, after.observation
                if np.array_equal(*pair):
                    continue
                yield Row(np.stack(pair), action)
                for each in symmetries:
                    yield Row(np.stack([each.observe(one) for one in pair]), each.actions[action])

    def _append_rows(self, rows: Rows, symmetries: Sequence[Symmetry]) -> None:
        """Append rows to the buffers, then the same rows transformed by each symmetry.

        A policy that is tied to another policy has no buffer: a symmetry turns its rows into rows of the other policy.
        """
        for each in (None, *symmetries):
            for key, found in (rows if each is None else transformed_rows(rows, each)).items():
                if key in self.data:
                    observe = self.views[key].view.observe
                    self.data[key].append(replace(row, observation=observe(row.observation)) for row in found)

    def _experience_of(self, labels: Labels) -> Iterator[tuple[PolicyKey, Experience]]:
        """Yield what Q-functions learn from: rollouts, and demonstrated segments, which end where they reached."""
        for key, trajectory in labels.experience:
            experience = self._experience(key, trajectory)
            if key in self.explorations:
                (segment,) = trajectory
                experience = replace(experience, demonstrated=self._explored(key, segment))
            yield key, experience
        for segment in chain.from_iterable(labels.demonstrations):
            if segment.subgoal is not None:
                key = pi(segment.subgoal)
                shown = replace(segment, outcome="reached") if segment.terminated else segment
                if key in self.explorations:
                    self._explored(key, shown)
                yield key, replace(self._experience(key, (shown,)), alone=False, demonstrated=range(len(shown.actions)))

    def _explored(self, key: PolicyKey, segment: Segment) -> Collection[int]:
        """Let a subgoal's exploration learn from a segment; return the states whose choices should be imitated."""
        places = [self._place(state.view) for state in segment.states]
        return self.explorations[key].learn(segment.actions, places, segment.outcome == "reached", segment.final)

    def _experience(self, key: PolicyKey, trajectory: Trajectory) -> Experience:
        dqn = self._dqn(key)
        return experience_of(key, trajectory, dqn.pseudo, dqn.returns)

    def _remember(self, experience: Sequence[tuple[PolicyKey, Experience]]) -> None:
        """Append experience to the replay buffers, then the same experience transformed by each symmetry."""
        for key, one in experience:
            if key in self.q:
                self.q[key].attempt(one)
        for each in (None, *(symmetries_of(self.domain) if self.preset.training.dqn.symmetries else ())):
            for given in experience:
                key, one = given if each is None else transformed_experience(*given, each)
                if key in self.q:
                    self.q[key].remember(one.observed(self.views[key].view.observe))


def _advance(updates: Iterator[None], until: float) -> bool:
    """Make updates until the time `until` of `time.monotonic`; return whether there may be more of them."""
    return any(time.monotonic() >= until for _ in updates)
