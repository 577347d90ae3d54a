"""The same run is the same run, whoever answers, and whatever happens to the server meanwhile."""

import json
import os
import random
import subprocess
import threading
import time
from pathlib import Path
from typing import Any

import pytest

from learner.bot import Bot, BotSettings
from learner.training import embedded
from server import wire
from tests.acceptance.processes import WAYPOST, ServerProcess, history, run_waypost

VALUES = ("hg-dagger", "--domain", "maze", "--instances", "corners", "--preset", "demo", "--seed", "0")
LENGTH = ("--episodes", "40", "--warm-start", "20")
KILLS = 20


@pytest.fixture(scope="module")
def in_process(tmp_path_factory: pytest.TempPathFactory) -> tuple[dict[str, Any], list[Any]]:
    """The run with the expert in the learner's process: its summary and its history."""
    store = tmp_path_factory.mktemp("in-process") / "store.db"
    summary = json.loads(run_waypost("train", *VALUES, *LENGTH, "--store", str(store), "--json"))
    with embedded(store) as connection:
        return summary, history(connection.learner, summary["run"])


def start_learner(server: ServerProcess, folder: Path) -> subprocess.Popen[str]:
    arguments = ("--expert", "queue", "--server", server.url, "--checkpoints", str(folder / "checkpoints"), "--json")
    return subprocess.Popen(
        [*WAYPOST, "train", *VALUES, *LENGTH, *arguments],
        env={**os.environ, "WAYPOST_TOKEN": server.token("learner", "learner")},
        stdout=subprocess.PIPE,
        text=True,
    )


def finished(learner: subprocess.Popen[str]) -> dict[str, Any]:
    out, _ = learner.communicate(timeout=240)
    assert learner.returncode == 0
    summary: dict[str, Any] = json.loads(out)
    return summary


def assert_same_run(
    server: ServerProcess, summary: dict[str, Any], reference: tuple[dict[str, Any], list[Any]]
) -> None:
    expected, rows = reference
    assert history(server.client("learner", "learner"), summary["run"]) == rows
    for what in ("weights", "cost", "success_rate", "first_at", "episodes"):
        assert summary[what] == expected[what]


def test_the_reference_run_asks_every_kind_of_query_of_the_algorithm(
    in_process: tuple[dict[str, Any], list[Any]],
) -> None:
    kinds = {ask["kind"] for _, _, ask, _, _ in in_process[1]}
    assert {"hier_demo", "inspect_full", "label_hi", "inspect_lo", "label_lo"} <= kinds


def test_the_ledger_adds_up_to_the_printed_cost(in_process: tuple[dict[str, Any], list[Any]]) -> None:
    summary, rows = in_process
    assert sum(units for *_, units in rows) == summary["cost"]["total"] == sum(summary["cost"]["by_kind"].values())


def test_a_real_server_with_the_oracle_bot_gives_the_same_run(
    server: ServerProcess, tmp_path: Path, in_process: tuple[dict[str, Any], list[Any]]
) -> None:
    bot = subprocess.Popen(
        [*WAYPOST, "oracle", "--server", server.url],
        env={**os.environ, "WAYPOST_TOKEN": server.token("bot", "annotator")},
        stderr=subprocess.DEVNULL,
    )
    try:
        summary = finished(start_learner(server, tmp_path))
    finally:
        bot.terminate()
        bot.wait()
    assert_same_run(server, summary, in_process)


def test_killing_the_server_twenty_times_loses_nothing_and_charges_nothing_twice(
    server: ServerProcess, tmp_path: Path, in_process: tuple[dict[str, Any], list[Any]]
) -> None:
    acknowledged: list[wire.Receipt] = []
    bot = Bot(server.client("bot", "annotator"), BotSettings())
    stop = threading.Event()

    def answer() -> None:
        while not stop.is_set():
            bot.work(wait=1, on_answer=acknowledged.append)

    server.token("learner", "learner")
    answering = threading.Thread(target=answer)
    answering.start()
    learner = start_learner(server, tmp_path)
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

    client = server.client("learner", "learner")
    stored = {query.id: query for query in _answered(client, summary["run"])}
    for receipt in acknowledged:
        assert stored[receipt.query].answer_id == receipt.answer
        assert stored[receipt.query].units == receipt.units
    costs = client.costs(summary["run"])
    assert costs.total == sum(query.units or 0 for query in stored.values())
    assert costs.reserved == 0


def _answered(client: Any, run: str) -> list[wire.Query]:
    queries: list[wire.Query] = []
    after = 0
    while True:
        page = client.answers(run, after)
        if not page.queries:
            return queries
        queries += page.queries
        after = page.cursor
