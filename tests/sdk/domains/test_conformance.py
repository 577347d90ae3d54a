"""`waypost domain check`: a correct domain passes, and each fault of a faulty one is named with its remedy."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from gymnasium import spaces
from tests.sdk.domains.kit import LineDomain, LineEnv, LineOracle

from waypost.domains import Horizons, InstanceSets, Symmetry, View
from waypost.domains.conformance import check, check_domain

Fault = Callable[[], Any]


def with_env(**members: Any) -> Any:
    """The line with an environment in which some members are replaced."""
    env = type("FaultyEnv", (LineEnv,), members)
    return type("Faulty", (LineDomain,), {"make_env": lambda self: env()})()


def with_oracle(**members: Any) -> Any:
    """The line with an oracle in which some members are replaced."""
    domain = LineDomain()
    domain.oracle = type("FaultyOracle", (LineOracle,), members)()
    return domain


def with_members(**members: Any) -> Any:
    """The line with other members."""
    return type("Faulty", (LineDomain,), members)()


def without(member: str) -> Any:
    """The line without a member."""
    return type("Partial", (), {n: m for n, m in vars(LineDomain).items() if n != member} | {"oracle": LineOracle()})()


def steps(self: Any, action: Any) -> Any:
    """The steps of an environment that raises at the third."""
    if self.steps == 2:
        raise ZeroDivisionError("speed is 0")
    return LineEnv.step(self, action)


def random_step(self: Any, action: Any) -> Any:
    return LineEnv.step(self, int(np.random.default_rng().integers(2)))


def shared_array(self: Any) -> Any:
    """An observation whose array is used again for the next one."""
    if not hasattr(self, "array"):
        self.array = np.zeros(6, np.float32)
    self.array[:] = np.eye(6, dtype=np.float32)[self.cell]
    return self.array


FAULTS: dict[str, tuple[Fault, str]] = {
    "no horizons": (lambda: without("horizons"), "The domain has no horizons"),
    "a text instead of names": (lambda: with_members(subgoals="middle"), "it must be a tuple of names"),
    "a name twice": (lambda: with_members(actions=("go", "go")), "actions contains a name twice"),
    "horizons of zero": (lambda: with_members(horizons=Horizons(0, 4, 12)), "each must be at least 1"),
    "a matrix as observation": (lambda: with_members(observation_shape=(2, 3)), "write (features,) or"),
    "a tiny picture": (lambda: with_members(observation_shape=(3, 7, 7)), "at least 10 rows and columns"),
    "no test instances": (lambda: with_members(instances=lambda s, n: InstanceSets([0], [])), ".test is empty"),
    "three actions, two names": (lambda: with_env(action_space=spaces.Discrete(3)), "3 actions, but actions has 2"),
    "continuous actions": (lambda: with_env(action_space=spaces.Box(-1, 1, (2,))), "it must be Discrete(2)"),
    "the wrong shape": (lambda: with_env(observe=lambda s: np.zeros(5, np.float32)), "has the shape (5,)"),
    "doubles": (lambda: with_env(observe=lambda s: np.zeros(6)), "return float32 or uint8"),
    "nan": (lambda: with_env(observe=lambda s: np.full(6, np.nan, np.float32)), "contains nan"),
    "a list as observation": (lambda: with_env(observe=lambda s: [0.0] * 6), "return a numpy array"),
    "a set as view": (lambda: with_members(state_view=lambda s, e: {e.cell}), "what JSON cannot hold"),
    "a tuple as view": (lambda: with_members(state_view=lambda s, e: (e.cell,)), "use lists instead of tuples"),
    "an enormous view": (lambda: with_members(state_view=lambda s, e: [0] * 60_000), "leave out what no expert needs"),
    "solved at the start": (lambda: with_members(succeeded=lambda s, e: True), "true at the start"),
    "endless episodes": (
        lambda: with_env(step=lambda s, a: (*LineEnv.step(s, 0)[:2], False, False, {})),
        "did not end within 12 actions",
    ),
    "an exception in an episode": (lambda: with_env(step=steps), "raised ZeroDivisionError: speed is 0"),
    "one array for all observations": (lambda: with_env(observe=shared_array), "return a copy"),
    "random beyond the seed": (lambda: with_env(step=random_step), "gave another state after"),
    "a grey picture": (lambda: with_members(frame=lambda s, e: np.zeros((8, 8), np.uint8)), "(rows, columns, 3)"),
    "a landmark by name": (lambda: with_members(landmarks=lambda s, i, v: {"end": (0, 0, 1, 1)}), "by the numbers"),
    "a landmark in pixels": (lambda: with_members(landmarks=lambda s, i, v: {0: (3, 4, 9, 8)}), "as shares of"),
    "a landmark without a side": (lambda: with_members(landmarks=lambda s, i, v: {0: (0, 0, 1)}), "as shares of"),
    "a place of an action by name": (
        lambda: with_members(action_landmarks=lambda s, i, v: {"left": (0, 0, 1, 1)}),
        "by the numbers of actions, 0 to 1",
    ),
    "a place of an action in pixels": (
        lambda: with_members(action_landmarks=lambda s, i, v: {1: (3, 4, 9, 8)}),
        "action_landmarks returns (3, 4, 9, 8) for action 1; return its left, upper",
    ),
    "a list as place": (lambda: with_members(place=lambda s, v: [v]), "return a tuple instead"),
    "a view of another shape": (
        lambda: with_members(lo_view=View((3,), lambda seen: seen)),
        "lo_view.observe returns the shape (6,)",
    ),
    "a centered view of another shape": (
        lambda: with_members(centered_view=View((3,), lambda seen: seen)),
        "centered_view.observe returns the shape (6,)",
    ),
    "a crop of another shape": (
        lambda: with_members(crop_view=View((3,), lambda seen: seen)),
        "crop_view.observe returns the shape (6,)",
    ),
    "a symmetry that loses an action": (
        lambda: with_members(symmetries=(Symmetry(lambda seen: seen, (0, 1), (0, 0)),)),
        "no reordering of all 2 actions",
    ),
    "an unknown outcome": (lambda: with_members(outcome=lambda *_: "done"), 'return "reached", "failed" or None'),
    "no good subgoal": (lambda: with_oracle(good_subgoals=lambda *_: []), "return at least one number of a subgoal"),
    "a subgoal that is reached": (
        lambda: with_oracle(good_subgoals=lambda s, i, state: [0] if state <= 3 else [1]),
        "where it is reached already",
    ),
    "a wrong prediction": (lambda: with_oracle(successor=lambda s, i, state, a: state), "successor returns"),
    "an oracle that turns back": (
        lambda: with_oracle(good_actions=lambda s, i, o, state, g: [1] if state < 2 else [0]),
        "The oracle needs more than 6 actions",
    ),
    "snapshots without restore": (lambda: with_members(replay="snapshots"), "no functions snapshot(env) and restore"),
}


def test_a_correct_domain_passes_every_check() -> None:
    results = check(LineDomain())
    assert [result.failures for result in results] == [()] * len(results)
    assert [result.check for result in results][-1] == "the oracle solves instances"


@pytest.mark.parametrize("name", FAULTS)
def test_a_fault_is_explained_in_one_sentence(name: str) -> None:
    fault, told = FAULTS[name]
    failures = check(fault())[-1].failures
    assert len(failures) == 1, failures
    assert told in failures[0]
    assert failures[0].endswith(".")
    assert "\n" not in failures[0]


@pytest.mark.parametrize("name", ["maze", "corridor"])
def test_the_domains_that_come_with_waypost_pass(name: str) -> None:
    assert [result.failures for result in check_domain(name) if result.failures] == []


@pytest.mark.parametrize(
    ("place", "told"),
    [
        ("chess", "there is no domain 'chess'"),
        ("nowhere:domain", "there is no module 'nowhere'"),
        ("broken:domain", "raised KeyError: 'board' (broken.py, line 1"),
        ("empty:domain", "the module 'empty' has no 'domain'"),
        ("empty:other", "it has no name, subgoals"),
    ],
)
def test_a_domain_that_cannot_be_loaded_is_explained(
    place: str, told: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "broken.py").write_text("{}['board']\n")
    (tmp_path / "empty.py").write_text("class other: pass\n")
    monkeypatch.chdir(tmp_path)
    monkeypatch.syspath_prepend(str(tmp_path))
    (result,) = check_domain(place)
    assert told in result.failures[0]
