"""What an answer leaves for those who follow a run: the trace of its episode, and the events."""

import json

import pytest
from sqlalchemy import select
from tests.server.kit import Service, query

from waypost.tracing import Step
from waypost_server.db.tables import events


@pytest.fixture
def ended(monkeypatch: pytest.MonkeyPatch) -> list[Step]:
    """The steps of traces that have ended."""
    steps: list[Step] = []
    monkeypatch.setattr(Step, "end", lambda step: steps.append(step))
    return steps


def test_the_trace_of_an_episode_has_the_lease_the_answer_its_charge_and_its_refund(
    lite: Service, ended: list[Step]
) -> None:
    run = lite.learner.create_run()
    (asked,) = lite.learner.ask(run, query("label_lo", episode=7))
    ended.clear()
    held = lite.annotator.lease()
    receipt = lite.annotator.answer(held)
    lite.annotator.retract(held)
    known = {"waypost.query": asked["id"]}
    answer = known | {"waypost.answer": receipt["answer"]}
    assert {(step.run, step.episode) for step in ended} == {(run, 7)}
    found = {step.name: step for step in ended}
    assert [step.name for step in ended] == ["lease", "charge", "answer", "refund"]
    assert found["lease"].attributes == known | {"waypost.kind": "label_lo", "waypost.assignment": held["id"]}
    assert found["answer"].attributes == answer | {"waypost.kind": "label_lo"}
    assert found["charge"].attributes == answer | {"waypost.units": 3.0}
    assert found["refund"].attributes == answer | {"waypost.units": -3.0}
    assert found["answer"].began == int(held["leased_at"] * 1e9)
    assert found["charge"].began > found["answer"].began, "answering began with the lease"


def test_events_say_what_was_answered_and_what_was_taken_back(lite: Service) -> None:
    run = lite.learner.create_run()
    (asked,) = lite.learner.ask(run, query("label_lo", episode=7))
    held = lite.annotator.lease()
    said = {"query": asked["id"], "answer": lite.annotator.answer(held)["answer"], "units": 3.0}
    lite.annotator.retract(held)
    ours = select(events.c.event, events.c.data).where(events.c.run_id == run)
    rows = lite.db.read_now(lambda tx: tx.conn.execute(ours.order_by(events.c.id)).all())
    told = [(row.event, json.loads(row.data)) for row in rows]
    assert told[-2:] == [("answered", said | {"kind": "label_lo", "episode": 7}), ("retracted", said)]
