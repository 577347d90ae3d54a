"""Plans the runs of the paper's section 6.1: the maze, with the preset `paper`."""

from waypost_learner.experiments.plan.series import HONEST, Group, Series
from waypost_learner.runs.config import TrainConfig


def imitation(instances: str, redraw: bool, *algorithms: str) -> tuple[Series, ...]:
    """Return a series of each imitation algorithm on a set of mazes."""
    labels = {
        "hg-dagger": "hg-DAgger",
        "h-bc": "h-BC",
        "flat-dagger": "flat DAgger",
        "flat-bc": "flat BC",
        "naive-h-dagger": "naive h-DAgger",
    }
    passive = {"h-bc", "flat-bc"}  # they have no training rollouts, so `redraw` does not apply
    return tuple(
        Series(TrainConfig(a, instances=instances, preset="paper", redraw=redraw and a not in passive), labels[a])
        for a in algorithms
    )


def hybrid(label: str, algorithm: str, head_start: float | None = None) -> Series:
    """Return a series of an algorithm whose actions are learned by reinforcement, on corner mazes."""
    config = TrainConfig(algorithm, instances="corners", preset="paper", episodes=8_000, head_start=head_start)
    return Series(config, label)


_FOUR = ("hg-dagger", "h-bc", "flat-dagger", "flat-bc")

AS_THE_AUTHORS = "Episodes: demonstrations and failed rollouts only. Costs: labels only. Both as the authors count."
_SUCCESS = ("success-by-episode", "success-by-cost", "success-by-lo-cost")

MAZE = (
    Group(
        "published",
        "corner mazes, counted as the authors count",
        AS_THE_AUTHORS,
        (*_SUCCESS, "cost-by-kind"),
        imitation("corners", True, *_FOUR),
        labels_only=True,
    ),
    Group(
        "naive",
        "corner mazes, hg-DAgger compared with labeling everything",
        AS_THE_AUTHORS,
        ("lo-cost-by-episode", "success-by-lo-cost"),
        imitation("corners", True, "hg-dagger", "naive-h-dagger"),
        labels_only=True,
    ),
    Group(
        "corners",
        "corner mazes, every rollout counted as an episode",
        HONEST,
        (*_SUCCESS, "cost-by-kind"),
        imitation("corners", False, *_FOUR),
    ),
    Group(
        "random",
        "random mazes, every rollout counted as an episode",
        HONEST,
        (*_SUCCESS, "cost-by-kind"),
        imitation("random", False, *_FOUR),
    ),
    Group(
        "hybrid",
        "corner mazes, actions learned by reinforcement",
        "Episodes: every rollout. LO samples: the learner's own steps in training rollouts.",
        ("progress-by-sample", "success-by-sample"),
        (
            hybrid("hg-DAgger/Q", "hg-dagger-q"),
            hybrid("h-DQN, head start 50 %", "h-dqn", head_start=0.5),
            hybrid("h-DQN", "h-dqn"),
            hybrid("flat DDQN", "flat-dqn"),
        ),
        hybrid=True,
    ),
)
