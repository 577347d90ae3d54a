"""What the tests of the examples share: every kind of query about a rollout, and a short run."""

from pathlib import Path
from typing import Any

from tests.learner.kit import store

from waypost import wire
from waypost.domains import Domain
from waypost_learner.algorithms.learner import Learner
from waypost_learner.algorithms.queries import HierDemo, InspectFull, InspectLo, LabelFull, LabelHi, LabelLo, Query
from waypost_learner.experts.oracle import OracleExpert
from waypost_learner.presets import find_preset
from waypost_learner.remote.translation import Translator
from waypost_learner.rollout.simulator import Simulator
from waypost_learner.runs.checkpoints import load
from waypost_learner.runs.config import TrainConfig
from waypost_learner.runs.evaluation import evaluate
from waypost_learner.runs.setup import build_learner
from waypost_learner.runs.training import train

QUICK = " ".join(f"train_{level}.{value}" for level in ("hi", "lo") for value in ("idle=0", "least=3200", "most=3200"))


def queries_of_every_kind(domain: Domain, instance: Any) -> list[Query]:
    """Queries of an untrained learner about an instance."""
    learner = Learner(domain, find_preset("lean"), seed=0, threads=1)
    s = learner.start(instance, 0)
    sigma = learner.roll_out(s)
    lo = [query(sigma[0]) for query in (InspectLo, LabelLo)]
    return [HierDemo(s.state), InspectFull(sigma), LabelHi(sigma), *lo, LabelFull(sigma)]


def check_answers_of_every_kind(domain: Domain, instance: Any) -> None:
    """The oracle answers every kind of query with names of the domain, and its demonstration succeeds."""
    translator, expert = Translator(domain, instance), OracleExpert(domain)
    asks = [translator.ask(query, 0, n) for n, query in enumerate(queries_of_every_kind(domain, instance))]
    demonstration, full, hi, _, lo, flat = (expert(ask) for ask in asks)
    assert isinstance(demonstration, wire.HierDemoAnswer)
    simulator = Simulator(domain)
    simulator.reset(instance)
    for action in [action for segment in demonstration.segments for action in segment.actions]:
        simulator.step(domain.actions.index(action))
    assert simulator.succeeded
    assert isinstance(full, wire.InspectAnswer)
    assert full.verdict == "fail"
    assert isinstance(hi, wire.LabelHiAnswer)
    assert set(hi.subgoals) <= set(domain.subgoals)
    assert isinstance(lo, wire.LabelLoAnswer)
    assert isinstance(flat, wire.LabelFullAnswer)
    assert len(flat.actions) == sum(len(segment.actions) for segment in asks[-1].segments)


def success_after(episodes: int, domain: str, folder: Path, warm_start: int = 3) -> float:
    """The success on 50 unseen instances after a run of hg-DAgger, which begins with some demonstrations."""
    config = TrainConfig("hg-dagger", domain=domain, episodes=max(episodes, 1), warm_start=warm_start, values=QUICK)
    learner = build_learner(config, threads=1)
    if episodes > 0:
        with store(folder / "runs") as (connection, options):
            summary = train(config, connection, options)
        load(options.checkpoints / f"{summary['run']}.safetensors", learner)
    return evaluate(learner, learner.domain.instances("random").test, 50).success_rate
