"""Curves and costs of a run, computed from the reported episodes and the ledger alone."""

from bisect import bisect_right
from collections import deque
from collections.abc import Iterable, Sequence
from itertools import accumulate
from typing import Any, NamedTuple, get_args

from pydantic_core import from_json
from sqlalchemy import func, select

from waypost import wire
from waypost.prices import to_units
from waypost_server.db.tables import episodes, ledger_sums
from waypost_server.db.transaction import Tx
from waypost_server.runs import service as runs

Result = dict[str, Any]
"""An EpisodeResult as it was stored after it had been checked; checking all again would take most of the time."""

LEVELS: tuple[wire.SuccessLevel, ...] = get_args(wire.SuccessLevel)


class Spent(NamedTuple):
    """The ledger's sum for one kind of query in one episode; amounts are micro-units."""

    episode: int
    kind: wire.Kind
    units: int
    lo_units: int
    seconds: float
    active_seconds: float


def trailing(outcomes: Sequence[bool | None], window: int = runs.TRAILING) -> list[float | None]:
    """Return the success rate over the last `window` test episodes at each episode. Untested episodes do not count."""
    recent: deque[bool] = deque()
    passed = 0
    rates: list[float | None] = []
    for outcome in outcomes:
        if outcome is not None:
            recent.append(outcome)
            passed += outcome - (recent.popleft() if len(recent) > window else False)
        rates.append(passed / len(recent) if recent else None)
    return rates


def _rewards(results: Sequence[Result], rows: Sequence[int]) -> list[float | None]:
    """Return the mean reward of the trailing training rollouts at these rows. Demonstrations do not count."""
    rewards = [result.get("reward", 0) for result in results if not result["warm_start"]]
    trained = list(accumulate(not result["warm_start"] for result in results))
    means: list[float | None] = []
    for row in rows:
        recent = rewards[max(trained[row] - runs.TRAILING, 0) : trained[row]]
        means.append(sum(recent) / len(recent) if recent else None)
    return means


def _reached(results: Sequence[Result], rows: range) -> dict[str, list[float]]:
    """Return how many of the trailing attempts at each subgoal reached it, at these rows."""
    attempts = [result.get("attempts", []) for result in results]
    subgoals = sorted({attempt["subgoal"] for episode in attempts for attempt in episode})
    recent = {name: deque([False] * runs.TRAILING, runs.TRAILING) for name in subgoals}
    rates: dict[str, list[float]] = {name: [] for name in subgoals}
    for row, episode in enumerate(attempts):
        for attempt in episode:
            recent[attempt["subgoal"]].append(attempt["reached"])
        if row in rows:
            for name, outcomes in recent.items():
                rates[name].append(sum(outcomes) / runs.TRAILING)
    return rates


def _ledger(tx: Tx, run: str) -> list[Spent]:
    sums = ledger_sums.c
    rows = tx.conn.execute(
        select(sums.episode, sums.kind, sums.units, sums.lo_units, sums.seconds, sums.active_seconds)
        .where(sums.run_id == run)
        .order_by(sums.episode, sums.kind)
    )
    return list(map(Spent._make, rows.all()))


def tests_of(tx: Tx, run: str) -> tuple[list[int], list[bool | None]]:
    """Return the reported episodes and the results of their tests."""
    rows = tx.conn.execute(
        select(episodes.c.episode, episodes.c.test_success).where(episodes.c.run_id == run).order_by(episodes.c.episode)
    ).all()
    return [episode for episode, _ in rows], [outcome for _, outcome in rows]


def _results(tx: Tx, run: str) -> list[Result]:
    """Return the complete results of the reported episodes."""
    rows = tx.conn.execute(select(episodes.c.result).where(episodes.c.run_id == run).order_by(episodes.c.episode))
    return list(from_json(f"[{','.join(rows.scalars())}]"))


def counting(paid: Sequence[int], reported: Sequence[int]) -> list[int]:
    """Return how many of the amounts that were paid in these episodes, in order, count at each reported episode."""
    return [bisect_right(paid, episode) for episode in reported]


def cumulative(counts: Sequence[int], amounts: Iterable[float]) -> list[float]:
    """Return the sums of the first so many amounts."""
    sums = [0.0, *accumulate(amounts)]
    return [sums[count] for count in counts]


def curves(tx: Tx, run: str, after: int = -1, most: int | None = None) -> wire.Curves:
    """Return success and cumulative cost, one row per reported episode after `after`.

    Args:
        tx: the transaction.
        run: the run.
        after: an episode; the rows are those of later ones.
        most: with more rows than this, only the last one and every n-th before it, for the smallest n that fits.

    Raises:
        NotFound: there is no such run.
    """
    runs.find(tx, run)
    results = _results(tx, run)
    reported, tests = [result["episode"] for result in results], [result["test_success"] for result in results]
    rows = _rows(bisect_right(reported, after), len(reported), most)
    chosen = [reported[row] for row in rows]
    spent = _ledger(tx, run)
    counts = counting([entry.episode for entry in spent], chosen)
    rates = trailing(tests)
    lo_samples = list(accumulate(result["train_steps"] for result in results))
    learner_seconds = list(accumulate(result["seconds"] for result in results))
    return wire.Curves(
        episode=chosen,
        success_rate=[rates[row] for row in rows],
        test_success=[tests[row] for row in rows],
        cost=_units(cumulative(counts, (entry.units for entry in spent))),
        lo_cost=_units(cumulative(counts, (entry.lo_units for entry in spent))),
        seconds=cumulative(counts, (entry.seconds for entry in spent)),
        active_seconds=cumulative(counts, (entry.active_seconds for entry in spent)),
        cost_by_kind={
            kind: _units(cumulative(counts, (entry.units * (entry.kind == kind) for entry in spent)))
            for kind in wire.KINDS
        },
        hi_labels=[results[row]["hi_labels"] for row in rows],
        lo_samples=[lo_samples[row] for row in rows],
        learner_seconds=[learner_seconds[row] for row in rows],
        reward=_rewards(results, rows),
        reached=_reached(results, rows),
    )


def _rows(first: int, end: int, most: int | None) -> range:
    """Return the rows from `first` on, or the last one and every n-th before it, at most `most` of them."""
    step = 1 if most is None else max(1, -(-(end - first) // most))
    return range(end - 1, first - 1, -step)[::-1]


def _units(micro: Iterable[float]) -> list[float]:
    return [to_units(int(amount)) for amount in micro]


def costs(tx: Tx, run: str) -> wire.Costs:
    """Return the ledger's sums, also of a deleted run, and when the success rate first reached each level."""
    account = runs.find_account(tx, run)
    reported, tests = tests_of(tx, run)
    sums = _sums_by_kind(tx, run)
    total = _cost_of(sums.values())
    return wire.Costs(
        total=total.units,
        lo_total=total.lo_units,
        seconds=total.seconds,
        active_seconds=total.active_seconds,
        by_kind={kind: _cost_of([sums[kind]] if kind in sums else []) for kind in wire.KINDS},
        reserved=to_units(account.reserved),
        budget=None if account.budget is None else to_units(account.budget),
        tests=len(tests) - tests.count(None),
        first_at={
            level: None if row is None else wire.Milestone(episode=reported[row], cost=_until(tx, run, reported[row]))
            for level, row in zip(LEVELS, first_rows(map(float, LEVELS), tests), strict=True)
        },
    )


def _sums_by_kind(tx: Tx, run: str) -> dict[wire.Kind, Sequence[Any]]:
    """Return the sums of all episodes: queries, units and LO units in micro-units, seconds, active seconds."""
    sums = ledger_sums.c
    added = map(func.sum, (sums.queries, sums.units, sums.lo_units, sums.seconds, sums.active_seconds))
    rows = tx.conn.execute(select(sums.kind, *added).where(sums.run_id == run).group_by(sums.kind))
    return {kind: amounts for kind, *amounts in rows}


def _cost_of(sums: Iterable[Sequence[Any]]) -> wire.CostOfKind:
    queries, units, lo_units, seconds, active_seconds = map(sum, zip((0, 0, 0, 0.0, 0.0), *sums, strict=True))
    return wire.CostOfKind(
        queries=int(queries),
        units=to_units(int(units)),
        lo_units=to_units(int(lo_units)),
        seconds=max(seconds, 0.0),
        active_seconds=max(active_seconds, 0.0),
    )


def _until(tx: Tx, run: str, episode: int) -> float:
    """Return the cost up to and including an episode, in units."""
    sums = ledger_sums.c
    found = tx.conn.execute(select(func.sum(sums.units)).where(sums.run_id == run, sums.episode <= episode))
    return to_units(int(found.scalar_one() or 0))


def first_rows(levels: Iterable[float], tests: Sequence[bool | None]) -> list[int | None]:
    """Return for each level the first row where the rate over a full window of tests reached it."""
    tested = accumulate(int(outcome is not None) for outcome in tests)
    full = [
        (row, rate)
        for row, (n_tests, rate) in enumerate(zip(tested, trailing(tests), strict=True))
        if n_tests >= runs.TRAILING and rate is not None
    ]
    return [next((row for row, rate in full if rate >= level), None) for level in levels]


def first_at(
    level: float, reported: Sequence[int], tests: Sequence[bool | None], cost: Sequence[float]
) -> wire.Milestone | None:
    """Return the first episode where the rate over a full window of tests reached a level."""
    (row,) = first_rows([level], tests)
    return None if row is None else wire.Milestone(episode=reported[row], cost=cost[row])
