"""Draws the figures, one function each. Lines and bands show our runs, markers show published numbers."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
from matplotlib import rc_context
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from waypost_learner.experiments.figures import look
from waypost_learner.experiments.figures.data import KINDS, Column, Comparison, RunCurves
from waypost_learner.experiments.figures.look import count_axis, curve, frame, legend, percent_axis, point
from waypost_learner.experiments.figures.published import NEVER, SUBGOALS, Published, author_logs, published
from waypost_learner.experiments.figures.statistics import Track
from waypost_learner.experiments.plan.series import Series

Value = Callable[[RunCurves], Column]
Points = Callable[[Published], Iterator[tuple[float, float]]]

_LINES = "Lines: our runs."
_MARKERS = "Lines: our runs. Markers: published medians."


def success_by_episode(comparison: Comparison) -> Figure:
    """Draw the success rate after each episode."""
    return _success(comparison, "Success by episode", "Episodes", lambda run: run.episodes, _points_by_episode)


def success_by_cost(comparison: Comparison) -> Figure:
    """Draw the success rate against the expert cost."""
    labels_only = comparison.group.labels_only
    x = f"Expert cost, units{' (labels only)' if labels_only else ''}"
    return _success(comparison, "Success against expert cost", x, lambda run: run.cost(labels_only), _points_by_cost)


def success_by_log_cost(comparison: Comparison) -> Figure:
    """Draw the success rate against the expert cost on a logarithmic axis."""
    figure, (axes,) = frame(comparison, "Success against expert cost")
    _success_curves(axes, comparison, lambda run: run.cost(comparison.group.labels_only), _no_points)
    look.log_axis(axes.xaxis, "Expert cost, units (logarithmic)")
    _close(figure, comparison, _LINES)
    return figure


def success_by_lo_cost(comparison: Comparison) -> Figure:
    """Draw the success rate against the cost of LO-level labels, including those of demonstrations."""
    x = "LO-level expert cost, units (actions and terminations, including demonstrations)"
    title = "Success against LO-level expert cost"
    return _success(comparison, title, x, lambda run: run.lo_cost, _points_by_lo_cost)


def cost_by_kind(comparison: Comparison) -> Figure:
    """Draw hg-DAgger's cumulative cost of each kind of query by episode."""
    series, runs = _first(comparison)
    group = comparison.group
    figure, (axes,) = frame(comparison, f"Expert cost of {series.label} by kind of query")
    entries = []
    for kind in KINDS:
        label, style = look.KINDS[kind]
        if any(run.units[kind].any() for run in runs):
            curve(axes, [Track(run.episodes, run.units[kind], run.complete) for run in runs], style)
            entries.append((label, style))
    total = [Track(run.episodes, run.cost(group.labels_only), run.complete) for run in runs]
    curve(axes, total, look.SUM)
    cost = published(group, series).cost
    if cost is not None:
        point(axes, 1_000, cost, look.SUM, f"{series.config.algorithm} cost")
    count_axis(axes.xaxis, "Episodes")
    count_axis(axes.yaxis, "Cumulative expert cost, units")
    entries.append(("all labels" if group.labels_only else "all", look.SUM))
    explanation = 'Lines: our runs. "all labels" excludes inspections. Marker: published median of all labels.'
    legend(figure, entries, explanation if cost is not None else _LINES, markers=False)
    return figure


def lo_cost_by_episode(comparison: Comparison) -> Figure:
    """Draw the cumulative cost of LO-level labels by episode, without demonstrations."""
    figure, (axes,) = frame(comparison, "LO-level expert cost without demonstrations")
    for series, runs in comparison.runs.items():
        tracks = [Track(run.episodes, run.lo_label_cost, run.complete) for run in runs]
        curve(axes, tracks, look.style_of(series))
    count_axis(axes.xaxis, "Episodes")
    count_axis(axes.yaxis, "Cumulative cost of LO labels, units")
    _close(figure, comparison, _LINES)
    return figure


def progress_by_sample(comparison: Comparison) -> Figure:
    """Draw hg-DAgger/Q's success rate and its number of HI labels against LO samples."""
    series, runs = _first(comparison)
    figure, (above, below) = frame(comparison, f"{series.label}: success and HI labels", panels=2)
    style = look.style_of(series)
    curve(above, [Track(run.lo_samples, 100 * run.success_rate, run.complete) for run in runs], style)
    curve(below, [Track(run.lo_samples, run.hi_labels, run.complete) for run in runs], style)
    percent_axis(above, "Success (trailing 100)")
    count_axis(below.yaxis, "HI labels, units")
    count_axis(below.xaxis, "LO samples")
    legend(figure, [(series.label, style)], _LINES, markers=False)
    return figure


def success_by_sample(comparison: Comparison) -> Figure:
    """Draw the success rate against LO samples."""
    figure, (axes,) = frame(comparison, "Success against LO samples")
    _success_curves(axes, comparison, lambda run: run.lo_samples, _no_points)
    finals = {series: published(comparison.group, series).final for series in comparison.runs}
    levels = {series: 100 * final for series, final in finals.items() if final is not None}
    for series, success in levels.items():
        look.level(axes, success, look.style_of(series), f"{series.label} {success:g}%")
    count_axis(axes.xaxis, "LO samples")
    _close(figure, comparison, f"{_LINES} Thin dotted lines: final success of published curves." if levels else _LINES)
    return figure


def progress_by_subgoal(comparison: Comparison) -> Figure:
    """Draw how often the first series reached each subgoal, against LO samples, beside the authors' five runs."""
    series, runs = _first(comparison)
    figure, (axes,) = frame(comparison, f"{series.label}: progress by subgoal")
    entries = []
    for subgoal, color in zip(SUBGOALS, look.OF_SUBGOALS, strict=True):
        ours, theirs = replace(look.style_of(series), color=color), replace(look.AUTHORS, color=color)
        learned = [run for run in runs if subgoal in run.reached]
        curve(axes, [Track(run.lo_samples, 100 * run.reached[subgoal], run.complete) for run in learned], ours)
        curve(axes, [Track(log.lo_samples, 100 * log.reached[subgoal], over=True) for log in author_logs()], theirs)
        entries.append((subgoal.replace("_", " "), ours))
    percent_axis(axes, "Attempts that succeeded (trailing 100)")
    look.log_axis(axes.xaxis, "LO samples (logarithmic)")
    axes.set_xlim(left=1_000)
    entries.append(("the authors' runs", look.AUTHORS))
    legend(figure, entries, "Solid: our runs. Dashed: the authors' five runs, from their logs.", markers=False)
    return figure


def reward_by_sample(comparison: Comparison) -> Figure:
    """Draw the mean reward of training rollouts against LO samples."""
    figure, (axes,) = frame(comparison, "Reward against LO samples")
    for series, runs in comparison.runs.items():
        tracks = [Track(run.lo_samples, run.reward, run.complete) for run in runs]
        curve(axes, tracks, look.style_of(series), quartiles=True)
    count_axis(axes.yaxis, "Mean reward (trailing 100 rollouts)")
    # Otherwise a reward that is always 0 has several ticks that say 0.
    axes.yaxis.set_major_locator(MaxNLocator(integer=True, min_n_ticks=1))
    count_axis(axes.xaxis, "LO samples")
    several = any(len(runs) > 1 for runs in comparison.runs.values())
    _close(figure, comparison, f"{_LINES} Darker bands: quartiles." if several else _LINES)
    return figure


def hi_labels(comparison: Comparison) -> Figure:
    """Draw a histogram of the first series' HI labels at the end, beside those of the authors' five runs."""
    series, runs = _first(comparison)
    figure, (axes,) = frame(comparison, f"{series.label}: HI labels of whole runs")
    ours, theirs = [run.hi_labels[-1] for run in runs], [log.hi_labels for log in author_logs()]
    style = look.style_of(series)
    bins = np.geomspace(100, 100_000, 31).tolist()
    axes.hist(ours, bins, color=style.color)
    axes.hist(theirs, bins, color=look.AUTHORS.color, hatch="//", edgecolor="white")
    look.log_axis(axes.xaxis, "HI labels (logarithmic)")
    axes.yaxis.set_major_locator(MaxNLocator(integer=True))
    count_axis(axes.yaxis, "Runs")
    explanation = "The authors' runs ended when the door was reached in 91 of 100 attempts."
    legend(figure, [(series.label, style), ("the authors' runs", look.AUTHORS)], explanation, markers=False)
    return figure


FIGURES: dict[str, Callable[[Comparison], Figure]] = {
    "success-by-episode": success_by_episode,
    "success-by-cost": success_by_cost,
    "success-by-log-cost": success_by_log_cost,
    "success-by-lo-cost": success_by_lo_cost,
    "cost-by-kind": cost_by_kind,
    "lo-cost-by-episode": lo_cost_by_episode,
    "progress-by-sample": progress_by_sample,
    "success-by-sample": success_by_sample,
    "progress-by-subgoal": progress_by_subgoal,
    "reward-by-sample": reward_by_sample,
    "hi-labels": hi_labels,
}
"""The drawing functions, by the figure names in `plan.Group.figures`."""

# These figures show only a group's first series.
_OF_THE_FIRST = frozenset({"cost-by-kind", "progress-by-sample", "progress-by-subgoal", "hi-labels"})


def figures_of(comparison: Comparison) -> Iterator[tuple[str, Figure]]:
    """Yield a group's figures with their names. Skip figures of the first series if that series has no runs."""
    group = comparison.group
    for name in group.figures:
        if group.series[0] in comparison.runs or name not in _OF_THE_FIRST:
            yield f"{group.name}-{name}", FIGURES[name](comparison)


def save(figure: Figure, folder: Path, name: str) -> list[Path]:
    """Write a figure as SVG and PNG, and return both paths. The same figure gives the same files."""
    paths = [folder / f"{name}.svg", folder / f"{name}.png"]
    with rc_context(look.RC):
        figure.savefig(paths[0], metadata={"Date": None})
        figure.savefig(paths[1], dpi=look.DPI)
    return paths


# --- helpers


def _first(comparison: Comparison) -> tuple[Series, Sequence[RunCurves]]:
    series = comparison.group.series[0]
    return series, comparison.runs[series]


def _success(comparison: Comparison, title: str, x: str, value: Value, points: Points) -> Figure:
    """Return a figure of every series' success rate against a value of its runs."""
    figure, (axes,) = frame(comparison, title)
    marked = _success_curves(axes, comparison, value, points)
    count_axis(axes.xaxis, x)
    _close(figure, comparison, _MARKERS if marked else _LINES, marked)
    return figure


def _success_curves(axes: Axes, comparison: Comparison, x: Value, points: Points) -> bool:
    """Draw every series' success rate against x, and its published points. Return whether it drew any points."""
    marked = False
    for series, runs in comparison.runs.items():
        style = look.style_of(series)
        curve(axes, [Track(x(run), 100 * run.success_rate, run.complete) for run in runs], style)
        for at, success in points(published(comparison.group, series)):
            point(axes, at, 100 * success, style, f"{series.label} {at:g} {100 * success:g}%")
            marked = True
    percent_axis(axes, f"Success on {comparison.group.tests} (trailing 100)")
    return marked


def _points_by_episode(known: Published) -> Iterator[tuple[float, float]]:
    yield from known.success.items()


def _points_by_cost(known: Published) -> Iterator[tuple[float, float]]:
    for level, cost in known.cost_at.items():
        if cost < NEVER:
            yield cost, level
    if known.cost is not None and known.final is not None:
        yield known.cost, known.final


def _points_by_lo_cost(known: Published) -> Iterator[tuple[float, float]]:
    if known.lo_only:
        yield from _points_by_cost(known)


def _no_points(_: Published) -> Iterator[tuple[float, float]]:
    yield from ()


def _close(figure: Figure, comparison: Comparison, explanation: str, markers: bool = False) -> None:
    legend(figure, [(series.label, look.style_of(series)) for series in comparison.runs], explanation, markers)
