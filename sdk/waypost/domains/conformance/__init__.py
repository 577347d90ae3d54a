"""Check that a domain keeps the contract, and explain each failure: `waypost domain check NAME`."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass

from waypost.domains.conformance.declarations import names_are_valid, numbers_are_valid, parts_fit, spaces_fit
from waypost.domains.conformance.episodes import (
    ends_in_time,
    is_deterministic,
    is_json,
    keeps_what_it_returned,
    observes_arrays,
    starts_unsolved,
)
from waypost.domains.conformance.oracle import oracle_solves
from waypost.domains.contract import MEMBERS, Domain
from waypost.domains.failures import explained
from waypost.domains.find import find_domain

Check = Callable[[Domain], Iterator[str]]
"""Yields one sentence for each failure: what is wrong, and what to change."""

CHECKS: tuple[tuple[str, Check], ...] = (
    ("names of subgoals and actions", names_are_valid),
    ("horizons, shapes and instances", numbers_are_valid),
    ("the environment's spaces", spaces_fit),
    ("observations", observes_arrays),
    ("views are JSON", is_json),
    ("an episode does not begin at its end", starts_unsolved),
    ("episodes end in time", ends_in_time),
    ("returned values do not change", keeps_what_it_returned),
    ("trajectories can be carried out again", is_deterministic),
    ("optional parts", parts_fit),
    ("the oracle solves instances", oracle_solves),
)
"""Every check after the domain was found. If one fails, those after it are not made: they would fail for its reason."""


@dataclass(frozen=True)
class Result:
    """The result of one check."""

    check: str
    failures: tuple[str, ...]  # one sentence each; none if the check passed


def check_domain(name: str) -> list[Result]:
    """Check a domain and return the results, up to the first check that fails.

    Args:
        name: the domain's name, or its place as for `find_domain`.
    """
    try:
        domain = find_domain(name)
    except ValueError as error:
        return [Result("the domain is found", (f"{error}.",))]
    except Exception as error:
        return [Result("the domain is found", (f"{explained('Loading it', error)}.",))]
    return [Result("the domain is found", ()), *check(domain)]


def check(domain: Domain) -> list[Result]:
    """Check a domain object and return the results, up to the first check that fails."""
    missing = [member for member in MEMBERS if not hasattr(domain, member)]
    results = [Result("members", (f"The domain has no {', '.join(missing)}.",) if missing else ())]
    for name, one in CHECKS:
        if results[-1].failures:
            break
        results.append(Result(name, tuple(_failures(one, domain))))
    return results


def _failures(one: Check, domain: Domain) -> Iterator[str]:
    try:
        yield from one(domain)
    except Exception as error:
        yield f"{explained('This check', error)}."
