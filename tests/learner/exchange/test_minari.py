"""The export to Minari: its own loader reads the episodes, with what the expert said where, and what it cost."""

from collections import defaultdict
from pathlib import Path
from typing import Any

import minari
import numpy as np
import pytest
import torch
from tests.learner.exchange.kit import done, trained

from waypost_learner.domains.corridor import CorridorDomain, CorridorOracle
from waypost_learner.remote.embedded import embedded, stored_runs

CELLS = 13


@pytest.fixture(scope="module", params=["hg-dagger", "naive-h-dagger", "flat-dagger", "hg-stagger", "hg-takeover"])
def exported(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, str, list[Any]]:
    """The store of a run, the run's id, and its episodes as Minari loads them."""
    folder = tmp_path_factory.mktemp("minari")
    run = trained(folder, algorithm=request.param, episodes=30 if request.param == "hg-takeover" else 10)["run"]
    done("export", run, "--store", folder / "waypost.db", "--format", "minari", "--out", folder / "data")
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("MINARI_DATASETS_PATH", str(folder / "data"))
        dataset = minari.load_dataset(f"waypost-corridor-{run}-v0")
    assert dataset.total_steps == sum(len(episode.actions) for episode in dataset.iterate_episodes())
    return folder / "waypost.db", run, list(dataset.iterate_episodes())


def at(observation: np.ndarray) -> tuple[int, int]:
    """The agent's cell and the target in an observation."""
    cell = int(observation[:CELLS].argmax())
    return cell, cell + int(observation[CELLS:].argmax()) - (CELLS - 1)


def test_observations_are_those_of_the_environment(exported: tuple[Path, str, list[Any]]) -> None:
    env = CorridorDomain().make_env()
    for episode in exported[2]:
        assert len(episode.observations) == len(episode.actions) + 1 == len(episode.infos["units"])
        start, target = at(episode.observations[0])
        env.reset()
        env.cell, env.corridor, env.steps = start, type(env.corridor)(start, target), 0
        for action, seen, reward, ended in zip(
            episode.actions, episode.observations[1:], episode.rewards, episode.terminations, strict=True
        ):
            observation, earned, terminated, *_ = env.step(action)
            assert np.array_equal(observation, seen)
            assert (reward, ended) == (earned, terminated)
        assert episode.terminations[-1] != episode.truncations[-1]
        assert not episode.terminations[:-1].any()
        assert not episode.truncations[:-1].any()


def test_labels_are_where_the_expert_gave_them(exported: tuple[Path, str, list[Any]]) -> None:
    """The oracle gave them, so each label must be right at the very state where it stands."""
    oracle, said = CorridorOracle(), defaultdict[str, int](int)
    for episode in exported[2]:
        infos = episode.infos
        first = np.flatnonzero(np.diff(infos["segment"], prepend=-1))
        for place, observation in enumerate(episode.observations):
            cell, target = at(observation)
            instance, origin = {"target": target}, at(episode.observations[first[first <= place][-1]])[0]
            if (subgoal := int(infos["expert_subgoal"][place])) >= 0:
                assert place in first
                assert subgoal in oracle.good_subgoals(instance, cell)
                said["subgoal"] += 1
            if (action := int(infos["expert_action"][place])) >= 0:
                toward = int(infos["subgoal"][place])
                toward = oracle.good_subgoals(instance, cell)[0] if toward < 0 else toward
                origin = cell if infos["subgoal"][place] < 0 else origin
                assert action in oracle.good_actions(instance, origin, cell, toward)
                said["action"] += 1
            assert (infos["expert_subgoal"][place] >= 0) == (infos["expert_subgoal_by"][place] != b"")
            assert (infos["expert_action"][place] >= 0) == (infos["expert_action_by"][place] != b"")
        if infos["inspect_full"][-1] >= 0:
            assert bool(infos["inspect_full"][-1]) == oracle.succeeded({"target": target}, cell)
    assert said["action"] > 0


def test_terminations_stand_where_a_segment_should_end(exported: tuple[Path, str, list[Any]]) -> None:
    oracle = CorridorOracle()
    for episode in exported[2]:
        infos, starts = episode.infos, np.flatnonzero(np.diff(episode.infos["segment"], prepend=-1))
        assert infos["expert_termination"][0] == -1
        for place in np.flatnonzero(infos["expert_termination"] >= 0):
            origin = starts[starts < place][-1]  # of the segment that leads here
            cell, target = at(episode.observations[place])
            reached = oracle.reached(
                {"target": target}, at(episode.observations[origin])[0], cell, int(infos["subgoal"][origin])
            )
            assert bool(infos["expert_termination"][place]) == reached


def test_cost_and_time_add_up_to_the_ledger(exported: tuple[Path, str, list[Any]]) -> None:
    store, run, episodes = exported
    found: dict[int, np.ndarray] = defaultdict(lambda: np.zeros(3))
    for episode in episodes:
        number = int(episode.infos["run_episode"][0])
        found[number] += [episode.infos[name].sum() for name in ("units", "seconds", "active_seconds")]
    booked: dict[int, np.ndarray] = defaultdict(lambda: np.zeros(3))
    with stored_runs(store) as source:
        for record in source.records(run, "ledger").records:
            booked[record.episode] += [record.units, record.seconds, record.active_seconds]  # type: ignore[union-attr]
    assert found.keys() == booked.keys()
    for number, sums in booked.items():
        assert np.allclose(found[number], sums)
    with embedded(store) as connection:
        assert sum(sums[0] for sums in found.values()) == connection.learner.costs(run).total
    pseudonyms = {by for episode in episodes for by in episode.infos["annotator"] if by}
    assert pseudonyms == {f"annotator-{run}-1".encode()}


def test_the_cost_of_an_answer_is_at_the_last_state_that_it_is_about(exported: tuple[Path, str, list[Any]]) -> None:
    for episode in exported[2]:
        infos = episode.infos
        ends = {*np.flatnonzero(np.diff(infos["segment"], prepend=0)), len(episode.actions)}
        assert set(np.flatnonzero(infos["units"])) <= ends
        assert infos["units"][-1] > 0
        assert all((infos["units"] > 0) == (infos["annotator"] != b""))


def test_a_policy_takes_a_training_step_on_the_episodes(exported: tuple[Path, str, list[Any]]) -> None:
    labeled = [(e.observations[e.infos["expert_action"] >= 0], e.infos["expert_action"]) for e in exported[2]]
    observations = torch.from_numpy(np.concatenate([seen for seen, _ in labeled]))
    actions = torch.from_numpy(np.concatenate([given[given >= 0] for _, given in labeled]))
    torch.manual_seed(0)
    network = torch.nn.Linear(observations.shape[1], 2)
    optimizer = torch.optim.SGD(network.parameters(), lr=0.1)

    def loss() -> torch.Tensor:
        return torch.nn.functional.cross_entropy(network(observations), actions)

    before = loss()
    before.backward()
    optimizer.step()
    assert loss() < before
