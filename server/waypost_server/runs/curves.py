"""Curves and costs of a run, computed from the reported episodes and the ledger alone."""

from bisect import bisect_left, bisect_right
from collections import deque
from collections.abc import Iterable, Sequence
from itertools import accumulate, compress
from operator import attrgetter
from typing import Any, get_args

import msgspec
from sqlalchemy import bindparam, func, select

from waypost import wire
from waypost.prices import to_units
from waypost_server.db.prepared import Columns, Prepared
from waypost_server.db.tables import episodes, ledger_sums
from waypost_server.db.transaction import Tx
from waypost_server.runs import service as runs

_OF_RUN = episodes.c.run_id == bindparam("run")
_RESULTS = select(func.aggregate_strings(episodes.c.result, ",")).where(_OF_RUN)
_TESTS = Prepared(select(episodes.c.episode, episodes.c.test_success).where(_OF_RUN).order_by(episodes.c.episode))
_SUMS = ledger_sums.c
_SPENT = Prepared(
    select(_SUMS.episode, _SUMS.kind, _SUMS.units, _SUMS.lo_units, _SUMS.seconds, _SUMS.active_seconds)
    .where(_SUMS.run_id == bindparam("run"))
    .order_by(_SUMS.episode, _SUMS.kind)
)
"""The ledger's sums for each kind of query in each episode; amounts are micro-units."""

LEVELS: tuple[wire.SuccessLevel, ...] = get_args(wire.SuccessLevel)


class Attempt(msgspec.Struct, gc=False):
    """One attempt of a learner at a subgoal."""

    subgoal: str
    reached: bool


class Result(msgspec.Struct, gc=False):
    """What the curves need of an EpisodeResult. It was checked before it was stored; a run has thousands."""

    episode: int
    warm_start: bool
    test_success: bool | None
    train_steps: int
    hi_labels: int
    seconds: float
    reward: float = 0.0
    attempts: list[Attempt] = []


_PARSER = msgspec.json.Decoder(list[Result])


def trailing(
    outcomes: Sequence[bool | None], window: int = runs.TRAILING, rows: Iterable[int] | None = None
) -> list[float | None]:
    """Return the success rate over the last `window` test episodes, at each episode or at these rows of them.

    Untested episodes do not count.
    """
    passed = list(accumulate((outcome for outcome in outcomes if outcome is not None), initial=0))
    tested = list(accumulate(outcome is not None for outcome in outcomes))
    counts = tested if rows is None else [tested[row] for row in rows]
    return [(passed[n] - passed[max(n - window, 0)]) / min(n, window) if n else None for n in counts]


def _rewards(results: Sequence[Result], rows: range) -> list[float | None]:
    """Return the mean reward of the trailing training rollouts at these rows. Demonstrations do not count."""
    rewards = [result.reward for result in results if not result.warm_start]
    trained = list(accumulate(not result.warm_start for result in results))
    means: list[float | None] = []
    for row in rows:
        recent = rewards[max(trained[row] - runs.TRAILING, 0) : trained[row]]
        means.append(sum(recent) / len(recent) if recent else None)
    return means


def _reached(results: Sequence[Result], rows: range) -> dict[str, list[float]]:
    """Return how many of the trailing attempts at each subgoal reached it, at these rows."""
    subgoals = sorted({attempt.subgoal for result in results for attempt in result.attempts})
    if not subgoals:
        return {}
    recent = {name: deque([False] * runs.TRAILING, runs.TRAILING) for name in subgoals}
    rates: dict[str, list[float]] = {name: [] for name in subgoals}
    for row, result in enumerate(results):
        for attempt in result.attempts:
            recent[attempt.subgoal].append(attempt.reached)
        if row in rows:
            for name, outcomes in recent.items():
                rates[name].append(sum(outcomes) / runs.TRAILING)
    return rates


def tests_of(tx: Tx, run: str) -> tuple[Sequence[int], Sequence[bool | None]]:
    """Return the reported episodes and the results of their tests."""
    tests = _TESTS.columns(tx.conn, {"run": run})
    return tests.episode, tests.test_success


def _results(tx: Tx, run: str) -> list[Result]:
    """Return what the curves need of the reported episodes."""
    # The database joins ten thousand texts in less time than a driver takes to hand them over one by one.
    joined = tx.conn.execute(_RESULTS, {"run": run}).scalar_one() or ""
    return sorted(_PARSER.decode(f"[{joined}]"), key=attrgetter("episode"))


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
    reported, tests = [result.episode for result in results], [result.test_success for result in results]
    rows = _rows(bisect_right(reported, after), len(reported), most)
    chosen = [reported[row] for row in rows]
    spent = _SPENT.columns(tx.conn, {"run": run})
    counts = counting(spent.episode, chosen)
    lo_samples = list(accumulate(result.train_steps for result in results))
    learner_seconds = list(accumulate(result.seconds for result in results))
    return wire.Curves(
        episode=chosen,
        success_rate=trailing(tests, rows=rows),
        test_success=[tests[row] for row in rows],
        cost=_units(cumulative(counts, spent.units)),
        lo_cost=_units(cumulative(counts, spent.lo_units)),
        seconds=cumulative(counts, spent.seconds),
        active_seconds=cumulative(counts, spent.active_seconds),
        cost_by_kind=_by_kind(spent, chosen),
        hi_labels=[results[row].hi_labels for row in rows],
        lo_samples=[lo_samples[row] for row in rows],
        learner_seconds=[learner_seconds[row] for row in rows],
        reward=_rewards(results, rows),
        reached=_reached(results, rows),
    )


def _by_kind(spent: Columns, chosen: Sequence[int]) -> dict[wire.Kind, list[float]]:
    """Return for each kind of query its cumulative cost at the chosen episodes."""
    costs = {kind: [0.0] * len(chosen) for kind in wire.KINDS}
    for kind in set(spent.kind):
        paid = [one == kind for one in spent.kind]
        counts = counting(list(compress(spent.episode, paid)), chosen)
        costs[kind] = _units(cumulative(counts, compress(spent.units, paid)))
    return costs


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
    tested = [row for row, outcome in enumerate(tests) if outcome is not None][runs.TRAILING - 1 :]
    rates = (rate or 0.0 for rate in trailing(tests, rows=tested))  # none is None, as all have a test
    best = list(accumulate(rates, max))  # so far, so it never falls
    places = [bisect_left(best, level) for level in levels]
    return [tested[place] if place < len(tested) else None for place in places]


def first_at(
    level: float, reported: Sequence[int], tests: Sequence[bool | None], cost: Sequence[float]
) -> wire.Milestone | None:
    """Return the first episode where the rate over a full window of tests reached a level."""
    (row,) = first_rows([level], tests)
    return None if row is None else wire.Milestone(episode=reported[row], cost=cost[row])
