"""Draws the figure of the theory: measured ratios compared with the bounds, and every cost compared with its bound."""

from collections.abc import Sequence
from pathlib import Path
from typing import Literal

from matplotlib import rc_context
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import FixedLocator, NullLocator

from waypost_learner.experiments.figures.look import DPI, RC
from waypost_learner.experiments.theory.grid import EPISODES, Row, worst
from waypost_learner.experiments.theory.simulation import Episodes

# The palette of Okabe and Ito. hg-DAgger and flat DAgger have the same colors as in `experiments/figures/look.py`.
_BLUE, _GREEN, _VERMILLION, _PURPLE, _GREY = "#0072B2", "#009E73", "#D55E00", "#CC79A7", "0.4"
_FILLED: dict[Episodes, Literal["full", "none"]] = {"worst": "full", "random": "none"}


def draw(rows: Sequence[Row]) -> Figure:
    """Return the figure. It needs no display."""
    with rc_context(RC):
        figure = Figure(figsize=(11, 5.4), layout="constrained")
        left, right = figure.subplots(1, 2)
        _draw_ratios(left, rows)
        _draw_costs(right, rows)
    return figure


def save(rows: Sequence[Row], folder: Path) -> None:
    """Write theory.svg and theory.png into a folder. The same numbers give the same files."""
    with rc_context(RC):
        figure = draw(rows)
        figure.savefig(folder / "theory.svg", metadata={"Date": None})  # without the time
        figure.savefig(folder / "theory.png", dpi=DPI)


def _draw_ratios(axes: Axes, rows: Sequence[Row]) -> None:
    proportions = sorted({row.proportion for row in rows})
    ends = [proportions[0] / 1.2, proportions[-1] * 1.2]
    axes.plot(ends, ends, color=_GREY, linestyle="--", label="the paper's proportion")
    bounds = sorted({(row.proportion, row.ratio_of_bounds) for row in rows})
    axes.plot(*zip(*bounds, strict=True), "_", color="black", markersize=26, label="ratio of the two bounds")
    # Move the two kinds of points apart, so that they do not hide each other.
    for episodes, color, marker, apart in zip(EPISODES, (_VERMILLION, _PURPLE), "oD", (0.96, 1.04), strict=True):
        found = [(row.proportion * apart, row.ratio) for row in rows if row.episodes == episodes and row.ratio]
        if found:
            label = f"measured, {episodes} episodes"
            axes.plot(*zip(*found, strict=True), marker, color=color, fillstyle=_FILLED[episodes], label=label)
    axes.set(
        xscale="log",
        yscale="log",
        xlabel=r"$(H_{HI}+H_{LO})\,/\,(H_{HI}\,H_{LO})$",
        ylabel="hg-DAgger / flat DAgger",
        title="Learning cost of hg-DAgger for each unit of flat DAgger's",
    )
    axes.xaxis.set(major_locator=FixedLocator(proportions), minor_locator=NullLocator(), major_formatter="{x:g}")
    axes.yaxis.set(major_locator=FixedLocator([0.1, 0.2, 0.5, 1, 2, 5]), major_formatter="{x:g}")
    axes.yaxis.set_minor_formatter("")
    axes.legend()


def _draw_costs(axes: Axes, rows: Sequence[Row]) -> None:
    bounds = [side.learning_bound for row in rows for side in (row.hg, row.flat)]
    ends = [min(bounds) / 2, max(bounds) * 1.5]
    axes.plot(ends, ends, color=_GREY, linestyle="--", label="cost = bound")
    for name, side, color, marker in (("hg-DAgger", "hg", _BLUE, "o"), ("flat DAgger", "flat", _GREEN, "^")):
        for episodes in EPISODES:
            sides = [getattr(row, side) for row in rows if row.episodes == episodes]
            axes.plot(
                [one.learning_bound for one in sides],
                [one.worst * one.learning_bound for one in sides],
                marker,
                color=color,
                fillstyle=_FILLED[episodes],
                label=f"{name}, {episodes} episodes",
            )
    axes.set(
        xscale="log",
        yscale="log",
        xlabel="bound on the learning cost (Theorems 1 and 2), units",
        ylabel="learning cost of the worst seed, units",
        title=f"No cost is more than {max(worst(rows).values()):.1%} of its bound",
    )
    axes.legend()
