"""The oracle of a wrapped environment: the author's functions, which use names, as an `Oracle`, which uses numbers."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

from waypost.domains.search import SearchOracle
from waypost.trajectory import Action, Subgoal

State = Any


@dataclass(frozen=True)
class Rules:
    """What an author gave of an expert; the arguments of `EnvironmentDomain` with these names."""

    reached: Callable[[State, State, str], bool] | None
    succeeded: Callable[[State], bool] | None
    good_subgoals: Callable[[State], Sequence[str]] | None
    good_actions: Callable[[State, State, str], Sequence[str]] | None
    successor: Callable[[State, str], State] | None

    @property
    def wanted(self) -> bool:
        """Whether the author wants an oracle.

        Raises:
            ValueError: something that the oracle needs is missing.
        """
        given = [name for name in ("good_subgoals", "good_actions", "successor") if getattr(self, name) is not None]
        missing = [name for name in ("reached", "succeeded") if getattr(self, name) is None]
        complete = self.successor is not None or (self.good_subgoals is not None and self.good_actions is not None)
        if given and missing and given != ["successor"]:
            raise ValueError(f"an oracle with {' and '.join(given)} also needs {' and '.join(missing)}")
        if given and not complete:
            raise ValueError("an oracle needs both good_subgoals and good_actions, or successor, or restore")
        return complete and not missing


class NamedOracle:
    """Answers with the author's functions, and with a search where a function is missing.

    Args:
        domain: the domain's name, for messages.
        subgoals: the names of the subgoals.
        actions: the names of the actions.
        rules: the author's functions.
    """

    def __init__(self, domain: str, subgoals: tuple[str, ...], actions: tuple[str, ...], rules: Rules) -> None:
        self._domain, self._subgoals, self._actions, self._rules = domain, subgoals, actions, rules
        if rules.successor is not None:
            successor = rules.successor
            self._search = SearchOracle(
                len(subgoals),
                len(actions),
                lambda _, state, action: successor(state, actions[action]),
                self.reached,
                self.succeeded,
            )
            self.successor = self._search.successor

    def good_subgoals(self, instance: Any, state: Any) -> Sequence[Subgoal]:
        """Return every optimal subgoal."""
        if self._rules.good_subgoals is None:
            return self._search.good_subgoals(instance, state)
        return [number_of(name, self._subgoals, "subgoal") for name in self._rules.good_subgoals(state)]

    def good_actions(self, instance: Any, origin: Any, state: Any, subgoal: Subgoal) -> Sequence[Action]:
        """Return every optimal action toward a subgoal."""
        if self._rules.good_actions is None:
            return self._search.good_actions(instance, origin, state, subgoal)
        good = self._rules.good_actions(origin, state, self._subgoals[subgoal])
        return [number_of(name, self._actions, "action") for name in good]

    def reached(self, instance: Any, origin: Any, state: Any, subgoal: Subgoal) -> bool:
        """Return whether a subgoal is accomplished."""
        del instance
        assert self._rules.reached is not None
        return bool(self._rules.reached(origin, state, self._subgoals[subgoal]))

    def succeeded(self, instance: Any, state: Any) -> bool:
        """Return whether the task is accomplished."""
        del instance
        assert self._rules.succeeded is not None
        return bool(self._rules.succeeded(state))


def number_of(name: str, names: tuple[str, ...], what: str) -> int:
    """Return the number of a subgoal or an action.

    Raises:
        ValueError: there is no such name.
    """
    if name not in names:
        raise ValueError(f"{name!r} is no {what}; the {what}s are: {', '.join(names)}")
    return names.index(name)
