"""What the tests of the examples share: every kind of query about a rollout, and a short run."""

from pathlib import Path
from typing import Any

from tests.learner.kit import store

from waypost.domains import Domain
from waypost_learner.algorithms.learner import Learner
from waypost_learner.algorithms.queries import HierDemo, InspectFull, InspectLo, LabelFull, LabelHi, LabelLo, Query
from waypost_learner.presets import find_preset
from waypost_learner.runs.checkpoints import load
from waypost_learner.runs.config import TrainConfig
from waypost_learner.runs.evaluation import evaluate
from waypost_learner.runs.setup import build_learner
from waypost_learner.runs.training import train

DOMAINS = [
    "waypost_control:upright_pendulum",
    "waypost_crossing:lava_crossing",
    "waypost_dialogue:flight_dialogue",
    "waypost_minigrid:unlock_pickup",
]
QUICK = " ".join(f"train_{level}.{value}" for level in ("hi", "lo") for value in ("idle=0", "least=3200", "most=3200"))


def queries_of_every_kind(domain: Domain, instance: Any) -> list[Query]:
    """Queries of an untrained learner about an instance."""
    learner = Learner(domain, find_preset("lean", domain=domain.name), seed=0, threads=1)
    s = learner.start(instance, 0)
    sigma = learner.roll_out(s)
    lo = [query(sigma[0]) for query in (InspectLo, LabelLo)]
    return [HierDemo(s.state), InspectFull(sigma), LabelHi(sigma), *lo, LabelFull(sigma)]


def success_after(episodes: int, domain: str, folder: Path, warm_start: int = 3, values: str = QUICK) -> float:
    """The success on 50 unseen instances after a run of hg-DAgger, which begins with some demonstrations."""
    config = TrainConfig("hg-dagger", domain=domain, episodes=max(episodes, 1), warm_start=warm_start, values=values)
    learner = build_learner(config, threads=1)
    if episodes > 0:
        with store(folder / "runs") as (connection, options):
            summary = train(config, connection, options)
        load(options.checkpoints / f"{summary['run']}.safetensors", learner)
    return evaluate(learner, learner.domain.instances("random").test, 50).success_rate
