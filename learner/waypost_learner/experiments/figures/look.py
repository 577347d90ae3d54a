"""Defines the look of the figures: colors, lines, markers, titles, legends and axes."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from matplotlib import rc_context
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.layout_engine import ConstrainedLayoutEngine
from matplotlib.lines import Line2D
from matplotlib.ticker import FuncFormatter, StrMethodFormatter

from waypost.wire import Kind
from waypost_learner.experiments.figures.data import Comparison
from waypost_learner.experiments.figures.statistics import Track, band
from waypost_learner.experiments.plan.series import Series

RC: dict[Any, Any] = {
    "font.family": "DejaVu Sans",  # part of matplotlib, so figures are identical on every machine
    "font.size": 10,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "grid.color": "0.9",
    "axes.axisbelow": True,
    "legend.frameon": False,
    "svg.hashsalt": "waypost",  # element ids are not random, so the same figure gives the same file
}
SIZE, DPI = (8.0, 5.2), 120  # inches, dots per inch


@dataclass(frozen=True)
class Style:
    """The look of one curve. Line and marker also identify it for readers who cannot see the color."""

    color: str
    line: Any  # matplotlib's dashes
    marker: str


# The palette of Okabe and Ito: its colors differ for every kind of color vision.
_BLACK, _ORANGE, _SKY, _GREEN = "#000000", "#E69F00", "#56B4E9", "#009E73"
_BLUE, _VERMILLION, _PURPLE = "#0072B2", "#D55E00", "#CC79A7"
_DASHED, _DOTTED, _DASH_DOT, _LONG = (0, (5, 2)), (0, (1, 1.2)), (0, (6, 2, 1, 2)), (0, (9, 2, 1, 2, 1, 2))

_ALGORITHMS = {
    "hg-dagger": Style(_BLUE, "solid", "o"),
    "hg-stagger": Style(_VERMILLION, _DASHED, "s"),
    "hg-takeover": Style(_GREEN, _DASH_DOT, "^"),
    "h-bc": Style(_VERMILLION, _DASHED, "s"),
    "flat-dagger": Style(_GREEN, _DASH_DOT, "^"),
    "flat-bc": Style(_PURPLE, _DOTTED, "D"),
    "naive-h-dagger": Style(_ORANGE, _DASHED, "v"),
    "hg-dagger-q": Style(_BLUE, "solid", "o"),
    "h-dqn": Style(_VERMILLION, _DASHED, "s"),
    "flat-dqn": Style(_PURPLE, _DOTTED, "D"),
}
_WITH_HEAD_START = Style(_GREEN, _DASH_DOT, "^")
_WITH_OTHER_VALUES = {"hg-dagger": Style(_SKY, _LONG, "P"), "hg-stagger": Style(_ORANGE, _DASH_DOT, "v")}
OF_SUBGOALS = (_ORANGE, _BLUE, _GREEN, _PURPLE)
"""The colors of the subgoals of Montezuma's Revenge, in their order."""
AUTHORS = Style(_BLACK, _DASHED, "s")
"""The authors' runs."""
_BESIDE = Style(_BLACK, _DASHED, "o")

KINDS: dict[Kind, tuple[str, Style]] = {
    "hier_demo": ("HierDemo", Style(_PURPLE, _DOTTED, "D")),
    "label_hi": ("Label HI", Style(_BLUE, "solid", "o")),
    "label_lo": ("Label LO", Style(_VERMILLION, _DASHED, "s")),
    "label_full": ("Label FULL", Style(_VERMILLION, _DASHED, "s")),
    "inspect_full": ("Inspect FULL", Style(_GREEN, _DASH_DOT, "^")),
    "inspect_lo": ("Inspect LO", Style(_ORANGE, _LONG, "v")),
}
SUM = Style(_BLACK, "solid", "o")


def style_of(series: Series) -> Style:
    """Return the style of a series, which is the same in all figures."""
    if series.beside:
        return _BESIDE
    algorithm = series.config.algorithm
    if series.config.values is not None and algorithm in _WITH_OTHER_VALUES:
        return _WITH_OTHER_VALUES[algorithm]
    return _WITH_HEAD_START if series.config.head_start is not None else _ALGORITHMS[algorithm]


def frame(comparison: Comparison, title: str, panels: int = 1) -> tuple[Figure, list[Axes]]:
    """Return a figure with `panels` axes, one above the other.

    Its head has the title, the group's title, the number of runs, and how episodes and costs are counted.
    """
    group = comparison.group
    with rc_context(RC):
        figure = Figure(SIZE, layout=ConstrainedLayoutEngine(rect=(0.01, 0.01, 0.98, 0.83)))
        figure.text(0.02, 0.965, title, fontsize=13, fontweight="bold", va="top")
        subtitle = f"{group.title[:1].upper()}{group.title[1:]}. {_runs(comparison)}\n{group.counting}"
        figure.text(0.02, 0.905, subtitle, fontsize=9, va="top", linespacing=1.4)
        axes = figure.subplots(panels, sharex=True, squeeze=False)[:, 0]
    return figure, list(axes)


def _runs(comparison: Comparison) -> str:
    numbers = sorted({len(runs) for runs in comparison.runs.values()})
    said = " to ".join(str(number) for number in {numbers[0], numbers[-1]})
    text = "One run each" if numbers == [1] else f"Median and range of {said} runs"
    unfinished = any(not run.complete for runs in comparison.runs.values() for run in runs)
    return f"{text}{', some unfinished' if unfinished else ''}."


def curve(axes: Axes, tracks: Sequence[Track], style: Style, quartiles: bool = False) -> None:
    """Draw the median of the runs as a line, and their range as a band; with `quartiles`, a darker band within it."""
    found = band(tracks)
    if found is None:
        return
    if len(tracks) > 1:
        axes.fill_between(found.x, found.low, found.high, color=style.color, alpha=0.15, linewidth=0)
        if quartiles:
            within = found.lower_quartile, found.upper_quartile
            axes.fill_between(found.x, *within, color=style.color, alpha=0.25, linewidth=0)
    axes.plot(found.x, found.median, color=style.color, linestyle=style.line, linewidth=1.8)


def point(axes: Axes, x: float, y: float, style: Style, gid: str) -> None:
    """Draw a published number as a marker; `gid` becomes part of its id in the SVG."""
    (marker,) = axes.plot(
        x, y, style.marker, color=style.color, markersize=8, markeredgecolor="white", markeredgewidth=1.2, zorder=5
    )
    marker.set_gid(f"published {gid}")


def level(axes: Axes, y: float, style: Style, gid: str) -> None:
    """Draw the final success rate of a published curve as a thin horizontal line."""
    line = axes.axhline(y, color=style.color, linewidth=1.0, linestyle=(0, (2, 4)))
    line.set_gid(f"published {gid}")


def legend(figure: Figure, entries: Sequence[tuple[str, Style]], explanation: str, markers: bool) -> None:
    """Draw a legend below the axes, with an explanation as its title."""
    handles = [
        Line2D(
            [], [], color=s.color, linestyle=s.line, linewidth=1.8, marker=s.marker if markers else None, label=label
        )
        for label, s in entries
    ]
    with rc_context(RC):
        figure.legend(
            handles=handles,
            loc="outside lower left",
            ncols=len(handles) if len(handles) <= 4 else 3,
            handlelength=3.6,
            title=explanation,
            alignment="left",
            title_fontsize=9,
        )


def percent_axis(axes: Axes, label: str) -> None:
    """Format the y axis for a success rate in percent, with a label."""
    axes.set_ylim(-2, 102)
    axes.yaxis.set_major_formatter(StrMethodFormatter("{x:.0f}%"))
    axes.set_ylabel(label)


def count_axis(axis: Any, label: str) -> None:
    """Format the ticks of an axis as whole numbers, and set its label."""
    axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:,.0f}"))
    axis.set_label_text(label)


def log_axis(axis: Any, label: str) -> None:
    """Make the x axis logarithmic from 100 on, and set its label."""
    axis.axes.set_xscale("log")
    axis.axes.set_xlim(left=100)
    count_axis(axis, label)

    def between(value: float, _: int | None) -> str:
        low, high = axis.get_view_interval()
        return f"{value:,.0f}" if high < 10 * low else ""  # only a short axis has room for minor labels

    axis.set_minor_formatter(FuncFormatter(between))
