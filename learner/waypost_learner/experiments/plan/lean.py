"""Plans the runs of docs/lean.md: the maze, with the preset `lean`."""

from waypost_learner.experiments.plan.series import HONEST, Group, Series
from waypost_learner.runs.config import TrainConfig

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

LEAN = (
    Group(
        "lean-random",
        "random mazes, preset lean compared with preset paper",
        HONEST,
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
        HONEST,
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
        HONEST,
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
        HONEST,
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
