"""What the gates doubt: choices like those that an answer found wrong, in about the share that was asked for."""

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import torch
from numpy.typing import NDArray
from tests.learner.kit import corridor, history, segment, store
from tests.learner.policies.fields_kit import TRAIN, briefly, taught

from waypost_learner.gates import GATES, make_gate
from waypost_learner.gates.gate import Doubts, Gate, GateSpec
from waypost_learner.gates.value import Value
from waypost_learner.gates.views import DISAGREEMENT, N_FEATURES, Seen, seen_in
from waypost_learner.policies.fields.field_net import FieldSpec
from waypost_learner.rollout import streams
from waypost_learner.rollout.policy_keys import META, pi
from waypost_learner.rollout.rollout import Outputs, run
from waypost_learner.runs.setup import set_up
from waypost_learner.runs.training import train

KINDS = sorted(GATES)


def seen_like(sure: list[float], disagreement: float = 0.0) -> NDArray[np.float32]:
    """Features of segments whose choices were more or less likely."""
    features = np.zeros((len(sure), N_FEATURES), np.float32)
    features[:, 0] = features[:, 1] = sure
    features[:, DISAGREEMENT] = disagreement
    return features


def rollouts(gate: Gate, n: int, rng: np.random.Generator, asked: bool = True) -> None:
    """Let a gate learn from rollouts in which unlikely choices were wrong."""
    for _ in range(n):
        sure = rng.uniform(-4, 0, 5).tolist()
        seen: Seen = {"hi": seen_like(sure), "lo": seen_like(sure)}
        said = {h: one > -3.5 for h, one in enumerate(sure)} if asked else {}
        gate.learn(Doubts([], [], seen).judged({"hi": said, "lo": said}))


@pytest.mark.parametrize("kind", KINDS)
def test_a_gate_doubts_everything_until_it_has_seen_twenty_segments(kind: Any) -> None:
    gate, rng = make_gate(GateSpec(kind, 0.2), seed=0), np.random.default_rng(0)
    seen: Seen = {"hi": seen_like([0.0] * 3), "lo": seen_like([0.0] * 3)}
    rollouts(gate, 3, rng)
    assert (gate.doubts(seen).hi, gate.doubts(seen).lo) == ([True] * 3, [True] * 3)
    rollouts(gate, 1, rng)
    assert not any(gate.doubts(seen).hi)


@pytest.mark.parametrize("kind", KINDS)
def test_a_gate_doubts_what_is_like_the_choices_that_were_wrong(kind: Any) -> None:
    gate = make_gate(GateSpec(kind, 0.4), seed=0)
    rollouts(gate, 20, np.random.default_rng(0))
    seen: Seen = {"hi": seen_like([-0.1, -0.2, -3.9]), "lo": seen_like([-3.9, -0.1, -0.2])}
    doubts = gate.doubts(seen)
    assert doubts.hi == [False, False, True]
    assert doubts.lo[0]


@pytest.mark.parametrize(("kind", "least", "most"), [("aim", 0.1, 0.3), ("thrifty", 0.02, 0.2), ("lazy", 0.1, 0.5)])
def test_the_share_of_new_segments_that_is_doubted_is_about_the_one_asked_for(
    kind: Any, least: float, most: float
) -> None:
    gate, rng = make_gate(GateSpec(kind, 0.2), seed=0), np.random.default_rng(0)
    rollouts(gate, 40, rng)
    found = [gate.doubts({"hi": seen_like(rng.uniform(-4, 0, 5).tolist()), "lo": seen_like([0.0])}) for _ in range(60)]
    assert least < np.mean([doubts.hi for doubts in found]) < most  # the half of thrifty's share is for novelty


def test_lazydagger_goes_on_doubting_until_it_is_almost_sure_of_the_expert() -> None:
    measures, thresholds = np.array([[0.1, 0.6, 0.2, 0.06, 0.04, 0.2]], np.float32), np.array([0.5], np.float32)
    gates = [make_gate(GateSpec(kind, 0.2), seed=0) for kind in ("lazy", "aim")]
    assert [gate.above(measures, thresholds) for gate in gates] == [
        [False, True, True, True, False, False],
        [False, True, False, False, False, False],
    ]


def test_thriftydagger_doubts_what_is_novel_although_it_looks_safe() -> None:
    gate = make_gate(GateSpec("thrifty", 0.2), seed=0)
    rollouts(gate, 20, np.random.default_rng(0))
    known, novel = (gate.doubts({"hi": seen_like([-0.1], views), "lo": seen_like([-0.1])}) for views in (0.0, 0.5))
    assert (known.hi, novel.hi) == ([False], [True])


def test_a_value_spreads_from_an_answer_to_the_segments_before_it_in_the_same_rollout_alone() -> None:
    features = torch.eye(4)  # two rollouts of two segments
    known, last = torch.tensor([math.nan, 1.0, math.nan, 0.0]), torch.tensor([False, True, False, True])
    early, right, other, wrong = Value(features, known, last, (0.0, 1.0), 0.8, 0)(features).tolist()
    assert [right, wrong] == pytest.approx([1, 0], abs=0.1)
    assert [early, other] == pytest.approx([0.8, 0], abs=0.1)
    ignored = Value(features, known, last, (0.0, 1.0), None, 0)
    assert ignored(features)[[1, 3]].tolist() == pytest.approx([1, 0], abs=0.1)


def test_what_answers_said_is_remembered_of_their_segments_and_nothing_of_the_others() -> None:
    seen: Seen = {"hi": seen_like([-1, -2, -3]), "lo": seen_like([-4, -5, -6])}
    rows = Doubts([], [], seen).judged({"hi": {0: True, 1: False}, "lo": {0: True}})
    assert [(row.choice, row.termination) for row in rows["hi"]] == [(0, 0), (1, 0), (-1, 1)]
    assert [(row.choice, row.termination) for row in rows["lo"]] == [(0, 0), (-1, 0), (-1, 1)]
    assert [float(row.observation[0]) for row in rows["lo"]] == [-4, -5, -6]


def test_a_gate_sees_how_sure_the_policies_were_of_what_they_chose() -> None:
    def sure(observations: Any) -> Outputs:
        n = len(observations)
        return Outputs(np.log(np.tile(np.float32([0.5, 0.25, 0.25]), (n, 1))), np.full(n, 0.75, np.float32))

    sigma = (segment(1, n_actions=2, action=0), segment(0, n_actions=1, action=2))
    asked = []

    def disagreement(key: Any, observations: Any) -> NDArray[np.float32]:
        asked.append((key, len(observations)))
        return np.full(len(observations), 0.125, np.float32)

    seen = seen_in(sigma, {META: sure, pi(0): sure, pi(1): sure}, disagreement)
    entropy = 1.5 * math.log(2)
    half, quarter = math.log(0.5), math.log(0.25)
    assert seen["hi"][0].tolist() == pytest.approx([quarter, quarter, entropy, 0.75, math.log(2), 0.125])
    assert seen["lo"][0].tolist() == pytest.approx([half, half, entropy, 0.75, math.log(3), 0.125])
    assert seen["lo"][1].tolist() == pytest.approx([quarter, quarter, entropy, 0.75, math.log(2), 0.125])
    assert asked == [(META, 1), (pi(1), 2), (META, 1), (pi(0), 1)]


def test_the_symmetric_views_of_a_network_that_was_hardly_trained_disagree_and_without_symmetries_nothing_does() -> (
    None
):
    learner = taught(briefly(2), 1)
    sigma = run(learner.rollout(learner.make_simulator(), TRAIN[5], streams.TRAIN, 0), learner.policies)
    seen = learner.doubts(sigma).seen
    assert (seen["hi"][:, DISAGREEMENT] > 0).any()
    assert (seen["lo"][:, DISAGREEMENT] > 0).any()
    alone = taught(briefly(2, symmetries=False, fields=FieldSpec(symmetries=False)), 1)
    assert (alone.doubts(sigma).seen["hi"][:, DISAGREEMENT] == 0).all()


def test_one_seed_is_one_run_and_an_episode_without_doubts_asks_nothing(tmp_path: Path) -> None:
    config = corridor(algorithm="hg-gated", values="gate.share=0.1", episodes=24)
    runs = []
    for name in ("one", "other"):
        with store(tmp_path / name) as (connection, options):
            summary = train(config, connection, options)
            runs.append((summary["weights"], history(connection.learner, summary["run"])))
    assert runs[0] == runs[1]
    asked = [(episode, ask["kind"]) for episode, _, ask, _, _ in runs[0][1]]
    assert {kind for _, kind in asked} <= {"hier_demo", "label_hi", "inspect_lo", "label_lo"}
    per_episode = [sum(episode == one for episode, _ in asked) for one in range(24)]
    assert min(per_episode[:8]) > 0  # too few segments for a quantile
    assert 0 in per_episode[8:]


@pytest.mark.parametrize("share", ["0.0", "1.0", "-0.5"])
def test_a_share_that_is_none_is_refused(share: str) -> None:
    with pytest.raises(ValueError, match=r"gate\.share is the share of segments to ask about, between 0 and 1"):
        set_up(corridor(algorithm="hg-gated", values=f"gate.share={share}"), threads=1)


def test_thriftydaggers_gate_is_refused_where_no_views_could_disagree() -> None:
    with pytest.raises(ValueError, match=r'gate\.kind="thrifty" compares symmetric views.*gate\.kind="lazy"'):
        set_up(corridor(algorithm="hg-gated", values='gate.kind="thrifty"'), threads=1)
