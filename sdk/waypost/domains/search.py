"""A computed expert by search: which choices are best follows from `successor`, `reached` and `succeeded`.

A subgoal is carried out on a shortest path to the first state that reaches it. A good subgoal begins a sequence of
subgoals that accomplishes the task with the fewest actions. The search visits every state that it must, so it suits
domains with up to some ten thousand states for each instance.
"""

import heapq
import json
from collections import deque
from collections.abc import Callable, Iterator, Sequence
from functools import lru_cache
from itertools import count
from typing import Any

from waypost.trajectory import Action, Subgoal

Successor = Callable[[Any, Any, Action], Any]
"""Maps an instance, a state and an action to the next state, all JSON views."""


class SearchOracle:
    """An `Oracle` that finds good choices by breadth-first search.

    Args:
        subgoals: the number of subgoals.
        actions: the number of actions.
        successor: returns the state after an action.
        reached: returns whether a subgoal, chosen in `origin`, is accomplished in `state`.
        succeeded: returns whether the task is accomplished in `state`.
        states: how many states a search may visit.
    """

    def __init__(
        self,
        subgoals: int,
        actions: int,
        successor: Successor,
        reached: Callable[[Any, Any, Any, Subgoal], bool],
        succeeded: Callable[[Any, Any], bool],
        states: int = 100_000,
    ) -> None:
        self._subgoals, self._actions, self._states = range(subgoals), range(actions), states
        self.successor, self.reached, self.succeeded = successor, reached, succeeded
        self._next = lru_cache(maxsize=1_000_000)(self._successors_of)
        self._path = lru_cache(maxsize=100_000)(self._search)

    def good_subgoals(self, instance: Any, state: Any) -> Sequence[Subgoal]:
        """Return every subgoal that begins a sequence of subgoals with the fewest actions; () if there is none."""
        if self.succeeded(instance, state):
            return ()
        costs = {g: self._cost_through(instance, state, g) for g in self._subgoals}
        least = min((cost for cost in costs.values() if cost is not None), default=None)
        return () if least is None else tuple(g for g, cost in costs.items() if cost == least)

    def good_actions(self, instance: Any, origin: Any, state: Any, subgoal: Subgoal) -> Sequence[Action]:
        """Return every action that begins a shortest path to the subgoal; () if it is reached or out of reach."""
        if self.reached(instance, origin, state, subgoal):
            return ()
        lengths = {}
        for action, following in self._next(_key(instance), _key(state)):
            path = self._path(_key(instance), _key(origin), following, subgoal)
            if path is not None:
                lengths[action] = path[0]
        least = min(lengths.values(), default=None)
        return tuple(action for action, length in lengths.items() if length == least)

    def _cost_through(self, instance: Any, state: Any, first: Subgoal) -> int | None:
        """Return the fewest actions to the end of the task if `first` is the next subgoal; None if it cannot end."""
        order = count()  # breaks ties, so that states are never compared
        frontier = [(cost, next(order), end) for cost, end in self._after(instance, _key(state), first)]
        best: dict[str, int] = {}
        while frontier:
            cost, _, here = heapq.heappop(frontier)
            if here in best:
                continue
            best[here] = cost
            if self.succeeded(instance, json.loads(here)):
                return cost
            for subgoal in self._subgoals:
                for more, end in self._after(instance, here, subgoal):
                    if end not in best:
                        heapq.heappush(frontier, (cost + more, next(order), end))
        return None

    def _after(self, instance: Any, state: str, subgoal: Subgoal) -> Iterator[tuple[int, str]]:
        """Yield the number of actions and the state after carrying out a subgoal, if that is possible."""
        if self.reached(instance, json.loads(state), json.loads(state), subgoal):
            return  # a subgoal that is reached already leads nowhere
        path = self._path(_key(instance), state, state, subgoal)
        if path is not None:
            yield path

    def _search(self, instance: str, origin: str, start: str, subgoal: Subgoal) -> tuple[int, str] | None:
        """Return the length of a shortest path to a subgoal and the state at its end; None if there is no path."""
        here, chosen_in = json.loads(instance), json.loads(origin)
        seen, frontier = {start}, deque([(0, start)])
        while frontier:
            length, key = frontier.popleft()
            state = json.loads(key)
            if self.reached(here, chosen_in, state, subgoal):
                return length, key
            if self.succeeded(here, state):
                continue  # the episode ends here
            for _, following in self._next(instance, key):
                if following not in seen:
                    seen.add(following)
                    frontier.append((length + 1, following))
            if len(seen) > self._states:
                raise ValueError(
                    f"the search visited {self._states:,} states without an end: give good_subgoals and good_actions, "
                    "or leave what does not matter out of the state"
                )
        return None

    def _successors_of(self, instance: str, state: str) -> tuple[tuple[Action, str], ...]:
        here, view = json.loads(instance), json.loads(state)
        if self.succeeded(here, view):
            return ()
        return tuple((action, _key(self.successor(here, view, action))) for action in self._actions)


def _key(view: Any) -> str:
    """Return a JSON view as a text, which can be a key."""
    return json.dumps(view, sort_keys=True)
