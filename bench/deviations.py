"""Measures the effect of some deviations in docs/paper.md: `python bench/deviations.py [--store FILE]`.

Without a store, the script trains policies from scratch on the same demonstrations. They differ in one value, and are
compared with the expert on unseen corner mazes. There is only one seed, so differences of a percent or less are not
significant. With a store, the script counts how often a deviation mattered in its runs. It prints tables and asserts
nothing.
"""

import argparse
import itertools
import json
import sqlite3
from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import torch

from waypost import wire
from waypost.trajectory import Trajectory
from waypost_learner.domains.maze.domain import MazeDomain
from waypost_learner.domains.maze.env import TRAIL
from waypost_learner.domains.maze.maze import SUBGOALS
from waypost_learner.experts.oracle import OracleExpert
from waypost_learner.policies.datasets import UNLABELED, Dataset, Row
from waypost_learner.policies.imitation import Policy, TrainSpec
from waypost_learner.policies.labels import Labels, rows_of, transformed_rows
from waypost_learner.presets.paper import PAPER
from waypost_learner.remote.translation import Translator
from waypost_learner.rollout.policy_keys import META, pi
from waypost_learner.rollout.simulator import Simulator

DOMAIN = MazeDomain()
ORACLE = OracleExpert(DOMAIN)
DEMONSTRATIONS, UNSEEN = 600, 200
HI_SAMPLES, LO_SAMPLES = 200_000, 100_000
FIRES = PAPER.rollouts.choosing.termination_threshold


def demonstrations(train: bool, n: int) -> Iterator[Trajectory]:
    """Yield the oracle's trajectories on corner mazes."""
    sets, rng = DOMAIN.instances("corners"), np.random.default_rng(0)
    for instance in (sets.train if train else sets.test)[:n]:
        if train and sets.vary:
            instance = sets.vary(instance, rng)
        state = Simulator(DOMAIN).reset(instance).view
        answer = ORACLE.demonstrate(DOMAIN.instance_view(instance), state)
        sigma = Translator(DOMAIN, instance).answer(answer)
        assert isinstance(sigma, tuple)
        yield sigma


def dataset(rows: list[Row]) -> Dataset:
    """Return a buffer of these rows."""
    data = Dataset(DOMAIN.observation_shape)
    data.append(rows)
    return data


# --- meta-controllers


def hi_rows(sigmas: list[Trajectory], symmetric: bool = False) -> list[Row]:
    """Return D_HI of demonstrations; with `symmetric`, in all symmetries."""
    labels = [Labels() for _ in sigmas]
    for one, sigma in zip(labels, sigmas, strict=True):
        one.append_demonstration(sigma)
    rows = [rows_of(one) for one in labels]
    if symmetric:
        rows += [transformed_rows(one, symmetry) for one in rows for symmetry in DOMAIN.symmetries]
    return [row for one in rows for row in one[META]]


def without_trail(rows: list[Row]) -> list[Row]:
    """Return the rows without the trail of visited cells."""

    def hidden(observation: np.ndarray) -> np.ndarray:
        return np.where(observation == TRAIL, np.float32(0), observation)

    return [replace(row, observation=hidden(row.observation)) for row in rows]


def with_torch_initialization(policy: Policy) -> None:
    """Initialize the weights with torch's default instead of Glorot's initialization."""
    torch.manual_seed(0)
    for layer in policy.network:
        if isinstance(layer, torch.nn.Conv2d | torch.nn.Linear):
            layer.reset_parameters()


def hi_accuracy(
    spec: TrainSpec, train: list[Row], test: list[Row], change: Callable[[Policy], None] = lambda _: None
) -> str:
    """Train a mu, and return the percentage of unseen expert states in which it agrees with the expert."""
    spec = replace(spec, least=HI_SAMPLES, most=HI_SAMPLES)
    policy = Policy(DOMAIN.observation_shape, len(SUBGOALS), False, PAPER.training.network, spec, seed=0)
    change(policy)
    policy.train(dataset(train))
    chosen = policy(np.stack([row.observation for row in test])).logits.argmax(1)
    return f"{100 * float((chosen == [row.choice for row in test]).mean()):.1f} %"


def meta_controllers() -> None:
    """Measure deviations 5, 13 and 15."""
    known, unseen = list(demonstrations(True, DEMONSTRATIONS)), list(demonstrations(False, UNSEEN))
    train, test, spec = hi_rows(known), hi_rows(unseen), PAPER.training.train_hi
    print(
        f"\nHI choices in {len(test)} unseen states after {HI_SAMPLES:,} samples of {DEMONSTRATIONS} demonstrations\n"
    )
    print("| deviation | meta-controller | agrees with the expert |\n|---|---|---|")
    print(f"| | `paper` preset | {hi_accuracy(spec, train, test)} |", flush=True)
    print(f"| 5 | 32-bit floats | {hi_accuracy(replace(spec, bf16=False), train, test)} |", flush=True)
    print(f"| 5 | no dropout | {hi_accuracy(replace(spec, dropout=0), train, test)} |", flush=True)
    print(f"| 5 | batches of 64 | {hi_accuracy(replace(spec, batch=64), train, test)} |", flush=True)
    print(f"| 5 | torch's initialization | {hi_accuracy(spec, train, test, with_torch_initialization)} |", flush=True)
    print(f"| 13 | no trail | {hi_accuracy(spec, without_trail(train), without_trail(test))} |", flush=True)
    print(f"| 15 | in all symmetries | {hi_accuracy(spec, hi_rows(known, True), test)} |", flush=True)


# --- subpolicies


class Separate:
    """pi_g and beta_g as two networks, as in the paper."""

    def __init__(self, spec: TrainSpec) -> None:
        shape, network = DOMAIN.observation_shape, PAPER.training.network
        self.acting = Policy(shape, len(DOMAIN.actions), False, network, spec, seed=0)
        self.ending = Policy(shape, 2, False, network, spec, seed=1)

    def train(self, rows: list[Row]) -> None:
        """Train each network on the rows that have its label."""
        self.acting.train(dataset([replace(row, termination=UNLABELED) for row in rows if row.choice != UNLABELED]))
        ends = [Row(row.observation, row.termination) for row in rows if row.termination != UNLABELED]
        self.ending.train(dataset(ends))

    def __call__(self, observations: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return the chosen actions and the probabilities that beta_g is true."""
        logits = self.ending(observations).logits
        return self.acting(observations).logits.argmax(1), np.exp(-np.logaddexp(0, logits[:, 0] - logits[:, 1]))


class Headed:
    """pi_g with beta_g as an extra head."""

    def __init__(self, spec: TrainSpec) -> None:
        self.policy = Policy(DOMAIN.observation_shape, len(DOMAIN.actions), True, PAPER.training.network, spec, seed=0)

    def train(self, rows: list[Row]) -> None:
        """Train the network."""
        self.policy.train(dataset(rows))

    def __call__(self, observations: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return the chosen actions and the probabilities that beta_g is true."""
        outputs = self.policy(observations)
        return outputs.logits.argmax(1), outputs.termination


def lo_rows(sigmas: list[Trajectory], first_state: bool) -> dict[int, list[Row]]:
    """Return D_g of demonstrations; with `first_state`, label beta_g as false in the first state of each segment."""
    labels = Labels()
    for sigma in sigmas:
        labels.append_demonstration(sigma)
    rows = rows_of(labels)
    starts = {s.start.observation.tobytes() for sigma in sigmas for s in sigma} if first_state else set()

    def begun(row: Row) -> Row:
        asked = row.termination != UNLABELED or row.observation.tobytes() not in starts
        return row if asked else replace(row, termination=0)

    return {g: [begun(row) for row in rows.get(pi(g), [])] for g in range(len(SUBGOALS))}


def subpolicies() -> None:
    """Measure deviations 4 and 7."""
    known = list(demonstrations(True, PAPER.warm_start))
    test = lo_rows(list(demonstrations(False, UNSEEN)), first_state=False)
    spec = replace(PAPER.training.train_lo, least=LO_SAMPLES, most=LO_SAMPLES)
    print(f"\nSubpolicies in unseen expert states, {LO_SAMPLES:,} samples of {PAPER.warm_start} demonstrations\n")
    print("| deviation | subpolicy | agrees with the expert | ends in time | ends too early |\n|---|---|---|---|---|")
    variants: list[tuple[str, str, Callable[[TrainSpec], Any], bool]] = [
        ("", "`paper` preset", Headed, False),
        ("4", "beta_g is also trained in first states", Headed, True),
        ("7", "two networks", Separate, False),
    ]
    for number, name, make, first_state in variants:
        right, fired = [], {0: list[bool](), 1: list[bool]()}
        for g, rows in lo_rows(known, first_state).items():
            policy = make(spec)
            policy.train(rows)
            actions, ends = policy(np.stack([row.observation for row in test[g]]))
            for row, action, end in zip(test[g], actions, ends, strict=True):
                if row.choice != UNLABELED:
                    right.append(action == row.choice)
                if row.termination != UNLABELED:
                    fired[row.termination].append(bool(end > FIRES))
        columns = (f"{100 * float(np.mean(column)):.1f} %" for column in (right, fired[1], fired[0]))
        print(f"| {number} | {name} | {' | '.join(columns)} |", flush=True)


# --- counts in runs


def queries(db: sqlite3.Connection, run: str, kind: str) -> Iterator[tuple[Any, Any]]:
    """Yield the queries of a kind with their answers, as JSON data."""
    found = db.execute(
        "SELECT ask, content FROM queries JOIN answers ON answers.id = queries.answer_id WHERE queries.run_id = ? "
        "AND kind = ?",
        (run, kind),
    )
    return ((json.loads(ask), json.loads(answer)) for ask, answer in found)


def percent(part: int, whole: int) -> str:
    """Return a percentage and its whole as text."""
    return f"{100 * part / whole:.1f} % of {whole:,}" if whole else "none"


def count(db: sqlite3.Connection, run: str, title: str) -> None:
    """Count deviations 3, 4, 10, 11, 12 and 16 in one run."""
    assert DOMAIN.oracle is not None
    segments = actions = followed = 0
    for _, answer in queries(db, run, "hier_demo"):
        subgoals = [segment["subgoal"] for segment in answer["segments"]]
        segments, actions = segments + len(subgoals), actions + sum(len(s["actions"]) for s in answer["segments"])
        followed += sum(a == b and a is not None for a, b in itertools.pairwise(subgoals))
    ties = invalid = chosen = 0
    for ask, answer in queries(db, run, "label_hi"):
        for segment, label in zip(ask["segments"], answer["subgoals"], strict=True):
            start, own = segment["states"][0], SUBGOALS.index(segment["subgoal"])
            chosen += 1
            ties += segment["subgoal"] == label != SUBGOALS[DOMAIN.oracle.good_subgoals(ask["instance"], start)[0]]
            invalid += not DOMAIN.oracle.good_actions(ask["instance"], start, start, own)
    labels = after = 0
    for _, answer in queries(db, run, "label_lo"):
        ends = answer["terminations"]
        labels += len(ends)
        after += len(ends) - 1 - ends.index(True) if True in ends else 0
    print(f"\n{title}\n\n| deviation | | |\n|---|---|---|")
    if segments:
        print(f"| 3, 16 | demonstrations: actions, segments | {actions:,}, {segments:,} |")
        print(f"| 4 | segments followed by a segment with the same subgoal | {percent(followed, segments)} |")
    if chosen:
        print(f"| 10 | agreements that are ties | {percent(ties, chosen)} HI labels |")
        print(f"| 12 | chosen subgoals that are not valid | {percent(invalid, chosen)} |")
    if labels:
        print(f"| 11 | states of Label_LO after the first true termination | {percent(after, labels)} |")


def main() -> None:
    """Train and compare policies, or count in a store."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--store", type=Path, help="count in the maze runs of this store instead of training")
    file = parser.parse_args().store
    torch.set_num_threads(1)
    if file is None:
        meta_controllers()
        subpolicies()
        return
    with sqlite3.connect(f"{file.resolve().as_uri()}?mode=ro", uri=True) as db:
        runs = db.execute("SELECT id, vocabulary, algorithm, seed, name FROM runs ORDER BY number")
        for run, vocabulary, algorithm, seed, name in runs.fetchall():
            if wire.Vocabulary.model_validate_json(vocabulary).domain == DOMAIN.name:
                count(db, run, f"{algorithm}, seed {seed}: {name}")


if __name__ == "__main__":
    main()
