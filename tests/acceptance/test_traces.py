"""A trace shows each episode from its questions to the training on their answers, across server and learner."""

import json
import signal
import time
from collections import defaultdict
from pathlib import Path

import pytest
from tests.acceptance.collector import Collector, Span, collecting
from tests.acceptance.processes import ServerProcess, free_port, run_waypost

from waypost.tracing import ids_of

EPISODES = 6
TRAIN = ("train", "hg-dagger", "--domain", "corridor", "--warm-start", "2", "--json", "--episodes")


def stop(server: ServerProcess) -> float:
    """Stop a server as an operator does, and return how many seconds it took."""
    assert server.process is not None
    began = time.monotonic()
    server.process.send_signal(signal.SIGTERM)
    server.process.wait(60)
    return time.monotonic() - began


def by_episode(collector: Collector, run: str) -> dict[int, list[Span]]:
    found = defaultdict(list)
    for span in collector.spans:
        assert span.attributes["waypost.run"] == run
        found[span.attributes["waypost.episode"]].append(span)
    return found


def test_one_trace_shows_an_episode_from_its_queries_to_the_training_step(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    with collecting() as collector:
        monkeypatch.setenv("OTEL_EXPORTER_OTLP_ENDPOINT", collector.address)
        server = ServerProcess(tmp_path, free_port())
        server.start()
        token = server.token("learner", "admin")
        summary = json.loads(run_waypost(*TRAIN, str(EPISODES), "--server", server.url, "--token", token))
        stop(server)
    episodes = by_episode(collector, summary["run"])
    assert sorted(episodes) == list(range(EPISODES))
    for number, spans in episodes.items():
        trace, first = ids_of(summary["run"], number)
        assert {span.trace for span in spans} == {trace}
        (root,) = [span for span in spans if span.name == "episode"]
        assert (root.id, root.parent, root.service) == (first, None, "waypost-learner")
        assert all(span.parent == first for span in spans if span is not root)
        (learn,) = [span for span in spans if span.name == "learn"]
        for query in {span.attributes["waypost.query"] for span in spans if span.name == "ask"}:
            steps = [span for span in spans if span.attributes.get("waypost.query") == query]
            assert [span.name for span in sorted(steps, key=lambda span: span.ended)] in (
                ["ask", "lease", "answer", "charge", "use"],
                ["ask", "lease", "charge", "answer", "use"],  # of one transaction
            )
            assert {span.service for span in steps} == {"waypost-server"}
            assert max(span.ended for span in steps) <= learn.began
        assert root.began <= learn.began <= learn.ended <= root.ended
    charged = [span.attributes["waypost.units"] for span in collector.spans if span.name == "charge"]
    assert sum(charged) == summary["cost"]["total"] > 0


def test_without_a_collector_at_its_address_a_server_works_and_ends_soon(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("OTEL_EXPORTER_OTLP_ENDPOINT", f"http://127.0.0.1:{free_port()}")
    server = ServerProcess(tmp_path, free_port())
    server.start()
    token = server.token("learner", "admin")
    monkeypatch.delenv("OTEL_EXPORTER_OTLP_ENDPOINT")
    summary = json.loads(run_waypost(*TRAIN, "3", "--server", server.url, "--token", token))
    assert summary["episodes"] == 3
    assert stop(server) < 8
