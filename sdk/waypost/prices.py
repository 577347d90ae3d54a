"""The cost model: the cost of an answer, and the maximum cost of an answer to a query.

Only the server charges answers. The default prices are the paper's (Le et al. 2018, section 3): every subgoal, action,
termination and inspection costs 1. Amounts are whole micro-units, so that sums are exact.
"""

from collections.abc import Sequence
from dataclasses import dataclass

from waypost import wire

MICRO = 1_000_000


@dataclass(frozen=True)
class Cost:
    """A cost in micro-units."""

    units: int
    lo: int = 0  # the part for LO labels: actions and terminations


def to_micro(units: float) -> int:
    """Return units as whole micro-units."""
    return round(units * MICRO)


def to_units(micro: int) -> float:
    """Return micro-units as units."""
    return micro / MICRO


def cost(answer: wire.Answer, prices: wire.Prices) -> Cost:
    """Return the cost of an answer."""
    match answer:
        case wire.HierDemoAnswer():
            n_subgoals = sum(segment.subgoal is not None for segment in answer.segments)
            return _hier_demo(n_subgoals, _n_actions(answer.segments), prices)
        case wire.InspectAnswer():
            return _inspect(answer.kind, prices)
        case wire.LabelHiAnswer():
            return _label_hi(len(answer.subgoals), prices)
        case wire.LabelLoAnswer():
            return _label_lo(len(answer.actions), prices)
        case wire.LabelFullAnswer():
            return _label_full(len(answer.actions), prices)


def highest_cost(ask: wire.Ask, prices: wire.Prices) -> Cost:
    """Return the maximum cost of an answer to a query. Only the cost of a demonstration depends on the answer."""
    match ask:
        case wire.AskHierDemo():
            # Every segment has an action, so there are at most as many segments as actions.
            n_subgoals = 0 if ask.flat else min(ask.max_segments, ask.max_actions)
            return _hier_demo(n_subgoals, ask.max_actions, prices)
        case wire.AskInspectFull() | wire.AskInspectLo():
            return _inspect(ask.kind, prices)
        case wire.AskLabelHi():
            return _label_hi(len(ask.segments), prices)
        case wire.AskLabelLo():
            return _label_lo(_n_actions(ask.segments), prices)
        case wire.AskLabelFull():
            return _label_full(_n_actions(ask.segments), prices)


def price(ask: wire.Ask, prices: wire.Prices) -> wire.Price:
    """Return the price of a query in the form that annotators get."""
    if not isinstance(ask, wire.AskHierDemo):
        return wire.Price(fixed=to_units(highest_cost(ask, prices).units), per_action=0, per_segment=0)
    per_segment = 0 if ask.flat else _hier_demo(1, 0, prices).units
    return wire.Price(fixed=0, per_action=to_units(_hier_demo(0, 1, prices).units), per_segment=to_units(per_segment))


def _hier_demo(n_subgoals: int, n_actions: int, prices: wire.Prices) -> Cost:
    """Price the labels that h-BC (Algorithm 1) learns from: subgoals, actions, and a termination per subgoal."""
    lo = n_actions * to_micro(prices.action) + n_subgoals * to_micro(prices.termination)
    return Cost(n_subgoals * to_micro(prices.subgoal) + lo, lo)


def _inspect(kind: wire.Kind, prices: wire.Prices) -> Cost:
    return Cost(to_micro(prices.inspect_full if kind == "inspect_full" else prices.inspect_lo))


def _label_hi(n_subgoals: int, prices: wire.Prices) -> Cost:
    return Cost(n_subgoals * to_micro(prices.subgoal))


def _label_lo(n_actions: int, prices: wire.Prices) -> Cost:
    """Price Label_LO: the action of each state, and the termination of the last state (H + 1 labels)."""
    units = n_actions * to_micro(prices.action) + to_micro(prices.termination)
    return Cost(units, units)


def _label_full(n_actions: int, prices: wire.Prices) -> Cost:
    units = n_actions * to_micro(prices.action)
    return Cost(units, units)


def _n_actions(segments: Sequence[wire.Segment] | Sequence[wire.DemoSegment]) -> int:
    return sum(len(segment.actions) for segment in segments)
