"""Which episodes the expert is asked about: all of them, or a share of what is known to succeed."""

from collections.abc import Callable
from itertools import groupby
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.learner.kit import corridor, examples, history, store

from waypost import wire
from waypost_learner.experts.oracle import OracleExpert
from waypost_learner.policies.dqn import QFunction
from waypost_learner.presets import find_preset
from waypost_learner.presets.monitoring import EVERY_EPISODE, Monitoring
from waypost_learner.runs.config import TrainConfig
from waypost_learner.runs.setup import set_up
from waypost_learner.runs.training import train

KNOWN_AT_ONCE = "monitoring.rate=0.5 monitoring.confidence=0.5"  # after one pass
SOON = "monitoring.rate=0.5 monitoring.confidence=0.75"  # after two
shares = st.floats(0.001, 0.999)


@examples
@given(shares, shares)
def test_so_many_passes_in_a_row_are_just_enough_for_the_confidence(rate: float, confidence: float) -> None:
    passes = Monitoring(0.1, rate, confidence).clearance
    assert rate**passes <= (1 - confidence) * (1 + 1e-9)
    assert passes == 1 or rate ** (passes - 1) > (1 - confidence) * (1 - 1e-9)


@examples
@given(st.integers(0, 200), st.integers(0, 99))
def test_until_success_is_known_everything_is_inspected(passes: int, seed: int) -> None:
    inspected = Monitoring(share=0.0).inspects(passes, np.random.default_rng(seed))
    assert inspected == (passes < 29)  # 0.9 ** 29 is the first below 0.05


@examples
@given(st.integers(0, 10_000), st.integers(0, 99))
def test_algorithm_2_inspects_every_episode(passes: int, seed: int) -> None:
    assert EVERY_EPISODE.inspects(passes, np.random.default_rng(seed))


@pytest.mark.parametrize("values", ["share=1.5", "share=-0.1", "rate=1.0", "rate=0.0", "confidence=1.0"])
def test_what_is_no_share_and_no_rate_is_refused(values: str) -> None:
    with pytest.raises(ValueError, match="monitoring needs a share from 0 to 1"):
        find_preset("lean", f"monitoring.{values}")


@pytest.mark.parametrize(
    "values",
    [{"algorithm": one} for one in ("h-bc", "naive-h-dagger", "flat-bc", "h-dqn")] + [{"redraw": True}],
)
def test_monitoring_is_refused_where_nothing_is_monitored(values: dict[str, Any]) -> None:
    with pytest.raises(ValueError, match=r"only hg-dagger, hg-dagger-by-place, hg-stagger, .* are monitored, and"):
        set_up(corridor(values="monitoring.share=0.5", **values), threads=1)


def asked_and_reported(path: Path, config: TrainConfig) -> tuple[dict[int, list[Any]], list[wire.EpisodeResult]]:
    """What was asked and answered, by episode, and every episode's result."""
    reported: list[wire.EpisodeResult] = []
    with store(path) as (connection, options):
        summary = train(config, connection, options, on_episode=lambda result, _units: reported.append(result))
        rows = history(connection.learner, summary["run"])
    return {episode: list(of) for episode, of in groupby(rows, key=lambda row: row[0])}, reported


@pytest.fixture
def judge(monkeypatch: pytest.MonkeyPatch) -> Callable[[set[int]], None]:
    """Let the expert say that just these episodes failed, whatever the learner did on this machine."""
    right = OracleExpert.__call__

    def let(fails: set[int]) -> None:
        def judged(expert: OracleExpert, ask: wire.Ask) -> wire.Answer:
            if ask.kind != "inspect_full":
                return right(expert, ask)
            return wire.InspectAnswer(kind="inspect_full", verdict="fail" if ask.episode in fails else "pass")

        monkeypatch.setattr(OracleExpert, "__call__", judged)

    return let


def passed(rows: list[Any]) -> bool:
    return any(answer.kind == "inspect_full" and answer.verdict == "pass" for *_, answer, _units in rows)


@pytest.mark.parametrize("algorithm", ["hg-dagger", "hg-stagger", "flat-dagger"])
def test_what_is_known_to_succeed_is_not_asked_about_and_not_charged(
    tmp_path: Path, algorithm: str, judge: Callable[[set[int]], None]
) -> None:
    judge({3, 4})
    config = corridor(algorithm=algorithm, values=f"monitoring.share=0.0 {KNOWN_AT_ONCE}")
    asked, reported = asked_and_reported(tmp_path, config)
    assert list(asked) == [0, 1, 2, 3, 4, 5]
    assert [result.episode for result in reported] == list(range(12))
    assert all(result.train_success is not None for result in reported[3:])
    assert reported[4].lo_labels >= reported[3].lo_labels > 0
    assert all(result.lo_labels == reported[4].lo_labels for result in reported[4:])


def test_the_hybrid_is_asked_about_subgoals_until_they_are_known_to_be_right_and_then_learns_by_itself(
    tmp_path: Path, judge: Callable[[set[int]], None], monkeypatch: pytest.MonkeyPatch
) -> None:
    judge(set(range(12)))  # no episode succeeds, but from episode 2 on every subgoal is right
    judged = OracleExpert.__call__

    def agrees(expert: OracleExpert, ask: wire.Ask) -> wire.Answer:
        if isinstance(ask, wire.AskLabelHi) and ask.episode >= 2:
            return wire.LabelHiAnswer(kind="label_hi", subgoals=[str(one.subgoal) for one in ask.segments])
        if isinstance(ask, wire.AskLabelHi):
            others = {"west": "east", "east": "target", "target": "west"}
            return wire.LabelHiAnswer(kind="label_hi", subgoals=[others[str(one.subgoal)] for one in ask.segments])
        return judged(expert, ask)

    monkeypatch.setattr(OracleExpert, "__call__", agrees)
    config = corridor(algorithm="hg-dagger-q", values=f"monitoring.share=0.0 {SOON}", warm_start=0)
    learned: list[int] = []
    original = QFunction.remember
    monkeypatch.setattr(
        QFunction, "remember", lambda q, one: (learned.append(len(one.transitions)), original(q, one))[1]
    )
    asked, reported = asked_and_reported(tmp_path, config)
    assert list(asked) == [0, 1, 2, 3]
    assert sum(learned) >= sum(result.train_steps for result in reported[2:])


def test_a_share_is_inspected_until_one_fails_and_then_everything_again(
    tmp_path: Path, judge: Callable[[set[int]], None]
) -> None:
    judge(set(range(0, 40, 5)))
    asked, _ = asked_and_reported(tmp_path, corridor(values=f"monitoring.share=0.5 {SOON}", episodes=40))
    known, passes = dict[int, bool](), 0
    for episode in range(3, 40):
        known[episode] = passes >= 2
        if episode in asked:
            passes = passes + 1 if passed(asked[episode]) else 0
    assert set(range(40)) - set(asked) <= {episode for episode, is_known in known.items() if is_known}
    inspected = [episode for episode, is_known in known.items() if is_known and episode in asked]
    assert 0 < len(inspected) < sum(known.values())
    assert any(not passed(asked[episode]) for episode in inspected)  # otherwise nothing was inspected again


def test_the_same_run_is_the_same_where_only_a_share_is_inspected(tmp_path: Path) -> None:
    config = corridor(values=f"monitoring.share=0.5 {SOON}")
    assert asked_and_reported(tmp_path / "one", config)[0] == asked_and_reported(tmp_path / "other", config)[0]
