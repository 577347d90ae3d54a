"""Presets by name, and with other values."""

from dataclasses import fields, replace

import pytest

from waypost_learner.presets import PRESETS, find_preset
from waypost_learner.presets.base import groups_by_value, value_of
from waypost_learner.runs.config import TrainConfig
from waypost_learner.runs.setup import set_up

LEAN, PAPER = PRESETS["lean"], PRESETS["paper"]


@pytest.mark.parametrize("values", [None, ""])
def test_without_other_values_a_preset_is_as_its_file_has_it(values: str | None) -> None:
    assert find_preset("paper", values) == PAPER


def test_the_order_of_other_values_does_not_matter() -> None:
    assert find_preset("lean", "symmetries=false tied=false") == find_preset("lean", "tied=false symmetries=false")


def test_other_values_stand_in_the_place_of_the_presets() -> None:
    changed = find_preset("paper", "h_hi=null train_hi.batch=64 network.hidden=64 train_hi.dropout=0")
    training, rollouts = PAPER.training, PAPER.rollouts
    train_hi = replace(training.train_hi, batch=64, dropout=0)
    training = replace(training, train_hi=train_hi, network=replace(training.network, hidden=64))
    assert changed == replace(PAPER, rollouts=replace(rollouts, h_hi=None), training=training)
    assert changed == PAPER.with_values(h_hi=None, train_hi=train_hi, network=training.network)


def test_the_names_of_values_are_unique_across_groups() -> None:
    names = [field.name for field in fields(PAPER) if field.name not in ("rollouts", "training", "use")]
    names += [field.name for group in (PAPER.rollouts, PAPER.training, PAPER.use) for field in fields(group)]
    assert len(names) == len(set(names))
    assert set(groups_by_value(PAPER)) == set(names)
    assert {"relabeling", "train_hi", "h_hi", "warm_start", "monitoring", "choosing", "dqn"} <= set(names)


def test_a_value_is_replaced_by_its_name_in_whatever_group_it_is() -> None:
    changed = PAPER.with_values(symmetries=True, repeat_penalty=2.0, warm_start=7)
    assert (changed.use.symmetries, changed.rollouts.repeat_penalty, changed.warm_start) == (True, 2.0, 7)
    assert value_of(changed, "repeat_penalty") == 2.0
    with pytest.raises(ValueError, match="no value 'rollouts'"):
        PAPER.with_values(rollouts=None)


@pytest.mark.parametrize(
    ("preset", "values", "said"),
    [
        ("lean", "views=false", r"planning=32 needs views=true.*write planning=null too"),
        ("paper", "planning=16", r"planning=16 needs views=true"),
        ("lean", "symmetries=false", r"tied=true needs symmetries=true.*write tied=false too"),
        ("lean", "planning=0", r"planning=0 is no number of features"),
    ],
)
def test_values_that_contradict_each_other_are_refused_with_what_to_write(preset: str, values: str, said: str) -> None:
    with pytest.raises(ValueError, match=said):
        find_preset(preset, values)


def test_without_views_nothing_is_planned() -> None:
    assert find_preset("lean", "views=false planning=null").use == replace(LEAN.use, views=False, planning=None)


@pytest.mark.parametrize(
    ("values", "said"),
    [
        ("relabelling=false", r"no value 'relabelling'; the values are: .*relabeling"),
        ("train_hi.batches=3", r"no value 'batches'; the values are: .*batch"),
        (
            "network.convolutions=[[16,6,4]]",
            r"write network.convolutions=VALUE, a JSON value such as \[{\"channels\": \d+, \"kernel\": \d",
        ),
        ("relabeling", r"'' is no value for 'relabeling': write relabeling=VALUE, a JSON value such as false"),
        ("relabeling=no", r"'no' is no value for 'relabeling'"),
        ("relabeling=1", r"'1' is no value for 'relabeling'"),
        ("warm_start=2.5", r"'2.5' is no value for 'warm_start'"),
        ("warm_start=null", r"'null' is no value for 'warm_start'"),
        ("network.hidden=true", r"is no value for 'network.hidden'"),
        ("train_hi=3", r"'train_hi' is a group of values"),
        ("warm_start.batch=3", r"'warm_start' is no group of values"),
        ("train_hi=3 train_hi.batch=3", r"'train_hi' is given twice"),
        ("tied=true", r"tied=true needs symmetries=true"),
        ('warm_start="many"', r"is no value for 'warm_start'"),
    ],
)
def test_what_is_no_value_is_refused_with_what_there_is(values: str, said: str) -> None:
    with pytest.raises(ValueError, match=said):
        find_preset("paper", values)


def test_single_subgoals_can_have_other_values_of_their_q_functions() -> None:
    training = find_preset("paper", domain="montezuma").training
    assert (training.dqn_for("stair").least, training.dqn_for("key").least) == (1_000, 20_000)
    of_the_stair = replace(training.dqn, least=1_000, target_every=250, epsilon=((0, 1.0), (50_000, 0.02)))
    assert training.dqn_for("stair") == of_the_stair
    assert training.dqn_for(None) == training.dqn


@pytest.mark.parametrize(
    ("values", "said"),
    [
        ('dqn_of={"key":{"leest":5}}', "no value 'leest'; the values are: learning_rate, "),
        ('dqn_of={"key":{"least":"many"}}', "gives 'key' a value of a wrong type"),
        ('dqn_of={"keys":{"least":5}}', "names 'keys', but the subgoals are: stair, key, stair_back, door"),
    ],
)
def test_values_of_single_subgoals_that_cannot_be_are_refused(values: str, said: str) -> None:
    with pytest.raises(ValueError, match=said):
        set_up(TrainConfig("hg-dagger-q", domain="montezuma", values=values), threads=1)
