"""Formats the results of the theory as a text table."""

from collections.abc import Iterator, Sequence

from waypost_learner.experiments.theory.grid import EPISODES, Row, worst
from waypost_learner.experiments.theory.simulation import Episodes

_TITLES: dict[Episodes, str] = {
    "worst": "Worst episodes, chosen by an adversary who knows the learner:",
    "random": "Random episodes:",
}
_HEADS = (
    f"{'':26}{'hg-DAgger':>33}{'flat DAgger':>33}{'hg-DAgger / flat DAgger':>26}",
    f"H_HI H_LO  |M| |Pi_LO| |G|{2 * '   cost / bound  learn / bound  max'}   learn  bounds   paper",
)


def table(rows: Sequence[Row], seeds: int, rounds: int) -> Iterator[str]:
    """Yield the lines of the table."""
    yield f"Means over {seeds} seeds, in units, after T = {rounds} episodes. `cost` includes the T inspections of whole"
    yield "episodes; `learn` excludes them. `max` is the largest `learn` / bound of all seeds. The last three columns"
    yield "are the ratio of `learn`, the ratio of its bounds, and (H_HI + H_LO) / (H_HI H_LO)."
    for episodes in EPISODES:
        yield from ("", _TITLES[episodes], *_HEADS)
        yield from (_line(row) for row in rows if row.episodes == episodes)
    spent = worst(rows)
    yield ""
    yield f"The largest `learn` / bound of all seeds is {spent['hg']:.1%} (hg-DAgger) and {spent['flat']:.1%} (flat)."


def _line(row: Row) -> str:
    cell = row.cell
    sizes = f"{cell.h_hi:4}{cell.h_lo:5}{cell.n_mu:5}{cell.n_pi:8}{cell.n_subgoals:4}"
    sides = "".join(
        f"{side.cost:7.0f} /{side.bound:6.0f}{side.learning:7.0f} /{side.learning_bound:6.0f}{side.worst:5.0%}"
        for side in (row.hg, row.flat)
    )
    ratio = "none" if row.ratio is None else f"{row.ratio:.2f}"
    return f"{sizes}{sides}{ratio:>8}{row.ratio_of_bounds:8.2f}{row.proportion:8.3f}"
