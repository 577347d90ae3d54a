"""Configurations: everything that they name is built, and what would be ignored is refused."""

from dataclasses import replace

import pytest

from waypost_learner.experiments import plan
from waypost_learner.runs.config import TrainConfig
from waypost_learner.runs.setup import build_learner, set_up

PLANNED = plan.runs_of(list(plan.GROUPS.values()), seeds=(0,))
DISTINCT = list(dict.fromkeys(replace(run, instances="random", episodes=1) for run in PLANNED))


@pytest.mark.parametrize("config", DISTINCT, ids=lambda run: f"{run.algorithm} {run.preset} {run.values}")
def test_every_run_of_the_figures_is_one_that_can_be_set_up(config: TrainConfig) -> None:
    assert set_up(config, threads=1).config == config


@pytest.mark.parametrize("algorithm", ["h-bc", "flat-bc", "h-dqn", "flat-dqn"])
def test_a_warm_start_is_for_algorithms_that_have_one(algorithm: str) -> None:
    with pytest.raises(ValueError, match=f"{algorithm} has no warm start: leave out --warm-start"):
        set_up(TrainConfig(algorithm, domain="corridor", warm_start=2), threads=1)


@pytest.mark.parametrize(
    ("algorithm", "domain", "values", "said"),
    [
        ("h-bc", "maze", "warm_start=5", "h-bc has no warm start"),
        ("hg-dagger", "maze", "train_flat.batch=32", "has no flat policy that imitates"),
        ("flat-dagger", "maze", "train_lo.batch=32", "has no pi_g that imitates"),
        ("flat-dagger", "maze", "train_hi.idle=0", "has no mu that imitates"),
        ("flat-dagger", "maze", "h_hi=5", "has no subgoals"),
        ("flat-dagger", "maze", "choosing.termination_threshold=0.8", "has no beta_g"),
        ("flat-dagger", "maze", "tied=true", "has no subgoals"),
        ("flat-dagger", "corridor", "relabeling=true", "declares no relabeling for it"),
        ("flat-dagger", "corridor", "planning=16", "no policy of flat-dagger has a view"),
        ("hg-dagger", "maze", "dqn.batch=32", "has no Q-function"),
        ("hg-dagger", "maze", "network.hidden=64", "all its networks plan"),
        ("hg-dagger", "maze", "train_hi_hybrid.batch=32", "has no mu that imitates beside Q-functions"),
        ("hg-dagger-q", "maze", "train_hi.batch=32", "trains it with train_hi_hybrid"),
        ("h-dqn", "maze", "choosing.temperature=0.2", "chooses epsilon-greedily"),
        ("flat-dqn", "maze", "dqn.pseudo.step=-0.1", "has no Q-function of a subgoal"),
        ("hg-dagger-q", "corridor", "dqn.exploration.wander=9", "the domain .corridor. declares no places"),
        ("hg-dagger", "corridor", "planning=16", "no policy of hg-dagger has a view"),
        ("hg-dagger", "maze", "monitoring.rate=0.8", "monitoring.share is 1"),
        ("hg-dagger", "maze", "gate.share=0.1", "asks without a gate"),
        ("hg-gated", "maze", "monitoring.share=0.5", "only hg-dagger, .* are monitored"),
        ("h-bc", "maze", "from_passed=true", "in h-bc the expert passes nothing that a policy could imitate"),
    ],
)
def test_a_value_without_effect_is_refused_with_the_reason(algorithm: str, domain: str, values: str, said: str) -> None:
    name, _, _ = values.partition("=")
    with pytest.raises(ValueError, match=rf"^{name} has no effect: .*{said}.*; leave it out of --values$"):
        set_up(TrainConfig(algorithm, domain=domain, values=values), threads=1)


@pytest.mark.parametrize(
    ("algorithm", "domain", "values"),
    [
        ("flat-dagger", "maze", "views=false planning=null tied=false relabeling=false repeat_penalty=0"),
        ("hg-dagger", "corridor", "planning=null"),
        ("hg-dagger", "maze", "planning=null network.hidden=64"),
        ("hg-dagger-q", "maze", "train_hi_hybrid.batch=32 dqn.batch=32"),
        ("hg-dagger", "maze", "monitoring.share=0.5 monitoring.rate=0.8"),
    ],
)
def test_values_with_an_effect_and_switched_off_ones_are_accepted(algorithm: str, domain: str, values: str) -> None:
    set_up(TrainConfig(algorithm, domain=domain, values=values), threads=1)


def test_a_learner_of_an_older_run_is_built_though_some_values_had_no_effect() -> None:
    assert build_learner(TrainConfig("h-bc", domain="corridor", warm_start=2), threads=1).preset.warm_start == 2


def test_an_algorithm_that_asks_once_per_place_is_told_places() -> None:
    by_place = TrainConfig("hg-dagger-by-place", preset="paper")
    assert set_up(by_place, threads=1).told == "structure"
    assert set_up(replace(by_place, algorithm="hg-dagger"), threads=1).told == "nothing"
    with pytest.raises(ValueError, match="asks once per place, and --told crop tells no places: leave out --told"):
        set_up(replace(by_place, told="crop"), threads=1)
    missing = set_up(replace(by_place, domain="corridor"), threads=1).missing
    assert missing["places to label once"] == "Each segment is labeled."
