"""Review: answers are paged through by what they disagree with, commented on, and sent back while that still helps."""

from typing import Any

import pytest
from sqlalchemy import select
from sqlalchemy.exc import DBAPIError
from tests.server.gold.test_gold import bring, is_gold
from tests.server.kit import Caller, Json, Service, query, right_answer, together

from waypost_server.db.checking import check
from waypost_server.db.tables import comments, predictions

LONG = "x" * 2_000


def answered(service: Service, run: str, *asks: Json, by: Caller | None = None, **more: Any) -> list[Json]:
    """Ask queries and answer them; returns them as they stand then."""
    who, done = by or service.annotator, []
    for one in service.learner.ask(run, *asks):
        who.answer(who.lease(run=run), **more)
        done.append(service.learner.get(f"/queries/{one['id']}"))
    return done


def send_back(service: Service, found: Json, text: str = "The goal was reached.", expect: int = 201) -> Any:
    body = {"answer": found["answer_id"], "text": text}
    return service.learner.post(f"/queries/{found['id']}/send-back", body, expect)


def walk(caller: Caller, run: str, **wanted: Any) -> list[int]:
    """The queries that a reviewer sees one after another, from the newest to the oldest."""
    seen: list[int] = []
    while True:
        before = {} if not seen else {"before": seen[-1]}
        rows = caller.get(f"/runs/{run}/review", params=wanted | before | {"limit": 1})["rows"]
        if not rows:
            return seen
        seen.append(rows[0]["query"]["id"])


def test_an_answer_that_is_sent_back_is_refunded_once_and_its_query_is_open_again(service: Service) -> None:
    run = service.learner.create_run(budget=10.0)
    (found,) = answered(service, run, query("label_hi"))
    assert service.learner.costs(run)["total"] == 1

    def once(_: int) -> int:
        body = {"answer": found["answer_id"], "text": "Look at the start again."}
        path = f"/api/v1/queries/{found['id']}/send-back"
        return service.client.post(path, json=body, headers=service.learner.headers).status_code

    assert sorted(together(once, 3)) == [201, 409, 409]
    costs = service.learner.costs(run)
    assert (costs["total"], costs["reserved"]) == (0, 1)
    assert [one["entry"] for one in service.learner.get(f"/runs/{run}/ledger")["entries"]] == ["refund", "charge"]
    now = service.learner.get(f"/queries/{found['id']}")
    assert (now["state"], now["answer"]) == ("open", None)
    history = service.learner.get(f"/queries/{found['id']}/history")
    assert history["assignments"][0]["answer"]["fate"] == "retracted"
    assert [(one["by"], one["text"], one["answer"]) for one in history["comments"]] == [
        ("lea", "Look at the start again.", found["answer_id"])
    ]
    assert service.learner.get(f"/runs/{run}/answers")["queries"] == [], "the learner waits for another answer"
    assert all(not one.n_faults for one in service.db.read_now(check))


def test_whoever_gets_the_query_next_reads_why_and_so_does_the_author(service: Service) -> None:
    run = service.learner.create_run()
    first, other = answered(service, run, query(), query(ordinal=1))
    service.learner.post(f"/queries/{first['id']}/comments", {"text": "for us alone"}, 201)
    send_back(service, first, "It burned in the lava.")
    ada = service.user("ada", "annotator")
    again = ada.lease(run=run)
    assert again["query"]["id"] == first["id"]
    assert [one["text"] for one in again["comments"]] == ["It burned in the lava."]
    ada.release(again)
    mine = service.annotator.lease(run=run)
    assert mine["query"]["id"] == first["id"], "its author may answer it again"
    (back,) = service.annotator.get("/me/returned")["returned"]
    assert back["query"] == first["id"]
    assert back["run_name"] == "a run"
    assert back["answer"]["verdict"] == "pass"
    assert back["comment"]["text"] == "It burned in the lava."
    assert ada.get("/me/returned")["returned"] == []
    service.annotator.answer(mine, {"kind": "inspect_full", "verdict": "fail"})
    assert service.learner.costs(run)["total"] == 2, "one charge for each of the two queries"
    service.learner.ask(run, query(ordinal=2))
    assert service.annotator.lease(run=run)["comments"] == []
    assert other["state"] == "answered"


def test_what_cannot_be_mended_cannot_be_sent_back_but_commented_on(service: Service) -> None:
    run = service.learner.create_run()
    used, late, retracted = answered(service, run, query(), query(ordinal=1), query(ordinal=2))
    service.learner.post(f"/queries/{used['id']}/use")
    assert send_back(service, used, expect=409)["type"].endswith("/answer-used")
    assert send_back(service, retracted | {"answer_id": used["answer_id"]}, expect=409)["type"].endswith(
        "/answer-retracted"
    )
    service.learner.patch(run, state="finished")
    assert send_back(service, late, expect=409)["type"].endswith("/run-finished")
    assert service.learner.costs(run)["total"] == 3
    said = service.learner.post(f"/queries/{used['id']}/comments", {"text": LONG}, 201)
    assert (said["text"], said["answer"]) == (LONG, None)
    for text in ("", " \n ", LONG + "x", "\x00"):
        service.learner.post(f"/queries/{used['id']}/comments", {"text": text}, 422)
    assert service.annotator.get("/me/returned")["returned"] == []


def test_a_comment_is_never_changed(service: Service) -> None:
    run = service.learner.create_run()
    (found,) = answered(service, run, query())
    send_back(service, found)
    for change in (comments.update().values(text="other"), comments.delete()):
        with pytest.raises(DBAPIError, match="append-only"):
            service.db.write_now(lambda tx, change=change: tx.conn.execute(change))


def test_answers_are_paged_through_by_annotator_kind_and_disagreement(service: Service) -> None:
    run = service.learner.create_run()
    suggestions: list[Json | None] = [
        {"kind": "label_hi", "subgoals": ["south"]},
        {"kind": "label_hi", "subgoals": ["north"]},
        None,
        # After the end of the segment, a label means nothing.
        {"kind": "label_lo", "actions": ["down", "down"], "terminations": [False, False, True]},
        {"kind": "label_lo", "actions": ["down", "up"], "terminations": [False, True, False]},
    ]
    asks = [
        query("label_lo" if one and one["kind"] == "label_lo" else "label_hi", ordinal=n, suggestion=one)
        for n, one in enumerate(suggestions)
    ]
    same, other, without, lo_same, lo_other = (one["id"] for one in answered(service, run, *asks))
    ada = service.user("ada", "annotator")
    (hers,) = answered(service, run, query("inspect_full", episode=1), by=ada)
    service.learner.ask(run, query(episode=2))
    reviewer = service.learner
    assert walk(reviewer, run) == [hers["id"], lo_other, lo_same, without, other, same]
    assert walk(reviewer, run, annotator="ada") == [hers["id"]]
    assert walk(reviewer, run, kind="label_lo") == [lo_other, lo_same]
    assert walk(reviewer, run, disagrees="suggestion") == [lo_other, other]
    page = reviewer.get(f"/runs/{run}/review", params={"kind": "label_hi"})
    assert [one["differs"] for one in page["rows"]] == [None, True, False]
    back = reviewer.get(f"/runs/{run}/review", params={"after": other, "limit": 1})
    assert back["rows"][0]["query"]["id"] == without
    send_back(service, service.learner.get(f"/queries/{other}"))
    assert walk(reviewer, run, disagrees="suggestion") == [lo_other]


def predict(service: Service, run: str, *sent: tuple[int, Json], episode: int = 7, expect: int = 204) -> Json:
    body = {"episode": episode, "predictions": [{"query": query_id, "answer": answer} for query_id, answer in sent]}
    return service.learner.call("PUT", f"/runs/{run}/predictions", body, expect)


def test_answers_are_compared_with_what_the_policies_would_answer_now(service: Service) -> None:
    run = service.learner.create_run()
    right, wrong, unknown = (
        one["id"] for one in answered(service, run, *(query("label_hi", ordinal=n) for n in range(3)))
    )
    for one in (right, wrong):
        service.learner.post(f"/queries/{one}/use")
    given = service.learner.get(f"/queries/{right}")["answer"]
    other = {"kind": "label_hi", "subgoals": ["north"]}
    assert given != other
    predict(service, run, (right, other), (wrong, other))
    predict(service, run, (right, given), episode=8)
    assert walk(service.learner, run, disagrees="policy") == [wrong]
    rows = service.learner.get(f"/runs/{run}/review")["rows"]
    assert [one["query"]["id"] for one in rows] == [unknown, wrong, right]
    assert [one["policy"] for one in rows] == [
        None,
        {
            "episode": 7,
            "answer": other,
            "differences": [{"place": 0, "answer": given["subgoals"][0], "policy": "north"}],
        },
        {"episode": 8, "answer": given, "differences": []},
    ]
    service.learner.patch(run, state="finished")
    service.learner.call("DELETE", f"/runs/{run}")
    assert service.db.read_now(lambda tx: tx.conn.execute(select(predictions)).all()) == []


def test_each_label_of_a_segment_is_compared_up_to_its_ends(service: Service) -> None:
    run = service.learner.create_run()
    (asked,) = service.learner.ask(run, query("label_lo"))
    answer = {"kind": "label_lo", "actions": ["down", "down"], "terminations": [False, False, False]}
    service.annotator.answer(service.annotator.lease(run=run), answer)
    service.learner.post(f"/queries/{asked['id']}/use")
    predict(service, run, (asked["id"], answer | {"actions": ["up", "down"], "terminations": [False, True, False]}))
    (row,) = service.learner.get(f"/runs/{run}/review")["rows"]
    assert row["policy"]["differences"] == [
        {"place": 0, "answer": "down", "policy": "up"},
        {"place": 1, "answer": "down", "policy": "(done)"},
        {"place": 2, "answer": "(not done)", "policy": None},
    ]


def test_a_prediction_must_be_a_label_for_a_query_of_the_run_with_a_used_answer(service: Service) -> None:
    run, another = service.learner.create_run(), service.learner.create_run()
    label, unused = (one["id"] for one in answered(service, run, *(query("label_hi", ordinal=n) for n in range(2))))
    (foreign,) = answered(service, another, query("label_hi"))
    for one in (label, foreign["id"]):
        service.learner.post(f"/queries/{one}/use")
    good: Json = {"kind": "label_hi", "subgoals": ["south"]}
    for sent in (
        [(unused, good)],
        [(foreign["id"], good)],
        [(label, good), (label, good)],
        [(label, {"kind": "label_hi", "subgoals": ["nowhere"]})],
        [(label, {"kind": "inspect_full", "verdict": "pass"})],
    ):
        predict(service, run, *sent, expect=422)
    assert service.learner.get(f"/runs/{run}/review")["rows"][-1]["policy"] is None, "nothing of it is stored"
    mallory = service.user("mallory", "learner")
    mallory.call("PUT", f"/runs/{run}/predictions", {"episode": 0, "predictions": []}, 403)


def test_wrong_answers_to_gold_queries_are_reviewed_beside_the_right_ones(service: Service) -> None:
    run = service.learner.create_run()
    assert walk(service.learner, run, disagrees="gold") == []
    bring(service, run, "label_lo", n=2)
    service.learner.ask(run, *(query(ordinal=n) for n in range(6)))
    golden = []
    for wrong in ({"actions": ["up", "down"], "terminations": [False, True, False]}, {}):
        while True:
            held = service.annotator.lease(run=run)
            if is_gold(service, run, held):
                golden.append(held["query"]["id"])
                service.annotator.answer(held, right_answer(held["query"]["ask"]) | wrong)
                break
            service.annotator.answer(held)
    assert walk(service.learner, run, disagrees="gold") == golden[:1]
    assert set(golden).isdisjoint(walk(service.learner, run))
    (row,) = service.learner.get(f"/runs/{run}/review", params={"disagrees": "gold"})["rows"]
    assert [(one["given"], one["is_right"]) for one in row["gold"]] == [("up", False), ("(done)", False), (None, False)]
    found = service.learner.get(f"/queries/{golden[0]}")
    service.learner.post(f"/queries/{golden[0]}/comments", {"text": "Talk to them."}, 201)
    assert send_back(service, found, expect=409)["type"].endswith("/cannot-send-back")
