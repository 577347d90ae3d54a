"""The client that the documentation shows, run as it is against a real server."""

import os
import subprocess
import sys

import pytest
from tests.repository.kit import ROOT

from waypost import wire
from waypost.client import Client
from waypost_learner.domains.maze.domain import MazeDomain
from waypost_learner.remote.translation import vocabulary
from waypost_server.auth import tokens
from waypost_server.settings import Settings
from waypost_server.users import service as users

SCRIPT = ROOT / "docs" / "rest_client.py"
DOMAIN = MazeDomain()


def token(served, name: str, role: wire.Role) -> str:
    user = served.db.write_now(lambda tx: users.create_user(tx, name, role))
    return served.db.write_now(lambda tx: tokens.create_token(tx, user.id, "")).token


def inspect_full(maze, last) -> wire.AskInspectFull:
    segment = wire.Segment(subgoal="north", states=[list(maze.start), list(last)], actions=["up"])
    return wire.AskInspectFull(
        kind="inspect_full",
        episode=0,
        ordinal=0,
        question="Did it do the whole task?",
        instance=DOMAIN.instance_view(maze),
        segments=[segment],
    )


@pytest.mark.parametrize("arrives", [True, False])
def test_the_client_in_the_documentation_leases_answers_and_sees_what_it_cost(start_server, sqlite_url, arrives):
    served = start_server(Settings(database=sqlite_url))
    maze = DOMAIN.instances("corners").train[0]
    learner = Client(served.url, token(served, "learner", "learner"))
    run = learner.create_run(wire.RunCreate(name="a run", algorithm="hg-dagger", seed=0, vocabulary=vocabulary(DOMAIN)))
    (asked,) = learner.ask(run.id, [inspect_full(maze, maze.goal if arrives else maze.start)])

    done = subprocess.run(
        [sys.executable, SCRIPT, served.url],
        env={**os.environ, "WAYPOST_TOKEN": token(served, "program", "annotator")},
        capture_output=True,
        text=True,
        check=False,
        timeout=60,
    )

    verdict = "pass" if arrives else "fail"
    assert done.stderr == ""
    assert done.stdout.splitlines() == [
        f"Did it do the whole task? {verdict}: 1 unit, query {asked.id}",
        "The run has cost 1 units.",
    ]
    answered = learner.query(asked.id)
    assert (answered.state, answered.annotator) == ("answered", "program")
    assert answered.answer == wire.InspectAnswer(kind="inspect_full", verdict=verdict)
    learner.close()


def test_it_is_as_short_as_the_documentation_says():
    code = SCRIPT.read_text().partition('"""\n')[2]
    assert len([line for line in code.splitlines() if line.strip()]) <= 25
