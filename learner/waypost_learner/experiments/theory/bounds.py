"""Computes the bounds of Theorems 1 and 2 (Le et al. 2018, section 4.2) and their ratio, for the prices of a run."""

from dataclasses import dataclass
from math import log2

from waypost import prices as pricing
from waypost import wire
from waypost.prices import to_units
from waypost_learner.experiments.theory.classes import Cell


@dataclass(frozen=True)
class Expense:
    """The expert cost of T rounds, in units."""

    monitoring: float  # T C_I^full, the same for both learners
    learning: float  # everything else

    @property
    def total(self) -> float:
        """The sum of both."""
        return self.monitoring + self.learning


@dataclass(frozen=True)
class OperationCosts:
    """The highest cost of each operation of the expert, in units (section 3)."""

    inspect_full: float  # C_I^full
    inspect_lo: float  # C_I^LO
    label_hi: float  # C_L^HI
    label_lo: float  # C_L^LO
    label_full: float  # C_L^full


def operation_costs(cell: Cell, prices: wire.Prices) -> OperationCosts:
    """Return the cost of each operation of the theorems: of its longest answer under the cell's horizons."""

    def units(answer: wire.Answer) -> float:
        return to_units(pricing.cost(answer, prices).units)

    terminations = [False] * (cell.h_lo + 1)
    return OperationCosts(
        inspect_full=units(wire.InspectAnswer(kind="inspect_full", verdict="fail")),
        inspect_lo=units(wire.InspectAnswer(kind="inspect_lo", verdict="fail")),
        label_hi=units(wire.LabelHiAnswer(kind="label_hi", subgoals=["g"] * cell.h_hi)),
        label_lo=units(wire.LabelLoAnswer(kind="label_lo", actions=["a"] * cell.h_lo, terminations=terminations)),
        label_full=units(wire.LabelFullAnswer(kind="label_full", actions=["a"] * cell.h_lo * cell.h_hi)),
    )


def theorem_1(cell: Cell, n_used: int, rounds: int, costs: OperationCosts) -> Expense:
    """Return the bound of Theorem 1 for hg-DAgger; `n_used` is |G_opt|, the number of subgoals that the expert uses."""
    lo_mistakes = n_used * log2(cell.n_pi)
    a_failure = costs.label_hi + cell.h_hi * costs.inspect_lo
    learning = (log2(cell.n_mu) + lo_mistakes) * a_failure + lo_mistakes * costs.label_lo
    return Expense(rounds * costs.inspect_full, learning)


def theorem_2(cell: Cell, rounds: int, costs: OperationCosts) -> Expense:
    """Return the bound of Theorem 2 for flat DAgger."""
    mistakes = log2(cell.n_mu) + cell.n_subgoals * log2(cell.n_pi)
    return Expense(rounds * costs.inspect_full, mistakes * costs.label_full)


def ratio_of_bounds(cell: Cell, costs: OperationCosts) -> float:
    """Return an upper bound of the ratio of the learning terms of Theorem 1 and Theorem 2."""
    return (costs.label_hi + cell.h_hi * costs.inspect_lo + costs.label_lo) / costs.label_full


def proportion(cell: Cell) -> float:
    """Return (H_HI + H_LO) / (H_HI H_LO). If an inspection costs O(1), the ratio is proportional to this number."""
    return (cell.h_hi + cell.h_lo) / (cell.h_hi * cell.h_lo)
