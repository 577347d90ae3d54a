"""Curves and costs of a run, computed from the reported episodes and the ledger alone."""

from bisect import bisect_right
from collections import defaultdict, deque
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from itertools import accumulate
from typing import get_args

from sqlalchemy import select

from waypost import wire
from waypost.prices import to_units
from waypost_server.db.tables import episodes, ledger_sums
from waypost_server.db.transaction import Tx
from waypost_server.runs import service as runs

LEVELS: tuple[wire.SuccessLevel, ...] = get_args(wire.SuccessLevel)


@dataclass(frozen=True)
class Spent:
    """The ledger's sum for one kind of query in one episode; amounts are micro-units."""

    episode: int
    kind: wire.Kind
    queries: int
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


def _rewards(results: Sequence[wire.EpisodeResult]) -> list[float | None]:
    """Return the mean reward of the trailing training rollouts at each episode. Demonstrations do not count."""
    recent: deque[float] = deque(maxlen=runs.TRAILING)
    means: list[float | None] = []
    for result in results:
        if not result.warm_start:
            recent.append(result.reward)
        means.append(sum(recent) / len(recent) if recent else None)
    return means


def _reached(results: Sequence[wire.EpisodeResult]) -> dict[str, list[float]]:
    """Return how many of the trailing attempts at each subgoal reached it, at each episode."""
    subgoals = sorted({attempt.subgoal for result in results for attempt in result.attempts})
    recent = {name: deque([False] * runs.TRAILING, runs.TRAILING) for name in subgoals}
    rates: dict[str, list[float]] = {name: [] for name in subgoals}
    for result in results:
        for attempt in result.attempts:
            recent[attempt.subgoal].append(attempt.reached)
        for name, outcomes in recent.items():
            rates[name].append(sum(outcomes) / runs.TRAILING)
    return rates


def _ledger(tx: Tx, run: str) -> list[Spent]:
    sums = ledger_sums.c
    rows = tx.conn.execute(
        select(sums.episode, sums.kind, sums.queries, sums.units, sums.lo_units, sums.seconds, sums.active_seconds)
        .where(sums.run_id == run)
        .order_by(sums.episode, sums.kind)
    )
    return [Spent(*row) for row in rows]


def tests_of(tx: Tx, run: str) -> tuple[list[int], list[bool | None]]:
    """Return the reported episodes and the results of their tests."""
    rows = tx.conn.execute(
        select(episodes.c.episode, episodes.c.test_success).where(episodes.c.run_id == run).order_by(episodes.c.episode)
    ).all()
    return [row.episode for row in rows], [row.test_success for row in rows]


def _results(tx: Tx, run: str) -> list[wire.EpisodeResult]:
    """Return the complete results of the reported episodes."""
    rows = tx.conn.execute(select(episodes.c.result).where(episodes.c.run_id == run).order_by(episodes.c.episode))
    return [wire.EpisodeResult.model_validate_json(row.result) for row in rows]


def cumulative(reported: Sequence[int], amounts: Iterable[tuple[int, float]]) -> list[float]:
    """Return the running sum of (episode, amount) pairs at each reported episode. The pairs are in episode order."""
    sums: list[float] = []
    pending = iter([*amounts, (2**63, 0)])
    episode, amount = next(pending)
    total: float = 0
    for row in reported:
        while episode <= row:
            total += amount
            episode, amount = next(pending)
        sums.append(total)
    return sums


def curves(tx: Tx, run: str, after: int = -1) -> wire.Curves:
    """Return success and cumulative cost, one row per reported episode after `after`."""
    runs.find(tx, run)
    results = _results(tx, run)
    reported, tests = [result.episode for result in results], [result.test_success for result in results]
    spent = _ledger(tx, run)
    by_kind: dict[wire.Kind, list[tuple[int, float]]] = defaultdict(list)
    for entry in spent:
        by_kind[entry.kind].append((entry.episode, entry.units))
    first = bisect_right(reported, after)
    return wire.Curves(
        episode=reported[first:],
        success_rate=trailing(tests)[first:],
        test_success=tests[first:],
        cost=_units(cumulative(reported, ((entry.episode, entry.units) for entry in spent)))[first:],
        lo_cost=_units(cumulative(reported, ((entry.episode, entry.lo_units) for entry in spent)))[first:],
        seconds=cumulative(reported, ((entry.episode, entry.seconds) for entry in spent))[first:],
        active_seconds=cumulative(reported, ((entry.episode, entry.active_seconds) for entry in spent))[first:],
        cost_by_kind={kind: _units(cumulative(reported, by_kind[kind]))[first:] for kind in wire.KINDS},
        hi_labels=[result.hi_labels for result in results[first:]],
        lo_samples=list(accumulate(result.train_steps for result in results))[first:],
        learner_seconds=list(accumulate(result.seconds for result in results))[first:],
        reward=_rewards(results)[first:],
        reached={name: rates[first:] for name, rates in _reached(results).items()},
    )


def _units(micro: Iterable[float]) -> list[float]:
    return [to_units(int(amount)) for amount in micro]


def costs(tx: Tx, run: str) -> wire.Costs:
    """Return the ledger's sums, also of a deleted run, and when the success rate first reached each level."""
    row = runs.find_account(tx, run)
    reported, tests = tests_of(tx, run)
    spent = _ledger(tx, run)
    by_kind = {kind: _sum([entry for entry in spent if entry.kind == kind]) for kind in wire.KINDS}
    total = _sum(spent)
    cost = _units(cumulative(reported, ((entry.episode, entry.units) for entry in spent)))
    return wire.Costs(
        total=total.units,
        lo_total=total.lo_units,
        seconds=total.seconds,
        active_seconds=total.active_seconds,
        by_kind=by_kind,
        reserved=to_units(row.reserved),
        budget=None if row.budget is None else to_units(row.budget),
        first_at={level: first_at(float(level), reported, tests, cost) for level in LEVELS},
    )


def _sum(spent: Sequence[Spent]) -> wire.CostOfKind:
    return wire.CostOfKind(
        queries=sum(entry.queries for entry in spent),
        units=to_units(sum(entry.units for entry in spent)),
        lo_units=to_units(sum(entry.lo_units for entry in spent)),
        seconds=max(sum(entry.seconds for entry in spent), 0.0),
        active_seconds=max(sum(entry.active_seconds for entry in spent), 0.0),
    )


def first_at(
    level: float, reported: Sequence[int], tests: Sequence[bool | None], cost: Sequence[float]
) -> wire.Milestone | None:
    """Return the first episode where the rate over a full window of tests reached a level."""
    tested = accumulate(int(outcome is not None) for outcome in tests)
    for episode, units, n_tests, rate in zip(reported, cost, tested, trailing(tests), strict=True):
        if n_tests >= runs.TRAILING and rate is not None and rate >= level:
            return wire.Milestone(episode=episode, cost=units)
    return None
