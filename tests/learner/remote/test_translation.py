"""Queries keep their meaning on the wire, and so do answers on the way back."""

from typing import Any

import pytest

from waypost import prices as pricing
from waypost import wire
from waypost.trajectory import Segment, Trajectory
from waypost_learner.algorithms.queries import HierDemo, InspectFull, InspectLo, LabelFull, LabelHi, LabelLo
from waypost_learner.domains.corridor import Corridor, CorridorDomain
from waypost_learner.experts.oracle import OracleExpert
from waypost_learner.policies.labels import LoLabels
from waypost_learner.remote.translation import Translator, vocabulary
from waypost_learner.rollout.simulator import Simulator
from waypost_server.queries import checks

WEST, EAST, TARGET = range(3)
domain = CorridorDomain()
instance = Corridor(0, 6)
translator = Translator(domain, instance)


def walked(*segments: tuple[int | None, list[int]]) -> Trajectory:
    simulator = Simulator(domain)
    state, sigma = simulator.reset(instance), []
    for subgoal, actions in segments:
        states = [state, *(simulator.step(action) for action in actions)]
        sigma.append(Segment(subgoal, tuple(states), tuple(actions), terminated=True))
        state = states[-1]
    return tuple(sigma)


sigma = walked((EAST, [1] * 4), (WEST, [1, 0]))


@pytest.mark.parametrize(
    "query",
    [
        HierDemo(sigma[0].start),
        InspectFull(sigma),
        LabelHi(sigma),
        InspectLo(sigma[1], before=sigma[:1]),
        LabelLo(sigma[1], before=sigma[:1]),
        LabelFull(walked((None, [1, 1, 0]))),
    ],
)
def test_every_query_is_what_the_server_accepts_and_carries_its_key_and_the_instance(query: Any) -> None:
    ask = translator.ask(query, episode=4, ordinal=2)
    checks.check_ask(ask, checks.Names.of(vocabulary(domain)), ["query"])
    assert (ask.episode, ask.ordinal) == (4, 2)
    assert ask.instance == {"cells": 13, "start": 0, "target": 6}


def test_segments_cross_the_wire_with_their_names_states_and_what_came_before() -> None:
    ask = translator.ask(LabelLo(sigma[1], before=sigma[:1]), 0, 3)
    assert isinstance(ask, wire.AskLabelLo)
    assert ask.segments == [wire.Segment(subgoal="west", states=[4, 5, 4], actions=["east", "west"])]
    assert ask.context == [wire.Segment(subgoal="east", states=[0, 1, 2, 3, 4], actions=["east"] * 4)]
    assert ask.suggestion == wire.LabelLoAnswer(
        kind="label_lo", actions=["east", "west"], terminations=[False, False, True]
    )
    assert "west" in ask.question


def test_the_suggestion_of_label_hi_is_what_the_learner_chose() -> None:
    ask = translator.ask(LabelHi(sigma), 0, 1)
    assert ask.suggestion == wire.LabelHiAnswer(kind="label_hi", subgoals=["east", "west"])


def test_label_hi_can_be_of_one_segment_with_what_came_before() -> None:
    ask = translator.ask(LabelHi(sigma[1:], before=sigma[:1]), 0, 1)
    whole = translator.ask(LabelHi(sigma), 0, 1)
    assert (ask.context, ask.segments) == (whole.segments[:1], whole.segments[1:])
    assert ask.suggestion == wire.LabelHiAnswer(kind="label_hi", subgoals=["west"])
    assert "this segment" in ask.question
    assert "each segment" in whole.question
    assert pricing.cost(ask.suggestion, wire.Prices()).units == pricing.cost(whole.suggestion, wire.Prices()).units // 2


def test_answers_come_back_as_numbers() -> None:
    assert translator.answer(wire.InspectAnswer(kind="inspect_lo", verdict="pass")) is True
    assert translator.answer(wire.InspectAnswer(kind="inspect_full", verdict="fail")) is False
    assert translator.answer(wire.LabelHiAnswer(kind="label_hi", subgoals=["target", "west"])) == (TARGET, WEST)
    labels = wire.LabelLoAnswer(kind="label_lo", actions=["east", None], terminations=[False, True, False])
    assert translator.answer(labels) == LoLabels((1, None), (False, True, False))
    assert translator.answer(wire.LabelFullAnswer(kind="label_full", actions=["west"])) == (0,)


def test_a_demonstration_is_carried_out_again_to_see_what_the_networks_would_have_seen() -> None:
    ask = translator.ask(HierDemo(sigma[0].start), 0, 0)
    replayed: Any = translator.answer(OracleExpert(domain)(ask))
    assert [(s.subgoal, s.actions, [x.view for x in s.states]) for s in replayed] == [
        (EAST, (1, 1, 1, 1), [0, 1, 2, 3, 4]),
        (TARGET, (1, 1), [4, 5, 6]),
    ]
    assert (replayed[0].states[-1].observation == replayed[1].states[0].observation).all()


def test_a_demonstration_that_goes_on_after_the_end_is_cut_there() -> None:
    overlong = wire.HierDemoAnswer(
        kind="hier_demo",
        segments=[
            wire.DemoSegment(subgoal="target", actions=["east"] * 9),
            wire.DemoSegment(subgoal="west", actions=["west"]),
        ],
    )
    replayed: Any = translator.answer(overlong)
    assert [(s.subgoal, len(s.actions)) for s in replayed] == [(TARGET, 6)]
