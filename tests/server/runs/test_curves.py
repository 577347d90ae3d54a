"""Curves and costs, out of the ledger and the reported episodes alone."""

import json
from itertools import pairwise

import pytest
from sqlalchemy import text
from tests.server.kit import Json, Service, in_process, query, right_answer

from waypost_server.db.engine import Database
from waypost_server.runs.curves import counting, cumulative, first_at, trailing


def result(episode: int, passed: bool | None = True, **more: object) -> Json:
    return {
        "episode": episode,
        "warm_start": False,
        "train_success": None,
        "test_success": passed,
        "train_steps": 10,
        "test_steps": 10,
        "hi_labels": 0,
        "lo_labels": 0,
        "seconds": 0.5,
    } | more


def report(service: Service, run: str, *results: Json, expect: int = 200) -> Json:
    return dict(service.learner.post(f"/runs/{run}/episodes", {"episodes": list(results)}, expect))


def test_the_trailing_rate_leaves_untested_episodes_out() -> None:
    assert trailing([None, True, None, False, True], 2) == [None, 1.0, 1.0, 0.5, 0.5]
    assert trailing([True] * 100 + [False] * 50)[-1] == 0.5


def test_costs_add_up_to_each_reported_episode() -> None:
    paid, amounts = [0, 1, 3, 9], [1, 2, 4, 8]
    assert cumulative(counting(paid, [0, 2, 3]), amounts) == [1, 3, 7]
    assert cumulative(counting(paid, []), amounts) == []
    assert cumulative(counting([], [5]), []) == [0]


def test_a_level_counts_only_over_a_hundred_tests() -> None:
    tests: list[bool | None] = [True] * 99 + [None, False, True]
    episodes = list(range(len(tests)))
    costs = [float(n) for n in episodes]
    milestone = first_at(0.99, episodes, tests, costs)
    assert milestone is not None
    assert (milestone.episode, milestone.cost) == (100, 100.0)
    assert first_at(1.0, episodes, tests, costs) is None
    assert first_at(0.5, episodes[:99], tests[:99], costs[:99]) is None


def test_curves_join_episodes_with_the_ledger(service: Service) -> None:
    run = service.learner.create_run()
    service.learner.ask(run, query("inspect_full", episode=0), query("label_lo", episode=0, ordinal=1))
    service.learner.ask(run, query("label_hi", episode=2), query("label_full", episode=9))
    for _ in range(4):
        service.annotator.answer(service.annotator.lease())
    report(service, run, result(0, False), result(1, None), result(2, True))
    curves = service.viewer.get(f"/runs/{run}/curves")
    assert curves["episode"] == [0, 1, 2]
    assert curves["success_rate"] == [0, 0, 0.5]
    assert curves["test_success"] == [False, None, True]
    assert curves["cost"] == [4, 4, 5]
    assert curves["lo_cost"] == [3, 3, 3]
    assert curves["cost_by_kind"]["label_lo"] == [3, 3, 3]
    assert curves["cost_by_kind"]["label_hi"] == [0, 0, 1]
    assert curves["cost_by_kind"]["label_full"] == [0, 0, 0]
    assert 0 < curves["seconds"][0] <= curves["seconds"][2]
    costs = service.viewer.get(f"/runs/{run}/costs")
    assert (costs["total"], costs["lo_total"]) == (7, 5)
    assert costs["first_at"] == {"0.8": None, "0.9": None, "0.95": None, "0.99": None}


def test_curves_carry_what_the_learner_reported_of_itself(service: Service) -> None:
    run = service.learner.create_run()
    warm = result(0, hi_labels=12, train_steps=0, seconds=1.5)
    report(service, run, warm, result(1, None, hi_labels=12, train_steps=100), result(3, hi_labels=20, train_steps=44))
    curves = service.viewer.get(f"/runs/{run}/curves")
    assert curves["hi_labels"] == [12, 12, 20]
    assert curves["lo_samples"] == [0, 100, 144]
    assert curves["learner_seconds"] == [1.5, 2, 2.5]


def test_curves_show_how_often_the_last_hundred_attempts_reached_each_subgoal(service: Service) -> None:
    run = service.learner.create_run()
    many = [{"subgoal": "key", "reached": True}] * 99 + [{"subgoal": "door", "reached": False}]
    once = [{"subgoal": "key", "reached": True}, {"subgoal": "key", "reached": False}]
    report(service, run, result(0), result(1, attempts=many), result(2, attempts=once))
    curves = service.viewer.get(f"/runs/{run}/curves")
    assert curves["reached"] == {"key": [0, 0.99, 0.99], "door": [0, 0, 0]}
    later = service.viewer.get(f"/runs/{run}/curves?after=0")
    assert later["reached"] == {"key": [0.99, 0.99], "door": [0, 0]}


def test_the_mean_reward_leaves_demonstrations_out(service: Service) -> None:
    run = service.learner.create_run()
    report(service, run, result(0, warm_start=True), *(result(n, reward=100.0 * n) for n in range(1, 103)))
    rewards = service.viewer.get(f"/runs/{run}/curves")["reward"]
    assert rewards[:3] == [None, 100, 150]
    assert rewards[-1] == 100 * (3 + 102) / 2  # of the last hundred


def test_the_run_shows_its_trailing_success(service: Service) -> None:
    run = service.learner.create_run()
    report(service, run, *(result(n, n >= 150) for n in range(200)), result(200, None))
    now = service.viewer.get(f"/runs/{run}")
    assert (now["episodes_done"], now["success_rate"]) == (201, 0.5)


def test_milestones_say_when_a_level_was_first_reached(service: Service) -> None:
    run = service.learner.create_run()
    service.learner.ask(run, query(episode=0), query("label_lo", episode=120))
    for _ in range(2):
        service.annotator.answer(service.annotator.lease())
    report(service, run, *(result(n, n >= 20) for n in range(130)))
    first_at = service.learner.costs(run)["first_at"]
    assert first_at["0.8"] == {"episode": 99, "cost": 1}
    assert first_at["0.9"] == {"episode": 109, "cost": 1}
    assert first_at["0.99"] is None or first_at["0.99"]["cost"] == 1
    assert first_at["0.95"] == {"episode": 114, "cost": 1}
    assert service.learner.costs(run)["tests"] == 130


def test_reporting_again_changes_nothing_and_otherwise_is_refused(service: Service) -> None:
    run = service.learner.create_run()
    report(service, run, result(0))
    assert report(service, run, result(0), result(1))["episodes_done"] == 2
    problem = report(service, run, result(2), result(1, False), expect=409)
    assert problem["type"] == "/problems/different-content"
    assert service.viewer.get(f"/runs/{run}")["episodes_done"] == 2
    service.learner.patch(run, state="finished")
    report(service, run, result(1))
    assert report(service, run, result(5), expect=409)["type"] == "/problems/run-finished"


@pytest.mark.parametrize("wrong", [{"seconds": -1}, {"test_success": 1}, {"hi_labels": -1}, {"extra": 0}])
def test_a_result_that_makes_no_sense_is_refused(lite: Service, wrong: Json) -> None:
    report(lite, lite.learner.create_run(), result(0) | wrong, expect=422)


def filled(service: Service, run: str, n_episodes: int, per_episode: int, active: float = 0.0) -> None:
    """Fill a run with answered queries of one unit, by the shortest way; `active`: the annotator's seconds for each."""
    ask = (
        "INSERT INTO queries (run_id, episode, ordinal, kind, state, priority, ask, digest, reserve, revision, used, "
        "created_at) VALUES (:run, :e, :o, 'label_lo', 'open', 0, :ask, '', 0, 0, :no, 0)"
    )
    lease = (
        "INSERT INTO assignments (query_id, user_id, token, state, deferring, leased_at, expires_at, ended_at) "
        "SELECT id, 1, '', 'answered', :no, 0, 0, 0 FROM queries WHERE run_id = :run"
    )
    answer = (
        "INSERT INTO answers (run_id, query_id, assignment_id, user_id, content, digest, revision, units, seconds, "
        "created_at) SELECT :run, query_id, a.id, 1, :content, '', 0, 1000000, 1, 0 FROM assignments a "
        "JOIN queries q ON q.id = a.query_id WHERE q.run_id = :run"
    )
    charge = (
        "INSERT INTO ledger (run_id, query_id, answer_id, entry, kind, episode, units, lo_units, seconds, "
        "active_seconds, created_at) "
        "SELECT :run, query_id, a.id, 'charge', 'label_lo', q.episode, 1000000, 1000000, 1, :active, 0 FROM answers a "
        "JOIN queries q ON q.id = a.query_id WHERE q.run_id = :run"
    )
    spend = "UPDATE runs SET spent = (SELECT sum(units) FROM ledger WHERE run_id = :run) WHERE id = :run"

    def fill(tx: object) -> None:
        asked = query("label_lo", n_actions=20)
        content = json.dumps(right_answer(asked))
        rows = [
            {"run": run, "e": e, "o": o, "no": False, "ask": json.dumps(asked)}
            for e in range(n_episodes)
            for o in range(per_episode)
        ]
        tx.conn.execute(text(ask), rows)
        for statement in (lease, answer, charge, spend):
            tx.conn.execute(text(statement), {"run": run, "no": False, "content": content, "active": active})

    service.db.write_now(fill)


def test_a_long_run_has_a_row_an_episode_and_every_cost(service: Service) -> None:
    run = service.learner.create_run()
    filled(service, run, 1_000, 5)
    report(service, run, *(result(n, n % 3 > 0) for n in range(1_000)))
    curves = service.viewer.get(f"/runs/{run}/curves")
    assert curves["episode"] == list(range(1_000))
    assert curves["cost"] == [5.0 * (n + 1) for n in range(1_000)]
    assert service.learner.costs(run)["total"] == 5_000


@pytest.mark.parametrize("most", [2, 3, 7, 333, 500, 999, 1_000, 5_000])
def test_of_very_many_episodes_some_can_be_had_evenly_spaced_and_with_the_last(lite: Service, most: int) -> None:
    run = lite.learner.create_run()
    filled(lite, run, 1_000, 2, active=0.5)
    rewards = {"reward": 0.5, "attempts": [{"subgoal": "key", "reached": True}]}
    report(lite, run, *(result(n, n % 3 > 0, **rewards) for n in range(1_000)))
    every = lite.viewer.get(f"/runs/{run}/curves")
    some = lite.viewer.get(f"/runs/{run}/curves", params={"most": most})
    rows = [every["episode"].index(episode) for episode in some["episode"]]
    assert len({after - before for before, after in pairwise(rows)}) == 1
    assert rows[-1] == 999
    assert min(most, 1_000) / 2 < len(rows) <= most
    for name, column in every.items():
        for key, values in column.items() if isinstance(column, dict) else [("", column)]:
            found = some[name][key] if key else some[name]
            assert found == [values[row] for row in rows], name
    later = lite.viewer.get(f"/runs/{run}/curves", params={"most": most, "after": 997})
    assert later["episode"] == [998, 999]


def test_the_ledger_survives_a_restart(database_url: str) -> None:
    with in_process(database_url) as service:
        run = service.learner.create_run()
        service.learner.ask(run, query("label_lo"))
        service.annotator.answer(service.annotator.lease())
        costs = service.learner.costs(run)
    Database(database_url).close()
    with in_process(database_url) as service:
        assert service.learner.costs(run) == costs
