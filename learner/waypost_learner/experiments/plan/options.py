"""Plans the runs that tell which departure of the authors' experiments closes which gap to the published numbers.

Each option is added alone to the preset `paper`, and all together last. docs/paper.md says what each is.
"""

from dataclasses import replace
from typing import Any

from waypost_learner.experiments.plan.maze import AS_THE_AUTHORS, hybrid, imitation
from waypost_learner.experiments.plan.series import Group, Series

_MAZES = "waypost_learner.domains.maze"
_SLIPS = f"{_MAZES}.slips:SlipExpertMazeDomain"
_LAVA = f"{_MAZES}.lasting_lava:LastingLavaMazeDomain"
_BOTH = f"{_MAZES}.as_authors:AsAuthorsMazeDomain"
_TESTS_UNCUT = "h_hi_tests=100"
_PER_CHOICE, _FAILED = 'dqn.discount_per="choice"', "dqn.pseudo.failed=-1"

_HG, _FLAT, _BC = imitation("corners", True, "hg-dagger", "flat-dagger", "flat-bc")
_H_DQN = hybrid("h-DQN, head start 50 %", "h-dqn", head_start=0.5)


def _with(series: Series, label: str, **changes: Any) -> Series:
    return replace(series, label=f"{series.label}, {label}", config=replace(series.config, **changes))


def _of_labels(name: str, title: str, *series: Series) -> Group:
    return Group(f"options-{name}", f"corner mazes, {title}", AS_THE_AUTHORS, (), series, labels_only=True)


OPTIONS = (
    _of_labels(
        "hg-dagger",
        "hg-DAgger with each option of the authors' experiments",
        _HG,
        _with(_HG, "one label per place", algorithm="hg-dagger-by-place"),
        _with(_HG, "slip expert", domain=_SLIPS),
        _with(_HG, "lasting lava", domain=_LAVA),
        _with(_HG, "tests not cut", values=_TESTS_UNCUT),
        _with(_HG, "all four", algorithm="hg-dagger-by-place", domain=_BOTH, values=_TESTS_UNCUT),
    ),
    _of_labels(
        "flat-dagger",
        "flat DAgger with each option of the authors' experiments",
        _FLAT,
        _with(_FLAT, "every rollout labeled and counted", algorithm="plain-dagger", redraw=False),
        _with(_FLAT, "slip expert", domain=_SLIPS),
        _with(_FLAT, "lasting lava", domain=_LAVA),
        _with(_FLAT, "all three", algorithm="plain-dagger", redraw=False, domain=_BOTH),
    ),
    _of_labels(
        "flat-bc",
        "flat BC with each option of the authors' experiments",
        _BC,
        _with(_BC, "slip expert", domain=_SLIPS),
        _with(_BC, "lasting lava", domain=_LAVA),
        _with(_BC, "both", domain=_BOTH),
    ),
    Group(
        "options-h-dqn",
        "corner mazes, h-DQN with each option of the authors' experiments",
        "Episodes: every rollout. LO samples: the learner's own steps in training rollouts.",
        (),
        (
            _H_DQN,
            _with(_H_DQN, "discount per choice", values=_PER_CHOICE),
            _with(_H_DQN, "pseudo-reward -1", values=_FAILED),
            _with(_H_DQN, "lasting lava", domain=_LAVA),
            _with(_H_DQN, "all three", values=f"{_PER_CHOICE} {_FAILED}", domain=_LAVA),
        ),
        hybrid=True,
    ),
)
