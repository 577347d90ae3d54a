"""Assignments: who gets which query, for how long, and how it comes back."""

import threading
import time

import pytest
from sqlalchemy import select, update
from tests.server.kit import Service, in_process, query

from waypost_server.db.tables import assignments
from waypost_server.leases import service as leases


def kinds_of(*assignments: dict) -> list[str]:
    return [one["query"]["ask"]["kind"] for one in assignments]


def test_without_queries_there_is_nothing_to_lease(service: Service) -> None:
    assert service.annotator.lease(expect=204) is None


def test_a_lease_carries_the_query_its_run_and_its_end(service: Service) -> None:
    run = service.learner.create_run()
    (asked,) = service.learner.ask(run, query(suggestion={"kind": "inspect_full", "verdict": "pass"}))
    held = service.annotator.lease()
    assert held["query"]["ask"] == asked["ask"]
    assert held["query"]["state"] == "leased"
    assert held["run"]["id"] == run
    assert held["expires_at"] == pytest.approx(held["leased_at"] + 60)
    assert held["lease_seconds"] == pytest.approx(60)
    assert service.annotator.lease(expect=204) is None


def test_higher_priority_comes_first_then_age(service: Service) -> None:
    run = service.learner.create_run()
    service.learner.ask(run, query("inspect_lo", ordinal=0), query("label_lo", ordinal=1))
    service.learner.ask(run, query("label_full", ordinal=2), priority=5)
    held = [service.annotator.lease() for _ in range(3)]
    assert kinds_of(*held) == ["label_full", "inspect_lo", "label_lo"]


def test_an_annotator_goes_on_with_the_episode_just_answered(service: Service) -> None:
    run = service.learner.create_run()
    service.learner.ask(run, query(episode=0), query(episode=1))
    service.learner.ask(run, query("label_full", episode=1, ordinal=1), query("label_hi", episode=0, ordinal=1))
    first = service.annotator.lease()
    receipt = service.annotator.answer(first, next={})
    assert kinds_of(receipt["next"]) == ["label_hi"]
    assert kinds_of(service.user("otto", "annotator").lease()) == ["inspect_full"]


def test_a_follow_up_does_not_overtake_a_higher_priority(service: Service) -> None:
    run = service.learner.create_run()
    service.learner.ask(run, query(episode=0))
    held = service.annotator.lease()
    service.learner.ask(run, query("label_hi", episode=0, ordinal=1))
    service.learner.ask(run, query("label_full", episode=7), priority=1)
    assert kinds_of(service.annotator.answer(held, next={})["next"]) == ["label_full"]


def test_only_the_wanted_kinds_and_run_are_leased(service: Service) -> None:
    one, two = service.learner.create_run(), service.learner.create_run()
    service.learner.ask(one, query("inspect_full"))
    service.learner.ask(two, query("label_lo"))
    assert service.annotator.lease(kinds=["label_hi"], expect=204) is None
    assert service.annotator.lease(kinds=[], expect=204) is None
    assert kinds_of(service.annotator.lease(kinds=["label_hi", "label_lo"])) == ["label_lo"]
    assert service.annotator.lease(run=two, expect=204) is None
    assert service.annotator.lease(run=one)["run"]["id"] == one
    for unknown in ("nowhere", "0123456789ab", "\0"):
        assert service.annotator.lease(run=unknown, expect=404)["type"] == "/problems/not-found"


def test_a_paused_run_hands_nothing_out_until_it_resumes(service: Service) -> None:
    run = service.learner.create_run()
    service.learner.ask(run, query())
    service.learner.patch(run, state="paused")
    assert service.annotator.lease(expect=204) is None
    service.learner.patch(run, state="running")
    service.annotator.lease()


def test_a_skipped_query_is_offered_to_others_only(service: Service) -> None:
    service.learner.ask(service.learner.create_run(), query())
    service.annotator.release(service.annotator.lease(), skip=True, reason="too dark")
    assert service.annotator.lease(expect=204) is None
    service.user("otto", "annotator").lease()


def test_a_query_that_was_skipped_before_can_be_skipped_again(service: Service) -> None:
    service.learner.ask(service.learner.create_run(), query())
    held = service.annotator.lease()
    service.annotator.release(held, skip=True)
    user = service.annotator.get("/me")["id"]
    service.db.write_now(lambda tx: leases.grant(tx, held["query"]["id"], user, 60))
    (again,) = service.annotator.get("/assignments")["assignments"]
    service.annotator.release(again, skip=True)
    service.user("otto", "annotator").lease()


def test_a_released_query_is_offered_to_everybody_again(service: Service) -> None:
    service.learner.ask(service.learner.create_run(), query())
    held = service.annotator.lease()
    service.annotator.release(held)
    assert service.annotator.release(held, expect=409)["type"] == "/problems/lease-ended"
    again = service.annotator.lease()
    assert again["id"] != held["id"]
    assert again["token"] != held["token"]


def test_a_reloaded_page_finds_its_assignments(service: Service) -> None:
    run = service.learner.create_run()
    service.learner.ask(run, query(), query(ordinal=1))
    held = [service.annotator.lease(), service.annotator.lease()]
    assert service.annotator.get("/assignments")["assignments"] == held
    service.annotator.answer(held[0])
    (left,) = service.annotator.get("/assignments")["assignments"]
    assert (left["id"], left["token"]) == (held[1]["id"], held[1]["token"])
    assert service.user("otto", "annotator").get("/assignments")["assignments"] == []


def test_a_reloaded_page_does_not_find_what_has_expired(service: Service) -> None:
    service.learner.ask(service.learner.create_run(), query())
    service.annotator.lease()
    service.db.write_now(lambda tx: tx.conn.execute(update(assignments).values(expires_at=tx.now - 1)))
    assert service.annotator.get("/assignments")["assignments"] == []


def test_a_renewed_lease_outlives_its_first_end_but_not_its_cap(database_url: str) -> None:
    with in_process(database_url, lease_seconds=1.0, lease_cap_seconds=1.6, reap_seconds=0.1) as service:
        service.learner.ask(service.learner.create_run(), query())
        held = service.annotator.lease()
        time.sleep(0.6)
        assert service.annotator.renew(held)["expires_at"] == pytest.approx(held["leased_at"] + 1.6, abs=0.01)
        time.sleep(0.5)
        assert service.annotator.lease(expect=204) is None
        assert service.annotator.renew(held)["expires_at"] == pytest.approx(held["leased_at"] + 1.6, abs=0.01)
        time.sleep(0.6)
        assert service.annotator.renew(held, expect=409)["type"] == "/problems/lease-expired"
        service.annotator.lease()


def test_a_vanished_annotators_query_comes_back_by_itself(database_url: str) -> None:
    lease_seconds = 1.0
    with in_process(database_url, lease_seconds=lease_seconds, poll_seconds=60) as service:
        service.learner.ask(service.learner.create_run(), query())
        held = service.annotator.lease()
        again = service.user("otto", "annotator").lease(wait=30)
        assert again["query"]["id"] == held["query"]["id"]
        assert 0 <= again["leased_at"] - held["expires_at"] <= 5


def test_a_waiting_annotator_is_woken_by_a_question(database_url: str) -> None:
    with in_process(database_url, poll_seconds=60) as service:
        run = service.learner.create_run()
        got: list[float] = []

        def wait() -> None:
            service.annotator.lease(wait=30)
            got.append(time.monotonic())

        waiting = threading.Thread(target=wait)
        waiting.start()
        time.sleep(0.3)
        asked = time.monotonic()
        service.learner.ask(run, query())
        waiting.join()
    assert got[0] - asked < 15, "woken by the question, not when the wait was over"


def test_a_deferring_bot_leaves_queries_to_people_at_work(service: Service) -> None:
    run = service.learner.create_run()
    bot = service.user("bot", "annotator")
    assert service.annotator.lease(kinds=["inspect_full"], expect=204) is None
    service.learner.ask(run, query("inspect_full"), query("label_hi", ordinal=1))
    assert kinds_of(bot.lease(defer=60)) == ["label_hi"], "nobody at work takes that kind"
    assert bot.lease(defer=60, expect=204) is None
    assert kinds_of(service.annotator.lease(kinds=["inspect_full"])) == ["inspect_full"]


def test_a_deferring_bot_takes_what_has_become_old(service: Service) -> None:
    run = service.learner.create_run()
    bot = service.user("bot", "annotator")
    assert service.annotator.lease(expect=204) is None
    service.learner.ask(run, query())
    assert bot.lease(defer=0.5, expect=204) is None
    held = bot.lease(defer=0.5, wait=10)
    assert held["leased_at"] - held["query"]["created_at"] >= 0.5


def test_a_person_who_skipped_a_query_still_takes_the_others(service: Service) -> None:
    run, bot = service.learner.create_run(), service.user("bot", "annotator")
    service.learner.ask(run, query(), query(ordinal=1))
    service.annotator.release(service.annotator.lease(), skip=True)
    service.annotator.release(service.annotator.lease())
    bot.lease(defer=60)  # what the person skipped
    assert bot.lease(defer=60, expect=204) is None


def test_a_deferring_bot_takes_what_the_person_at_work_skipped(service: Service) -> None:
    run = service.learner.create_run()
    bot = service.user("bot", "annotator")
    service.learner.ask(run, query())
    held = service.annotator.lease()
    service.annotator.release(held, skip=True)
    assert bot.lease(defer=60)["query"]["id"] == held["query"]["id"]


def test_an_annotator_who_has_gone_holds_no_bot_back(database_url: str) -> None:
    with in_process(database_url, presence_seconds=1) as service:
        bot = service.user("bot", "annotator")
        run = service.learner.create_run()
        assert service.annotator.lease(expect=204) is None
        service.learner.ask(run, query())
        assert bot.lease(defer=60, expect=204) is None
        bot.lease(defer=60, wait=10)


def test_a_lease_keeps_an_annotator_present(database_url: str) -> None:
    with in_process(database_url, presence_seconds=0.1) as service:
        bot = service.user("bot", "annotator")
        run = service.learner.create_run()
        service.learner.ask(run, query())
        service.annotator.lease()
        service.learner.ask(run, query(ordinal=1))
        time.sleep(0.3)
        assert bot.lease(defer=60, expect=204) is None


def test_two_bots_do_not_wait_for_each_other(service: Service) -> None:
    run = service.learner.create_run()
    one, two = service.user("bot1", "annotator"), service.user("bot2", "annotator")
    assert one.lease(defer=60, expect=204) is None
    service.learner.ask(run, query(), query(ordinal=1))
    one.lease(defer=60)
    two.lease(defer=60)


def test_a_bot_that_holds_what_it_deferred_is_not_at_work(database_url: str) -> None:
    with in_process(database_url, presence_seconds=0.2) as service:
        one, two = service.annotators(2)
        one.lease(expect=204)  # it asked without deferring, which counts for a while
        time.sleep(0.4)
        service.learner.ask(service.learner.create_run(), query(), query(ordinal=1))
        one.lease(defer=60)
        two.lease(defer=60)


def test_a_follow_up_is_kept_for_who_is_at_work_on_its_episode(service: Service) -> None:
    run = service.learner.create_run()
    service.learner.ask(run, query("inspect_full"))
    service.annotator.answer(service.annotator.lease())
    service.learner.ask(run, query("label_hi", ordinal=1))
    otto = service.user("otto", "annotator")
    assert otto.lease(expect=204) is None
    assert kinds_of(service.annotator.lease()) == ["label_hi"]


def test_a_follow_up_is_kept_for_a_while_only(database_url: str) -> None:
    with in_process(database_url, follow_up_seconds=0.5) as service:
        run = service.learner.create_run()
        service.learner.ask(run, query())
        service.annotator.answer(service.annotator.lease())
        service.learner.ask(run, query(ordinal=1))
        held = service.user("otto", "annotator").lease(wait=10)
        assert held["leased_at"] - held["query"]["created_at"] >= 0.5


def test_a_follow_up_waits_neither_for_the_absent_nor_for_whom_it_is_not_for(database_url: str) -> None:
    with in_process(database_url, presence_seconds=0.2) as service:
        otto = service.user("otto", "annotator")
        run = service.learner.create_run()
        service.learner.ask(run, query())
        service.annotator.answer(service.annotator.lease(kinds=["inspect_full"]))
        service.learner.ask(run, query("label_hi", ordinal=1), query("inspect_full", ordinal=2))
        assert kinds_of(otto.lease()) == ["label_hi"], "the other takes no such kind"
        time.sleep(0.3)
        assert kinds_of(otto.lease()) == ["inspect_full"], "the other has gone"


def test_what_is_leased_ahead_leaves_enough_for_everybody_at_work(service: Service) -> None:
    run = service.learner.create_run()
    service.learner.ask(run, *(query(episode=number) for number in range(3)))
    service.annotator.lease()
    service.annotator.lease(ahead=True)
    otto = service.user("otto", "annotator")
    assert service.annotator.lease(ahead=True)["query"]["ask"]["episode"] == 2, "nobody else was at work"
    assert otto.lease(expect=204) is None
    service.learner.ask(run, query(episode=3))
    assert service.annotator.lease(ahead=True, expect=204) is None, "otto has none"
    otto.lease()


def test_a_page_that_goes_gives_back_all_it_holds_but_what_it_still_answers(service: Service) -> None:
    run = service.learner.create_run()
    service.learner.ask(run, *(query(episode=episode) for episode in range(4)))
    answering, shown, ahead = (service.annotator.lease(tab="one") for _ in range(3))
    other = service.annotator.lease(tab="two")
    service.annotator.leave("one", answering)
    assert [one["id"] for one in service.annotator.get("/assignments")["assignments"]] == [answering["id"], other["id"]]
    service.annotator.answer(answering)
    service.annotator.answer(shown, expect=409)
    service.annotator.answer(ahead, expect=409)
    service.annotator.answer(other)


def test_nothing_is_leased_to_a_page_that_has_gone_whatever_was_on_its_way(service: Service) -> None:
    run = service.learner.create_run()
    service.learner.ask(run, *(query(episode=episode) for episode in range(3)))
    answered = service.annotator.lease(tab="one")
    service.annotator.leave("one", answered)
    assert service.annotator.lease(tab="one", expect=204) is None
    assert service.annotator.answer(answered, next={"tab": "one"})["next"] is None
    service.annotator.leave("one")  # said twice, it is the same
    assert service.annotator.lease(tab="two")["query"]["ask"]["episode"] == 1
    assert service.user("otto", "annotator").lease(tab="one")["query"]["ask"]["episode"] == 2, "another's page"


def test_a_page_that_has_gone_stays_gone_when_another_goes(service: Service) -> None:
    service.learner.ask(service.learner.create_run(), query())
    service.annotator.leave("one")
    service.annotator.leave("two")
    assert service.annotator.lease(tab="one", expect=204) is None


def test_a_page_that_goes_gives_back_nothing_of_another_annotators_page(service: Service) -> None:
    service.learner.ask(service.learner.create_run(), query())
    otto = service.user("otto", "annotator")
    held = otto.lease(tab="one")
    service.annotator.leave("one")
    assert service.annotator.lease(expect=204) is None
    otto.answer(held)


def test_a_page_that_goes_gives_back_what_it_took_back(service: Service) -> None:
    run = service.learner.create_run()
    service.learner.ask(run, query())
    held = service.annotator.lease(tab="one")
    service.annotator.answer(held)
    service.annotator.retract(held, tab="one")
    service.annotator.leave("one")
    service.annotator.lease(tab="two")


def test_who_is_sent_away_gives_back_their_own_queries_alone(service: Service) -> None:
    service.learner.ask(service.learner.create_run(), query(), query(ordinal=1))
    otto = service.user("otto", "annotator")
    theirs, ours = otto.lease(), service.annotator.lease()
    service.admin.change(otto, active=False)
    assert service.annotator.lease()["query"]["id"] == theirs["query"]["id"]
    service.annotator.answer(ours)


def test_how_a_lease_ended_is_kept_with_the_reason(service: Service) -> None:
    service.learner.ask(service.learner.create_run(), query())
    service.annotator.release(service.annotator.lease(), reason="lunch")
    service.annotator.release(service.annotator.lease(), skip=True, reason="too dark")
    ended = select(assignments.c.state, assignments.c.reason).order_by(assignments.c.id)
    rows = service.db.read_now(lambda tx: tx.conn.execute(ended).all())
    assert [tuple(row) for row in rows] == [("released", "lunch"), ("skipped", "too dark")]
