"""Theorems 1 and 2 against the halving algorithm, and what the simulation of them must be to say anything."""

import csv
import json
import re
from collections.abc import Generator
from dataclasses import replace
from itertools import product
from math import log2
from pathlib import Path
from typing import Any, cast

import numpy as np
import pytest
from click.testing import Result
from hypothesis import given
from hypothesis import strategies as st
from tests.learner.kit import examples
from typer.testing import CliRunner

from waypost import wire
from waypost_learner import cli
from waypost_learner.algorithms.flat_dagger import flat_dagger
from waypost_learner.algorithms.hg_dagger import hg_dagger
from waypost_learner.algorithms.queries import Answer, InspectLo, LabelLo, Query
from waypost_learner.experiments.theory import grid, report
from waypost_learner.experiments.theory.adversary import worst_instance
from waypost_learner.experiments.theory.bounds import (
    Expense,
    operation_costs,
    proportion,
    ratio_of_bounds,
    theorem_1,
    theorem_2,
)
from waypost_learner.experiments.theory.classes import N_ACTIONS, N_POSITIONS, Cell, Classes, draw_classes
from waypost_learner.experiments.theory.halving import Product, Simple, VersionSpace
from waypost_learner.experiments.theory.simulation import Episodes, HalvingLearner, PricedExpert, simulate
from waypost_learner.experiments.theory.task import Task, observed
from waypost_learner.policies.datasets import Row
from waypost_learner.policies.labels import Labels
from waypost_learner.rollout.policy_keys import FLAT, META, PolicyKey

SMALL = (Cell(2, 2, 8, 4, 2), Cell(3, 2, 5, 3, 3))
SEEDS = st.integers(0, 2**32)
EPISODES = st.sampled_from(grid.EPISODES)


@st.composite
def cells(draw: st.DrawFn) -> Cell:
    """Small cells; the sizes of classes are no powers of two."""
    sizes = draw(st.tuples(st.integers(1, 4), st.integers(2, 5), st.integers(2, 40), st.integers(2, 9)))
    return Cell(*sizes, n_subgoals=draw(st.integers(2, 4)))


def drawn(cell: Cell, seed: int) -> tuple[Classes, Task, np.random.Generator]:
    rng = np.random.default_rng(seed)
    classes = draw_classes(cell, rng)
    return classes, Task(cell, classes, rng), rng


def overheard(episode: Generator[Query, Any, Labels], heard: list[tuple[Any, Any]]) -> Generator[Query, Any, Labels]:
    """The same episode; its queries and their answers are kept."""
    answer: Answer | None = None
    while True:
        try:
            query = episode.send(answer)
        except StopIteration as over:
            return cast(Labels, over.value)
        answer = yield query
        heard.append((query, answer))


def hg_episodes(cell: Cell, seed: int, rounds: int) -> list[list[tuple[Any, Any]]]:
    """What hg-DAgger asks on random episodes, and what it hears."""
    classes, task, rng = drawn(cell, seed)
    learner: Any = HalvingLearner(task, classes, flat=False)
    expert, all_heard = PricedExpert(task, wire.Prices()), []
    for t in range(rounds):
        instance, heard = task.draw_instance(rng), list[tuple[Any, Any]]()
        learner.learn(expert.carry_out(overheard(hg_dagger(learner.start(instance), learner), heard), instance, t))
        all_heard.append(heard)
    return all_heard


# --- the theorems


@examples
@given(cells(), SEEDS, st.booleans(), EPISODES)
def test_no_run_costs_more_than_its_bound(cell: Cell, seed: int, flat: bool, episodes: Episodes) -> None:
    result = simulate(cell, seed, rounds=25, flat=flat, episodes=episodes)
    assert result.spent.monitoring == result.bound.monitoring == 25
    assert result.spent.learning <= result.bound.learning + 1e-9


@examples
@given(cells(), SEEDS, st.booleans(), EPISODES)
def test_a_version_space_makes_at_most_as_many_mistakes_as_its_class_can_be_halved(
    cell: Cell, seed: int, flat: bool, episodes: Episodes
) -> None:
    mistakes = simulate(cell, seed, rounds=25, flat=flat, episodes=episodes).mistakes
    size = {META: cell.n_mu, FLAT: cell.n_mu * cell.n_pi**cell.n_subgoals}
    assert all(number <= log2(size.get(key, cell.n_pi)) for key, number in mistakes.items())


@examples
@given(cells(), SEEDS, EPISODES)
def test_each_failed_episode_shows_a_mistake(cell: Cell, seed: int, episodes: Episodes) -> None:
    flat = simulate(cell, seed, rounds=25, flat=True, episodes=episodes)
    assert flat.asked["label_full"] <= flat.mistakes[FLAT]
    hg = simulate(cell, seed, rounds=25, flat=False, episodes=episodes)
    assert hg.asked["label_hi"] <= sum(hg.mistakes.values())
    assert hg.asked["label_lo"] <= sum(hg.mistakes.values()) - hg.mistakes[META]


@pytest.mark.parametrize("flat", [False, True])
def test_the_worst_episodes_nearly_meet_the_bound_so_it_is_put_to_the_test(flat: bool) -> None:
    result = simulate(Cell(4, 4, 256, 16, 4), seed=0, rounds=40, flat=flat, episodes="worst")
    assert result.spent.learning > 0.9 * result.bound.learning


def test_the_bounds_are_the_papers() -> None:
    cell = Cell(h_hi=4, h_lo=3, n_mu=8, n_pi=4, n_subgoals=3)
    costs = operation_costs(cell, wire.Prices())
    # Each failed episode: 4 subgoals labeled, 4 segments inspected; each LO mistake: 3 actions and a termination.
    assert theorem_1(cell, 2, 10, costs).monitoring == 10
    assert theorem_1(cell, 2, 10, costs).learning == (3 + 2 * 2) * (4 + 4) + 2 * 2 * (3 + 1)
    assert theorem_2(cell, 10, costs).total == 10 + (3 + 3 * 2) * 12
    assert ratio_of_bounds(cell, costs) == (4 + 4 + 4) / 12
    assert proportion(cell) == (4 + 3) / (4 * 3)


def test_the_bounds_follow_the_prices_of_the_run() -> None:
    cell = Cell(h_hi=4, h_lo=3, n_mu=8, n_pi=4, n_subgoals=3)
    prices = wire.Prices(subgoal=2, action=3, termination=5, inspect_full=7, inspect_lo=11)
    costs = operation_costs(cell, prices)
    assert theorem_1(cell, 1, 10, costs).monitoring == 70
    assert theorem_1(cell, 1, 10, costs).learning == (3 + 2) * (4 * 2 + 4 * 11) + 2 * (3 * 3 + 5)
    assert theorem_2(cell, 10, costs).learning == (3 + 3 * 2) * 12 * 3


# --- the halving algorithm


def taught(space: VersionSpace, classes: Classes, places: list[tuple[int, int]], key: PolicyKey) -> None:
    """Let a version space learn the expert's choices in states (u, x), and hold each step against the algorithm."""
    for u, x in places:
        wanted = classes.pi_star[classes.mu_star[u], x] if key == FLAT else classes.mu_star[x]
        wanted = classes.pi_star[key.subgoal, x] if key.subgoal is not None else wanted
        observation, before = observed([u, x, 0]).observation, (space.size, space.mistakes)
        erred = space.choose(observation) != wanted
        space.learn([Row(observation, int(wanted))])
        assert space.choose(observation) == wanted
        assert space.mistakes == before[1] + erred
        assert space.size <= before[0] / 2 if erred else space.size == before[0]


PLACES = st.lists(st.tuples(st.integers(0, N_POSITIONS - 1), st.integers(0, N_POSITIONS - 1)), max_size=30)


@examples
@given(cells(), SEEDS, PLACES)
def test_a_mistake_halves_the_version_space_and_never_removes_the_expert(
    cell: Cell, seed: int, places: list[tuple[int, int]]
) -> None:
    classes, *_ = drawn(cell, seed)
    mu, pi, full = Simple(classes.mu, cell.n_subgoals), Simple(classes.pi, N_ACTIONS), Product(classes)
    taught(mu, classes, places, META)
    taught(pi, classes, places, PolicyKey("lo", 0))
    taught(full, classes, places, FLAT)
    assert (mu.tables[mu.left] == classes.mu_star).all(axis=1).any()
    assert (pi.tables[pi.left] == classes.pi_star[0]).all(axis=1).any()
    with_mu_star = full.left[(classes.mu == classes.mu_star).all(axis=1)]  # [.., |G|, |Pi_LO|]
    are_pi_star = (classes.pi == classes.pi_star[:, None]).all(axis=-1)  # [|G|, |Pi_LO|]
    assert (with_mu_star & are_pi_star).any(axis=-1).all(axis=-1).any()


@examples
@given(SEEDS, PLACES)
def test_the_version_space_of_full_policies_votes_as_if_all_were_enumerated(
    seed: int, places: list[tuple[int, int]]
) -> None:
    classes, *_ = drawn(Cell(2, 2, 4, 3, 3), seed)
    acts = np.array(
        [classes.pi[list(rows)][mu] for mu in classes.mu for rows in product(range(3), repeat=3)]
    )  # [|Pi_FULL|, u, x]
    full, left = Product(classes), np.ones(len(acts), bool)
    for u, x in places:
        wanted = classes.pi_star[classes.mu_star[u], x]
        if full.choose(observed([u, x, 0]).observation) != wanted:
            left &= acts[:, u, x] == wanted
        full.learn([Row(observed([u, x, 0]).observation, int(wanted))])
        assert full.size == left.sum()
        assert (full.votes == np.stack([(acts[left] == a).sum(axis=0) for a in range(N_ACTIONS)], axis=-1)).all()


def test_a_class_too_large_to_be_counted_exactly_is_refused() -> None:
    classes, *_ = drawn(Cell(2, 2, 4, 64, 9), 0)
    with pytest.raises(ValueError, match="4 times 64 to the power of 9 policies"):
        Product(classes)


# --- the episodes


@examples
@given(cells(), SEEDS)
def test_hg_dagger_asks_for_no_lo_labels_from_the_first_wrong_subgoal_on(cell: Cell, seed: int) -> None:
    for (_, passed), *heard in hg_episodes(cell, seed, rounds=10):
        if passed:
            assert heard == []
            continue
        (hi, d_star), *about_segments = heard
        sigma = hi.trajectory
        good = [segment.subgoal == g_star for segment, g_star in zip(sigma, d_star, strict=True)]
        first_wrong = [*good, False].index(False)
        inspected = [(sigma.index(asked.segment), said) for asked, said in about_segments if type(asked) is InspectLo]
        labeled = [sigma.index(asked.segment) for asked, _ in about_segments if type(asked) is LabelLo]
        assert len(inspected) + len(labeled) == len(about_segments)
        failed = [h for h, said in inspected if not said]
        assert [h for h, _ in inspected] == list(range(failed[0] + 1 if failed else first_wrong))
        assert labeled == failed
        assert all(h < first_wrong for h in labeled)


@examples
@given(cells(), SEEDS, st.booleans())
def test_each_of_the_worst_episodes_shows_one_mistake_after_everything_was_inspected(
    cell: Cell, seed: int, flat: bool
) -> None:
    classes, task, _ = drawn(cell, seed)
    learner: Any = HalvingLearner(task, classes, flat)
    expert, mistakes = PricedExpert(task, wire.Prices()), 0
    while (instance := worst_instance(task, classes, learner.policies)) is not None:
        expert.asked.clear()
        learner.learn(
            expert.carry_out((flat_dagger if flat else hg_dagger)(learner.start(instance), learner), instance, 0)
        )
        mistakes += 1
        assert sum(policy.mistakes for policy in learner.policies.values()) == mistakes
        assert expert.asked["label_full" if flat else "label_hi"] == 1
        assert expert.asked["inspect_lo"] == (0 if flat else cell.h_hi - 1 + expert.asked["label_lo"])


def test_both_learners_meet_the_same_expert_on_the_same_episodes_and_all_episodes_have_the_horizons_lengths() -> None:
    classes, task, rng = drawn(Cell(3, 4, 8, 4, 2), 0)
    instance = task.draw_instance(rng)
    hierarchical, flat = (HalvingLearner(task, classes, flat=is_flat) for is_flat in (False, True))
    sigma, (tau,) = hierarchical.roll_out(hierarchical.start(instance)), flat.roll_out(flat.start(instance))
    assert [len(segment.actions) for segment in sigma] == [4, 4, 4]
    assert len(tau.actions) == 12
    assert [state.view[0] for state in tau.states[:-1:4]] == [state.view[1] for state in tau.states[:-1:4]]


def test_the_same_seed_gives_the_same_numbers_and_another_one_gives_others() -> None:
    first, again = (grid.measure(SMALL, seeds=2, rounds=15) for _ in range(2))
    assert [row.values() for row in first] == [row.values() for row in again]
    alone = [simulate(Cell(4, 4, 64, 8, 3), seed, 30, flat=False, episodes="random").spent for seed in range(4)]
    assert len({spent.learning for spent in alone}) > 1


def test_a_row_has_the_means_over_the_seeds_and_the_share_that_the_worst_seed_spent() -> None:
    *_, row = grid.measure(SMALL[1:], seeds=5, rounds=15)  # on random episodes, where seeds differ
    spent = [simulate(SMALL[1], seed, 15, flat=False, episodes=row.episodes) for seed in range(5)]
    assert row.hg.learning == pytest.approx(sum(one.spent.learning for one in spent) / 5)
    shares = {one.spent.learning / one.bound.learning for one in spent}
    assert row.hg.worst == max(shares) > min(shares)


# --- the command


@pytest.fixture
def small_grid(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(grid, "GRID", SMALL)


def theory(*arguments: str) -> Result:
    return CliRunner().invoke(cli.app, ["theory", "--seeds", "2", "--rounds", "15", *arguments])


@pytest.mark.usefixtures("small_grid")
def test_the_table_has_a_line_for_each_cell_and_kind_of_episodes() -> None:
    done = theory()
    assert (done.exit_code, done.stderr) == (0, "")
    lines = [line for line in done.stdout.splitlines() if re.match(r" +\d+ +\d+ +\d+", line)]
    assert len(lines) == len(SMALL) * 2
    assert [line.split()[:5] for line in lines[:2]] == [["2", "2", "8", "4", "2"], ["3", "2", "5", "3", "3"]]
    assert lines[0].split()[-2:] == ["1.75", "1.000"]  # (2 + 2 + 3) / 4 and 4 / 4
    assert re.search(r"The largest .* is \d+\.\d% \(hg-DAgger\) and \d+\.\d% \(flat\)\.", done.stdout)


@pytest.mark.usefixtures("small_grid")
def test_with_json_one_line_has_every_number() -> None:
    (line,) = theory("--json").stdout.splitlines()
    found = json.loads(line)
    assert (found["seeds"], found["rounds"], len(found["cells"])) == (2, 15, len(SMALL) * 2)
    cell = found["cells"][0]
    assert {"h_hi", "h_lo", "n_mu", "n_pi", "n_subgoals", "episodes"} < cell.keys()
    assert cell["hg_bound"] == cell["hg_learning_bound"] + 15
    assert cell["ratio"] == cell["hg_learning"] / cell["flat_learning"]
    assert found["worst"]["hg"] == max(one["hg_worst"] for one in found["cells"]) <= 1


def test_there_is_no_ratio_to_a_learner_that_never_failed(monkeypatch: pytest.MonkeyPatch) -> None:
    def without_failures(*values: Any) -> Any:
        result = simulate(*values)
        return replace(result, spent=Expense(result.spent.monitoring, 0))

    monkeypatch.setattr(grid, "simulate", without_failures)
    rows = grid.measure(SMALL[:1], seeds=1, rounds=1)
    assert [row.ratio for row in rows] == [None, None]
    assert [line.split()[-3] for line in report.table(rows, 1, 1) if line.startswith("   2")] == ["none", "none"]


@pytest.mark.usefixtures("small_grid")
def test_with_a_folder_the_numbers_and_the_picture_are_written_always_the_same(tmp_path: Path) -> None:
    folders = [tmp_path / "new" / name for name in ("a", "b")]
    for folder in folders:
        assert theory("--out", str(folder)).exit_code == 0
        assert {path.name for path in folder.iterdir()} == {"theory.csv", "theory.svg", "theory.png"}
    for name in ("theory.csv", "theory.svg", "theory.png"):
        assert (folders[0] / name).read_bytes() == (folders[1] / name).read_bytes()
    with (folders[0] / "theory.csv").open() as file:
        lines = list(csv.DictReader(file))
    assert [float(line["ratio_of_bounds"]) for line in lines[:2]] == [7 / 4, 9 / 6]
    assert (folders[0] / "theory.svg").read_text().startswith("<?xml")


@pytest.mark.parametrize("wrong", [("--seeds", "0"), ("--rounds", "0"), ("--seeds", "many")])
def test_values_that_make_no_sense_are_refused(wrong: tuple[str, str]) -> None:
    done = CliRunner().invoke(cli.app, ["theory", *wrong])
    assert (done.exit_code, done.stdout) == (2, "")
    assert wrong[0].strip("-") in done.stderr


def test_a_folder_that_cannot_be_is_refused_with_a_sentence_before_anything_is_simulated(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("no folder")
    done = CliRunner().invoke(cli.app, ["theory", "--out", str(tmp_path / "file")])
    assert (done.exit_code, done.stdout) == (2, "")
    assert re.fullmatch(r"Cannot write to the folder .*file: File exists\.\n", done.stderr)
