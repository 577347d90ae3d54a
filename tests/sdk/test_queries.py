"""Each kind of query of a training script, against a real server: what annotators see, and what comes back."""

from typing import Any

import numpy as np
import pytest
from tests.sdk.kit import BACK, WALK

import waypost
from waypost import wire

ANSWERS: list[tuple[Any, wire.Answer, Any]] = [
    (waypost.InspectFull([WALK], episode=0), wire.InspectAnswer(kind="inspect_full", verdict="pass"), True),
    (waypost.InspectLo(WALK, episode=0), wire.InspectAnswer(kind="inspect_lo", verdict="fail"), False),
    (
        waypost.LabelHi([WALK, BACK], episode=0),
        wire.LabelHiAnswer(kind="label_hi", subgoals=["key", "door"]),
        ("key", "door"),
    ),
    (
        waypost.LabelFull([WALK, BACK], episode=0),
        wire.LabelFullAnswer(kind="label_full", actions=["right", "left", "left"]),
        ("right", "left", "left"),
    ),
    (
        waypost.LabelLo(WALK, episode=0),
        lo := wire.LabelLoAnswer(kind="label_lo", actions=["right", None], terminations=[False, True, False]),
        lo,
    ),
    (
        waypost.HierDemo(0, max_segments=2, max_actions=9, episode=0),
        wire.HierDemoAnswer(kind="hier_demo", segments=[wire.DemoSegment(subgoal="key", actions=["left"])]),
        (wire.DemoSegment(subgoal="key", actions=["left"]),),
    ),
]


@pytest.mark.parametrize(("query", "given_answer", "received"), ANSWERS, ids=lambda one: type(one).__name__)
def test_each_kind_of_query_comes_back_with_the_answer_that_was_given(service, query, given_answer, received):
    run = service.start()
    asked = run.ask(query)
    assignment = service.lease()
    service.annotator.answer(assignment, given_answer)
    assert asked.answer(timeout=10) == received
    assert (asked.latest.annotator, asked.latest.used) == ("abe", True)


def test_annotators_see_the_instance_the_context_and_the_learners_own_choices(service):
    run = service.start()
    run.ask(waypost.LabelLo(BACK, context=[WALK], instance={"goal": 9}, episode=3, terminated=False))
    ask = service.lease().query.ask
    assert (ask.episode, ask.instance) == (3, {"goal": 9})
    assert [segment.subgoal for segment in ask.context] == ["door"]
    assert ask.suggestion == wire.LabelLoAnswer(kind="label_lo", actions=["left"], terminations=[False, False])
    assert ask.question == "It tried “key”. What should it have done at each step?"


def test_a_script_lets_somebody_play_on_from_where_its_policy_failed(service):
    run = service.start()
    run.ask(waypost.HierDemo(WALK.states[-1], max_segments=1, max_actions=4, context=[WALK], episode=3))
    ask = service.lease().query.ask
    assert (ask.state, ask.max_segments, len(ask.context)) == (WALK.states[-1], 1, 1)
    assert ask.question == "Play on until a subgoal is reached."
    with pytest.raises(ValueError, match="begins in another state"):
        run.ask(waypost.HierDemo(99, max_segments=1, max_actions=4, context=[WALK], episode=4))


def test_arrays_become_lists(service):
    run = service.start()
    states = np.array([[0.5, 1], [2, 3]], np.float32)
    segment = waypost.Segment(states, ["left"])
    run.ask(waypost.InspectFull([segment], instance={"size": np.int64(3)}, episode=0))
    ask = service.lease().query.ask
    assert isinstance(ask, wire.AskInspectFull)
    assert (ask.segments[0].states, ask.instance) == ([[0.5, 1], [2, 3]], {"size": 3})


def test_pictures_are_uploaded_and_annotators_can_load_them(service):
    run = service.start()
    pictures = [np.full((4, 6, 3), shade, np.uint8) for shade in (0, 128, 128)]
    run.ask(waypost.InspectFull([waypost.Segment([0, 1, 2], ["left", "left"], pictures=pictures)], episode=0))
    ask = service.lease().query.ask
    assert isinstance(ask, wire.AskInspectFull)
    first, second, third = ask.segments[0].frames
    assert first != second == third
    assert service.annotator._http.get(f"/frames/{first}").content.startswith(b"\x89PNG")


def test_places_of_subgoals_in_the_pictures_come_with_them(service):
    run = service.start()
    door, key = (0.5, 0.1, 1, 0.2), (0, 0.25, 0.5, 0.75)
    pictures = [np.full((4, 6, 3), shade, np.uint8) for shade in (0, 128)]
    for episode, landmarks in enumerate(([{"door": door, "key": key}], [{"door": door}, {}])):
        segment = waypost.Segment([0, 1], ["left"], "door", pictures, landmarks)
        run.ask(waypost.LabelHi([segment], episode=episode))
        ask = service.lease().query.ask
        assert isinstance(ask, wire.AskLabelHi)
        found = [{g: (b.left, b.top, b.right, b.bottom) for g, b in one.items()} for one in ask.segments[0].landmarks]
        assert found == landmarks


def test_places_of_actions_are_sent_in_names_and_equal_questions_are_asked_once_whatever_the_boxes(service):
    run = service.start()
    pictures = [np.full((4, 6, 3), shade, np.uint8) for shade in (0, 128)]

    def labels(**boxes):
        segment = waypost.Segment([0, 1], ["left"], "door", pictures, **boxes)
        return waypost.LabelLo(segment, episode=0)

    asked = run.ask(labels(action_landmarks=[{"left": (0, 0, 0.5, 1)}, {}]))
    ask = service.lease().query.ask
    assert ask.segments[0].action_landmarks == [{"left": wire.Box(left=0, top=0, right=0.5, bottom=1)}, {}]
    again = run.ask(labels(landmarks=[{"door": (0, 0, 1, 1)}], action_landmarks=[{"right": (0.5, 0, 1, 1)}]))
    assert again.id == asked.id
