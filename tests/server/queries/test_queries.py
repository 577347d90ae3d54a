"""Queries: asked once however often they are sent, and waited for without asking again."""

import threading
import time

import pytest
from tests.server.db.plans import plans
from tests.server.kit import Json, Service, in_process, query, segment

BOX = {"left": 0.25, "top": 0.25, "right": 0.5, "bottom": 1}


def test_asking_again_returns_the_query_with_its_answer(service: Service) -> None:
    run = service.learner.create_run()
    asks = [query(), query("label_lo", ordinal=1)]
    first = service.learner.ask(run, *asks)
    assert service.learner.ask(run, *asks) == first
    service.annotator.answer(service.annotator.lease())
    again = service.learner.ask(run, *asks)
    assert [one["id"] for one in again] == [one["id"] for one in first]
    assert again[0]["answer"] == {"kind": "inspect_full", "verdict": "pass"}
    assert service.learner.get(f"/runs/{run}")["reserved"] == 3


def test_the_same_key_with_other_content_is_refused_and_nothing_is_asked(service: Service) -> None:
    run = service.learner.create_run()
    service.learner.ask(run, query())
    changed = query(instance={"lava": [1]})
    problem = service.learner.ask(run, query(ordinal=1), changed, expect=409)
    assert problem["type"] == "/problems/different-content"
    assert problem["detail"].startswith("queries.1: episode 0")
    assert service.learner.get(f"/runs/{run}")["open_queries"] == 1
    both = service.learner.ask(run, query(ordinal=2), query(ordinal=2, instance=1), expect=409)
    assert both["type"] == "/problems/different-content"


def test_the_same_query_twice_in_one_list_is_one_query(service: Service) -> None:
    one, two = service.learner.ask(service.learner.create_run(), query(), query())
    assert one == two


def test_to_ask_reads_no_other_query_of_the_run(lite: Service) -> None:
    run = lite.learner.create_run()
    asks = [query(episode=1), query(episode=2)]
    (plan,) = plans("(queries.episode, queries.ordinal) IN", lambda: lite.learner.ask(run, *asks))
    assert "queries USING INDEX sqlite_autoindex_queries_2 (run_id=? AND episode=?" in plan


@pytest.mark.parametrize(
    ("ask", "field"),
    [
        (query(segments=[{"subgoal": "north", "states": [1, 2], "actions": ["up", "up"]}]), ["segments", 0, "states"]),
        (query(segments=[{"subgoal": "west", "states": [1], "actions": []}]), ["segments", 0, "subgoal"]),
        (query(segments=[{"subgoal": None, "states": [1, 2], "actions": ["left"]}]), ["segments", 0, "actions", 0]),
        (query(segments=[segment(2) | {"landmarks": [{"west": BOX}]}]), ["segments", 0, "landmarks", 0]),
        (query(segments=[segment(2) | {"landmarks": [{"north": BOX}] * 2}]), ["segments", 0, "landmarks"]),
        (query(segments=[segment(2) | {"action_landmarks": [{"north": BOX}]}]), ["segments", 0, "action_landmarks", 0]),
        (query(segments=[segment(2) | {"action_landmarks": [{"up": BOX}] * 2}]), ["segments", 0, "action_landmarks"]),
        (query(context=[segment(2) | {"action_landmarks": [{"west": BOX}]}]), ["context", 0, "action_landmarks", 0]),
        *(
            (query(segments=[segment(1) | {"landmarks": [{"north": BOX | wrong}]}]), ["segments", 0, "landmarks", 0])
            for wrong in ({"left": 0.5}, {"bottom": 0.25}, {"right": 1.1})
        ),
        (query("label_lo", segments=[segment(1, None)]), ["segments", 0, "subgoal"]),
        (query("label_lo", segments=[segment(1), segment(1)]), ["segments"]),
        (query(context=[{"subgoal": "west", "states": [1], "actions": []}]), ["context", 0, "subgoal"]),
        (query(suggestion={"kind": "label_full", "actions": []}), ["suggestion", "kind"]),
        (query("label_full", suggestion={"kind": "label_full", "actions": ["up"]}), ["suggestion", "actions"]),
        (query(episode=-1), ["episode"]),
        (query(episode="0"), ["episode"]),
        (query(ordinal=2**40), ["ordinal"]),
        (query(colour="red"), ["colour"]),
        (query("guess"), []),
    ],
)
def test_a_query_that_makes_no_sense_names_the_field(lite: Service, ask: Json, field: list[str | int]) -> None:
    run = lite.learner.create_run()
    problem = lite.learner.ask(run, ask, expect=422)
    assert problem["errors"][0]["loc"][: 3 + len(field)] == ["body", "queries", 0, *field]
    assert lite.learner.get(f"/runs/{run}")["open_queries"] == 0


def test_a_run_without_subgoals_cannot_ask_for_them(lite: Service) -> None:
    flat = {"domain": "maze", "subgoals": [], "actions": ["up"], "renderer": "maze"}
    run = lite.learner.create_run(vocabulary=flat)
    for ask in (query("hier_demo"), query("label_hi", segments=[segment(1, None)])):
        assert lite.learner.ask(run, ask, expect=422)["errors"][0]["loc"] == ["body", "queries", 0, "kind"]
    lite.learner.ask(run, query("label_full", segments=[segment(1, None)]))


def test_a_run_has_a_bounded_number_of_open_queries(database_url: str) -> None:
    with in_process(database_url, max_open_queries=2) as service:
        run = service.learner.create_run()
        service.learner.ask(run, query(), query(ordinal=1))
        body = {"queries": [query(ordinal=2)]}
        reply = service.client.post(f"/api/v1/runs/{run}/queries", json=body, headers=service.learner.headers)
        assert reply.status_code == 429
        assert int(reply.headers["retry-after"]) >= 1
        service.learner.ask(run, query())
        service.annotator.answer(service.annotator.lease())
        service.learner.ask(run, query(ordinal=2))


def test_queries_are_listed_newest_first_and_filtered(service: Service) -> None:
    run = service.learner.create_run()
    service.learner.ask(
        run, *(query("label_lo" if n % 2 else "inspect_full", episode=n // 3, ordinal=n) for n in range(6))
    )
    service.annotator.answer(service.annotator.lease())

    def ordinals(**params: object) -> list[int]:
        found = service.viewer.get(f"/runs/{run}/queries", params=params)["queries"]
        return [one["ask"]["ordinal"] for one in found]

    assert ordinals() == [5, 4, 3, 2, 1, 0]
    assert ordinals(kind="label_lo") == [5, 3, 1]
    assert ordinals(episode=1) == [5, 4, 3]
    assert ordinals(state="answered") == [0]
    page = service.viewer.get(f"/runs/{run}/queries", params={"limit": 2})["queries"]
    assert ordinals(before=page[-1]["id"], limit=2) == [3, 2]


def test_answers_come_in_the_order_they_were_given_after_a_cursor(service: Service) -> None:
    run, other = service.learner.create_run(), service.learner.create_run()
    service.learner.ask(run, query(), query(ordinal=1), query(ordinal=2))
    service.learner.ask(other, query())
    held = [service.annotator.lease(run=run) for _ in range(3)]
    service.annotator.answer(service.annotator.lease(run=other))
    for one in reversed(held):
        service.annotator.answer(one)
    page = service.learner.get(f"/runs/{run}/answers", params={"limit": 2})
    assert [one["ask"]["ordinal"] for one in page["queries"]] == [2, 1]
    page = service.learner.get(f"/runs/{run}/answers", params={"after": page["cursor"]})
    assert [one["ask"]["ordinal"] for one in page["queries"]] == [0]
    page = service.learner.get(f"/runs/{run}/answers", params={"after": page["cursor"]})
    assert page["queries"] == []


@pytest.mark.parametrize("path", ["/queries/1", "/runs/{run}/answers"])
def test_a_waiting_learner_is_woken_by_the_answer(database_url: str, path: str) -> None:
    with in_process(database_url, poll_seconds=30) as service:
        run = service.learner.create_run()
        service.learner.ask(run, query())
        held = service.annotator.lease()
        got: list[float] = []

        def wait() -> None:
            assert service.learner.get(path.format(run=run), params={"wait": 20})
            got.append(time.monotonic())

        waiting = threading.Thread(target=wait)
        waiting.start()
        time.sleep(0.3)
        answered = time.monotonic()
        service.annotator.answer(held)
        waiting.join()
        assert got[0] - answered < 1


def test_waiting_ends_with_the_query_as_it_stands(lite: Service) -> None:
    (asked,) = lite.learner.ask(lite.learner.create_run(), query())
    before = time.monotonic()
    assert lite.learner.get(f"/queries/{asked['id']}", params={"wait": 0.3})["state"] == "open"
    assert time.monotonic() - before >= 0.3


def test_unknown_runs_and_queries_are_not_found(service: Service) -> None:
    for path in ("/runs/000000000000", "/runs/%00", "/runs/x/costs", "/runs/x/answers", "/queries/77"):
        assert service.learner.get(path, 404)["type"] == "/problems/not-found"
    for run in ("nowhere", "%00"):
        service.learner.ask(run, query(), expect=404)
    service.learner.post("/queries/77/use", expect=404)
    service.learner.get("/queries/99999999999999999999999", 422)
