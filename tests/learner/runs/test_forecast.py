"""A forecast in words."""

import pytest

from waypost import wire
from waypost_learner.runs.forecast import level, sentence


def forecast(**more: object) -> wire.Forecast:
    nothing = dict.fromkeys(("reached", "too_early", "more_units", "more_seconds", "missed"))
    counts = {"same_configuration": 4, "other_configurations": 0}
    return wire.Forecast.model_validate({"target": "0.9", **nothing, **counts, **more})


def span(low: float | None, median: float | None, high: float | None) -> dict[str, float | None]:
    return {"low": low, "median": median, "high": high}


@pytest.mark.parametrize(
    ("found", "words"),
    [
        (
            {"more_units": span(81.4, 1234.5, 2560), "more_seconds": span(80, 1200, 2000)},
            "About 1,200 more units (81 to 2,600) until 90% of tests succeed. "
            "For the annotators, this is 20 min of work.",
        ),
        (
            {"more_units": span(81, 123, None), "missed": 0.16},
            "About 120 more units (81 or more) until 90% of tests succeed. "
            "In 16% of the possible futures it never gets there.",
        ),
        (
            {"more_units": span(81, None, None), "missed": 0.6},
            "At least 81 more units until 90% of tests succeed, if ever. "
            "In 60% of the possible futures it never gets there.",
        ),
        (
            {"more_units": span(None, None, None), "missed": 0.97},
            "90% of tests will probably never succeed. In 97% of the possible futures it never gets there.",
        ),
        ({"too_early": "Nothing."}, "Too early to say when 90% of tests succeed. Nothing."),
        ({"reached": {"episode": 99, "cost": 351.5}}, "90% of tests succeeded after 351.5 units, in episode 99."),
    ],
)
def test_a_forecast_is_said_in_a_sentence_or_two(found: dict[str, object], words: str) -> None:
    assert sentence(forecast(**found)) == words


def test_a_rate_without_a_forecast_is_refused_with_those_that_have_one() -> None:
    assert level("0.95") == "0.95"
    with pytest.raises(ValueError, match=r"no forecast for '0\.5'; choose one of 0\.8, 0\.9, 0\.95, 0\.99"):
        level("0.5")
