"""The corridor: the smallest complete domain, and the template for others."""

import gymnasium
import numpy as np
import pytest
from gymnasium.utils.env_checker import check_env
from hypothesis import given
from hypothesis import strategies as st
from tests.learner.kit import examples

from waypost.domains import find_domain
from waypost_learner.domains.corridor import CELLS, EAST, MAX_STEPS, WEST, Corridor, CorridorDomain, CorridorEnv, moved

domain = CorridorDomain()
cells = st.integers(0, CELLS - 1)


def test_the_environment_passes_gymnasiums_checker_without_a_warning() -> None:
    gymnasium.register("Corridor-v0", CorridorEnv)
    try:
        check_env(gymnasium.make("Corridor-v0").unwrapped)
    finally:
        del gymnasium.registry["Corridor-v0"]


@examples
@given(cells, cells, st.data())
def test_good_choices_reach_the_target_in_exactly_the_shortest_number_of_steps(
    start: int, target: int, data: st.DataObject
) -> None:
    view, here, steps = {"target": target}, start, 0
    while here != target:
        subgoal = data.draw(st.sampled_from(domain.oracle.good_subgoals(view, here)))
        origin = here
        while here == origin or not domain.oracle.reached(view, origin, here, subgoal):
            here = moved(here, data.draw(st.sampled_from(domain.oracle.good_actions(view, origin, here, subgoal))))
            steps += 1
        assert abs(here - origin) <= domain.horizons.lo
    assert steps == abs(target - start)


def test_walls_stop_the_agent_and_time_ends_the_episode() -> None:
    env = CorridorEnv()
    env.reset(options={"instance": Corridor(1, 12)})
    truncations = [env.step(np.int64(WEST))[3] for _ in range(MAX_STEPS)]
    assert env.cell == 0
    assert truncations == [False] * (MAX_STEPS - 1) + [True]


def test_arriving_ends_the_episode_with_reward_one() -> None:
    env = CorridorEnv()
    env.reset(options={"instance": Corridor(10, 12)})
    assert env.step(np.int64(EAST))[1:4] == (0, False, False)
    assert env.step(np.int64(EAST))[1:4] == (1, True, False)


def test_training_and_test_instances_are_all_pairs_once() -> None:
    sets = domain.instances("random")
    assert len(set(sets.train) | set(sets.test)) == len(sets.train) + len(sets.test) == CELLS * (CELLS - 1)
    assert domain.instances("random") == sets


@pytest.mark.parametrize("name", ["maze", "corridor"])
def test_a_domain_is_found_by_its_name_and_keeps_its_promises(name: str) -> None:
    found = find_domain(name)
    assert found.name == name
    instance = found.instances("random").train[0]
    env = found.make_env()
    observation, _ = env.reset(options={"instance": instance})
    assert observation.shape == found.observation_shape == env.observation_space.shape
    assert not found.succeeded(env)
    assert found.oracle is not None
    view, state = found.instance_view(instance), found.state_view(env)
    assert not found.oracle.succeeded(view, state)
    (subgoal, *_) = found.oracle.good_subgoals(view, state)
    (action, *_) = found.oracle.good_actions(view, state, state, subgoal)
    env.step(np.int64(action))
    assert found.state_view(env) == found.oracle.successor(view, state, action)


def test_a_domain_that_is_not_installed_is_refused_with_those_that_are() -> None:
    with pytest.raises(ValueError, match=r"no domain 'chess'; the installed domains are: .*corridor.*maze"):
        find_domain("chess")
