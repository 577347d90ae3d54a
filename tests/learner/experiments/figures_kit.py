"""Runs made by hand, for the tests of figures."""

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from waypost import wire
from waypost_learner.experiments import plan
from waypost_learner.experiments.figures import measures
from waypost_learner.experiments.figures.data import KINDS, Comparison, RunCurves
from waypost_learner.runs.config import TrainConfig
from waypost_server.runs.curves import trailing


def run_of(
    config: TrainConfig, tests: Sequence[bool | None], hi: Sequence[int] | None = None, **costs: Sequence[float]
) -> RunCurves:
    """A run whose tests, sizes of D_HI and cumulative costs are given; 10 LO samples an episode."""
    n = len(tests)
    by_kind: dict[wire.Kind, list[float]] = {kind: list(costs.get(kind, [0.0] * n)) for kind in KINDS}
    curves = wire.Curves(
        episode=list(range(n)),
        success_rate=trailing(tests),
        test_success=list(tests),
        cost=[sum(column) for column in zip(*by_kind.values(), strict=True)],
        lo_cost=list(costs.get("lo_cost", [0.0] * n)),
        seconds=[0.0] * n,
        active_seconds=[0.0] * n,
        cost_by_kind=by_kind,
        hi_labels=list(hi or [0] * n),
        lo_samples=[10 * (row + 1) for row in range(n)],
        learner_seconds=[0.1 * (row + 1) for row in range(n)],
        reward=[None] * n,
        reached={},
    )
    return RunCurves.of(config, curves)


def published_runs(n: int = 1_000, **more: Any) -> Comparison:
    """The published group with one run each, in which everything costs 1 an episode."""
    group = plan.GROUPS["published"]
    ones = list(np.cumsum(np.ones(n)))
    runs = {
        series: [run_of(replace(series.config, episodes=n), [True] * n, **dict.fromkeys(KINDS, ones), **more)]
        for series in group.series
    }
    return Comparison(group, runs)


def results_of(comparison: Comparison) -> dict[tuple[str, str], measures.Result]:
    return {(result.series, result.measure): result for result in measures.summary([comparison])}


def marked(figure: Figure) -> dict[str, tuple[float, float]]:
    """The published points on a figure, by what they are of."""
    points = [line for axes in figure.axes for line in axes.get_lines() if (line.get_gid() or "").startswith("publ")]
    return {str(line.get_gid()): (line.get_xdata()[0], line.get_ydata()[0]) for line in points}  # type: ignore[index]
