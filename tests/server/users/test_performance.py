"""Annotators' own numbers, counted by the database."""

import statistics

import pytest
from sqlalchemy import text
from tests.server.kit import Caller, Service, query

ANSWERS = {"inspect_full": [300.0, 100.0, 200.0], "label_lo": [400.0, 100.0, 900.0, 200.0], "label_hi": [500.0]}


def answer_some(service: Service, who: Caller) -> None:
    """Answer queries of several kinds, each in the seconds given."""
    run = service.learner.create_run()
    asks = [query(kind, episode=n) for kind, seconds in ANSWERS.items() for n, _ in enumerate(seconds)]
    service.learner.ask(run, *(ask | {"ordinal": place} for place, ask in enumerate(asks)))
    left = {kind: list(seconds) for kind, seconds in ANSWERS.items()}
    for _ in asks:
        held = who.lease(run=run)
        back = {"seconds": left[held["query"]["ask"]["kind"]].pop(), "id": held["id"]}
        service.db.write_now(
            lambda tx, back=back: tx.conn.execute(
                text("UPDATE assignments SET leased_at = leased_at - :seconds WHERE id = :id"), back
            )
        )
        who.answer(held)


def test_medians_and_sums_are_by_kind(service: Service) -> None:
    answer_some(service, service.annotator)
    found = service.annotator.get("/me/numbers")
    assert (found["total"], found["today"]) == ({"answers": 8, "units": 16.0}, {"answers": 8, "units": 16.0})
    by_kind = {one["kind"]: one for one in found["by_kind"]}
    assert set(by_kind) == set(ANSWERS)
    for kind, seconds in ANSWERS.items():
        assert by_kind[kind]["median_seconds"] == pytest.approx(statistics.median(seconds), abs=30)
        assert (by_kind[kind]["total"]["answers"], by_kind[kind]["agreement"]) == (len(seconds), None)


def test_administrators_see_everybody_and_others_themselves(service: Service) -> None:
    answer_some(service, service.annotator)
    held = service.admin.lease(204)
    assert held is None
    listed = service.admin.get("/numbers")["annotators"]
    assert [(one["name"], one["total"]["answers"]) for one in listed] == [("abe", 8)]
    assert service.admin.get(f"/users/{listed[0]['user']}/numbers") == listed[0]
    assert service.viewer.get("/me/numbers")["by_kind"] == []
    service.viewer.get("/numbers", 403)
    service.admin.get("/users/999/numbers", 404)


@pytest.mark.parametrize(("days", "today", "week"), [(0, 8, 8), (1, 0, 8), (7, 0, 0)])
def test_days_are_told_apart(lite: Service, days: int, today: int, week: int) -> None:
    answer_some(lite, lite.annotator)
    with_triggers_off = [
        "DROP TRIGGER answers_no_update",
        f"UPDATE answers SET created_at = created_at - {days * 86_400}",
    ]
    for statement in with_triggers_off:
        lite.db.write_now(lambda tx, statement=statement: tx.conn.execute(text(statement)))
    found = lite.annotator.get("/me/numbers")
    assert (found["today"]["answers"], found["week"]["answers"], found["total"]["answers"]) == (today, week, 8)


def test_answers_taken_back_do_not_count(service: Service) -> None:
    service.learner.ask(service.learner.create_run(), query())
    held = service.annotator.lease()
    service.annotator.answer(held)
    service.annotator.retract(held)
    assert service.annotator.get("/me/numbers")["total"] == {"answers": 0, "units": 0.0}
