"""What a learner is told of its domain is limited by the level of the run, and nothing beyond the level is used."""

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from tests.learner.kit import store

from waypost_learner.algorithms.learner import Learner
from waypost_learner.domains.maze.domain import MazeDomain
from waypost_learner.policies.fields import agent_finder
from waypost_learner.policies.levels import Levels
from waypost_learner.presets import find_preset
from waypost_learner.presets.base import Preset
from waypost_learner.presets.lean import LEAN
from waypost_learner.presets.paper import PAPER
from waypost_learner.presets.told import LEVELS, STRUCTURE, level_of
from waypost_learner.rollout.policy_keys import FLAT, META, pi
from waypost_learner.runs.config import TrainConfig
from waypost_learner.runs.setup import set_up
from waypost_learner.runs.training import train

HIERARCHIES = [
    Levels(),
    Levels(q_lo=True),
    Levels(q_hi=True, q_lo=True),
    Levels(flat=True),
    Levels(flat=True, q_lo=True),
]
maze = MazeDomain()


def shapes(preset: Preset, levels: Levels) -> set[tuple[int, ...]]:
    learner = Learner(maze, preset, seed=0, levels=levels, threads=1)
    return {view.view.shape for view in learner.views.values()}


@pytest.mark.parametrize("levels", HIERARCHIES)
def test_a_learner_sees_no_more_of_an_observation_than_its_level_says(levels: Levels) -> None:
    whole, around, crop = maze.observation_shape, maze.centered_view.shape, maze.crop_view.shape
    for level in ("nothing", "symmetries"):
        assert shapes(find_preset("lean", told=level), levels) == {whole}
    assert shapes(find_preset("lean", told="centered"), levels) == {around}
    assert shapes(find_preset("lean", told="crop"), levels) == ({around} if levels.flat else {around, crop})


@pytest.mark.parametrize("level", [*LEVELS, STRUCTURE])
def test_a_preset_at_a_level_uses_that_level_and_the_levels_before_it(level: str) -> None:
    preset = find_preset("lean", told=level)
    assert level_of(preset, q_functions=True) == level
    assert (preset.rollouts.repeat_penalty > 0, preset.use.relabeling, preset.use.planning is not None) == (
        (level == STRUCTURE,) * 3
    )
    assert preset.training.dqn.symmetries == (level != "nothing")
    assert find_preset("lean", told=STRUCTURE) == LEAN
    unlimited = replace(preset, use=LEAN.use, rollouts=LEAN.rollouts)
    assert replace(unlimited, training=replace(unlimited.training, dqn=LEAN.training.dqn)) == LEAN


def test_the_papers_preset_is_told_nothing_unless_its_q_functions_learn_in_every_symmetry() -> None:
    assert level_of(PAPER, q_functions=False) == "nothing"
    assert level_of(PAPER, q_functions=True) == "symmetries"


def test_values_may_use_less_than_the_level_but_not_more() -> None:
    assert not find_preset("lean", "tied=false", told="symmetries").use.tied
    assert find_preset("lean", "centered=false", told="crop").use.crop
    for values, told, least in (
        ("symmetries=true", "nothing", "symmetries"),
        ("dqn.symmetries=true", "nothing", "symmetries"),
        ("centered=true", "symmetries", "centered"),
        ("crop=true", "centered", "crop"),
        ("repeat_penalty=1", "crop", "structure"),
        ("dqn.exploration.wander=5", "crop", "structure"),
        ("relabeling=true", "crop", "structure"),
    ):
        with pytest.raises(ValueError, match=rf"than --told {told} allows: leave .* --told {least}"):
            find_preset("lean", values, told=told)
    with pytest.raises(ValueError, match=r"than --told nothing allows: leave .* --told crop"):
        find_preset("general", "fields.reach=5", told="nothing")
    with pytest.raises(ValueError, match=r"there is no level 'much'.* nothing, symmetries, centered, crop, structure"):
        find_preset("lean", told="much")


def test_the_views_of_a_level_are_the_domains() -> None:
    learner = Learner(maze, find_preset("lean", told="crop"), seed=0, threads=1)
    assert learner.views[META].view is maze.centered_view
    assert learner.views[pi(0)].view is maze.crop_view
    flat = Learner(maze, find_preset("lean", told="crop"), seed=0, levels=Levels(flat=True), threads=1)
    assert flat.views[FLAT].view is maze.centered_view


@pytest.mark.parametrize("algorithm", ["hg-dagger", "flat-dagger", "hg-dagger-q"])
def test_a_run_that_is_told_nothing_learns_each_label_once_as_it_was_given(algorithm: str) -> None:
    learner = set_up(TrainConfig(algorithm, told="nothing"), threads=1).learner
    assert all(view.symmetry is None and view.owner == key for key, view in learner.views.items())
    observation = np.random.default_rng(0).random(maze.observation_shape, np.float32)
    assert all(view.view.observe(observation) is observation for view in learner.views.values())


def test_a_run_whose_policies_share_a_network_was_told_no_more_than_symmetries() -> None:
    for level in ("symmetries", "centered", "crop", "structure"):
        assert set_up(TrainConfig("hg-dagger", preset="general", told=level), threads=1).told == "symmetries"
    assert set_up(TrainConfig("hg-dagger", preset="general", told="nothing"), threads=1).told == "nothing"
    assert set_up(TrainConfig("hg-dagger", preset="lean", told="crop"), threads=1).told == "crop"


class Secret:
    """A part of a domain that may be found, but not used."""

    def _refuse(self, *_: Any) -> Any:
        raise AssertionError("the learner used a part of the domain that it was not told")

    __call__ = __iter__ = __len__ = __getitem__ = __getattr__ = _refuse

    def __bool__(self) -> bool:
        return True


PLACES = ("place", "relabeled", "relabeled_actions", "retraced", "hi_view", "lo_view", "flat_view", "flat_grid")


def reticent(*parts: str) -> type[MazeDomain]:
    """A maze that keeps parts secret."""
    return type("Reticent", (MazeDomain,), dict.fromkeys(parts, Secret()))


TellsNothing = reticent(*PLACES, "symmetries", "centered_view", "crop_view")
TellsSymmetries = reticent(*PLACES, "centered_view", "crop_view")
TellsTheAgent = reticent(*PLACES, "crop_view")
TellsTheCrop = reticent(*PLACES)


@pytest.mark.parametrize(
    ("told", "teller", "preset", "algorithm", "networks"),
    [
        ("nothing", "TellsNothing", "general", "hg-dagger", ["train_shared"]),
        ("nothing", "TellsNothing", "general", "flat-dagger", ["train_shared"]),
        ("nothing", "TellsNothing", "general", "hg-gated", ["train_shared"]),
        ("nothing", "TellsNothing", "lean", "hg-stagger", ["train_hi", "train_lo"]),
        ("symmetries", "TellsSymmetries", "general", "hg-dagger", ["train_shared"]),
        ("symmetries", "TellsSymmetries", "lean", "hg-dagger", ["train_hi", "train_lo"]),
        ("centered", "TellsTheAgent", "lean", "hg-dagger", ["train_hi", "train_lo"]),
        ("crop", "TellsTheCrop", "lean", "hg-dagger", ["train_hi", "train_lo"]),
    ],
)
def test_a_whole_run_uses_nothing_more_of_the_domain_than_it_is_told(
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    told: str,
    teller: str,
    preset: str,
    algorithm: str,
    networks: list[str],
) -> None:
    monkeypatch.setattr(agent_finder, "_TRIES", 1)  # to be fast
    fast = " ".join(f"{one}.least=64 {one}.most=64 {one}.idle=0" for one in networks)
    fast += " fields.far=8" if preset == "general" else ""
    domain = f"{__name__}:{teller}"
    config = TrainConfig(
        algorithm, domain, preset=preset, episodes=3, warm_start=1, told=told, test_every=3, values=fast
    )
    with store(tmp_path) as (connection, options):
        summary = train(config, connection, options)
    assert (summary["told"], summary["episodes"]) == (told, 3)
