"""Finds a domain by its name, or by the place of its definition."""

import importlib
import sys
from importlib.metadata import EntryPoints, entry_points
from pathlib import Path

from waypost import wire
from waypost.domains.contract import MEMBERS, Domain

GROUP = "waypost.domains"
"""The entry-point group of installed domains."""


def find_domain(name: str) -> Domain:
    """Return a domain.

    Args:
        name: the name of an installed domain, or "module:attribute" for a domain that is not installed. The module
            may be a file in the current folder. An attribute that is a class or function is called without arguments.

    Raises:
        ValueError: there is no such domain; the message lists the installed domains.
    """
    if ":" in name:
        return _domain_at(name)
    found = {entry.name: entry for entry in _entries()}
    if name not in found:
        raise ValueError(
            f"there is no domain {name!r}; the installed domains are: {', '.join(sorted(found))}. "
            "Write MODULE:ATTRIBUTE for a domain that is not installed"
        )
    return _made(found[name].load(), name)


def place_of(run: wire.Run) -> str:
    """Return where the domain of a run is found: where the run found it, else under the name in its vocabulary."""
    return str(run.config.get("domain", run.vocabulary.domain))


def installed() -> list[str]:
    """Return the names of the installed domains."""
    return sorted(entry.name for entry in _entries())


def _entries() -> EntryPoints:
    return entry_points(group=GROUP)


def _domain_at(place: str) -> Domain:
    module, _, attribute = place.partition(":")
    here = str(Path.cwd())
    if here not in sys.path:
        sys.path.insert(0, here)
    try:
        found = getattr(importlib.import_module(module), attribute)
    except ModuleNotFoundError as error:
        if error.name != module:
            raise
        raise ValueError(f"there is no module {module!r} here or among the installed packages") from error
    except AttributeError as error:
        raise ValueError(f"the module {module!r} has no {attribute!r}") from error
    return _made(found, place)


def _made(found: object, name: str) -> Domain:
    made = found() if callable(found) else found
    missing = [member for member in MEMBERS if not hasattr(made, member)]
    if missing or not isinstance(made, Domain):
        raise ValueError(f"{name!r} is no domain: it has no {', '.join(missing)}; `waypost domain check` says more")
    return made
