"""The first learner of a domain sends practice, so that people practice what they will be asked."""

from collections import Counter
from collections.abc import Iterator
from pathlib import Path

import pytest

from waypost import wire
from waypost.client import Client
from waypost.domains import Domain, find_domain
from waypost_learner.domains.corridor import CorridorDomain
from waypost_learner.remote.embedded import embedded
from waypost_learner.remote.translation import vocabulary
from waypost_learner.runs import practice
from waypost_learner.runs.practice import send_practice


@pytest.fixture
def client(tmp_path: Path) -> Iterator[Client]:
    """A learner's client of an empty store."""
    with embedded(tmp_path / "store.db") as connection:
        yield connection.learner


def run_of(client: Client, domain: Domain) -> str:
    wanted = wire.RunCreate(name="new", algorithm="hg-dagger", seed=0, vocabulary=vocabulary(domain))
    return client.create_run(wanted).id


def test_a_domain_without_practice_gets_its_own_with_pictures(client: Client) -> None:
    corridor = find_domain("corridor")
    assert send_practice(client, run_of(client, corridor), corridor, "random") is None
    found = client.practice("corridor")
    kinds = Counter(one.ask.kind for one in found.queries)
    assert kinds == dict.fromkeys(("inspect_full", "inspect_lo", "label_hi", "label_lo", "label_full"), 2)
    assert len(found.examples) == len(kinds), "a worked example of each kind"
    assert {(one.ask.flat, bool(one.ask.context)) for one in found.demonstrations} == {
        (False, False),
        (True, False),
        (False, True),
    }
    for one in found.queries:
        for segment in one.ask.segments:
            assert all(client.frame(frame).startswith(b"\x89PNG") for frame in segment.frames)


def test_practice_is_made_once_and_again_when_the_domain_has_changed(
    client: Client, monkeypatch: pytest.MonkeyPatch
) -> None:
    made: list[str] = []
    really = practice.made
    monkeypatch.setattr(practice, "made", lambda domain, *more: (made.append(domain.name), really(domain, *more))[1])
    corridor = CorridorDomain()
    for _ in range(2):
        send_practice(client, run_of(client, corridor), corridor, "random")
    assert made == ["corridor"]
    corridor.subgoals = ("left", "right", "target")
    send_practice(client, run_of(client, corridor), corridor, "random")
    assert made == ["corridor", "corridor"]
    assert client.practice("corridor").vocabulary.subgoals == ["left", "right", "target"]
    maze = find_domain("maze")
    send_practice(client, run_of(client, maze), maze, "random")
    assert len(made) == 2, "the server has a file for the maze"


def test_without_an_oracle_nothing_is_sent_and_without_suitable_rollouts_the_run_goes_on(
    client: Client, monkeypatch: pytest.MonkeyPatch
) -> None:
    corridor = CorridorDomain()
    monkeypatch.setattr(practice, "CANDIDATES", 0)
    why = send_practice(client, run_of(client, corridor), corridor, "random")
    assert why is not None
    assert "gets no practice queries for the domain 'corridor': no rollout is suitable" in why
    corridor.oracle = None
    assert send_practice(client, run_of(client, corridor), corridor, "random") is None
