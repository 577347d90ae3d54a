"""Runs: their states, their budgets and what finishing does."""

import pytest
from tests.server.kit import VOCABULARY, Service, query, together


def test_a_run_is_created_listed_and_renamed(service: Service) -> None:
    config = {"rate": 0.5, "layers": [1, 2], "name": "grün \u0000"}
    first = service.learner.create_run(config=config, seed=2**63 - 1, episodes=10)
    second = service.learner.create_run()
    assert [run["id"] for run in service.viewer.get("/runs")["runs"]] == [second, first]
    run = service.viewer.get(f"/runs/{first}")
    assert (run["config"], run["seed"], run["vocabulary"]) == (config, 2**63 - 1, VOCABULARY)
    assert (run["state"], run["spent"], run["success_rate"]) == ("running", 0, None)
    assert service.learner.patch(first, name="better", result={"ok": True})["name"] == "better"
    assert service.learner.patch(first)["result"] == {"ok": True}


def test_a_vocabulary_names_nothing_twice(lite: Service) -> None:
    body = {"name": "x", "algorithm": "x", "seed": 0, "vocabulary": VOCABULARY | {"actions": ["up", "up"]}}
    problem = lite.learner.post("/runs", body, 422)
    assert problem["errors"][0]["loc"] == ["body", "vocabulary", "actions"]


def test_finishing_cancels_what_is_open_and_releases_its_reserve(service: Service) -> None:
    run = service.learner.create_run(budget=10)
    asked = service.learner.ask(run, query(), query("label_lo", ordinal=1), query(ordinal=2))
    service.annotator.answer(service.annotator.lease())
    held = service.annotator.lease()
    finished = service.learner.patch(run, state="finished")
    assert (finished["spent"], finished["reserved"], finished["open_queries"]) == (1, 0, 0)
    assert finished["finished_at"] >= finished["created_at"]
    states = [service.learner.get(f"/queries/{one['id']}")["state"] for one in asked]
    assert states == ["answered", "cancelled", "cancelled"]
    assert service.annotator.answer(held, expect=409)["type"] == "/problems/query-cancelled"
    assert service.annotator.lease(expect=204) is None
    assert service.learner.costs(run)["total"] == 1


def test_a_finished_run_takes_nothing_new_but_shows_what_it_has(service: Service) -> None:
    run = service.learner.create_run()
    (asked,) = service.learner.ask(run, query())
    held = service.annotator.lease()
    service.annotator.answer(held)
    service.learner.patch(run, state="finished")
    for refused in (
        service.learner.ask(run, query(ordinal=1), expect=409),
        service.learner.patch(run, 409, state="running"),
        service.annotator.retract(held, expect=409),
    ):
        assert refused["type"] == "/problems/run-finished"
    assert service.learner.ask(run, query())[0]["id"] == asked["id"]
    assert service.learner.patch(run, state="finished")["state"] == "finished"


def test_a_question_beyond_the_budget_is_refused(service: Service) -> None:
    run = service.learner.create_run(budget=4)
    service.learner.ask(run, query("label_lo"), query(ordinal=1))
    problem = service.learner.ask(run, query(ordinal=2), expect=402)
    assert problem["type"] == "/problems/budget-exhausted"
    dear = service.learner.create_run(prices={"subgoal": 1e9, "action": 1e9, "termination": 1e9})
    service.learner.ask(dear, query("hier_demo", max_segments=10_000, max_actions=10_000), expect=402)
    assert "0 of the run's budget are free" in problem["detail"]
    service.learner.patch(run, budget=5)
    service.learner.ask(run, query(ordinal=2))


def test_what_a_demonstration_does_not_use_of_its_reserve_is_free_again(service: Service) -> None:
    run = service.learner.create_run(budget=10)
    service.learner.ask(run, query("hier_demo"))
    assert service.learner.get(f"/runs/{run}")["reserved"] == 10
    service.learner.ask(run, query(ordinal=1), expect=402)
    service.annotator.answer(service.annotator.lease())
    service.learner.ask(run, query(ordinal=1))


def test_an_answer_cannot_be_taken_back_if_asking_again_would_not_fit(service: Service) -> None:
    run = service.learner.create_run(budget=10)
    service.learner.ask(run, query("hier_demo"))
    held = service.annotator.lease()
    service.annotator.answer(held)
    service.learner.ask(run, query("label_full", ordinal=1, n_actions=6))
    assert service.annotator.retract(held, expect=402)["type"] == "/problems/budget-exhausted"
    now = service.learner.get(f"/runs/{run}")
    assert (now["spent"], now["reserved"]) == (4, 6)


def test_an_answer_can_be_taken_back_if_asking_again_just_fits(service: Service) -> None:
    run = service.learner.create_run(budget=10)
    service.learner.ask(run, query("hier_demo", max_actions=2, max_segments=1))
    held = service.annotator.lease()
    asked_for = service.learner.get(f"/runs/{run}")["reserved"]
    units = service.annotator.answer(held)["units"]
    service.learner.patch(run, budget=asked_for)
    service.annotator.retract(held)
    now = service.learner.get(f"/runs/{run}")
    assert (now["spent"], now["reserved"]) == (0, asked_for)
    assert 0 < units <= asked_for


def test_a_budget_is_not_lowered_below_what_is_held(service: Service) -> None:
    run = service.learner.create_run(budget=10)
    service.learner.ask(run, query("label_lo"))
    problem = service.learner.patch(run, 409, budget=2)
    assert problem["type"] == "/problems/budget-too-low"
    assert "3 reserved" in problem["detail"]
    assert (problem["spent"], problem["reserved"]) == (0, 3)
    assert service.learner.patch(run, budget=3)["budget"] == 3
    assert service.learner.patch(run, budget=None)["budget"] is None


def test_prices_that_are_not_binary_fractions_add_up_exactly(service: Service) -> None:
    run = service.learner.create_run(budget=1, prices={"inspect_full": 0.1})
    service.learner.ask(run, *(query(ordinal=n) for n in range(10)))
    service.learner.ask(run, query(ordinal=10), expect=402)
    for _ in range(10):
        service.annotator.answer(service.annotator.lease())
    now = service.learner.get(f"/runs/{run}")
    assert (now["spent"], now["reserved"]) == (1, 0)


def test_sixty_four_clients_never_overspend_the_last_unit(service: Service) -> None:
    run = service.learner.create_run(budget=1)
    body = [{"queries": [query(ordinal=n)]} for n in range(64)]

    def ask(number: int) -> int:
        path = f"/api/v1/runs/{run}/queries"
        return service.client.post(path, json=body[number], headers=service.learner.headers).status_code

    assert sorted(together(ask, 64)) == [200] + [402] * 63
    assert service.learner.get(f"/runs/{run}")["reserved"] == 1


@pytest.mark.parametrize("budget", [-1, float("inf"), "5", 1e12])
def test_a_budget_is_a_bounded_number(lite: Service, budget: object) -> None:
    run = lite.learner.create_run()
    body = f'{{"budget": {"1e999" if budget == float("inf") else repr(budget).replace(chr(39), chr(34))}}}'
    headers = lite.learner.headers | {"Content-Type": "application/json"}
    assert lite.client.patch(f"/api/v1/runs/{run}", content=body, headers=headers).status_code == 422
