"""Theorems 1 and 2 of Le et al. 2018 and the ratio that follows from them (section 4.2), for the prices of a run."""

from dataclasses import dataclass
from math import log2

from waypost import prices as pricing
from waypost import wire
from waypost.prices import to_units
from waypost_learner.experiments.theory.classes import Cell


@dataclass(frozen=True)
class Expense:
    """What an expert costs by round T, in units."""

    monitoring: float  # T C_I^full, the same for both learners
    learning: float  # everything else

    @property
    def total(self) -> float:
        """Both together."""
        return self.monitoring + self.learning


@dataclass(frozen=True)
class OperationCosts:
    """What each operation of the expert costs at most, in units (section 3)."""

    inspect_full: float  # C_I^full
    inspect_lo: float  # C_I^LO
    label_hi: float  # C_L^HI
    label_lo: float  # C_L^LO
    label_full: float  # C_L^full


def operation_costs(cell: Cell, prices: wire.Prices) -> OperationCosts:
    """Return what answers as long as the horizons cost."""

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
    """Return the bound for hg-DAgger; `n_used` is |G_opt|, the number of subgoals that the expert uses."""
    lo_mistakes = n_used * log2(cell.n_pi)
    a_failure = costs.label_hi + cell.h_hi * costs.inspect_lo
    learning = (log2(cell.n_mu) + lo_mistakes) * a_failure + lo_mistakes * costs.label_lo
    return Expense(rounds * costs.inspect_full, learning)


def theorem_2(cell: Cell, rounds: int, costs: OperationCosts) -> Expense:
    """Return the bound for flat DAgger."""
    mistakes = log2(cell.n_mu) + cell.n_subgoals * log2(cell.n_pi)
    return Expense(rounds * costs.inspect_full, mistakes * costs.label_full)


def ratio_of_bounds(cell: Cell, costs: OperationCosts) -> float:
    """Return what bounds the ratio of the two theorems' learning terms."""
    return (costs.label_hi + cell.h_hi * costs.inspect_lo + costs.label_lo) / costs.label_full


def proportion(cell: Cell) -> float:
    """Return (H_HI + H_LO) / (H_HI H_LO), to which the ratio is proportional where an inspection costs O(1)."""
    return (cell.h_hi + cell.h_lo) / (cell.h_hi * cell.h_lo)
