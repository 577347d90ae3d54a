"""A forecast in words, for the command line."""

from typing import cast, get_args

from waypost import wire


def level(text: str) -> wire.SuccessLevel:
    """Return a success rate that can be forecast.

    Raises:
        ValueError: it cannot; naming those that can.
    """
    for known in get_args(wire.SuccessLevel):
        if text == known:
            return cast(wire.SuccessLevel, known)
    raise ValueError(f"there is no forecast for {text!r}; choose one of {', '.join(get_args(wire.SuccessLevel))}")


def sentence(found: wire.Forecast) -> str:
    """Return what is forecast, as one paragraph."""
    target = f"{float(found.target):.0%} of tests"
    if found.reached is not None:
        return f"{target} succeeded after {found.reached.cost:g} units, in episode {found.reached.episode}."
    if found.more_units is None:
        return f"Too early to say when {target} succeed. {found.too_early}"
    units, missed = found.more_units, f"In {found.missed or 0:.0%} of the possible futures it never gets there."
    if units.low is None:
        return f"{target} will probably never succeed. {missed}"
    if units.median is None:
        return f"At least {_rough(units.low)} more units until {target} succeed, if ever. {missed}"
    upper = "or more" if units.high is None else f"to {_rough(units.high)}"
    words = f"About {_rough(units.median)} more units ({_rough(units.low)} {upper}) until {target} succeed."
    if found.more_seconds is not None and found.more_seconds.median is not None:
        words += f" For the annotators, this is {found.more_seconds.median / 60:.0f} min of work."
    return words if units.high is not None else f"{words} {missed}"


def _rough(units: float) -> str:
    """Return an amount with two digits that count."""
    return f"{float(f'{units:.2g}'):,.0f}" if units >= 10 else f"{max(units, 1):.0f}"
