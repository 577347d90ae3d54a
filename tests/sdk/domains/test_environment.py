"""`waypost.domain(...)`: a Gymnasium environment becomes a domain in a few lines."""

from pathlib import Path
from typing import Any

import gymnasium
import numpy as np
import pytest
from gymnasium import spaces
from gymnasium.utils.env_checker import check_env

import waypost
from waypost.domains import ActionLandmarked, Ending, Landmarked, Pictured, Restorable, Solved, find_domain
from waypost.domains.conformance import check


def lake(**given: Any) -> Any:
    """FrozenLake on a 4x4 map: the ice is slippery, so steps are random within the seed."""
    common = {"subgoals": ["cross"], "horizons": (100, 1, 100), "actions": ["left", "down", "right", "up"]}
    return waypost.domain("FrozenLake-v1", **common | given)


class Arm(gymnasium.Env[Any, Any]):
    """A joint that turns by a torque. Its observation is a picture with the channels last."""

    metadata = {"render_modes": []}  # noqa: RUF012
    action_space = spaces.Box(-1, 1, (1,), np.float32)
    observation_space = spaces.Box(0, 255, (12, 16, 3), np.uint8)

    def reset(self, *, seed: int | None = None, options: Any = None) -> tuple[Any, dict[str, Any]]:
        super().reset(seed=seed)
        self.angle = float(self.np_random.uniform(-0.5, 0.5)) if options is None else options["angle"]
        return self.picture(), {}

    def step(self, action: Any) -> tuple[Any, float, bool, bool, dict[str, Any]]:
        self.angle += float(action[0])
        return self.picture(), float(self.angle >= 2), self.angle >= 2, False, {}

    def picture(self) -> Any:
        picture = np.zeros((12, 16, 3), np.uint8)
        picture[:, : max(int(4 * self.angle), 0)] = 255
        return picture


def arm(**given: Any) -> Any:
    common = {
        "name": "arm",
        "subgoals": ["half", "whole"],
        "actions": {"back": [-0.5], "forth": [0.5]},
        "horizons": (8, 4, 12),
        "state": lambda env: {"angle": env.unwrapped.angle},
    }
    return waypost.domain(Arm, **common | given)


EXPERT: dict[str, Any] = {
    "reached": lambda origin, state, subgoal: state["angle"] >= (2 if subgoal == "whole" else 1),
    "succeeded": lambda state: state["angle"] >= 2,
}


def test_an_id_and_subgoals_are_enough_and_people_can_answer() -> None:
    domain = lake()
    assert [result.failures for result in check(domain) if result.failures] == []
    assert domain.name == "frozenlake-v1"
    assert domain.observation_shape == (16,)
    assert not isinstance(domain, Solved)
    assert not isinstance(domain, Ending)
    assert not isinstance(domain, Restorable)


def test_an_instance_is_a_seed_that_fixes_the_whole_episode() -> None:
    domain, episodes = lake(), []
    for _ in range(2):
        env = domain.make_env()
        env.reset(options={"instance": 7})
        views = []
        for step in range(12):
            *_, terminated, truncated, _ = env.step(np.int64(step % 4))
            views.append(domain.state_view(env))
            if terminated or truncated:
                break
        episodes.append(views)
    assert episodes[0] == episodes[1]
    train, test = domain.instances("random").train, domain.instances("random").test
    assert not set(train) & set(test)


def test_the_wrapped_environment_passes_gymnasiums_checker() -> None:
    with pytest.warns(UserWarning, match=r"infinity|spec"):
        check_env(lake().make_env())


def test_names_stand_for_continuous_actions_and_pictures_get_their_channels_first() -> None:
    domain = arm()
    env = domain.make_env()
    observation, _ = env.reset(options={"instance": {"options": {"angle": 1.0}}})
    assert domain.actions == ("back", "forth")
    assert observation.shape == domain.observation_shape == (3, 12, 16)
    assert observation.dtype == np.uint8
    env.step(np.int64(domain.actions.index("forth")))
    assert domain.state_view(env) == {"angle": 1.5}


def test_without_succeeded_a_rewarded_end_is_a_success() -> None:
    domain = arm()
    env = domain.make_env()
    env.reset(options={"instance": {"options": {"angle": 1.6}}})
    assert not domain.succeeded(env)
    env.step(np.int64(1))
    assert domain.succeeded(env)


def test_an_episode_is_cut_at_the_full_horizon() -> None:
    env = arm().make_env()
    env.reset(options={"instance": 1})
    ends = [env.step(np.int64(0))[3] for _ in range(12)]
    assert ends == [False] * 11 + [True]


def test_the_environments_own_picture_is_used_and_another_one_replaces_it() -> None:
    assert isinstance(lake(), Pictured)
    assert not isinstance(arm(), Pictured)
    domain = arm(picture=lambda env: np.moveaxis(np.zeros((3, 5, 6), np.uint8), 0, -1))
    env = domain.make_env()
    env.reset(options={"instance": 1})
    assert domain.frame(env).shape == (5, 6, 3)


def test_landmarks_are_given_by_the_names_of_subgoals() -> None:
    assert not isinstance(arm(), Landmarked)
    domain = arm(landmarks=lambda state: {"whole": (0, 0, state["angle"] / 4, 1)})
    assert domain.landmarks(None, {"angle": 2}) == {1: (0, 0, 0.5, 1)}
    with pytest.raises(ValueError, match="'nothing' is no subgoal; the subgoals are: half, whole"):
        arm(landmarks=lambda state: {"nothing": (0, 0, 1, 1)}).landmarks(None, {})


def test_places_of_actions_are_given_by_the_names_of_actions() -> None:
    assert not isinstance(arm(), ActionLandmarked)
    domain = arm(action_landmarks=lambda state: {"forth": (0, 0, state["angle"] / 4, 1)})
    assert not isinstance(domain, Landmarked)
    assert domain.action_landmarks(None, {"angle": 2}) == {domain.actions.index("forth"): (0, 0, 0.5, 1)}
    with pytest.raises(ValueError, match="'half' is no action; the actions are: "):
        arm(action_landmarks=lambda state: {"half": (0, 0, 1, 1)}).action_landmarks(None, {})


def test_rules_in_names_make_an_oracle() -> None:
    domain = arm(
        **EXPERT,
        good_subgoals=lambda state: ["half"] if state["angle"] < 1 else ["whole"],
        good_actions=lambda origin, state, subgoal: ["forth"],
    )
    assert [result.failures for result in check(domain) if result.failures] == []
    assert domain.oracle.good_subgoals(None, {"angle": 1.2}) == [1]


@pytest.mark.parametrize(
    "model",
    [
        {"successor": lambda state, action: {"angle": state["angle"] + (0.5 if action == "forth" else -0.5)}},
        {"restore": lambda env, state: setattr(env.unwrapped, "angle", state["angle"])},
    ],
    ids=["successor", "restore"],
)
def test_a_search_finds_the_oracle_from_what_the_author_knows(model: dict[str, Any]) -> None:
    domain = arm(**EXPERT, **model)
    assert [result.failures for result in check(domain) if result.failures] == []
    assert domain.oracle.good_subgoals(None, {"angle": 0.25}) == (0, 1), "both lead there with as many actions"
    assert domain.oracle.good_actions(None, {"angle": 0.25}, {"angle": 0.25}, 1) == (1,)


@pytest.mark.parametrize(
    ("given", "told"),
    [
        ({"horizons": None}, "the environment has no time limit"),
        ({"actions": None}, "give each action a name"),
        ({"name": None}, "needs a name"),
        ({"instances": {"train": [1]}}, 'instances must be {"train"'),
        ({"observe": lambda seen: seen[0]}, "write observe=..."),
        ({"good_subgoals": lambda state: ["half"]}, "also needs reached and succeeded"),
        ({**EXPERT, "good_subgoals": lambda state: ["half"]}, "needs both good_subgoals and good_actions"),
    ],
)
def test_what_is_missing_is_said(given: dict[str, Any], told: str) -> None:
    with pytest.raises(ValueError, match=r".") as refused:
        arm(**given)
    assert told in str(refused.value)


def test_an_unknown_environment_and_unknown_names_are_said() -> None:
    with pytest.raises(ValueError, match="Gymnasium cannot make 'Nowhere-v0'"):
        waypost.domain("Nowhere-v0", ["a"])
    domain = arm(**EXPERT, good_subgoals=lambda state: ["third"], good_actions=lambda origin, state, subgoal: ["up"])
    with pytest.raises(ValueError, match="'third' is no subgoal; the subgoals are: half, whole"):
        domain.oracle.good_subgoals(None, {"angle": 0})


def test_a_domain_in_a_file_is_found_by_its_place(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "lakes.py").write_text(
        "import waypost\nsmall = waypost.domain('FrozenLake-v1', ['cross'], horizons=(9, 9, 99))\n"
    )
    monkeypatch.chdir(tmp_path)
    monkeypatch.syspath_prepend(str(tmp_path))
    assert find_domain("lakes:small").name == "frozenlake-v1"
