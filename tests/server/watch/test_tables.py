"""Looking through a run: its queries, its ledger, one query's history, who is at work."""

import pytest
from sqlalchemy import text
from tests.server.db.plans import plans
from tests.server.kit import Json, Service, query, segment
from tests.server.runs.test_curves import filled, report, result


def changed(service: Service, statement: str) -> None:
    """Let time have passed."""
    service.db.write_now(lambda tx: tx.conn.execute(text(statement)))


def test_queries_are_shown_without_their_trajectories(service: Service) -> None:
    run = service.learner.create_run()
    service.learner.ask(run, query(question="One?"), query("label_lo", ordinal=1, question="Two \u0000?"))
    held = service.annotator.lease()
    service.annotator.answer(held, {"kind": "inspect_full", "verdict": "fail"})
    page = service.viewer.get(f"/runs/{run}/query-rows")
    newest, oldest = page["rows"]
    assert (newest["question"], newest["state"], newest["answer"], newest["annotator"]) == (
        "Two \0?",
        "open",
        None,
        None,
    )
    assert oldest["answer"] == {"kind": "inspect_full", "verdict": "fail"}
    assert (oldest["annotator"], oldest["units"], oldest["episode"], oldest["ordinal"]) == ("abe", 1, 0, 0)
    assert oldest["answered_at"] >= oldest["created_at"]
    assert "segments" not in str(page)
    assert (page["total"], page["newest"], page["oldest"]) == (2, newest["id"], oldest["id"])


def test_queries_are_filtered_and_leafed_through_both_ways(service: Service) -> None:
    run, other = service.learner.create_run(), service.learner.create_run()
    asked = service.learner.ask(run, *(query(episode=n // 3, ordinal=n % 3) for n in range(7)))
    service.learner.ask(run, query("label_hi", episode=9))
    service.learner.ask(other, query())
    ids = [one["id"] for one in asked]
    get = service.viewer.get
    rows = f"/runs/{run}/query-rows"

    def shown(filters: str) -> list[int]:
        return [row["id"] for row in get(f"{rows}?{filters}")["rows"]]

    assert shown("kind=inspect_full&limit=3") == ids[6:3:-1]
    assert shown(f"kind=inspect_full&limit=3&before={ids[4]}") == ids[3:0:-1]
    assert shown(f"kind=inspect_full&limit=3&after={ids[0]}") == ids[3:0:-1]
    assert shown("episode=1") == ids[5:2:-1]
    held = service.annotator.lease(run=run)
    assert shown("annotator=abe") == [held["query"]["id"]], "who holds it"
    service.annotator.answer(held)
    assert shown("annotator=abe&state=answered") == [held["query"]["id"]], "who answered it"
    assert get(f"{rows}?annotator=nobody")["total"] == 0
    assert get("/runs/000000000000/query-rows", 404)["type"] == "/problems/not-found"


def test_queries_are_found_by_words_of_the_question_a_comment_a_reason_or_a_name(service: Service) -> None:
    run = service.learner.create_run()
    asks = [query(question="Did it burn in 100 % of the lava?"), query(ordinal=1), query(ordinal=2)]
    first, second, third = (one["id"] for one in service.learner.ask(run, *asks))
    service.annotator.answer(service.annotator.lease())
    service.annotator.answer(service.annotator.lease())
    held = service.annotator.lease()
    skip = {"token": held["token"], "reason": "Too dark", "skip": True}
    service.annotator.post(f"/assignments/{held['id']}/release", skip, 204)
    service.learner.post(f"/queries/{second}/comments", {"text": "Why not east?"}, 201)

    def found(words: str) -> list[int]:
        page = service.viewer.get(f"/runs/{run}/query-rows", params={"text": words})
        assert page["total"] == len(page["rows"])
        return [row["id"] for row in page["rows"]]

    assert found("LAVA burn") == [first]
    assert found("%") == [first], "no pattern of the database"
    assert found("east") == [second]
    assert found("dark") == [third]
    assert found("abe") == [second, first]
    assert found("abe lava") == [first]
    assert found("east lava") == []
    assert found("segments") == [], "the trajectory is not searched"


def test_the_ledger_lists_charges_and_refunds_and_agrees_with_the_account(service: Service) -> None:
    run = service.learner.create_run(budget=20)
    service.learner.ask(run, query("label_lo"), query(ordinal=1))
    held = service.annotator.lease()
    service.annotator.answer(held)
    again = service.annotator.retract(held)
    service.annotator.answer(again)
    service.annotator.answer(service.annotator.lease())
    page = service.viewer.get(f"/runs/{run}/ledger")
    assert [(line["entry"], line["units"], line["lo_units"], line["balance"]) for line in page["entries"]] == [
        ("charge", 1, 0, 4),
        ("charge", 3, 3, 3),
        ("refund", -3, -3, 0),
        ("charge", 3, 3, 3),
    ]
    assert (page["total"], page["units"], page["lo_units"]) == (4, 4, 3)
    assert page["units"] == page["spent"] == service.viewer.get(f"/runs/{run}")["spent"]
    assert page["seconds"] == pytest.approx(sum(line["seconds"] for line in page["entries"]))
    assert {line["annotator"] for line in page["entries"]} == {"abe"}
    refunds = service.viewer.get(f"/runs/{run}/ledger?entry=refund")
    assert [(line["units"], line["balance"]) for line in refunds["entries"]] == [(-3, 0)]
    assert (refunds["total"], refunds["units"], refunds["spent"]) == (1, -3, 4)
    older = service.viewer.get(f"/runs/{run}/ledger?kind=label_lo&limit=2&before={page['entries'][1]['id']}")
    assert [line["entry"] for line in older["entries"]] == ["refund", "charge"]
    newer = service.viewer.get(f"/runs/{run}/ledger?limit=2&after={page['entries'][3]['id']}")
    assert [line["entry"] for line in newer["entries"]] == ["charge", "refund"]


def test_a_query_tells_how_often_it_was_handed_out_and_what_came_of_it(service: Service) -> None:
    run = service.learner.create_run()
    first, middle, last = service.learner.ask(run, query(), query(ordinal=1), query(episode=1))
    bea = service.user("bea", "annotator")
    skipped = service.annotator.lease()
    service.annotator.release(skipped, skip=True, reason="=I cannot tell")
    expired = bea.lease()
    changed(service, "UPDATE assignments SET expires_at = 0 WHERE state = 'live'")
    bea.answer(expired, expect=409)
    held = bea.lease()
    again = bea.retract(held) if bea.answer(held) else None
    bea.answer(again, {"kind": "inspect_full", "verdict": "fail"})
    assert skipped["query"]["id"] == expired["query"]["id"] == again["query"]["id"] == first["id"]
    history = service.viewer.get(f"/queries/{first['id']}/history")
    told = [(one["annotator"], one["state"], one["reason"]) for one in history["assignments"]]
    assert told == [
        ("abe", "skipped", "=I cannot tell"),
        ("bea", "expired", None),
        ("bea", "answered", None),
        ("bea", "answered", None),
    ]
    fates = [one["answer"] and one["answer"]["fate"] for one in history["assignments"]]
    assert fates == [None, "late", "retracted", "counts"]
    assert history["assignments"][3]["answer"]["content"]["verdict"] == "fail"
    assert [(line["entry"], line["units"]) for line in history["ledger"]] == [
        ("charge", 1),
        ("refund", -1),
        ("charge", 1),
    ]
    (row,) = service.viewer.get(f"/runs/{run}/query-rows?kind=inspect_full&annotator=bea")["rows"]
    assert (row["skips"], row["expiries"]) == (1, 1)
    assert (history["previous"], history["next"]) == (None, middle["id"])
    history = service.viewer.get(f"/queries/{last['id']}/history")
    assert (history["assignments"], history["previous"], history["next"]) == ([], middle["id"], None)
    assert "token" not in str(history)
    service.viewer.get("/queries/999999/history", 404)


def test_who_is_at_work_and_on_what(service: Service) -> None:
    run, other = service.learner.create_run(), service.learner.create_run()
    (asked,) = service.learner.ask(run, query())
    bot, idle = service.user("bot", "annotator"), service.user("idle", "annotator")
    held = bot.lease(run=run, defer=0.01)
    while held is None:
        held = bot.lease(run=run, defer=0.01)
    idle.lease(204, kinds=["label_hi", "label_lo"], run=other)
    found = {one["annotator"]: one for one in service.viewer.get("/annotators")["annotators"]}
    assert set(found) == {"bot", "idle"}
    (holding,) = found["bot"]["holds"]
    assert (holding["query"], holding["run"], holding["kind"]) == (asked["id"], run, "inspect_full")
    assert (found["idle"]["run"], found["idle"]["kinds"]) == (other, ["label_hi", "label_lo"])
    assert found["idle"]["seen_at"] >= held["leased_at"]

    def of(one: str) -> list[str]:
        return [found["annotator"] for found in service.viewer.get(f"/annotators?run={one}")["annotators"]]

    assert (of(run), of(other)) == (["bot"], ["idle"])
    changed(service, "UPDATE presence SET asked_at = asked_at - 60")
    assert (of(run), of(other)) == (["bot"], []), "a lease lasts, asking is soon forgotten"
    bot.answer(held)
    assert of(run) == []
    service.viewer.get("/annotators?run=none", 404)


def test_whoever_waits_is_told_what_the_learner_does_and_how_long_that_usually_takes(service: Service) -> None:
    assert service.annotator.get("/outlook") == {"open": 0, "runs": []}
    run = service.learner.create_run(name="watched")

    def outlook() -> Json:
        (found,) = service.annotator.get("/outlook")["runs"]
        assert (found["run"], found["name"], found["domain"]) == (run, "watched", "maze")
        return dict(found)

    assert (outlook()["doing"], outlook()["usual_seconds"], outlook()["kinds"]) == ("nothing_yet", None, [])
    for state in ("paused", "running"):
        service.learner.patch(run, state=state)
    assert outlook()["doing"] == "nothing_yet", "people pause runs, too"
    asked = service.learner.ask(run, query(), query("label_hi", ordinal=1))
    assert (outlook()["doing"], outlook()["open"]) == ("asking", 10), "in tens, so that no gold query is noticed"
    for _ in asked:
        service.annotator.answer(service.annotator.lease(run=run))
    assert (outlook()["doing"], outlook()["open"]) == ("training", 0)
    for one in asked:
        service.learner.post(f"/queries/{one['id']}/use", expect=200)
    assert outlook()["doing"] == "training"
    report(service, run, result(0, True))
    assert outlook()["doing"] == "rolling_out"
    service.learner.ask(run, query(episode=1))
    times = text("SELECT max(created_at) FROM events WHERE event = :event")
    asked_at, answered_at = (
        service.db.write_now(lambda tx, event=event: tx.conn.execute(times, {"event": event}).scalar_one())
        for event in ("asked", "answered")
    )
    usual = pytest.approx(asked_at - answered_at)
    assert (outlook()["doing"], outlook()["usual_seconds"]) == ("asking", usual)
    assert outlook()["kinds"] == ["inspect_full", "label_hi"]
    for state in ("paused", "finished"):
        service.learner.patch(run, state=state)
        assert (outlook()["doing"], outlook()["usual_seconds"]) == (state, usual)
    other = service.learner.create_run(name="newer")
    assert [one["run"] for one in service.annotator.get("/outlook")["runs"]] == [other, run]
    assert [one["run"] for one in service.annotator.get(f"/outlook?run={run}")["runs"]] == [run, other]


def test_whoever_is_new_learns_how_demonstrations_are_asked_for(service: Service) -> None:
    run = service.learner.create_run()

    def forms() -> list[str]:
        (found,) = service.annotator.get("/outlook")["runs"]
        return list(found["demonstrations"])

    service.learner.ask(run, query())
    assert forms() == []
    service.learner.ask(run, query("hier_demo", ordinal=1, context=[segment()]))
    assert forms() == ["play_on"]
    service.learner.ask(run, query("hier_demo", ordinal=2, flat=True), query("hier_demo", ordinal=3))
    assert forms() == ["hier_demo", "flat_demo", "play_on"]


def test_a_long_run_is_leafed_through_page_by_page(service: Service) -> None:
    run = service.learner.create_run()
    filled(service, run, 1_000, 5)
    report(service, run, *(result(n, n % 3 > 0) for n in range(1_000)))
    for path in ("ledger", "ledger?kind=label_lo&before=2500", "query-rows", "query-rows?kind=label_lo&before=2500"):
        (rows,) = [found for found in service.viewer.get(f"/runs/{run}/{path}").values() if isinstance(found, list)]
        assert len(rows) == 50, path
    tail = service.viewer.get(f"/runs/{run}/curves?after=997")
    whole = service.viewer.get(f"/runs/{run}/curves")
    assert tail["episode"] == [998, 999]
    assert tail["success_rate"] == whole["success_rate"][-2:]
    assert tail["cost_by_kind"]["label_lo"] == whole["cost_by_kind"]["label_lo"][-2:]
    assert tail["lo_samples"] == whole["lo_samples"][-2:]


@pytest.mark.parametrize(
    ("path", "part", "index"),
    [
        ("/runs/{run}/stuck", "AS expiries", "ix_queries_run_state (run_id=? AND state=?)"),
        ("/runs/{run}/queries?state=cancelled", "(queries.id + 0)", "ix_queries_run_state (run_id=? AND state=?)"),
        ("/runs/{run}/queries?episode=0", "(queries.id + 0)", "sqlite_autoindex_queries_2 (run_id=? AND episode=?)"),
        ("/runs/{run}/query-rows?state=leased", "(queries.id + 0)", "ix_queries_run_state (run_id=? AND state=?)"),
        ("/runs/{run}/query-rows?episode=0", "(queries.id + 0)", "sqlite_autoindex_queries_2 (run_id=? AND episode=?)"),
        ("/annotators", "AS gold_ask", "ix_assignments_expiry (expires_at>?)"),
        ("/queries/{query}/history", "FROM ledger JOIN", "sqlite_autoindex_ledger_1 (answer_id=?)"),
        ("/me/returned", "AS answered_at", "SCAN comments"),
    ],
)
def test_the_few_rows_of_a_long_run_are_found_by_an_index(lite: Service, path: str, part: str, index: str) -> None:
    run = lite.learner.create_run()
    (asked,) = lite.learner.ask(run, query())
    (plan,) = plans(part, lambda: lite.admin.get(path.format(run=run, query=asked["id"])))
    assert index in plan
