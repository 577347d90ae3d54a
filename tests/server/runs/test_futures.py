"""Forecasts, out of tests and finished runs alone."""

import math
from itertools import pairwise

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from waypost_server.runs.curves import LEVELS
from waypost_server.runs.futures import Finished, Outcomes, futures_of


def learning(reaches: float, n_tests: int = 300, top: float = 1.0, spent: float = 600) -> Outcomes:
    """The tests of a run that has spent `spent` units in the end, and succeeds from some number of units on.

    From there on it fails as often as `top` says, evenly spread.
    """
    units = [spent * (n + 1) / n_tests for n in range(n_tests)]
    passed = [at >= reaches and int(n * top) > int((n - 1) * top) for n, at in enumerate(units)]
    return Outcomes(units, passed)


def until(tests: Outcomes, units: float) -> Outcomes:
    """The tests that were made for these units."""
    made = sum(at <= units for at in tests.units)
    return Outcomes(tests.units[:made], tests.passed[:made])


def finished(tests: Outcomes, differences: int = 0) -> Finished:
    return Finished.of(tests, tests.units[-1], differences)


SIBLINGS = [finished(learning(reaches)) for reaches in (90, 100, 110, 120)]

outcomes = st.lists(st.booleans(), min_size=1, max_size=250)
costs = st.floats(0.5, 60)


@st.composite
def some_tests(draw: st.DrawFn) -> Outcomes:
    passed = draw(st.one_of(outcomes, st.integers(1, 250).map(lambda n: [k > n // 2 for k in range(n)])))
    each = draw(costs)
    return Outcomes([each * (n + 1) for n in range(len(passed))], passed)


@settings(max_examples=30, deadline=None)
@given(some_tests(), st.lists(st.tuples(some_tests(), st.integers(0, 3)), max_size=4))
def test_every_forecast_is_in_the_future_and_in_order_and_never_earlier_for_a_higher_target(
    tests: Outcomes, others: list[tuple[Outcomes, int]]
) -> None:
    reached, spent = tests.reached(), tests.units[-1]
    open_levels = [level for level in LEVELS if reached[level] == math.inf]
    if not open_levels:
        return
    futures = futures_of(tests, spent, [finished(*other) for other in others])
    if not futures.all:
        assert all(futures.too_early(level) for level in open_levels)
        return
    assert sum(future.weight for future in futures.all) == pytest.approx(1)
    spans = [futures.span(level) for level in open_levels]
    for span, level in zip(spans, open_levels, strict=True):
        assert spent < span.low <= span.median <= span.high
        assert (span.high == math.inf) >= (futures.missed(level) > 0.1 + 1e-9)
    for lower, higher in pairwise(spans):
        assert (lower.low, lower.median, lower.high) <= (higher.low, higher.median, higher.high)
        assert lower.low <= higher.low
        assert lower.median <= higher.median
        assert lower.high <= higher.high


def test_a_run_like_its_siblings_is_forecast_where_they_got_there() -> None:
    run = learning(105)
    futures = futures_of(until(run, 60), 60, SIBLINGS)
    span, truth = futures.span("0.9"), run.reached()["0.9"]
    assert span.low < truth < span.high
    assert span.median == pytest.approx(truth, rel=0.15)
    assert futures.missed("0.9") == 0


def test_a_run_that_learns_later_than_its_siblings_is_forecast_later_the_longer_it_fails() -> None:
    run = learning(1e9)
    medians = [futures_of(until(run, units), units, SIBLINGS).span("0.9").median for units in (50, 150, 250)]
    assert medians[0] < medians[1] < medians[2]


def test_the_run_s_own_tests_tell_it_from_runs_that_learned_at_another_pace() -> None:
    fast, slow = finished(learning(40), 1), finished(learning(400), 1)
    run = learning(380)
    assert futures_of(until(run, 200), 200, [fast, slow]).span("0.9").median > 400
    run = learning(45)
    assert futures_of(until(run, 100), 100, [fast, slow]).span("0.9").median < 300


def test_finished_runs_count_the_less_the_more_settings_differ() -> None:
    early, late = learning(60), learning(400)
    nothing_yet = until(early, 50)

    def forecast(of_early: int, of_late: int) -> float:
        return futures_of(nothing_yet, 50, [finished(early, of_early), finished(late, of_late)]).span("0.9").median

    assert forecast(0, 5) < forecast(2, 2) < forecast(5, 0)


def test_runs_that_never_got_there_are_a_share_of_the_futures() -> None:
    never = [finished(learning(100, top=0.6)) for _ in range(2)]
    futures = futures_of(until(learning(100), 60), 60, [*SIBLINGS[:2], *never])
    assert futures.missed("0.9") == pytest.approx(0.5, abs=0.05)
    assert futures.span("0.9").high == math.inf
    sure = futures_of(until(learning(100), 60), 60, never)
    assert sure.missed("0.9") == pytest.approx(1)
    assert sure.too_early("0.9") is None
    assert "does not show yet whether" in str(
        futures_of(until(learning(100), 60), 60, [finished(learning(100, top=0.6), 1)]).too_early("0.9")
    ), "what other configurations did not reach is no forecast"


def test_without_a_finished_run_and_with_few_successes_it_is_too_early() -> None:
    tests = Outcomes([1.0, 2.0, 3.0], [False, True, False])
    assert futures_of(tests, 3, []).too_early("0.9") == (
        "There is no finished run of this domain and algorithm to compare with, and its own curve says nothing before "
        "10 successful tests; it has 1."
    )
    assert futures_of(Outcomes([], []), 0, []).too_early("0.9")
    gone_on = futures_of(until(learning(1e9), 500), 500, [finished(learning(10), 1)])
    assert str(gone_on.too_early("0.9")).startswith("No finished run is enough like this one")


def test_a_flat_curve_alone_says_nothing_and_a_rising_one_gives_a_range() -> None:
    flat = learning(0, top=0.4)
    assert "does not show yet" in str(futures_of(flat, 600, []).too_early("0.9"))
    rising = Outcomes([float(n + 1) for n in range(80)], [n > 20 for n in range(80)])
    futures = futures_of(rising, 80, [])
    assert futures.too_early("0.9") is None
    assert 80 < futures.span("0.9").low < futures.span("0.9").high


def test_a_long_run_is_thinned() -> None:
    blocks = learning(5_000, n_tests=100_000, spent=100_000).blocks()
    assert len(blocks) == 64
    assert sum(block.tests for block in blocks) == 100_000
    assert sum(block.passed for block in blocks) == pytest.approx(95_000, abs=2)
