"""Second answers: a share of the queries is answered once more, by somebody else, and nothing of the run changes."""

from itertools import product

import krippendorff
import pytest
from tests.server.gold.test_gold import answer_all
from tests.server.kit import Caller, Json, Service, query, right_answer, together

from waypost_server.answers.review.agreement import alpha
from waypost_server.db.checking import check
from waypost_server.gold.second import is_drawn


def facts(service: Service, run: str) -> list[Json]:
    """What the learner, the ledger and the curves know of a run, without ids and times."""
    found = [service.learner.get(f"/runs/{run}/{part}") for part in ("answers", "ledger", "costs", "query-rows")]
    answers, ledger, costs, rows = found
    return [
        {"answers": [(one["ask"]["ordinal"], one["answer"], one["annotator"]) for one in answers["queries"]]},
        {"ledger": [(one["entry"], one["ordinal"], one["units"]) for one in ledger["entries"]]},
        {
            "costs": (costs["total"], costs["reserved"]),
            "rows": [(one["ordinal"], one["state"]) for one in rows["rows"]],
        },
        {"state": {key: service.learner.get(f"/runs/{run}")[key] for key in ("spent", "reserved", "open_queries")}},
    ]


def twice(service: Service, run: str, asks: list[Json], other: Caller, **unlike: Json) -> None:
    """Let one annotator answer queries, and another one answer them again, some of them in another way."""
    service.learner.ask(run, *asks)
    answer_all(service.annotator, run, len(asks))
    for _ in asks:
        held = other.lease(run=run)
        ask = held["query"]["ask"]
        other.answer(held, unlike.get(str(ask["ordinal"])) or right_answer(ask))


def test_the_second_answer_comes_from_somebody_else_and_changes_nothing_of_the_run(service: Service) -> None:
    run = service.learner.create_run(budget=5.0, second_answers=1.0)
    kinds = ("inspect_full", "label_hi", "inspect_lo")
    asked = service.learner.ask(run, *(query(kind, ordinal=n) for n, kind in enumerate(kinds)))
    answer_all(service.annotator, run, 3)
    before = facts(service, run)
    service.annotator.lease(204, run=run)
    ada = service.user("ada", "annotator")
    held = ada.lease(run=run, kinds=["label_hi"])
    assert held["query"]["ask"] == asked[1]["ask"]
    assert (held["query"]["run"], held["run"]["id"]) == (run, run)
    assert held["query"]["id"] != asked[1]["id"]
    ada.answer(held, {"kind": "label_hi", "subgoals": ["north"]})
    skipped = ada.lease(run=run)
    ada.release(skipped, skip=True)
    ada.answer(ada.lease(run=run))
    ada.lease(204, run=run)
    assert facts(service, run) == before
    found = service.learner.get(f"/runs/{run}/agreement")
    assert (found["waiting"], found["units"]) == (1, 2)
    rows = service.learner.get(f"/runs/{run}/review")["rows"]
    assert [one["second"] and one["second"]["annotator"] for one in rows] == ["ada", "ada", None]
    (differing,) = service.learner.get(f"/runs/{run}/review", params={"disagrees": "second"})["rows"]
    assert differing["query"]["id"] == asked[1]["id"]
    assert differing["second"]["answer"]["subgoals"] == ["north"]
    service.learner.post(
        f"/queries/{held['query']['id']}/send-back", {"answer": differing["query"]["id"], "text": "no"}, 409
    )
    assert all(not one.n_faults for one in service.db.read_now(check))
    service.learner.patch(run, state="finished")
    service.user("eve", "annotator").lease(204, run=run)


def test_nobody_waits_for_second_answers_and_they_wait_for_nobody(service: Service) -> None:
    run = service.learner.create_run(second_answers=1.0)
    service.learner.ask(run, query(), query(ordinal=1))
    (first,) = answer_all(service.annotator, run, 1)
    assert service.learner.get(f"/queries/{first['query']['id']}")["state"] == "answered", "the learner has it"
    ada = service.user("ada", "annotator")
    second = ada.lease(run=run)
    assert second["query"]["ask"]["ordinal"] == 0, "in place of a query of the run"
    assert service.annotator.lease(run=run)["query"]["ask"]["ordinal"] == 1, "which stays free for others"
    ada.release(second)
    again = ada.lease(run=run)
    assert again["query"]["id"] == second["query"]["id"], "one copy for each query"
    ada.answer(again)
    retracted = ada.retract(again)
    assert service.learner.get(f"/runs/{run}/agreement")["waiting"] == 1
    ada.answer(retracted)
    assert service.learner.get(f"/runs/{run}/agreement")["waiting"] == 0


def test_annotators_who_come_together_get_one_copy(service: Service) -> None:
    run = service.learner.create_run(second_answers=1.0)
    service.learner.ask(run, query())
    answer_all(service.annotator, run, 1)
    others = service.annotators(4)

    def lease(number: int) -> int:
        headers = others[number].headers
        return service.client.post("/api/v1/assignments", json={"run": run}, headers=headers).status_code

    assert sorted(together(lease, 4)) == [201, 204, 204, 204]


def test_two_answers_of_one_annotator_are_no_pair(service: Service) -> None:
    run = service.learner.create_run(second_answers=1.0)
    ada = service.user("ada", "annotator")
    twice(service, run, [query()], ada)
    (found,) = service.learner.get(f"/runs/{run}/answers")["queries"]
    service.learner.post(f"/queries/{found['id']}/send-back", {"answer": found["answer_id"], "text": "No."}, 201)
    ada.answer(ada.lease(run=run))
    assert service.learner.get(f"/runs/{run}/agreement")["by_kind"] == []
    service.annotator.lease(204, run=run)


def test_a_demonstration_is_not_answered_twice(service: Service) -> None:
    run = service.learner.create_run(second_answers=1.0)
    service.learner.ask(run, query("hier_demo"))
    answer_all(service.annotator, run, 1)
    service.user("ada", "annotator").lease(204, run=run)
    assert service.learner.get(f"/runs/{run}/agreement")["waiting"] == 0


def test_the_draw_depends_on_the_seed_and_the_place_alone() -> None:
    places = list(product(range(100), range(20)))
    drawn = [place for place in places if is_drawn(7, *place, 0.1)]
    assert drawn[:4] == [place for place in places[: places.index(drawn[3]) + 1] if is_drawn(7, *place, 0.1)]
    assert 150 < len(drawn) < 250
    assert set(drawn) <= {place for place in places if is_drawn(7, *place, 0.2)}, "a larger share draws those, too"
    assert drawn != [place for place in places if is_drawn(8, *place, 0.1)]
    assert not any(is_drawn(7, *place, 0.0) for place in places)
    assert all(is_drawn(7, *place, 1.0) for place in places)


def test_alpha_is_given_by_kind_over_the_single_labels(service: Service) -> None:
    run = service.learner.create_run(second_answers=1.0)
    # The first annotator says: down, down, and done in the last state.
    asks = [query("label_lo", ordinal=n) for n in range(10)] + [query(episode=1, ordinal=20 + n) for n in range(2)]
    early = {"kind": "label_lo", "actions": ["up", None], "terminations": [False, True, False]}
    twice(service, run, asks, service.user("ada", "annotator"), **{"0": early, "1": early})
    by_kind = {one["kind"]: one for one in service.learner.get(f"/runs/{run}/agreement")["by_kind"]}
    lo = by_kind["label_lo"]
    # After the end that the second annotator gave, there is no label to compare.
    names = {"up": 0, "down": 1, "(done)": 2}
    pairs = [("down", "up"), ("down", "(done)")] * 2 + [("down", "down"), ("down", "down"), ("(done)", "(done)")] * 8
    data = [[names[pair[rater]] for pair in pairs] for rater in (0, 1)]
    expected = krippendorff.alpha(reliability_data=data, level_of_measurement="nominal")
    assert (lo["queries"], lo["labels"]) == (10, len(pairs))
    assert lo["share"] == pytest.approx(24 / 28)
    assert lo["alpha"] == pytest.approx(expected)
    assert by_kind["inspect_full"] == {"kind": "inspect_full", "queries": 2, "labels": 2, "share": 1, "alpha": None}


def test_alpha_is_the_one_of_the_literature() -> None:
    # By hand: one of ten pairs differs; there are 9 a and 11 b. D_o = 0.1, D_e = 2 * 9 * 11 / (20 * 19).
    pairs = [*[("a", "a")] * 4, *[("b", "b")] * 5, ("a", "b")]
    assert alpha(pairs) == pytest.approx(1 - 0.1 / (2 * 9 * 11 / (20 * 19)))
    assert alpha([("a", "a")] * 5) is None, "without another label, alpha is undefined"
