"""The cost model: what an answer costs, the most it can cost, and the price that an annotator is told."""

from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from waypost import prices, wire

UNITS = st.integers(0, 10**8).map(lambda micro: micro / 1_000_000)
PRICES = st.builds(wire.Prices, subgoal=UNITS, action=UNITS, termination=UNITS, inspect_full=UNITS, inspect_lo=UNITS)
LENGTHS = st.lists(st.integers(0, 6), min_size=1, max_size=5)


def segment(n_actions: int) -> wire.Segment:
    return wire.Segment(subgoal="north", states=list(range(n_actions + 1)), actions=["up"] * n_actions)


def ask(kind: str, lengths: list[int]) -> Any:
    model = {
        "inspect_full": wire.AskInspectFull,
        "label_hi": wire.AskLabelHi,
        "inspect_lo": wire.AskInspectLo,
        "label_lo": wire.AskLabelLo,
        "label_full": wire.AskLabelFull,
    }[kind]
    segments = [segment(length) for length in lengths]
    if kind in {"inspect_lo", "label_lo"}:
        segments = segments[:1]
    return model(episode=0, ordinal=0, question="", instance=None, kind=kind, segments=segments)  # type: ignore[arg-type]


def answer(asked: Any) -> Any:
    n_actions = sum(len(one.actions) for one in asked.segments)
    match asked.kind:
        case "label_hi":
            return wire.LabelHiAnswer(kind="label_hi", subgoals=["south"] * len(asked.segments))
        case "label_lo":
            ends = [False] * n_actions + [True]
            return wire.LabelLoAnswer(kind="label_lo", actions=["up"] * n_actions, terminations=ends)
        case "label_full":
            return wire.LabelFullAnswer(kind="label_full", actions=["up"] * n_actions)
        case kind:
            return wire.InspectAnswer(kind=kind, verdict="pass")


def demonstration(lengths: list[int], flat: bool) -> tuple[wire.AskHierDemo, wire.HierDemoAnswer]:
    moves = [wire.DemoSegment(subgoal=None if flat else "north", actions=["up"] * length) for length in lengths]
    asked = wire.AskHierDemo(
        episode=0, ordinal=0, question="", instance=None, kind="hier_demo", state=0, flat=flat,
        max_segments=max(len(lengths), 1), max_actions=sum(lengths),
    )  # fmt: skip
    return asked, wire.HierDemoAnswer(kind="hier_demo", segments=moves)


def test_the_papers_prices_are_the_length_of_a_label_and_one_per_inspection() -> None:
    paper = wire.Prices()
    costs = {kind: prices.cost(answer(ask(kind, [3, 2])), paper) for kind in wire.KINDS if kind != "hier_demo"}
    assert {kind: prices.to_units(cost.units) for kind, cost in costs.items()} == {
        "inspect_full": 1, "label_hi": 2, "inspect_lo": 1, "label_lo": 3 + 1, "label_full": 5,
    }  # fmt: skip
    assert {kind: prices.to_units(cost.lo) for kind, cost in costs.items()} == {
        "inspect_full": 0, "label_hi": 0, "inspect_lo": 0, "label_lo": 4, "label_full": 5,
    }  # fmt: skip
    _, shown = demonstration([3, 2], flat=False)
    assert prices.cost(shown, paper) == prices.Cost(9_000_000, 7_000_000)  # 2 subgoals; 5 actions and 2 terminations


@pytest.mark.parametrize("kind", [kind for kind in wire.KINDS if kind != "hier_demo"])
@given(lengths=LENGTHS, run=PRICES)
def test_every_answer_but_a_demonstration_costs_just_what_is_reserved_and_what_the_annotator_is_told(
    kind: str, lengths: list[int], run: wire.Prices
) -> None:
    asked = ask(kind, lengths)
    cost = prices.cost(answer(asked), run)
    assert cost == prices.highest_cost(asked, run)
    assert prices.price(asked, run) == wire.Price(fixed=prices.to_units(cost.units), per_action=0, per_segment=0)


@given(lengths=st.lists(st.integers(1, 6), min_size=1, max_size=5), flat=st.booleans(), run=PRICES)
def test_a_demonstration_costs_what_the_annotator_is_told_and_never_more_than_is_reserved(
    lengths: list[int], flat: bool, run: wire.Prices
) -> None:
    lengths = lengths[:1] if flat else lengths
    asked, shown = demonstration(lengths, flat)
    cost, told = prices.cost(shown, run), prices.price(asked, run)
    n_segments = 0 if flat else len(lengths)
    assert cost.units <= prices.highest_cost(asked, run).units
    assert told.fixed + told.per_action * sum(lengths) + told.per_segment * n_segments == pytest.approx(
        prices.to_units(cost.units)
    )


@given(micro=st.integers(0, 10**15))
def test_amounts_survive_the_wire(micro: int) -> None:
    assert prices.to_micro(prices.to_units(micro)) == micro
