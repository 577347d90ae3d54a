"""The web app knows the standard wordings of learners and of the server: it says them in its own language."""

import json
import re
from collections.abc import Iterator
from dataclasses import replace
from typing import Any, get_args

import pytest
from tests.repository.kit import ROOT

import waypost
from waypost import wire
from waypost.trajectory import Segment
from waypost_learner.algorithms.queries import HierDemo, InspectFull, InspectLo, LabelFull, LabelHi, LabelLo, Query
from waypost_learner.domains.corridor import Corridor, CorridorDomain
from waypost_learner.remote.translation import Translator
from waypost_learner.rollout.simulator import Simulator
from waypost_server.gold.practice import SHIPPED
from waypost_server.runs.futures import Future, Futures

WORDINGS = json.loads((ROOT / "web/src/api/wordings/wordings.json").read_text())
EAST = 1


def is_known(text: str) -> bool:
    """Whether the web app has this wording."""
    patterns = (re.escape(wording).replace(r"\{\}", ".+") for wording in WORDINGS.values())
    return any(re.fullmatch(pattern, text) for pattern in patterns)


def of_learners() -> Iterator[Query]:
    """Queries of every kind, in every form."""
    simulator = Simulator(CorridorDomain())
    start = simulator.reset(Corridor(0, 6))
    one = Segment(EAST, (start, simulator.step(EAST)), (EAST,), terminated=True)
    yield from (InspectFull((one,)), LabelHi((one,)), LabelHi((one, one)), InspectLo(one), LabelLo(one))
    yield LabelFull((one,))
    for before in ((), (one,)):
        state = one.states[-1] if before else start
        yield from (HierDemo(state, before=before), HierDemo(state, before=before, max_segments=1))
        yield HierDemo(state, before=before, flat=True)


def of_scripts() -> Iterator[wire.Ask]:
    """The same from a training script."""
    one = waypost.Segment(states=[0, 1], actions=["east"], subgoal="east")
    whole: list[Any] = [[one]]
    for kind in (waypost.InspectFull, waypost.LabelHi, waypost.LabelFull):
        yield kind(*whole, episode=0).message(0)
    for kind in (waypost.InspectLo, waypost.LabelLo):
        yield kind(one, episode=0).message(0)
    for n_segments, flat in ((1, False), (5, False), (5, True)):
        demonstration = waypost.HierDemo(1, n_segments, 9, flat=flat, episode=0)
        yield from (demonstration.message(0), replace(demonstration, context=[one]).message(0))


def test_every_question_of_a_learner_has_a_known_wording() -> None:
    asks = [Translator(CorridorDomain(), Corridor(0, 6)).ask(query, 0, 0) for query in of_learners()]
    assert {one.question for one in [*asks, *of_scripts()] if not is_known(one.question)} == set()
    kinds = {one.kind for one in asks}
    assert kinds == {one.kind for one in of_scripts()} == set(get_args(wire.Kind))


def test_every_practice_question_has_a_known_wording() -> None:
    shipped = json.loads(SHIPPED.read_text())
    assert all(is_known(one["ask"]["question"]) for one in shipped["exercises"] + shipped["demonstrations"])


@pytest.mark.parametrize("finished", [0, 1])
@pytest.mark.parametrize("found", [(), (Future(1.0, dict.fromkeys(("0.9",), float("inf"))),)])
def test_why_a_forecast_comes_too_early_has_a_known_wording(finished: int, found: tuple[Future, ...]) -> None:
    why = Futures(found, 0.0, finished, 3).too_early("0.9")
    assert why is not None
    assert is_known(why)
