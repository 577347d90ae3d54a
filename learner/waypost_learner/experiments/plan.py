"""Defines which runs each figure needs. `waypost sweep` trains them and `waypost figures` draws them.

The plan contains only configurations, so drawing figures does not import any algorithm.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import zip_longest

from waypost_learner.runs.config import TrainConfig

SEEDS = (0, 1, 2, 3, 4)


@dataclass(frozen=True)
class Series:
    """The runs of one curve: one configuration with several seeds."""

    config: TrainConfig  # with any seed: `runs` replaces it
    label: str
    beside: bool = False  # whether it is the reference of its group, drawn in black
    most: int | None = None  # use at most this many of the requested seeds

    def runs(self, seeds: Sequence[int]) -> list[TrainConfig]:
        """Return one configuration per seed."""
        return [replace(self.config, seed=seed) for seed in seeds[: self.most]]


@dataclass(frozen=True)
class Group:
    """Several series that one part of the report compares.

    Args:
        name: the name for `--figure`.
        title: the heading in the report: the mazes and the compared runs.
        counting: how episodes and costs are counted; shown on every figure.
        figures: the figures to draw, by their names in `FIGURES` of `figures/draw.py`.
        series: the curves.
        labels_only: whether costs exclude inspections. The authors' costs do, so only such groups are compared with
            the published numbers.
        hybrid: whether actions are learned by reinforcement. Success is then shown over LO samples instead of cost.
        lean: whether the group compares variants of the preset `lean`. Its tables use fewer episodes, and its cost
            axis is logarithmic.
        tests: the instances of the test episodes.
    """

    name: str
    title: str
    counting: str
    figures: tuple[str, ...]
    series: tuple[Series, ...]
    labels_only: bool = False
    hybrid: bool = False
    lean: bool = False
    tests: str = "unseen mazes"


def _imitation(instances: str, redraw: bool, *algorithms: str) -> tuple[Series, ...]:
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


def _hybrid(label: str, algorithm: str, head_start: float | None = None) -> Series:
    config = TrainConfig(algorithm, instances="corners", preset="paper", episodes=8_000, head_start=head_start)
    return Series(config, label)


_FOUR = ("hg-dagger", "h-bc", "flat-dagger", "flat-bc")

_AS_THE_AUTHORS = "Episodes: demonstrations and failed rollouts only. Costs: labels only. Both as the authors count."
_HONEST = "Episodes: every rollout. Costs: every label and every inspection."
_SUCCESS = ("success-by-episode", "success-by-cost", "success-by-lo-cost")

_MAZE = (
    Group(
        "published",
        "corner mazes, counted as the authors count",
        _AS_THE_AUTHORS,
        (*_SUCCESS, "cost-by-kind"),
        _imitation("corners", True, *_FOUR),
        labels_only=True,
    ),
    Group(
        "naive",
        "corner mazes, hg-DAgger compared with labeling everything",
        _AS_THE_AUTHORS,
        ("lo-cost-by-episode", "success-by-lo-cost"),
        _imitation("corners", True, "hg-dagger", "naive-h-dagger"),
        labels_only=True,
    ),
    Group(
        "corners",
        "corner mazes, every rollout counted as an episode",
        _HONEST,
        (*_SUCCESS, "cost-by-kind"),
        _imitation("corners", False, *_FOUR),
    ),
    Group(
        "random",
        "random mazes, every rollout counted as an episode",
        _HONEST,
        (*_SUCCESS, "cost-by-kind"),
        _imitation("random", False, *_FOUR),
    ),
    Group(
        "hybrid",
        "corner mazes, actions learned by reinforcement",
        "Episodes: every rollout. LO samples: the learner's own steps in training rollouts.",
        ("progress-by-sample", "success-by-sample"),
        (
            _hybrid("hg-DAgger/Q", "hg-dagger-q"),
            _hybrid("h-DQN, head start 50 %", "h-dqn", head_start=0.5),
            _hybrid("h-DQN", "h-dqn"),
            _hybrid("flat DDQN", "flat-dqn"),
        ),
        hybrid=True,
    ),
)

_FEWER = "relabeling=false repeat_penalty=0"


def _lean(
    label: str,
    algorithm: str = "hg-dagger",
    instances: str = "random",
    values: str | None = None,
    most: int | None = None,
    episodes: int = 300,
) -> Series:
    config = TrainConfig(algorithm, instances=instances, preset="lean", episodes=episodes, values=values)
    return Series(config, label, most=most)


def _part(label: str, values: str, episodes: int = 300) -> Series:
    return _lean(label, values=values, most=3, episodes=episodes)


def _paper(instances: str) -> Series:
    return Series(TrainConfig("hg-dagger", instances=instances, preset="paper"), "hg-DAgger, paper", True, most=1)


# Flat learners without what hg-DAgger's learner gets. The runs of flat learners that have it take hours (docs/lean.md).
_NOT_PLANNING = (
    "planning=null relabeling=false train_flat.learning_rate=0.001 train_flat.idle=0 train_flat.dropout=0.2 "
    "train_flat.bf16=true"
)
_AT_ONCE = "train_hi.idle=0 train_lo.idle=0"  # no continued training: nearly every episode of these gives labels
_SAMPLED = "monitoring.share=0.1 monitoring.rate=0.9"
_FAILING = 100  # episodes: most of them fail and are labeled completely, so they cost more than 300 successful ones

_LEAN = (
    Group(
        "lean-random",
        "random mazes, preset lean compared with preset paper",
        _HONEST,
        ("success-by-log-cost", "success-by-episode", "cost-by-kind"),
        (
            _lean("hg-DAgger"),
            _lean("hg-DAgger without relabeling and repeat penalty", values=_FEWER),
            _lean("naive h-DAgger", "naive-h-dagger", values=_AT_ONCE, most=3),
            _lean("h-BC", "h-bc", values=_AT_ONCE, most=3),
            _lean("flat DAgger, not planning", "flat-dagger", values=_NOT_PLANNING, most=3),
            _lean("flat BC, not planning", "flat-bc", values=_NOT_PLANNING, most=3),
            _paper("random"),
        ),
        lean=True,
    ),
    Group(
        "lean-corners",
        "corner mazes, preset lean compared with preset paper",
        _HONEST,
        ("success-by-log-cost",),
        (
            _lean("hg-DAgger", instances="corners"),
            _paper("corners"),
        ),
        lean=True,
    ),
    Group(
        "lean-parts",
        "random mazes, hg-DAgger with each part of lean removed alone",
        _HONEST,
        (),
        (
            _lean("all of lean"),
            _part("without relabeling", "relabeling=false"),
            _part("without the repeat penalty", "repeat_penalty=0"),
            _part("without symmetries, untied", "symmetries=false tied=false"),
            _part("untied", "tied=false"),
            _part("without planning, 100 episodes", "planning=null", _FAILING),
            _part("without views and planning, 100 episodes", "views=false planning=null", _FAILING),
            _lean("without averaging", values="train_hi.averaging=null train_lo.averaging=null"),
            _part("without continued training", _AT_ONCE),
            _part("20 demonstrations", "warm_start=20"),
        ),
        lean=True,
    ),
    Group(
        "lean-asking",
        "random mazes, preset lean with options that ask less than Algorithm 2",
        _HONEST,
        ("success-by-log-cost",),
        (
            _lean("Algorithm 2"),
            _lean("sampled monitoring", values=_SAMPLED),
            _lean("single states", "hg-stagger"),
            _lean("both options", "hg-stagger", values=_SAMPLED),
        ),
        lean=True,
    ),
)

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
        _HONEST,
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

_MONTEZUMA = (
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

GROUPS = {group.name: group for group in (*_MAZE, *_LEAN, *_MONTEZUMA)}
"""Every group by its name."""

FIGURES = {
    "maze": tuple(group.name for group in _MAZE),
    "lean": tuple(group.name for group in _LEAN),
    "montezuma": tuple(group.name for group in _MONTEZUMA),
    **{name: (name,) for name in GROUPS},
}
"""The groups of every value of `--figure`: `maze` and `montezuma` (sections of the paper), `lean`, or one group."""


def find_figure(name: str) -> list[Group]:
    """Return the groups of a figure.

    Raises:
        ValueError: no figure has this name; the message lists the names.
    """
    if name not in FIGURES:
        raise ValueError(f"there is no figure {name!r}; the figures are: {', '.join(FIGURES)}")
    return [GROUPS[group] for group in FIGURES[name]]


def runs_of(groups: Sequence[Group], seeds: Sequence[int]) -> list[TrainConfig]:
    """Return every run of the groups once, ordered by seed: first the runs of all series with the first seed."""
    runs = [each.runs(seeds) for group in groups for each in group.series]
    return list(dict.fromkeys(run for nth in zip_longest(*runs) for run in nth if run is not None))
