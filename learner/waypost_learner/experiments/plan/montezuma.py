"""Plans the runs of the paper's section 6.2: the first room of Montezuma's Revenge."""

from dataclasses import replace

from waypost_learner.experiments.plan.series import HONEST, Group, Series
from waypost_learner.runs.config import TrainConfig

_ROOM = TrainConfig("hg-dagger-q", domain="montezuma", episodes=550)  # fewer than 100,000 LO samples


def _room(
    label: str, algorithm: str, instances: str = "random", episodes: int = _ROOM.episodes, values: str | None = None
) -> Series:
    config = replace(_ROOM, algorithm=algorithm, instances=instances, episodes=episodes, values=values)
    return Series(config, label)


# As many LO samples as hg-DAgger/Q takes in its 550 episodes: attempts that fail are long. Tests fail too, and would
# take most of the time, so there are fewer.
_ROOM_H_DQN = replace(_ROOM, algorithm="h-dqn", episodes=200, test_every=2)


def _room_imitation(
    name: str, title: str, instances: str, tests: str, episodes: int, values: str | None = None
) -> Group:
    """Return a group of the imitation algorithms. hg-DAgger has so many episodes; the others pay more for theirs."""
    return Group(
        name,
        title,
        HONEST,
        ("success-by-log-cost", "cost-by-kind"),
        (
            _room("hg-DAgger", "hg-dagger", instances, episodes, values),
            _room("h-BC", "h-bc", instances, 40),  # 6,000 units, more than hg-DAgger needs
            _room("flat DAgger", "flat-dagger", instances, 80, values),  # about as many
        ),
        lean=True,
        tests=tests,
    )


# `paper` has this value too. It is named because the stair is learned in time only with it.
_BYTES = "network.scale=255"
_PAPER_ROOM = replace(_ROOM, preset="paper", episodes=3_000, values=_BYTES)

# Without demonstrations, attempts at a subgoal explore places until it was reached. The door takes some hundred
# attempts, and an episode has at most one.
_EXPLORING = replace(_ROOM, episodes=2_500, values="dqn.exploration.wander=40")

MONTEZUMA = (
    Group(
        "montezuma-hybrid",
        "Montezuma's Revenge, actions learned by reinforcement",
        "Tests: the 20 starts, on which the learner also trained. LO samples: the learner's steps in training.",
        ("progress-by-subgoal", "reward-by-sample", "success-by-sample", "hi-labels"),
        (_room("hg-DAgger/Q", "hg-dagger-q"), Series(_ROOM_H_DQN, "h-DQN")),
        hybrid=True,
        tests="the 20 starts",
    ),
    Group(
        "montezuma-alone",
        "Montezuma's Revenge, actions learned by reinforcement without demonstrations",
        "Tests: the 20 starts, on which the learner also trained. LO samples: the learner's steps in training.",
        ("progress-by-subgoal", "reward-by-sample", "success-by-sample", "hi-labels"),
        (
            Series(replace(_EXPLORING, warm_start=0), "hg-DAgger/Q"),
            Series(replace(_EXPLORING, algorithm="h-dqn"), "h-DQN", most=1),
        ),
        hybrid=True,
        tests="the 20 starts",
    ),
    Group(
        "montezuma-paper",
        "Montezuma's Revenge, the paper's network and values, without demonstrations",
        "Tests: the 20 starts, on which the learner also trained. LO samples: the learner's steps in training.",
        ("progress-by-subgoal", "reward-by-sample"),
        (
            Series(_PAPER_ROOM, "hg-DAgger/Q", most=1),
            Series(replace(_PAPER_ROOM, algorithm="h-dqn", episodes=6_000, test_every=20), "h-DQN", most=1),
        ),
        hybrid=True,
        tests="the 20 starts",
    ),
    _room_imitation(
        "montezuma-imitation",
        "Montezuma's Revenge, learned by imitation, every episode inspected",
        "random",
        "the 20 starts",
        150,
        "monitoring.share=1",  # sampling would end most inspections when 19 of the 20 starts succeed
    ),
    _room_imitation(
        "montezuma-slips",
        "Montezuma's Revenge, learned by imitation, one action in twenty is random",
        "slips",
        "unseen slips",
        300,
    ),
)
