"""Reads what a forecast needs from the store: the run's own tests, and finished runs of its domain and algorithm."""

import json
import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from sqlalchemy import func, select

from waypost import wire
from waypost.prices import MICRO, to_units
from waypost_server.db.functions import json_text
from waypost_server.db.prepared import Record
from waypost_server.db.tables import answers, assignments, ledger, ledger_sums, runs
from waypost_server.db.transaction import Tx
from waypost_server.runs import service
from waypost_server.runs.curves import counting, cumulative, first_at, tests_of
from waypost_server.runs.futures import Finished, Outcomes, Span, futures_of

# They bound the work: the finished runs looked at, newest first, and how many of their episodes are read.
_MOST_RUNS = 100
_MOST_EPISODES = 30_000
_LAST_ANSWERS = 500  # whose pace is the annotators' pace
_FASTEST = 0.2  # seconds per unit; nobody labels faster, so faster answers were given by a program


def forecast(tx: Tx, run: str, target: wire.SuccessLevel) -> wire.Forecast:
    """Return when a run will reach a success rate. A finished run is forecast as if it went on.

    Raises:
        NotFound: there is no such run.
    """
    row = service.find(tx, run)
    own = _read(tx, run)
    reached = first_at(float(target), own.episodes, own.outcomes, own.cost)
    if reached is not None:
        return _message(target, reached=reached)
    finished = list(_finished(tx, row))
    spent = to_units(row.spent)
    found = futures_of(own.tests, spent, finished)
    siblings = sum(one.differences == 0 for one in finished)
    counts = {"same_configuration": siblings, "other_configurations": len(finished) - siblings}
    too_early = found.too_early(target)
    if too_early is not None:
        return _message(target, too_early=too_early, **counts)
    span = found.span(target)
    pace = _seconds_per_unit(tx, run)
    return _message(
        target,
        more_units=_range(span, spent, 1.0),
        more_seconds=None if pace is None else _range(span, spent, pace),
        missed=found.missed(target),
        **counts,
    )


def _message(target: wire.SuccessLevel, **known: object) -> wire.Forecast:
    nothing = dict.fromkeys(("reached", "too_early", "more_units", "more_seconds", "missed"))
    counts = {"same_configuration": 0, "other_configurations": 0}
    return wire.Forecast.model_validate({"target": target, **nothing, **counts, **known})


def _range(span: Span, spent: float, factor: float) -> wire.ForecastRange:
    low, middle, high = (
        None if units == math.inf else (units - spent) * factor for units in (span.low, span.median, span.high)
    )
    return wire.ForecastRange(low=low, median=middle, high=high)


@dataclass(frozen=True)
class _Told:
    """What a run reported: its episodes, the outcomes of their tests, and the cumulative cost in units."""

    episodes: Sequence[int]
    outcomes: Sequence[bool | None]
    cost: Sequence[float]

    @property
    def tests(self) -> Outcomes:
        made = [
            (units, outcome) for units, outcome in zip(self.cost, self.outcomes, strict=True) if outcome is not None
        ]
        return Outcomes([units for units, _ in made], [outcome for _, outcome in made])


def _read(tx: Tx, run: str) -> _Told:
    reported, outcomes = tests_of(tx, run)
    amounts = tx.conn.execute(
        select(ledger_sums.c.episode, func.sum(ledger_sums.c.units))
        .where(ledger_sums.c.run_id == run)
        .group_by(ledger_sums.c.episode)
        .order_by(ledger_sums.c.episode)
    )
    paid = [(episode, int(units)) for episode, units in amounts]
    costs = cumulative(counting([episode for episode, _ in paid], reported), (units for _, units in paid))
    return _Told(reported, outcomes, [to_units(int(units)) for units in costs])


def _finished(tx: Tx, row: Record) -> Iterator[Finished]:
    """Yield the finished runs to compare with, the most alike first, then the newest."""
    named = json.loads(row.vocabulary)["domain"]
    found = tx.conn.execute(
        select(runs.c.id, runs.c.spent, runs.c.config, runs.c.prices)
        .where(
            runs.c.state == "finished",
            runs.c.gold_of.is_(None),
            runs.c.deleted_at.is_(None),
            runs.c.spent > 0,
            runs.c.algorithm == row.algorithm,
            json_text(runs.c.vocabulary, "domain") == named,
            runs.c.id != row.id,
        )
        .order_by(runs.c.number.desc())
        .limit(_MOST_RUNS)
    ).all()
    own = _settings(row)
    by_likeness = sorted((_differences(own, _settings(other)), place, other) for place, other in enumerate(found))
    read = 0
    for differences, _, other in by_likeness:
        told = _read(tx, other.id)
        if len(told.tests.units) >= service.TRAILING:
            yield Finished.of(told.tests, to_units(other.spent), differences)
        read += len(told.episodes)
        if read > _MOST_EPISODES:
            return


def _settings(row: Record) -> dict[str, object]:
    """Return what runs that differ only by their seed have in common."""
    return {**json.loads(row.config), "seed": None, "the run's prices": row.prices}


def _differences(one: Mapping[str, object], other: Mapping[str, object]) -> int:
    return sum(one.get(name) != other.get(name) for name in one.keys() | other.keys())


def _seconds_per_unit(tx: Tx, run: str) -> float | None:
    """Return the working time per unit of the last answers by people, or None if there were none."""
    last = (
        select(ledger.c.units, ledger.c.active_seconds)
        .join(answers, answers.c.id == ledger.c.answer_id)
        .join(assignments, assignments.c.id == answers.c.assignment_id)
        .where(
            ledger.c.run_id == run,
            ledger.c.entry == "charge",
            assignments.c.deferring.is_(False),  # only bots leave queries to others
            ledger.c.active_seconds * MICRO >= ledger.c.units * _FASTEST,
        )
        .order_by(ledger.c.id.desc())
        .limit(_LAST_ANSWERS)
        .subquery()
    )
    units, seconds = tx.conn.execute(select(func.sum(last.c.units), func.sum(last.c.active_seconds))).one()
    return float(seconds) / to_units(int(units)) if units else None
