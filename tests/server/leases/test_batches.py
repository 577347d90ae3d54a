"""Several queries by one request: the same ones that single requests would get, one after the other."""

import time
from concurrent.futures import ThreadPoolExecutor
from typing import Any

from tests.server.kit import Caller, Service, in_process, query


def kinds(caller: Caller, count: int = 10, **wish: Any) -> list[str]:
    """Lease a batch, and return the kinds of its queries."""
    held = caller.post("/assignments/batch", {"count": count, **wish}, 201)["assignments"]
    return [one["query"]["ask"]["kind"] for one in held]


def test_a_batch_has_only_the_wanted_kinds_of_the_wanted_run(service: Service) -> None:
    one, other = service.learner.create_run(), service.learner.create_run()
    service.learner.ask(one, query("inspect_full"), query("label_lo", ordinal=1))
    service.learner.ask(other, query("label_lo"), query("label_hi", ordinal=1))
    assert kinds(service.annotator, run=one, kinds=["label_lo", "label_hi"]) == ["label_lo"]
    assert kinds(service.annotator, kinds=["label_hi"]) == ["label_hi"]
    assert kinds(service.annotator, run=other) == ["label_lo"]
    assert kinds(service.annotator) == ["inspect_full"]
    service.annotator.post("/assignments/batch", {"count": 1, "run": "nowhere"}, 404)
    service.annotator.post("/assignments/batch", {"count": 1, "run": "\0"}, 404)


def test_a_deferring_batch_leaves_queries_to_people_at_work(service: Service) -> None:
    bot = service.user("bot", "annotator")
    service.annotator.lease(kinds=["inspect_full"], expect=204)
    service.learner.ask(service.learner.create_run(), query("inspect_full"), query("label_hi", ordinal=1))
    assert kinds(bot, defer=0.9) == ["label_hi"], "nobody at work takes that kind"
    assert kinds(service.annotator) == ["inspect_full"]


def test_a_batch_has_no_follow_up_of_another_who_is_at_work(service: Service) -> None:
    run, otto = service.learner.create_run(), service.user("otto", "annotator")
    service.learner.ask(run, query())
    service.annotator.answer(service.annotator.lease())
    service.learner.ask(run, query("label_hi", ordinal=1), query("label_lo", episode=1))
    assert kinds(otto) == ["label_lo"]
    assert kinds(service.annotator) == ["label_hi"]


def test_who_leases_a_batch_is_at_work(service: Service) -> None:
    bot = service.user("bot", "annotator")
    assert kinds(service.annotator) == []
    service.learner.ask(service.learner.create_run(), query())
    assert kinds(bot, defer=60) == []


def test_a_batch_is_woken_by_a_question(database_url: str) -> None:
    with in_process(database_url, poll_seconds=60) as service, ThreadPoolExecutor() as pool:
        run = service.learner.create_run()
        waiting = pool.submit(kinds, service.annotator, wait=30)
        time.sleep(0.3)
        began = time.monotonic()
        service.learner.ask(run, query())
        assert waiting.result() == ["inspect_full"]
        assert time.monotonic() - began < 10
