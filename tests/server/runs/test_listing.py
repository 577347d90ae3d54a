"""The list of runs: found by words and state, sorted, and paged."""

from tests.server.db.plans import plans
from tests.server.kit import VOCABULARY, Json, Service, query
from tests.server.runs.test_curves import report, result


def names(page: Json) -> list[str]:
    return [run["name"] for run in page["runs"]]


def test_runs_are_found_by_words_in_name_algorithm_domain_and_id(service: Service) -> None:
    learner = service.learner
    first = learner.create_run(name="Maze one", algorithm="h-bc")
    learner.create_run(name="maze two", vocabulary=VOCABULARY | {"domain": "corridor"})
    learner.create_run(name="50% _off")
    found = service.viewer.get
    assert names(found("/runs?text=MAZE one")) == ["Maze one"]
    assert names(found("/runs?text=corri")) == ["maze two"]
    assert names(found("/runs?text=h-bc maze")) == ["Maze one"]
    assert names(found(f"/runs?text={first}")) == ["Maze one"]
    assert names(found("/runs?text=%25")) == ["50% _off"], "a wildcard is a character like any other"
    assert names(found("/runs?text=_off")) == ["50% _off"]
    nothing = found("/runs?text=nowhere")
    assert (nothing["runs"], nothing["total"]) == ([], 0)


def test_runs_are_filtered_by_state_and_chosen_by_id(service: Service) -> None:
    first, second = (service.learner.create_run(name=name) for name in ("first", "second"))
    service.learner.create_run(name="third")
    service.learner.patch(second, state="finished")
    assert names(service.viewer.get("/runs?state=finished")) == ["second"]
    assert names(service.viewer.get(f"/runs?run={first}&run={second}&run=none")) == ["second", "first"]


def test_runs_are_sorted_and_paged(service: Service) -> None:
    cheap, dear, untested = (service.learner.create_run(name=name) for name in ("b", "A", "c"))
    service.learner.ask(cheap, query())
    service.learner.ask(dear, query("label_lo"))
    for _ in range(2):
        service.annotator.answer(service.annotator.lease())
    report(service, cheap, result(0, True))
    report(service, dear, result(0, False), result(1, False))
    service.learner.patch(untested, priority=1)
    get = service.viewer.get
    assert names(get("/runs")) == ["c", "A", "b"]
    assert names(get("/runs?sort=name&descending=false")) == ["A", "b", "c"]
    assert names(get("/runs?sort=cost")) == ["A", "b", "c"]
    assert names(get("/runs?sort=episodes&descending=false")) == ["c", "b", "A"]
    assert names(get("/runs?sort=success")) == ["b", "A", "c"]
    assert names(get("/runs?sort=success&descending=false")) == ["A", "b", "c"], "what is not known comes last"
    page = get("/runs?sort=name&descending=false&limit=1&offset=1")
    assert (names(page), page["total"]) == (["b"], 3)


def test_queries_of_a_run_with_a_higher_priority_come_first(service: Service) -> None:
    usual, urgent = (service.learner.create_run(name=name) for name in ("usual", "urgent"))
    service.learner.ask(usual, query(ordinal=0), query(ordinal=1), priority=9)
    service.learner.ask(urgent, query(ordinal=0))
    assert service.learner.patch(urgent, priority=5)["priority"] == 5
    service.learner.ask(urgent, query(ordinal=1))
    leased = [service.annotator.lease()["query"] for _ in range(3)]
    assert [one["run"] for one in leased] == [urgent, urgent, usual]


def test_a_follow_up_does_not_overtake_a_run_that_was_preferred_meanwhile(service: Service) -> None:
    begun, preferred = (service.learner.create_run(name=name) for name in ("begun", "preferred"))
    service.learner.ask(begun, query(ordinal=0), query(ordinal=1))
    service.learner.ask(preferred, query(ordinal=0), query(ordinal=1))
    first = service.annotator.lease()
    assert first["query"]["run"] == begun
    service.learner.patch(preferred, priority=1)
    second = service.annotator.answer(first, next={})["next"]
    assert second["query"]["run"] == preferred
    service.learner.patch(preferred, priority=-1)
    assert service.annotator.answer(second, next={})["next"]["query"]["run"] == begun


def test_a_query_whose_answer_is_retracted_has_the_priority_that_its_run_has_by_now(service: Service) -> None:
    usual, urgent = service.learner.create_run(), service.learner.create_run()
    service.learner.ask(usual, query())
    service.learner.ask(urgent, query())
    held = service.annotator.lease(run=urgent)
    service.annotator.answer(held)
    service.learner.patch(urgent, priority=1)
    service.annotator.release(service.annotator.retract(held))
    other = service.user("ada", "annotator")  # has answered no query of this episode
    assert other.lease()["run"]["id"] == urgent


def test_to_change_a_priority_leaves_answered_queries_alone(lite: Service) -> None:
    run = lite.learner.create_run()
    lite.learner.ask(run, query())
    (plan,) = plans("SET run_priority", lambda: lite.learner.patch(run, priority=1))
    assert "ix_queries_run_state (run_id=? AND state=?" in plan


def test_a_priority_is_bounded_and_for_those_who_may(service: Service) -> None:
    run = service.learner.create_run()
    assert service.learner.patch(run, 422, priority=1_001)["errors"][0]["loc"] == ["body", "priority"]
    for caller in (service.viewer, service.annotator):
        assert caller.patch(run, 403, priority=1)["type"] == "/problems/forbidden"
    assert service.admin.patch(run, priority=-1_000)["priority"] == -1_000
