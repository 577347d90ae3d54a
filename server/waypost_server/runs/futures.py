"""Forecasts how many units a run needs until its success rate reaches a level, from its tests and from finished runs.

A forecast is a weighted list of possible futures. Each finished run is one future per scale: this run learns like that
one, for 0.8 or 1.3 times its units. More futures are S-shaped curves of success against the logarithm of the units,
for runs that are like no finished run. A future in which the run had reached by now what it has not does not count;
every other counts the more, the better it agrees with the tests so far. The forecast is the median of all futures, and
the range that holds the middle 80 % of them.

Nothing here reads the store. `bench/forecast.py` compares these forecasts with finished runs; `docs/experimenter.md`
says how good they are.
"""

import math
from bisect import bisect_right
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import accumulate, pairwise
from statistics import median

from waypost.wire import SuccessLevel
from waypost_server.runs.curves import LEVELS, first_at
from waypost_server.runs.service import TRAILING

Outlook = Mapping[SuccessLevel, float]
"""By level, the units at which it is reached; infinite if it is not."""


@dataclass(frozen=True)
class Constants:
    """What was chosen on the committed runs with even seeds (`bench/forecast.py`)."""

    sibling_spread: float = 0.15  # of runs that differ only by seed: the standard deviation of the logarithms of scales
    cousin_spread: float = 0.5  # the same for other runs of the domain and algorithm
    cousins: float = 0.25  # all cousins together count as much as so many siblings
    shapes: float = 0.1  # the weight of all S-shaped curves beside the finished runs, before the tests
    tempering: float = 0.1  # each test counts as this share of a test, for learning goes in jumps that no curve has
    luck: float = 1.5  # the best of many windows of tests exceeds their mean by so many standard deviations


CONSTANTS = Constants()
_BLOCKS = 64  # tests are thinned to so many blocks
_BLOCK = 5  # tests in a block, at least
_ENOUGH = 10  # successes from which a run's own curve says something
_PLAUSIBLE = 0.1  # if less than this share is not refuted, the futures that remain are far-fetched
_HORIZON = 10  # S-shaped curves are believed up to so many times the units spent
_SCALES = [6 * step / 24 - 3 for step in range(25)]  # in standard deviations
_TOPS = (0.3, 0.5, 0.7, 0.8, 0.85, 0.9, 0.95, 0.98, 1.0)
_STEEPNESSES = (1.0, 2.0, 4.0, 8.0, 16.0)
_MIDDLES = [20 ** (step / 12 - 1) for step in range(25)]  # in units spent so far
_PACES = (0.5, 1.0, 2.0)  # units per test from now on, in recent units per test


@dataclass(frozen=True)
class Block:
    """Successive tests: the mean of the units spent before each, their number, and how many succeeded."""

    units: float
    tests: int
    passed: int


@dataclass(frozen=True)
class Outcomes:
    """The tests of a run in their order: the units spent up to each, and whether it succeeded."""

    units: Sequence[float]
    passed: Sequence[bool]

    def reached(self) -> Outlook:
        """Return when each level was reached."""
        found = {level: first_at(float(level), range(len(self.units)), self.passed, self.units) for level in LEVELS}
        return {level: math.inf if milestone is None else milestone.cost for level, milestone in found.items()}

    def blocks(self) -> list[Block]:
        """Return the tests as a bounded number of blocks."""
        n_tests = len(self.units)
        n_blocks = min(_BLOCKS, max(1, n_tests // _BLOCK), n_tests)
        edges = [n_tests * part // max(n_blocks, 1) for part in range(n_blocks + 1)]
        successes = [0, *accumulate(map(int, self.passed))]
        return [Block(sum(self.units[a:b]) / (b - a), b - a, successes[b] - successes[a]) for a, b in pairwise(edges)]


@dataclass(frozen=True)
class Finished:
    """A finished run beside the run in question: its tests, when it reached the levels, and its units.

    `differences` is the number of settings in which they differ, without the seed. Siblings differ in none, cousins do.
    """

    blocks: Sequence[Block]
    reached: Outlook
    spent: float
    differences: int

    @classmethod
    def of(cls, tests: Outcomes, spent: float, differences: int) -> "Finished":
        """Summarize a run that has made at least one test."""
        return cls(tests.blocks(), tests.reached(), spent, differences)


@dataclass(frozen=True)
class Span:
    """The units at which a level is reached, infinite for never: the median of all futures, and the 80 % range."""

    low: float
    median: float
    high: float


@dataclass(frozen=True)
class Future:
    """One way in which the run may go on. The weights of all futures add up to 1."""

    weight: float
    outlook: Outlook


@dataclass(frozen=True)
class Futures:
    """All futures of a run, and what they were made from."""

    all: Sequence[Future]
    from_siblings: float  # the weight of those that follow siblings
    finished: int  # the number of finished runs
    successes: int  # of the run's own tests

    def too_early(self, level: SuccessLevel) -> str | None:
        """Return why these futures do not say when a level is reached; None if they do."""
        alike = (
            "No finished run is enough like this one"
            if self.finished
            else "There is no finished run of this domain and algorithm to compare with"
        )
        if not self.all:
            own = f"its own curve says nothing before {_ENOUGH} successful tests; it has {self.successes}"
            return f"{alike}, and {own}."
        if self.from_siblings < 0.5 and self.span(level).median == math.inf:
            return f"{alike}, and its own curve does not show yet whether it gets there."
        return None

    def span(self, level: SuccessLevel) -> Span:
        """Return when a level will be reached. There must be a future."""
        ordered = sorted((future.outlook[level], future.weight) for future in self.all)
        sums = list(accumulate(weight for _, weight in ordered))
        low, middle, high = (ordered[min(bisect_right(sums, share), len(sums) - 1)][0] for share in (0.1, 0.5, 0.9))
        return Span(low, middle, high)

    def missed(self, level: SuccessLevel) -> float:
        """Return the share of the futures in which a level is not reached."""
        return min(1.0, sum(future.weight for future in self.all if future.outlook[level] == math.inf))


@dataclass(frozen=True)
class _Guess:
    """A future before it is known whether it is refuted: its weight before the tests, and how well it fits them."""

    weight: float
    fit: float
    outlook: Outlook
    end: float  # a run that did not reach a level says nothing about what comes after its end
    sibling: bool


def futures_of(
    tests: Outcomes, spent: float, finished: Sequence[Finished], constants: Constants = CONSTANTS
) -> Futures:
    """Return the futures of a run that has made these tests, has spent these units, and has not reached every level."""
    reached = tests.reached()
    # The lowest level that is missing decides which guesses are refuted, whatever the level in question. So all
    # forecasts of a run are made from the same futures, and a higher level is never forecast earlier.
    missing = next(level for level in LEVELS if reached[level] == math.inf)
    everything = list(_guesses(tests, spent, finished, constants))
    guesses = [guess for guess in everything if spent < min(guess.outlook[missing], guess.end)]
    if sum(guess.weight for guess in guesses) < _PLAUSIBLE * sum(guess.weight for guess in everything):
        guesses = []
    best = max((guess.fit for guess in guesses), default=0.0)
    weights = [guess.weight * math.exp(guess.fit - best) for guess in guesses]
    total = sum(weights)
    futures = [Future(weight / total, guess.outlook) for weight, guess in zip(weights, guesses, strict=True)]
    followed = sum(future.weight for future, guess in zip(futures, guesses, strict=True) if guess.sibling)
    return Futures(futures, min(followed, 1.0), len(finished), sum(tests.passed))


def _guesses(tests: Outcomes, spent: float, finished: Sequence[Finished], constants: Constants) -> Iterator[_Guess]:
    seen = tests.blocks()
    siblings = [run for run in finished if run.differences == 0]
    cousins = [run for run in finished if run.differences > 0]
    likeness = sum(0.5**run.differences for run in cousins)
    for run in siblings:
        yield from _like(run, constants.sibling_spread, 1.0, seen, constants)
    for run in cousins:
        share = constants.cousins * 0.5**run.differences / likeness
        yield from _like(run, constants.cousin_spread, share, seen, constants)
    if sum(tests.passed) >= _ENOUGH and spent > 0:
        share = len(siblings) + constants.cousins * bool(cousins)
        yield from _shaped(tests, spent, (share or 1.0) * constants.shapes, seen, constants)


def _like(run: Finished, spread: float, share: float, seen: Sequence[Block], constants: Constants) -> Iterator[_Guess]:
    """Yield a guess per scale: the run in question learns like this one, for so many times its units."""
    places = [block.units for block in run.blocks]
    rates = [_rate(run.blocks[max(row - 1, 0) : row + 1]) for row in range(len(run.blocks) + 1)]
    logs = [(math.log(rate), math.log(1 - rate)) for rate in rates]
    bells = [math.exp(-z * z / 2) for z in _SCALES]
    for z, bell in zip(_SCALES, bells, strict=True):
        scale = math.exp(z * spread)
        outlook = {level: units * scale for level, units in run.reached.items()}
        fit = _log_likelihood(seen, [logs[bisect_right(places, block.units / scale)] for block in seen])
        weight = share * bell / sum(bells)
        yield _Guess(weight, constants.tempering * fit, outlook, run.spent * scale, run.differences == 0)


def _rate(near: Sequence[Block]) -> float:
    """Return the success rate of the blocks before and after a place; never 0 or 1."""
    return (sum(block.passed for block in near) + 0.5) / (sum(block.tests for block in near) + 1)


def _log_likelihood(seen: Sequence[Block], logs: Sequence[tuple[float, float]]) -> float:
    """Return the logarithm of the likelihood of tests; `logs`: of the rates of success and of failure at each block."""
    pairs = zip(seen, logs, strict=True)
    return sum(block.passed * success + (block.tests - block.passed) * failure for block, (success, failure) in pairs)


def _shaped(
    tests: Outcomes, spent: float, share: float, seen: Sequence[Block], constants: Constants
) -> Iterator[_Guess]:
    """Yield S-shaped curves: the rate is `top` in the end, and half of it at `middle` units."""
    recent = tests.units[-min(TRAILING, len(tests.units) // 2) - 1 :]
    pace = median(after - before for before, after in pairwise(recent))
    means = {level: _mean_for(float(level), constants.luck) for level in LEVELS}
    share /= len(_TOPS) * len(_STEEPNESSES) * len(_MIDDLES) * len(_PACES)
    for top in _TOPS:
        for steepness in _STEEPNESSES:
            for middle in _MIDDLES:
                odds = [max(block.units / spent / middle, 1e-9) ** steepness for block in seen]
                rates = [min(max(top * one / (1 + one), 0.005), 0.995) for one in odds]
                logs = [(math.log(rate), math.log(1 - rate)) for rate in rates]
                fit = constants.tempering * _log_likelihood(seen, logs)
                for relative_pace in _PACES:
                    outlook = {}
                    for level, mean in means.items():
                        lag = relative_pace * pace * max(TRAILING / 2, TRAILING - len(tests.units))
                        at = middle * spent * (mean / (top - mean)) ** (1 / steepness) if mean < top else math.inf
                        units = max(at, spent) + lag
                        outlook[level] = units if units <= _HORIZON * spent else math.inf
                    yield _Guess(share, fit, outlook, math.inf, False)


def _mean_for(level: float, luck: float) -> float:
    """Return the success rate at which the best window of tests reaches a level."""
    return level - luck * math.sqrt(level * (1 - level) / TRAILING)
