"""Train a PPO agent of Stable-Baselines3 without a reward function: people say what succeeded and what was right.

    WAYPOST_TOKEN=wp_... python examples/stable_baselines3/train.py --server http://127.0.0.1:8000

The agent must reach the target cell of a corridor. After each rollout the script asks whether the episodes accomplished
the task (Inspect_FULL), and a pass is the reward of PPO. For the failed episodes it asks for the right actions
(Label_FULL), and the policy imitates them between the updates of PPO.
"""

import argparse
import sys
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import gymnasium
import numpy as np
import torch
from stable_baselines3 import PPO
from stable_baselines3.common.callbacks import BaseCallback

import waypost
from waypost_learner.domains.corridor import Corridor, CorridorDomain

DOMAIN = CorridorDomain()
INSTANCES = DOMAIN.instances("random")


@dataclass(frozen=True)
class Episode:
    """A finished training episode."""

    instance: Corridor
    observations: list[Any]  # of all states, for the policy
    segment: waypost.Segment  # the states and actions, for people


class Recorded(gymnasium.Wrapper[Any, Any, Any, Any]):
    """Random training instances without a reward. The last step of an episode has an `Episode` in its info."""

    def __init__(self) -> None:
        super().__init__(DOMAIN.make_env())

    def reset(self, **options: Any) -> tuple[Any, dict[str, Any]]:
        """Start a random training instance."""
        super().reset(**options)
        self.instance = INSTANCES.train[self.np_random.integers(len(INSTANCES.train))]
        observation, info = self.env.reset(options={"instance": self.instance})
        self.observations, self.states, self.pictures, self.actions = list[Any](), list[Any](), list[Any](), list[str]()
        self._record(observation)
        return observation, info

    def step(self, action: Any) -> tuple[Any, float, bool, bool, dict[str, Any]]:
        """Carry out an action. The reward of the environment stays hidden."""
        observation, _, terminated, truncated, info = self.env.step(action)
        self.actions.append(DOMAIN.actions[int(action)])
        self._record(observation)
        if terminated or truncated:
            segment = waypost.Segment(self.states, self.actions, pictures=self.pictures)
            info["episode_seen"] = Episode(self.instance, self.observations, segment)
        return observation, 0.0, terminated, truncated, info

    def _record(self, observation: Any) -> None:
        self.observations.append(observation)
        self.states.append(DOMAIN.state_view(self.env))
        self.pictures.append(DOMAIN.frame(self.env))


class AskPeople(BaseCallback):
    """Asks about the episodes of each rollout. Verdicts become the reward of PPO, and the policy imitates labels."""

    def __init__(self, run: waypost.Run, epochs: int = 20) -> None:
        super().__init__()
        self.run, self.epochs = run, epochs
        self.observations, self.labels = list[Any](), list[int]()  # what people have labeled so far
        self.episodes = 0
        self.budget_left = True

    def _on_rollout_start(self) -> None:
        self.imitate()  # here, because PPO has just made its own update
        self._ended = list[tuple[int, Episode]]()  # the last step of each episode of this rollout

    def _on_step(self) -> bool:
        if self.locals["dones"][0]:
            self._ended.append((self.locals["n_steps"], self.locals["infos"][0]["episode_seen"]))
        return self.budget_left

    def _on_rollout_end(self) -> None:
        try:
            self._ask()
        except waypost.BudgetExhausted:
            self.budget_left = False  # training ends with the next step

    def _ask(self) -> None:
        ended = {number: episode for number, (_, episode) in enumerate(self._ended, start=self.episodes)}
        last_steps = [step for step, _ in self._ended]
        self.episodes += len(ended)
        passed = self._answers(waypost.InspectFull, ended)

        buffer = self.locals["rollout_buffer"]
        buffer.rewards[last_steps, 0] = list(passed.values())
        buffer.compute_returns_and_advantage(last_values=self.locals["values"], dones=self.locals["dones"])

        failed = {number: episode for number, episode in ended.items() if not passed[number]}
        for number, actions in self._answers(waypost.LabelFull, failed).items():
            self.observations += failed[number].observations[:-1]  # the last state has no action
            self.labels += [DOMAIN.actions.index(action) for action in actions]
        for number, verdict in passed.items():
            test = INSTANCES.test[number % len(INSTANCES.test)]
            self.run.report(number, succeeds(self.model, test), train_success=verdict, lo_labels=len(self.labels))

    def _answers(self, kind: Any, episodes: Mapping[int, Episode]) -> dict[int, Any]:
        """Ask one query about each episode, and wait for the answers."""
        queries = [
            kind([one.segment], instance=DOMAIN.instance_view(one.instance), episode=number)
            for number, one in episodes.items()
        ]
        return dict(zip(episodes, self.run.wait(self.run.ask_all(queries)), strict=True))

    def imitate(self) -> None:
        """Raise the probability of the labeled actions (behavioral cloning in the states that the agent reached)."""
        if not self.labels:
            return
        policy = self.model.policy
        optimizer = torch.optim.Adam(policy.parameters(), lr=1e-3)
        observations, labels = torch.as_tensor(np.array(self.observations)), torch.tensor(self.labels)
        for _ in range(self.epochs):
            for rows in torch.randperm(len(labels)).split(64):
                _, log_probability, _ = policy.evaluate_actions(observations[rows], labels[rows])
                optimizer.zero_grad()
                (-log_probability.mean()).backward()
                optimizer.step()


def succeeds(model: PPO, instance: Corridor) -> bool:
    """Return whether the policy reaches the target, without exploration."""
    env = DOMAIN.make_env()
    observation, _ = env.reset(options={"instance": instance})
    ended = False
    while not ended:
        action, _ = model.predict(observation, deterministic=True)
        observation, _, terminated, truncated, _ = env.step(action)
        ended = terminated or truncated
    return DOMAIN.succeeded(env)


def success_rate(model: PPO, instances: Sequence[Corridor]) -> float:
    """Return the share of the instances on which the policy succeeds."""
    return sum(succeeds(model, instance) for instance in instances) / len(instances)


def main() -> None:
    """Train, and print the success on unseen instances before and after, and the cost."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--server", default="http://127.0.0.1:8000")
    parser.add_argument("--rollouts", type=int, default=12, help="how many rollouts of 256 steps")
    parser.add_argument("--budget", type=float, help="the highest total cost, in units")
    parser.add_argument("--seed", type=int, default=0)
    given = parser.parse_args()

    torch.set_num_threads(1)  # more threads only slow such small networks down
    model = PPO("MlpPolicy", Recorded(), n_steps=256, n_epochs=4, gamma=0.9, seed=given.seed, device="cpu")
    before = success_rate(model, INSTANCES.test)
    with waypost.start_run(
        f"PPO of Stable-Baselines3, seed {given.seed}",
        server=given.server,
        algorithm="ppo",
        domain=DOMAIN.name,  # the oracle bot can answer, because this domain has an oracle
        subgoals=DOMAIN.subgoals,
        actions=DOMAIN.actions,
        seed=given.seed,
        config={"rollouts": given.rollouts},
        budget=given.budget,
        resume=True,
    ) as run:
        callback = AskPeople(run)
        model.learn(256 * given.rollouts, callback)
        if not callback.budget_left:
            sys.exit("The budget is exhausted. Start again with a larger --budget, and the run continues.")
        callback.imitate()
        after, costs = success_rate(model, INSTANCES.test), run.costs()
        run.finish({"success_rate": after})
    print(f"Success on unseen instances: {before:.0%} before, {after:.0%} after.")
    spent = ", ".join(f"{sums.units:g} for {kind}" for kind, sums in costs.by_kind.items() if sums.units)
    print(f"Cost: {costs.total:g} units, {spent}.")


if __name__ == "__main__":
    main()
