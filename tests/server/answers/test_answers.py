"""Answers: stored, charged and closed together; refused when late; taken back until used."""

import time

import pytest
from tests.server.kit import Json, Service, in_process, query, right_answer

KINDS_AND_COSTS = [
    ("hier_demo", 4.0, 3.0),
    ("inspect_full", 1.0, 0.0),
    ("label_hi", 1.0, 0.0),
    ("inspect_lo", 1.0, 0.0),
    ("label_lo", 3.0, 3.0),
    ("label_full", 2.0, 2.0),
]


@pytest.mark.parametrize(("kind", "units", "lo_units"), KINDS_AND_COSTS)
def test_an_answer_of_each_kind_costs_what_it_labels(
    service: Service, kind: str, units: float, lo_units: float
) -> None:
    run = service.learner.create_run()
    service.learner.ask(run, query(kind))
    receipt = service.annotator.answer(service.annotator.lease())
    assert receipt["units"] == units
    costs = service.learner.costs(run)
    assert (costs["total"], costs["lo_total"], costs["reserved"]) == (units, lo_units, 0)
    assert costs["by_kind"][kind]["queries"] == 1
    (answered,) = service.learner.get(f"/runs/{run}/answers")["queries"]
    assert answered["answer"] == right_answer(query(kind))
    assert (answered["annotator"], answered["units"], answered["state"]) == ("abe", units, "answered")


def test_prices_are_the_runs_own(service: Service) -> None:
    prices = {"subgoal": 0.1, "action": 0.2, "termination": 0.4, "inspect_full": 0.5, "inspect_lo": 0}
    run = service.learner.create_run(prices=prices)
    service.learner.ask(run, query("hier_demo"), query("inspect_lo", ordinal=1))
    assert service.annotator.answer(service.annotator.lease())["units"] == pytest.approx(0.1 + 2 * 0.2 + 0.4)
    assert service.annotator.answer(service.annotator.lease())["units"] == 0


def test_the_same_answer_again_gets_the_same_receipt_and_the_same_next_assignment(service: Service) -> None:
    run = service.learner.create_run()
    service.learner.ask(run, query(), query("label_lo", ordinal=1))
    first = service.annotator.lease()
    receipt = service.annotator.answer(first, next={})
    assert receipt["next"]["query"]["ask"]["kind"] == "label_lo"
    assert service.annotator.answer(first, next={}) == receipt
    assert service.learner.costs(run)["total"] == 1


def test_another_answer_to_the_same_assignment_is_refused(service: Service) -> None:
    service.learner.ask(service.learner.create_run(), query())
    held = service.annotator.lease()
    service.annotator.answer(held)
    problem = service.annotator.answer(held, {"kind": "inspect_full", "verdict": "fail"}, expect=409)
    assert problem["type"] == "/problems/different-content"


def test_an_idempotency_key_names_one_answer(service: Service) -> None:
    run = service.learner.create_run()
    service.learner.ask(run, query(), query(ordinal=1))
    first, second = service.annotator.lease(), service.annotator.lease()
    key = {"Idempotency-Key": "abc"}
    receipt = service.annotator.answer(first, headers=key)
    assert service.annotator.answer(first, headers=key) == receipt
    other = {"kind": "inspect_full", "verdict": "fail"}
    for assignment, content in ((first, other), (second, None), (second, other)):
        problem = service.annotator.answer(assignment, content, expect=409, headers=key)
        assert problem["type"] == "/problems/idempotency-key-reused"
    assert service.learner.costs(run)["total"] == 1


@pytest.mark.parametrize(
    ("kind", "content", "field"),
    [
        ("inspect_full", {"kind": "label_full", "actions": []}, ["kind"]),
        ("label_full", {"kind": "label_full", "actions": ["up"]}, ["actions"]),
        ("label_full", {"kind": "label_full", "actions": ["up", "left"]}, ["actions", 1]),
        ("label_full", {"kind": "label_full", "actions": ["up", None]}, ["actions", 1]),
        ("label_hi", {"kind": "label_hi", "subgoals": ["west"]}, ["subgoals", 0]),
        ("label_hi", {"kind": "label_hi", "subgoals": []}, ["subgoals"]),
        ("label_lo", {"kind": "label_lo", "actions": ["up", "up"], "terminations": [True]}, ["terminations"]),
        ("label_lo", {"kind": "label_lo", "actions": ["up"], "terminations": [False] * 3}, ["actions"]),
        ("label_lo", {"kind": "label_lo", "actions": ["up", None], "terminations": [False] * 3}, ["actions", 1]),
        ("label_lo", {"kind": "label_lo", "actions": ["up", "up"], "terminations": [0, 0, 1]}, ["terminations", 0]),
        (
            "hier_demo",
            {"kind": "hier_demo", "segments": [{"subgoal": "north", "actions": []}]},
            ["segments", 0, "actions"],
        ),
        ("hier_demo", {"kind": "hier_demo", "segments": [{"subgoal": "north", "actions": ["up"] * 5}]}, ["segments"]),
        ("hier_demo", {"kind": "hier_demo", "segments": [{"subgoal": "north", "actions": ["up"]}] * 4}, ["segments"]),
        *(
            (
                "hier_demo",
                {"kind": "hier_demo", "segments": [{"subgoal": "north", "actions": ["up"]}], "replay": replay},
                ["replay", too_long],
            )
            for too_long, replay in (
                ("states", {"states": [1, 2, 3]}),
                ("frames", {"states": [1, 2], "frames": ["0" * 64]}),
                ("landmarks", {"states": [1, 2], "landmarks": [{}, {}, {}]}),
                ("action_landmarks", {"states": [1, 2], "action_landmarks": [{}, {}, {}]}),
            )
        ),
        (
            "hier_demo",
            {"kind": "hier_demo", "segments": [{"subgoal": "x", "actions": ["up"]}]},
            ["segments", 0, "subgoal"],
        ),
        ("inspect_lo", {"kind": "inspect_lo", "verdict": "maybe"}, ["verdict"]),
        ("inspect_lo", {"kind": "inspect_lo", "verdict": "pass", "extra": 1}, ["extra"]),
    ],
)
def test_an_answer_that_does_not_fit_names_the_field_and_the_lease_stays(
    lite: Service, kind: str, content: Json, field: list[str | int]
) -> None:
    run = lite.learner.create_run()
    lite.learner.ask(run, query(kind))
    held = lite.annotator.lease()
    problem = lite.annotator.answer(held, content, expect=422)
    assert problem["errors"][0]["loc"] == ["body", "answer", *field]
    assert lite.learner.costs(run)["total"] == 0
    lite.annotator.answer(held)


def test_actions_may_be_null_from_the_first_true_termination_on(lite: Service) -> None:
    lite.learner.ask(lite.learner.create_run(), query("label_lo"))
    content = {"kind": "label_lo", "actions": ["up", None], "terminations": [False, True, True]}
    assert lite.annotator.answer(lite.annotator.lease(), content)["units"] == 3


def test_an_answer_needs_its_owner_and_its_token(service: Service) -> None:
    service.learner.ask(service.learner.create_run(), query())
    held = service.annotator.lease()
    other = service.user("otto", "annotator")
    assert other.answer(held, expect=403)["type"] == "/problems/not-yours"
    assert service.annotator.answer(held | {"token": "guess"}, expect=403)["type"] == "/problems/wrong-token"
    assert service.annotator.answer(held | {"id": 999}, expect=404)["type"] == "/problems/not-found"
    service.annotator.answer(held)


def test_a_late_answer_is_refused_kept_and_costs_nothing(database_url: str) -> None:
    with in_process(database_url, lease_seconds=0.2) as service:
        run = service.learner.create_run()
        service.learner.ask(run, query())
        held = service.annotator.lease()
        time.sleep(0.3)
        for _ in range(2):
            assert service.annotator.answer(held, expect=409)["type"] == "/problems/lease-expired"
        run_now = service.learner.get(f"/runs/{run}")
        assert (run_now["spent"], run_now["reserved"], run_now["open_queries"]) == (0, 1, 1)
        metrics = service.client.get("/metrics", headers=service.viewer.headers).text
        assert 'waypost_answers_total{kind="late"} 1' in metrics
        service.annotator.answer(service.annotator.lease())
        assert service.learner.costs(run)["total"] == 1


def test_an_answer_after_a_release_is_refused(service: Service) -> None:
    service.learner.ask(service.learner.create_run(), query())
    held = service.annotator.lease()
    service.annotator.release(held)
    assert service.annotator.answer(held, expect=409)["type"] == "/problems/lease-ended"


def test_a_retracted_answer_is_refunded_and_its_correction_counts(service: Service) -> None:
    run = service.learner.create_run()
    service.learner.ask(run, query("label_lo"))
    first = service.annotator.lease()
    service.annotator.answer(first)
    again = service.annotator.retract(first)
    assert service.annotator.retract(first) == again
    assert service.learner.get(f"/runs/{run}/answers")["queries"] == []
    assert service.learner.costs(run)["total"] == 0
    assert service.learner.costs(run)["reserved"] == 3
    assert service.annotator.answer(first, expect=409)["type"] == "/problems/answer-retracted"
    correction = {"kind": "label_lo", "actions": ["up", "up"], "terminations": [False, False, False]}
    service.annotator.answer(again, correction)
    costs = service.learner.costs(run)
    assert (costs["total"], costs["reserved"], costs["by_kind"]["label_lo"]["queries"]) == (3, 0, 1)
    (answered,) = service.learner.get(f"/runs/{run}/answers")["queries"]
    assert answered["answer"] == correction


def test_an_answer_takes_the_time_since_its_lease(service: Service) -> None:
    service.learner.ask(service.learner.create_run(), query())
    began = time.monotonic()
    held = service.annotator.lease()
    leased = time.monotonic()
    time.sleep(0.05)
    answering = time.monotonic()
    seconds = service.annotator.answer(held)["seconds"]
    assert answering - leased <= seconds <= time.monotonic() - began


def test_a_correction_belongs_to_the_tab_that_retracted(service: Service) -> None:
    service.learner.ask(service.learner.create_run(), query())
    held = service.annotator.lease(tab="first")
    service.annotator.answer(held)
    again = service.annotator.retract(held, tab="second")
    service.annotator.leave("first")
    assert service.annotator.renew(again)
    service.annotator.leave("second")
    assert service.annotator.answer(again, expect=409)["type"] == "/problems/lease-ended"


def test_a_second_retraction_returns_the_annotators_own_correction_or_none(service: Service) -> None:
    run = service.learner.create_run()
    service.learner.ask(run, query(), query(ordinal=1))
    held = service.annotator.lease()
    service.annotator.answer(held)
    again = service.annotator.retract(held)
    service.annotator.lease()  # another query
    assert service.annotator.retract(held) == again
    service.annotator.release(again)
    taken = service.user("otto", "annotator").lease()
    assert taken["query"]["id"] == held["query"]["id"]
    assert service.annotator.retract(held, expect=409)["type"] == "/problems/answer-retracted"


def test_a_retracted_answers_query_has_the_runs_priority_of_now(service: Service) -> None:
    run, other = service.learner.create_run(), service.learner.create_run()
    (asked,) = service.learner.ask(run, query())
    held = service.annotator.lease()
    service.annotator.answer(held)
    service.learner.ask(other, query())
    service.admin.patch(other, priority=1)
    service.admin.patch(run, priority=2)
    service.annotator.release(service.annotator.retract(held))
    assert service.annotator.lease()["query"]["id"] == asked["id"]


def test_an_answer_the_learner_used_cannot_be_taken_back(service: Service) -> None:
    (asked,) = service.learner.ask(service.learner.create_run(), query())
    assert service.learner.post(f"/queries/{asked['id']}/use", expect=409)["type"] == "/problems/not-answered"
    held = service.annotator.lease()
    service.annotator.answer(held)
    used = service.learner.post(f"/queries/{asked['id']}/use")
    assert used["used"]
    assert service.learner.post(f"/queries/{asked['id']}/use") == used
    assert service.annotator.retract(held, expect=409)["type"] == "/problems/answer-used"


def test_only_the_annotator_who_answered_can_take_it_back(service: Service) -> None:
    service.learner.ask(service.learner.create_run(), query())
    held = service.annotator.lease()
    assert service.annotator.retract(held, expect=409)["type"] == "/problems/lease-ended"
    service.annotator.answer(held)
    service.user("otto", "annotator").retract(held, expect=403)


def test_stored_answers_and_ledger_lines_cannot_be_changed(service: Service) -> None:
    service.learner.ask(service.learner.create_run(), query())
    service.annotator.answer(service.annotator.lease())
    for statement in (
        "UPDATE answers SET units = 0",
        "DELETE FROM answers",
        "UPDATE ledger SET units = 0, lo_units = 0",
        "DELETE FROM ledger",
    ):
        with pytest.raises(Exception, match="append-only"):
            service.db.write_now(lambda tx, statement=statement: tx.conn.exec_driver_sql(statement))
