"""The same run is the same run, whoever answers, and whatever happens to the server meanwhile."""

import random
import threading
import time

from playwright.sync_api import Page
from tests.acceptance.person import Person
from tests.acceptance.processes import (
    LENGTH,
    VALUES,
    Reference,
    ServerProcess,
    answers,
    bot,
    finished,
    history,
    start_learner,
)

from waypost import wire
from waypost.domains import find_domain
from waypost_learner.experts.bot import Bot, BotSettings

KILLS = 20


def assert_same_run(server: ServerProcess, summary: dict[str, object], reference: Reference) -> None:
    expected, rows = reference
    assert history(server.client("learner", "learner"), summary["run"]) == rows
    for what in ("weights", "cost", "success_rate", "first_at", "episodes"):
        assert summary[what] == expected[what]


def test_the_reference_run_asks_every_kind_of_query_of_the_algorithm(
    in_process: Reference,
) -> None:
    kinds = {ask.kind for ask, _, _ in in_process[1]}
    assert {"hier_demo", "inspect_full", "label_hi", "inspect_lo", "label_lo"} <= kinds


def test_the_ledger_adds_up_to_the_printed_cost(in_process: Reference) -> None:
    summary, rows = in_process
    assert sum(units for *_, units in rows) == summary["cost"]["total"] == sum(summary["cost"]["by_kind"].values())


def test_a_real_server_with_the_oracle_bot_gives_the_same_run(server: ServerProcess, in_process: Reference) -> None:
    with bot(server, "bot"):
        summary = finished(start_learner(server, (*VALUES, *LENGTH)))
    assert_same_run(server, summary, in_process)


def test_two_bots_and_a_browser_taking_turns_give_the_same_run(
    server: ServerProcess, page: Page, in_process: Reference
) -> None:
    page.goto(server.login_link("person"))
    page.wait_for_url("**/practice?first=yes")
    page.goto(f"{server.url}/work")
    person = Person(page, server.client("learner", "learner"), find_domain("maze"))
    with bot(server, "bot one", "--seconds", "0.1"), bot(server, "bot two", "--seconds", "0.1"):
        learner = start_learner(server, (*VALUES, *LENGTH))
        person.work_until(lambda: learner.poll() is not None)
        summary = finished(learner)
    assert_same_run(server, summary, in_process)
    who = {query.annotator for query in answers(server.client("learner", "learner"), str(summary["run"]))}
    assert who == {"person", "bot one", "bot two"}


def test_killing_the_server_twenty_times_loses_nothing_and_charges_nothing_twice(
    server: ServerProcess, in_process: Reference
) -> None:
    acknowledged: list[wire.Receipt] = []
    oracle = Bot(server.client("bot", "annotator"), BotSettings())
    stop = threading.Event()

    def answer() -> None:
        while not stop.is_set():
            oracle.work(wait=1, on_answer=acknowledged.append)

    server.token("learner", "learner")
    answering = threading.Thread(target=answer)
    answering.start()
    learner = start_learner(server, (*VALUES, *LENGTH))
    moments = random.Random(0)
    kills = 0
    try:
        # The learner takes its time to start; the first kill comes when work is under way.
        while not acknowledged:
            time.sleep(0.05)
        while kills < KILLS and learner.poll() is None:
            time.sleep(moments.uniform(0.05, 0.6))
            server.kill()
            kills += 1
            server.start()
        summary = finished(learner)
    finally:
        stop.set()
        answering.join()
    assert kills == KILLS
    assert_same_run(server, summary, in_process)

    client, run = server.client("learner", "learner"), str(summary["run"])
    stored = {query.id: query for query in answers(client, run)}
    for receipt in acknowledged:
        assert stored[receipt.query].answer_id == receipt.answer
        assert stored[receipt.query].units == receipt.units
    costs = client.costs(run)
    assert costs.total == sum(query.units or 0 for query in stored.values())
    assert costs.reserved == 0
