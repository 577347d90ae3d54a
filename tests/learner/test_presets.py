"""Presets by name, and with other values."""

from dataclasses import replace

import pytest

from waypost_learner.presets import PRESETS, find_preset

PAPER = PRESETS["paper"]


@pytest.mark.parametrize("values", [None, ""])
def test_without_other_values_a_preset_is_as_its_file_has_it(values: str | None) -> None:
    assert find_preset("paper", values) == PAPER


def test_the_order_of_other_values_does_not_matter() -> None:
    assert find_preset("lean", "symmetries=false tied=false") == find_preset("lean", "tied=false symmetries=false")


def test_other_values_stand_in_the_place_of_the_presets() -> None:
    changed = find_preset("paper", "h_hi=null train_hi.batch=64 network.channels=[8,8] train_hi.dropout=0")
    train_hi = replace(PAPER.train_hi, batch=64, dropout=0)
    assert changed == replace(PAPER, h_hi=None, train_hi=train_hi, network=replace(PAPER.network, channels=(8, 8)))


@pytest.mark.parametrize(
    ("values", "said"),
    [
        ("relabelling=false", r"no value 'relabelling'; those that exist are: .*relabeling"),
        ("train_hi.batches=3", r"no value 'batches'; those that exist are: .*batch"),
        ("relabeling", r"'' is no value for 'relabeling': write relabeling=VALUE, a JSON value as false is"),
        ("relabeling=no", r"'no' is no value for 'relabeling'"),
        ("relabeling=1", r"'1' is no value for 'relabeling'"),
        ("warm_start=2.5", r"'2.5' is no value for 'warm_start'"),
        ("warm_start=null", r"'null' is no value for 'warm_start'"),
        ("network.channels=[8,true]", r"is no value for 'channels'"),
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
