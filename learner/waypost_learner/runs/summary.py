"""The summary of a run: the line that `waypost train --json` prints."""

from typing import Any

from waypost import wire
from waypost.client import Client
from waypost_learner.runs.checkpoints import weights_hash
from waypost_learner.runs.setup import Setup


def finish(setup: Setup, client: Client, run: str, ended: str, seconds: float) -> dict[str, Any]:
    """Finish a run at the server, and return its summary.

    Args:
        setup: the run's configuration and learner.
        client: the learner's client.
        run: the run's id.
        ended: why the run ended, in words.
        seconds: the wall time of the run in this process.
    """
    config, costs, state = setup.config, client.costs(run), client.run(run)
    summary: dict[str, Any] = {
        "run": run,
        "algorithm": config.algorithm,
        "domain": config.domain,
        "seed": config.seed,
        "told": setup.told,
        "episodes": state.episodes_done,
        "success_rate": state.success_rate,
        "cost": {"total": costs.total, "by_kind": {kind: cost.units for kind, cost in costs.by_kind.items()}},
        "first_at": {
            level: milestone.model_dump() if milestone else None for level, milestone in costs.first_at.items()
        },
        "wall_seconds": round(seconds, 3),
        "ended": ended,
        "weights": weights_hash(setup.learner),
    }
    if state.state != "finished":
        client.patch_run(run, wire.RunPatch(state="finished", result=summary))
    return summary
