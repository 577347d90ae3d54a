"""Active seconds: the annotator's own time, by the database's clock. Idle time counts up to a cap, nothing twice."""

import time
from collections.abc import Iterator

import pytest
from sqlalchemy import text
from tests.server.kit import Service, in_process, query

CAP = 1.0
SLACK = 0.01  # of exact sums


@pytest.fixture
def capped(database_url: str) -> Iterator[Service]:
    """A service whose idle cap is short."""
    with in_process(database_url, idle_seconds=CAP) as service:
        yield service


def ask(service: Service, n: int = 1) -> str:
    run = service.learner.create_run()
    service.learner.ask(run, *(query(episode=number) for number in range(n)))
    return run


def test_an_idle_gap_counts_up_to_the_cap_and_the_raw_seconds_go_on(capped: Service) -> None:
    run = ask(capped)
    held = capped.annotator.lease()
    time.sleep(CAP + 0.3)
    receipt = capped.annotator.answer(held)
    assert receipt["active_seconds"] == pytest.approx(CAP, abs=SLACK)
    assert receipt["seconds"] >= CAP + 0.3
    costs = capped.learner.costs(run)
    assert (costs["active_seconds"], costs["seconds"]) == (receipt["active_seconds"], receipt["seconds"])
    (stored,) = capped.learner.get(f"/runs/{run}/answers")["queries"]
    assert stored["active_seconds"] == receipt["active_seconds"]
    assert capped.annotator.get("/me")["median_seconds"] == receipt["active_seconds"]


def test_signs_of_activity_keep_the_clock_running(capped: Service) -> None:
    ask(capped)
    held = capped.annotator.lease()
    for _ in range(3):
        time.sleep(0.4)
        capped.annotator.renew(held, active=True)
    receipt = capped.annotator.answer(held)
    assert receipt["active_seconds"] > CAP
    assert receipt["active_seconds"] == pytest.approx(receipt["seconds"], abs=SLACK)


def test_a_heartbeat_without_activity_is_no_sign_of_it(capped: Service) -> None:
    ask(capped)
    held = capped.annotator.lease()
    for _ in range(3):
        time.sleep(0.4)
        capped.annotator.renew(held)
    assert capped.annotator.answer(held)["active_seconds"] == pytest.approx(CAP, abs=SLACK)


def test_the_clock_starts_at_a_lease_whatever_others_hold(capped: Service) -> None:
    ask(capped, 3)
    (other,) = capped.annotators(1)
    other.lease()
    capped.annotator.answer(capped.annotator.lease())
    time.sleep(0.5)
    held = capped.annotator.lease()
    capped.annotator.renew(held, active=True)
    time.sleep(CAP + 0.6)
    assert CAP <= capped.annotator.answer(held)["active_seconds"] < CAP + 0.4, "the break before the lease counts"


def test_a_query_leased_ahead_costs_time_from_the_answer_before_it(capped: Service) -> None:
    ask(capped, 2)
    first, ahead = capped.annotator.lease(), capped.annotator.lease(ahead=True)
    time.sleep(0.3)
    receipt = capped.annotator.answer(first)
    assert receipt["active_seconds"] == pytest.approx(receipt["seconds"], abs=SLACK)
    next_receipt = capped.annotator.answer(ahead)
    assert next_receipt["active_seconds"] <= next_receipt["seconds"] - 0.3 + SLACK


def test_waiting_for_a_query_is_nobodys_time(capped: Service) -> None:
    run = ask(capped)
    capped.annotator.answer(capped.annotator.lease())
    time.sleep(0.3)
    capped.learner.ask(run, query(episode=1))
    receipt = capped.annotator.answer(capped.annotator.lease())
    assert receipt["active_seconds"] == pytest.approx(receipt["seconds"], abs=SLACK)


def test_time_on_a_skipped_query_is_not_the_next_ones(capped: Service) -> None:
    ask(capped, 2)
    skipped, ahead = capped.annotator.lease(), capped.annotator.lease(ahead=True)
    time.sleep(0.3)
    capped.annotator.release(skipped, skip=True)
    receipt = capped.annotator.answer(ahead)
    assert receipt["active_seconds"] <= receipt["seconds"] - 0.3 + SLACK


def test_a_retracted_answer_gives_its_active_seconds_back(capped: Service) -> None:
    run = ask(capped)
    held = capped.annotator.lease()
    time.sleep(0.2)
    capped.annotator.answer(held)
    again = capped.annotator.retract(held)
    assert capped.learner.costs(run)["active_seconds"] == pytest.approx(0, abs=1e-6)
    seconds = capped.annotator.answer(again)["active_seconds"]
    assert capped.learner.costs(run)["active_seconds"] == pytest.approx(seconds)


def test_the_curve_sums_active_seconds(lite: Service) -> None:
    run = ask(lite)
    seconds = lite.annotator.answer(lite.annotator.lease())["active_seconds"]
    row = {"episode": 0, "warm_start": False, "train_success": True, "test_success": True, "seconds": 1.0}
    sizes = {"train_steps": 1, "test_steps": 1, "hi_labels": 0, "lo_labels": 0}
    lite.learner.post(f"/runs/{run}/episodes", {"episodes": [row | sizes]})
    assert lite.learner.get(f"/runs/{run}/curves")["active_seconds"] == [pytest.approx(seconds)]


def test_a_lease_older_than_the_clock_costs_no_active_time(lite: Service) -> None:
    ask(lite)
    held = lite.annotator.lease()
    lite.db.write_now(lambda tx: tx.conn.execute(text("DELETE FROM activity")))
    assert lite.annotator.answer(held)["active_seconds"] == 0
