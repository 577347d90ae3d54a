"""One network for all policies: it finds the agent and its moves, and learns every policy from given labels."""

from collections.abc import Callable
from dataclasses import replace
from functools import cache
from pathlib import Path

import numpy as np
import pytest
import torch
from tests.learner.policies.fields_kit import TRAIN, briefly, demonstrated, into_lava, maze, seen, taught, teach
from torch.nn import functional

from waypost.trajectory import Segment
from waypost_learner.algorithms.learner import Learner
from waypost_learner.domains.maze.maze import MOVES
from waypost_learner.policies.device import as_input
from waypost_learner.policies.fields import agent_finder
from waypost_learner.policies.fields.agent_finder import AgentFinder
from waypost_learner.policies.fields.field_net import FieldNet, FieldSpec
from waypost_learner.policies.fields.spreading import spread
from waypost_learner.policies.labels import Labels, LoLabels
from waypost_learner.policies.levels import Levels
from waypost_learner.rollout.policy_keys import FLAT, META, pi
from waypost_learner.runs import checkpoints
from waypost_learner.runs.config import Progress, TrainConfig
from waypost_learner.runs.setup import set_up


@cache
def learned() -> Learner:
    return taught(briefly(50), 4)


@pytest.mark.parametrize("symmetries", [True, False])
def test_it_finds_the_agent_from_demonstrated_actions(symmetries: bool) -> None:
    learner = taught(briefly(0, symmetries=symmetries), 4)
    assert learner.shared is not None
    network = learner.shared.acting
    assert isinstance(network, FieldNet)
    pictures, cells = seen()
    on_target = pictures[range(len(cells)), 2, *cells.T] != 0  # the end of an episode; nobody acts there any more
    found = network.finder.find(as_input(pictures)).cpu()
    np.testing.assert_array_equal(found[~on_target], cells[~on_target])
    moved = np.zeros((4, 9))
    moved[range(4), [3 * row + column + 4 for row, column in MOVES]] = 1
    np.testing.assert_allclose(network.displacements.cpu(), moved, atol=0.05)


@pytest.mark.parametrize("final", [True, False])
def test_an_agent_that_is_gone_after_an_episode_is_not_looked_for(final: bool, monkeypatch: pytest.MonkeyPatch) -> None:
    learner, looked = taught(briefly(0), 1, first=1), list[AgentFinder]()
    monkeypatch.setattr(AgentFinder, "_fit_once", lambda finder, *_: looked.append(finder))
    labels = Labels()
    labels.append_hi([replace(into_lava(TRAIN[500]), final=final)], [0])
    learner.learn(labels)
    assert (not looked) == final


def test_an_action_that_nobody_showed_may_move_the_agent_anywhere() -> None:
    finder = AgentFinder(3, 4)
    pictures = torch.from_numpy(seen(1)[0])
    shares = finder.displacements((pictures, torch.zeros(len(pictures), dtype=torch.int64), pictures))
    np.testing.assert_allclose(shares[1:], 1 / 9)
    np.testing.assert_allclose(shares[0], np.eye(9)[4], atol=0.01)


def test_it_learns_every_policy_from_four_demonstrations() -> None:
    learner = learned()
    right = dict.fromkeys(("hi", "lo", "ends"), 0.0)
    steps, segments = 0, 0
    for instance in TRAIN[500:520]:
        view = instance.to_json()
        for segment in demonstrated(instance):
            assert segment.subgoal is not None
            observations = np.stack([state.observation for state in segment.states])
            chosen = learner.policies[META](observations[:1]).logits.argmax()
            right["hi"] += chosen in maze.oracle.good_subgoals(view, segment.start.view)
            out = learner.policies[pi(segment.subgoal)](observations)
            for state, logits in zip(segment.states[:-1], out.logits, strict=False):
                good = maze.oracle.good_actions(view, segment.start.view, state.view, segment.subgoal)
                right["lo"] += logits.argmax() in good
            right["ends"] += out.termination[-1] > 0.5 and (out.termination[1:-1] < 0.5).all()
            steps, segments = steps + len(segment.actions), segments + 1
    assert right["hi"] / segments > 0.8  # one of five
    assert right["lo"] / steps > 0.95  # one of four
    assert right["ends"] / segments > 0.8


@pytest.mark.parametrize("right", [False, True])
def test_labels_toward_wrong_subgoals_do_not_teach_that_these_are_right(right: bool) -> None:
    """The control says of the same labels that their subgoals are right."""
    learner, oracle, labels = Learner(maze, briefly(100), 0, threads=1), maze.oracle, Labels()
    for instance in TRAIN[:4]:
        view = instance.to_json()
        labels.append_demonstration(demonstrated(instance))
        for one in demonstrated(instance):
            at = one.start.view
            for wrong in set(range(len(maze.subgoals))) - set(oracle.good_subgoals(view, at)):
                if good := oracle.good_actions(view, at, at, wrong):
                    toward = Segment(wrong, one.states[:2], one.actions[:1], terminated=False)
                    labels.lo += 8 * [(toward, LoLabels((good[0],), (False, False)), right)]
    learner.learn(labels)
    learner.train_idle()
    agrees = [
        learner.policies[META](one.start.observation[None]).logits.argmax()
        in oracle.good_subgoals(instance.to_json(), one.start.view)
        for instance in TRAIN[:4]
        for one in demonstrated(instance)
    ]
    assert (sum(agrees) / len(agrees) > 0.8) is not right


def test_a_flat_policy_learns_with_the_same_network() -> None:
    learner = taught(briefly(50), 4, levels=Levels(flat=True))
    assert isinstance(learner.learned[FLAT].network, FieldNet)
    good, steps = 0, 0
    for instance in TRAIN[500:520]:
        for segment in demonstrated(instance):
            logits = learner.policies[FLAT](np.stack([state.observation for state in segment.states[:-1]])).logits
            good += int((logits.argmax(1) == np.array(segment.actions)).sum())
            steps += len(segment.actions)
    assert good / steps > 0.5  # one of four; often two actions are right, and one was shown


def test_ends_of_subgoals_are_looked_for_as_far_away_as_subgoals_ended_so_far() -> None:
    def moved(segment: Segment) -> int:
        return max(
            abs(after - before) for before, after in zip(segment.start.view, segment.states[-1].view, strict=True)
        )

    learner = taught(briefly(1), 3)
    assert learner.shared is not None
    network = learner.shared.network
    assert learner.shared.acting.reach == network.reach
    assert network.reach == max(moved(one) for instance in TRAIN[:3] for one in demonstrated(instance))
    for segment in demonstrated(TRAIN[500]):
        network.look_as_far_as(*(as_input(one.observation[None]) for one in (segment.start, segment.states[-1])))
        assert network.reach == moved(segment)
    told = taught(briefly(1, fields=FieldSpec(reach=2)), 3)
    assert told.shared is not None
    assert told.shared.network.reach == 2


def test_a_subpolicy_that_sees_no_end_of_its_subgoal_acts_for_the_task() -> None:
    learner, observations = taught(briefly(50), 3), seen(1)[0]
    assert learner.shared is not None
    before = learner.shared.outputs(observations)
    for_the_task = before["flat"].unsqueeze(1).expand_as(before["lo"])
    assert not torch.allclose(before["lo"], for_the_task, atol=0.1)
    with torch.no_grad():
        learner.shared.acting.near[2].bias.fill_(-1e3)  # the network finds no end anywhere
    torch.testing.assert_close(learner.shared.outputs(observations)["lo"], for_the_task)


def test_only_what_was_observed_reaches_the_network() -> None:
    """Nothing of the domain's structure is used: a domain that declares none teaches the same weights."""

    class Bare:
        name, subgoals, actions = maze.name, maze.subgoals, maze.actions
        horizons, observation_shape, make_env, oracle = (
            maze.horizons,
            maze.observation_shape,
            maze.make_env,
            maze.oracle,
        )
        instances, state_view, instance_view = maze.instances, maze.state_view, maze.instance_view

    told = taught(briefly(2, symmetries=False), 2)
    bare = Learner(Bare(), briefly(2), 0, threads=1)  # type: ignore[arg-type]  # it needs no more
    teach(bare, 2)
    assert bare.shared is not None
    assert bare.shared.symmetries  # which it found, as nobody declared any
    assert checkpoints.weights_hash(bare) == checkpoints.weights_hash(told)


@pytest.mark.parametrize("enough", [0.9, 2.0])  # the agent is found at once; it is looked for to the end
def test_training_goes_on_from_a_checkpoint_whether_or_not_the_agent_is_found(
    tmp_path: Path, enough: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(agent_finder, "_ENOUGH", enough)
    monkeypatch.setattr(agent_finder, "_TRIES", 2)
    header = checkpoints.Header("a-run", TrainConfig("hg-dagger", preset="general"), Progress(1))
    checkpoints.write(tmp_path / "one", taught(briefly(2), 1), header, weights_only=False)
    resumed = Learner(maze, briefly(2), seed=99, threads=1)
    checkpoints.load(tmp_path / "one", resumed)
    teach(resumed, 2, first=1)
    assert checkpoints.weights_hash(resumed) == checkpoints.weights_hash(taught(briefly(2), 3))


def test_gradients_that_are_left_from_looking_for_the_agent_change_no_training() -> None:
    learners = [taught(briefly(2), 1) for _ in range(2)]
    for learner, left in zip(learners, (0.0, 1e3), strict=True):
        assert learner.shared is not None
        for one in learner.shared.network.finder.parameters():
            one.grad = torch.full_like(one, left)
        learner.train_idle()  # nothing is due
        learner.due = [META]
        learner.train_idle()
    assert checkpoints.weights_hash(learners[0]) == checkpoints.weights_hash(learners[1])


@pytest.mark.parametrize(("algorithm", "domain"), [("hg-dagger-q", "maze"), ("hg-dagger", "corridor")])
def test_policies_that_cannot_share_a_network_have_their_own_and_the_run_says_so(algorithm: str, domain: str) -> None:
    setup = set_up(TrainConfig(algorithm, domain=domain, preset="general"), threads=1)
    assert setup.learner.shared is None
    assert "its own network" in setup.missing["fields"]
    assert "fields" not in set_up(TrainConfig("hg-dagger", preset="general"), threads=1).missing


def refused(values: str, algorithm: str = "hg-dagger", preset: str = "general") -> Callable[[], object]:
    return lambda: set_up(TrainConfig(algorithm, preset=preset, values=values), threads=1)


@pytest.mark.parametrize(
    "values", ["train_hi.batch=16", "train_lo.batch=16", "network.hidden=8", "centered=true", "views=true", "crop=true"]
)
def test_values_of_networks_of_their_own_are_refused(values: str) -> None:
    with pytest.raises(ValueError, match=r"has no effect: .*fields"):
        refused(values)()


def test_values_of_the_shared_network_are_refused_where_there_is_none() -> None:
    with pytest.raises(ValueError, match="share no network"):
        refused("train_shared.batch=16", preset="lean")()
    with pytest.raises(ValueError, match="Q-function"):
        refused("fields.far=8", "hg-dagger-q")()


@pytest.mark.parametrize("values", ["fields.far=0", "fields.reach=0", "fields.ending=0", "fields.gain=0.0"])
def test_sizes_out_of_their_range_are_refused(values: str) -> None:
    with pytest.raises(ValueError, match="fields need far, reach"):
        refused(values)()


def test_steps_that_could_grow_beyond_all_numbers_are_refused() -> None:
    with pytest.raises(ValueError, match="smaller far or gain"):
        refused("fields.far=2000")()


def test_a_shared_network_needs_an_average_of_its_weights() -> None:
    with pytest.raises(ValueError, match="averaging"):
        refused("train_shared.averaging=null")()


def test_fields_stay_finite_over_many_steps() -> None:
    network = FieldNet((3, 17, 17), 5, 4, FieldSpec(far=300), torch.Generator().manual_seed(0))
    with torch.no_grad():
        for gate in (-50.0, 50.0):  # all open, all shut
            network.gates[2].bias.fill_(gate)
            out = network(torch.from_numpy(seen(1)[0]))
            assert all(bool(torch.isfinite(one).all()) for one in out.values())


def test_gradients_stay_finite_where_the_task_is_behind_walls() -> None:
    """There, the field around the agent is so small that the gradient of its logarithm is beyond float32."""
    shared = taught(briefly(1), 1).shared
    assert shared is not None
    network, pictures, target = shared.network, torch.from_numpy(seen(1)[0][:1]), 2  # the target's channel
    with torch.no_grad():
        network.source.weight.zero_()[0, target] = -7.0  # the target is -1 there
        network.gates[2].weight.zero_()
        network.gates[2].bias.fill_(2.0)  # nearly shut, everywhere
    flat = network(pictures)["flat"]
    assert flat.max() < -90
    torch.autograd.backward(flat[:, 0].sum())
    gradients = [one.grad for one in (*network.source.parameters(), *network.gates.parameters())]
    assert all(one is not None and bool(torch.isfinite(one).all()) for one in gradients)
    assert any(one is not None and bool(one.any()) for one in gradients)


def test_a_network_that_cannot_learn_any_more_says_so() -> None:
    learner = taught(briefly(1), 1)
    assert learner.shared is not None
    with torch.no_grad():
        learner.shared.network.source.bias.fill_(float("nan"))
    with pytest.raises(ValueError, match=r"no numbers.*lower train_shared\.learning_rate"):
        list(learner.shared.idle_updates(learner.data))


def test_rollouts_compute_what_the_network_says_of_a_picture_once() -> None:
    learner = taught(briefly(100), 2)
    assert learner.shared is not None
    rows: list[int] = []
    learner.shared.acting.register_forward_hook(lambda _, inputs, __: rows.append(len(inputs[0])))
    trajectories = [learner.roll_out(learner.start(instance, n)) for n, instance in enumerate(TRAIN[600:620])]
    pictures = [{state.observation.tobytes() for segment in one for state in segment.states} for one in trajectories]
    views = 1 + len(learner.shared.symmetries)
    assert sum(rows) <= views * sum(map(len, pictures))
    assert sum(map(len, trajectories)) > 2 * len(trajectories)  # mu was asked where subgoals had ended


def test_fields_and_their_gradients_are_those_of_repeated_convolutions() -> None:
    rng = torch.Generator().manual_seed(0)
    gates, source = (torch.rand(3, 6, 5, dtype=torch.float64, generator=rng).requires_grad_() for _ in range(2))
    weights = torch.rand(9, dtype=torch.float64, generator=rng)
    weights[4] = 0  # nothing comes from the pixel itself
    field = source
    for _ in range(7):
        moved = functional.conv2d(field.unsqueeze(1), weights.view(1, 1, 3, 3), padding=1).squeeze(1)
        field = gates * moved + source
    ours = spread(gates, source, weights, 7)
    torch.testing.assert_close(ours, field)
    some = torch.rand(3, 6, 5, dtype=torch.float64, generator=rng)
    wanted = torch.autograd.grad((some * field).sum(), (gates, source))
    torch.testing.assert_close(torch.autograd.grad((some * ours).sum(), (gates, source)), wanted)
