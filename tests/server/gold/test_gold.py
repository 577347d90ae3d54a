"""Gold queries: they look like any other, come at the rate the run sets, and touch nothing of the run's."""

from collections import Counter
from itertools import pairwise
from typing import Any

import pytest
from hypothesis import HealthCheck, example, given, settings
from hypothesis import strategies as st
from sqlalchemy import select
from tests.server.kit import API, Caller, Json, Service, in_process, query, right_answer

from waypost_server.db.tables import ledger
from waypost_server.gold.schedule import Position


def known(kind: str, n_actions: int = 2) -> Json:
    """What is right for `kit.query`; `kit.right_answer` is."""
    if kind == "label_hi":
        return {"kind": kind, "subgoals": [["south", "north"]]}
    if kind == "label_lo":
        return {"kind": kind, "actions": [["down"], ["up", "down"]], "end": n_actions}
    if kind == "label_full":
        return {"kind": kind, "actions": [["down"], ["up", "down"]]}
    return {"kind": kind, "verdict": "pass"}


KINDS = ("inspect_full", "label_hi", "inspect_lo", "label_lo", "label_full")


def bring(service: Service, run: str, *kinds: str, rate: float = 0.5, n: int = 1) -> list[Json]:
    """Give a run gold queries of its own, beside those of the learner."""
    asks = [query(kind, episode=9_000 + number, ordinal=number) for number in range(n) for kind in kinds]
    service.learner.post(f"/runs/{run}/gold", {"known": [{"ask": ask, "known": known(ask["kind"])} for ask in asks]})
    service.learner.patch(run, gold_rate=rate)
    return asks


def answer_all(caller: Caller, run: str, n: int) -> list[Json]:
    """Answer n queries, whatever they are; returns the assignments."""
    done = []
    for _ in range(n):
        assignment = caller.lease(run=run)
        caller.answer(assignment)
        done.append(assignment)
    return done


def is_gold(service: Service, run: str, assignment: Json) -> bool:
    """Only who may read a run's queries can tell."""
    own = service.admin.get(f"/runs/{run}/queries", params={"limit": 500})["queries"]
    return assignment["query"]["id"] not in [one["id"] for one in own]


def test_gold_queries_come_at_the_rate_and_never_twice_before_all_were_seen(service: Service) -> None:
    run = service.learner.create_run()
    service.learner.ask(run, *(query(episode=n) for n in range(40)))
    bring(service, run, "inspect_full", rate=0.25, n=5)
    done = answer_all(service.annotator, run, 40)
    gold = [one for one in done if is_gold(service, run, one)]
    assert len(gold) == 10
    for block in range(10):
        assert len([one for one in gold if one in done[4 * block : 4 * block + 4]]) == 1
    listed = service.admin.get(f"/runs/{run}/gold")["gold"]
    assert [one["answers"] for one in listed] == [2] * 5
    assert service.annotator.lease(run=run)["query"]["ask"]["episode"] == 30, "the learner's own, in order"


def test_a_gold_query_looks_like_any_other(service: Service) -> None:
    run = service.learner.create_run()
    service.learner.ask(run, *(query(episode=7, ordinal=n) for n in range(30)), priority=3)
    bring(service, run, "inspect_full")
    gold, other = (
        next(one for one in answer_all(service.annotator, run, 20) if is_gold(service, run, one) == wanted)
        for wanted in (True, False)
    )
    assert gold.keys() == other.keys()
    assert gold["query"].keys() == other["query"].keys()
    for field in ("run", "state", "priority", "answer", "used"):
        assert gold["query"][field] == other["query"][field]
    assert gold["query"]["ask"]["episode"] == 7
    assert gold["run"]["id"] == run
    assert service.viewer.get(f"/queries/{gold['query']['id']}")["run"] == run
    assert service.annotator.answer(gold).keys() == service.annotator.answer(other).keys()
    assert service.annotator.answer(gold)["units"] == service.annotator.answer(other)["units"] == 1
    service.annotator.get(f"/runs/{run}/gold", 403)


def reliability(service: Service, caller: Caller) -> Json:
    """Return all that an administrator sees of somebody's answers."""
    (user,) = [one["id"] for one in service.admin.get("/users")["users"] if one["name"] == caller.name]
    return dict(service.admin.get(f"/users/{user}/numbers"))


def numbers(service: Service) -> dict[str, Json]:
    return {one["kind"]: one for one in reliability(service, service.annotator)["by_kind"]}


def lease_gold(service: Service, run: str) -> Json:
    """Answer the run's own queries until a gold query comes."""
    while True:
        assignment = service.annotator.lease(run=run)
        if is_gold(service, run, assignment):
            return dict(assignment)
        service.annotator.answer(assignment)


WRONG = {"kind": "inspect_full", "verdict": "fail"}


def test_only_the_first_answer_to_a_gold_query_is_scored(service: Service) -> None:
    run = service.learner.create_run()
    service.learner.ask(run, *(query(ordinal=n) for n in range(20)))
    bring(service, run, "inspect_full")
    held = lease_gold(service, run)
    service.annotator.answer(held, WRONG)
    for _ in range(2):
        held = service.annotator.retract(held)
        service.annotator.answer(held)
    found = reliability(service, service.annotator)
    assert (found["gold"], found["agreement"]) == (1, 0)
    assert service.admin.get(f"/runs/{run}/gold")["gold"][0]["agreement"] == 0


@pytest.mark.parametrize("skip", [False, True])
def test_a_wrong_answer_to_a_gold_query_counts_even_if_it_is_retracted_for_good(service: Service, skip: bool) -> None:
    run = service.learner.create_run()
    service.learner.ask(run, *(query(ordinal=n) for n in range(20)))
    bring(service, run, "inspect_full")
    held = lease_gold(service, run)
    service.annotator.answer(held, WRONG)
    service.annotator.release(service.annotator.retract(held), skip=skip)
    found = reliability(service, service.annotator)
    assert (found["gold"], found["agreement"]) == (1, 0)


def test_annotators_see_their_own_agreement_in_steps_of_ten_gold_queries(lite: Service) -> None:
    run = lite.learner.create_run()
    lite.learner.ask(run, *(query(episode=n) for n in range(60)))
    bring(lite, run, "inspect_full", n=30)
    seen = []
    for number in range(1, 21):
        held = lease_gold(lite, run)
        lite.annotator.answer(held, WRONG if number > 10 else None)
        own = lite.annotator.get("/me/numbers")
        assert reliability(lite, lite.annotator)["gold"] == number
        assert own["total"] == reliability(lite, lite.annotator)["total"]
        assert sum(one["gold"] for one in own["by_kind"]) == own["gold"]
        seen.append((own["gold"], own["agreement"]))
    assert seen == [(0, None)] * 9 + [(10, 1)] * 10 + [(20, 0.5)]


@pytest.mark.parametrize("kind", KINDS)
def test_an_answer_is_scored_at_once_and_any_of_the_right_ones_counts(service: Service, kind: str) -> None:
    run = service.learner.create_run()
    service.learner.ask(run, *(query("label_lo", ordinal=n) for n in range(30)))
    bring(service, run, kind)
    wrong = {"verdict": "fail"} if "inspect" in kind else {"actions": ["up", "up"]}
    answers = [right_answer(query(kind)), right_answer(query(kind)) | wrong]
    if kind == "label_hi":
        answers[1] = {"kind": kind, "subgoals": ["north"]}
    for answer in answers:
        assignment = service.annotator.lease()
        while not is_gold(service, run, assignment):
            service.annotator.answer(assignment)
            assignment = service.annotator.lease()
        service.annotator.answer(assignment, answer)
    found = numbers(service)[kind]
    share = {"label_hi": 1.0, "label_lo": 5 / 6, "label_full": 3 / 4}.get(kind, 1 / 2)
    assert (found["gold"], found["agreement"]) == (2, pytest.approx(share))
    assert found["gold_right"] == (2 if kind == "label_hi" else 1)


def test_an_answered_query_becomes_gold_for_everybody_else(service: Service) -> None:
    run = service.learner.create_run()
    asked = service.learner.ask(run, query("label_hi"), *(query("label_hi", episode=n) for n in range(1, 20)))
    first = asked[0]["id"]
    service.learner.post(f"/runs/{run}/gold", {"answered": [first]}, 409)
    service.annotator.answer(service.annotator.lease())
    service.learner.post(f"/runs/{run}/gold", {"answered": [first + 1_000]}, 404)
    other = service.learner.create_run()
    service.learner.post(f"/runs/{other}/gold", {"answered": [first]}, 404)
    for _ in range(2):  # saying it again changes nothing
        listed = service.learner.post(f"/runs/{run}/gold", {"answered": [first]})["gold"]
    assert [(one["query"], one["author"], one["known"]["subgoals"]) for one in listed] == [(first, "abe", [["south"]])]
    service.learner.patch(run, gold_rate=0.5)
    assert not any(is_gold(service, run, one) for one in answer_all(service.annotator, run, 6)), "never to its author"
    seen = [is_gold(service, run, one) for one in answer_all(service.admin, run, 6)]
    assert seen.count(True) == 3
    service.learner.call("DELETE", f"/runs/{run}/gold/{listed[0]['id']}", expect=204)
    service.learner.call("DELETE", f"/runs/{run}/gold/{listed[0]['id']}", expect=404)
    assert not any(is_gold(service, run, one) for one in answer_all(service.admin, run, 4)), "retired"


def test_what_cannot_be_right_is_refused_and_nothing_is_kept(service: Service) -> None:
    run = service.learner.create_run()
    asks = [query(kind) for kind in KINDS]
    wrong: list[tuple[Json, Json]] = [
        (asks[0], known("inspect_lo")),
        (asks[1], {"kind": "label_hi", "subgoals": [["west"]]}),
        (asks[1], {"kind": "label_hi", "subgoals": [[]]}),
        (asks[1], {"kind": "label_hi", "subgoals": []}),
        (asks[3], {"kind": "label_lo", "actions": [["up"]], "end": 2}),
        (asks[3], {"kind": "label_lo", "actions": [["up"], ["up"], ["up"]], "end": 3}),
        (asks[4], {"kind": "label_full", "actions": [["up"], ["fly"]]}),
        (query("hier_demo"), {"kind": "hier_demo", "segments": []}),
    ]
    for ask, answer in wrong:
        good = {"ask": asks[0], "known": known("inspect_full")}
        service.learner.post(f"/runs/{run}/gold", {"known": [good, {"ask": ask, "known": answer}]}, 422)
    assert service.learner.get(f"/runs/{run}/gold")["gold"] == []
    service.learner.patch(run, 422, gold_rate=0.6)


def test_a_gold_query_given_back_comes_again_and_a_skipped_one_does_not(service: Service) -> None:
    run = service.learner.create_run()
    service.learner.ask(run, *(query(ordinal=n) for n in range(40)))
    bring(service, run, "inspect_lo", "label_hi")

    def next_gold() -> Json:
        while True:
            assignment = service.annotator.lease(run=run)
            if is_gold(service, run, assignment):
                return dict(assignment)
            service.annotator.answer(assignment)

    first = next_gold()
    service.annotator.release(first)
    again = next_gold()
    assert again["query"]["id"] == first["query"]["id"]
    service.annotator.release(again, skip=True)
    others = [next_gold() for _ in range(1)]
    assert again["query"]["ask"]["kind"] not in [one["query"]["ask"]["kind"] for one in others]
    service.annotator.answer(others[0])
    back = service.annotator.retract(others[0])
    assert back["query"]["id"] == others[0]["query"]["id"]


def test_an_episode_is_gone_on_with_after_a_gold_query(service: Service) -> None:
    run = service.learner.create_run()
    service.learner.ask(run, *(query(episode=n) for n in range(12)))
    service.learner.ask(run, *(query(episode=n, ordinal=1) for n in range(11, -1, -1)))
    bring(service, run, "label_hi")
    own, after_gold = list[int](), False
    for _ in range(20):
        assignment = service.annotator.lease(run=run)
        service.annotator.answer(assignment)
        if is_gold(service, run, assignment):
            after_gold = True
            continue
        own.append(assignment["query"]["ask"]["episode"])
        if after_gold and len(own) % 2 == 0:
            assert own[-1] == own[-2], "the follow-up of the episode that the gold query came into"
        after_gold = False
    assert own == sorted(own)


def test_gold_queries_end_with_their_run(service: Service) -> None:
    run = service.learner.create_run()
    service.learner.ask(run, *(query(ordinal=n) for n in range(20)))
    bring(service, run, "inspect_full")
    held = [service.annotator.lease(run=run) for _ in range(2)]
    assert [is_gold(service, run, one) for one in held].count(True) == 1
    service.learner.patch(run, state="finished")
    for assignment in held:
        assert service.annotator.answer(assignment, expect=409)["type"] == "/problems/query-cancelled"


def test_the_learner_can_use_no_gold_query(service: Service) -> None:
    run = service.learner.create_run()
    service.learner.ask(run, *(query(ordinal=n) for n in range(9)))
    bring(service, run, "inspect_full")
    gold = next(one for one in answer_all(service.annotator, run, 4) if is_gold(service, run, one))
    service.learner.post(f"/queries/{gold['query']['id']}/use", expect=409)


def accounts(service: Service, run: str) -> Any:
    """All that a run's learner, curves and bills are made of."""
    rows = service.db.read_now(
        lambda tx: tx.conn.execute(ledger.select().where(ledger.c.run_id == run).order_by(ledger.c.id)).all()
    )
    got = service.learner.get(f"/runs/{run}/answers", params={"limit": 500})["queries"]
    costs = service.learner.costs(run)
    about = service.learner.get(f"/runs/{run}")
    return (
        [(row.entry, row.kind, row.episode, row.units, row.lo_units) for row in rows],
        [(one["ask"], one["answer"], one["units"]) for one in got],
        (costs["total"], costs["lo_total"], costs["reserved"], {k: v["units"] for k, v in costs["by_kind"].items()}),
        (about["spent"], about["reserved"], about["open_queries"]),
    )


STEPS = st.lists(st.sampled_from(["answer", "answer", "skip", "release", "retract"]), min_size=4, max_size=10)


def test_a_run_with_gold_queries_costs_and_learns_what_it_does_without(database_url: str) -> None:
    met: Counter[str] = Counter()

    @settings(max_examples=3, deadline=None, derandomize=True, suppress_health_check=list(HealthCheck), database=None)
    @given(rate=st.sampled_from([0.1, 1 / 3, 0.5]), steps=STEPS)
    @example(rate=0.5, steps=["answer", "retract", "skip", "release"] * 3)
    def check(rate: float, steps: list[str]) -> None:
        plain, golden = (service.learner.create_run(budget=500.0) for _ in range(2))
        for run in (plain, golden):
            service.learner.ask(run, *(query(kind, episode=n) for n in range(4) for kind in [KINDS[n]]))
            service.learner.ask(run, *(query("label_lo", episode=n) for n in range(4, 20)))
        bring(service, golden, *KINDS, rate=rate)
        for step in steps:
            for run in (plain, golden):
                met[f"{step} {carry_out(step, run)}"] += 1
        assert accounts(service, plain) == accounts(service, golden)
        charged = service.db.read_now(lambda tx: tx.conn.execute(select(ledger.c.run_id).distinct()).scalars().all())
        listed = [run["id"] for run in service.viewer.get("/runs")["runs"]]
        assert set(charged) <= set(listed), "no gold query is in any ledger"

    def carry_out(step: str, run: str) -> str:
        """Do a step to the run's own next query, and to whatever gold comes before it."""
        assignment = service.annotator.lease(run=run)
        before = accounts(service, run)
        kind = "own"
        while is_gold(service, run, assignment):
            kind = "gold"
            act(step, assignment)
            assert accounts(service, run) == before
            for held in service.annotator.get("/assignments")["assignments"]:
                service.annotator.answer(held)
            assignment = service.annotator.lease(run=run)
        act(step, assignment)
        for held in service.annotator.get("/assignments")["assignments"]:
            service.annotator.answer(held)
        return kind

    def act(step: str, assignment: Json) -> None:
        if step in {"skip", "release"}:
            service.annotator.release(assignment, skip=step == "skip")
        else:
            service.annotator.answer(assignment)
        if step == "retract":
            service.annotator.retract(assignment)

    with in_process(database_url) as service:
        check()
    assert {f"{step} {kind}" for step in ("answer", "skip", "release", "retract") for kind in ("own", "gold")} <= set(
        met
    )


@given(user=st.integers(1, 50), rate=st.floats(0.01, 0.5), length=st.integers(1, 400))
@settings(deadline=None, max_examples=60)
def test_the_places_of_gold_queries_keep_to_the_rate_anywhere(user: int, rate: float, length: int) -> None:
    places = [n for n in range(length) if Position(user, "00000000abcd", n).is_gold(rate)]
    assert abs(len(places) - rate * length) <= 1
    assert places == [n for n in range(length) if Position(user, "00000000abcd", n).is_gold(rate)]


def test_the_places_differ_between_people_and_are_not_every_nth() -> None:
    streams = [[n for n in range(100) if Position(user, "00000000abcd", n).is_gold(0.1)] for user in range(6)]
    assert len({tuple(stream) for stream in streams}) == 6
    gaps = {b - a for stream in streams for a, b in pairwise(stream)}
    assert len(gaps) > 5


def test_no_listing_of_the_server_shows_that_there_is_gold(service: Service) -> None:
    run = service.learner.create_run()
    service.learner.ask(run, *(query(ordinal=n) for n in range(9)))
    bring(service, run, "inspect_full")
    answer_all(service.annotator, run, 6)
    assert [one["id"] for one in service.viewer.get("/runs")["runs"]] == [run]
    text = service.client.get("/metrics", headers=service.viewer.headers).text
    assert 'waypost_runs{state="running"} 1' in text
    assert 'state="paused"' not in text
    assert service.client.get(f"{API}/runs/{run}/gold", headers=service.viewer.headers).status_code == 403
