"""The forecast of a run, from a store."""

import pytest
from tests.server.kit import Json, Service
from tests.server.runs.test_curves import filled, report, result

CONFIG = {"preset": "lean", "seed": 0}


def learned(service: Service, n_episodes: int, fails: int, active: float = 0.0, **more: object) -> str:
    """A run that pays two units an episode and fails its first tests."""
    config = CONFIG | {"seed": fails} | dict(more.pop("config", {}))  # type: ignore[call-overload]
    run = service.learner.create_run(seed=fails, config=config, **more)
    filled(service, run, n_episodes, 2, active)
    report(service, run, *(result(n, n >= fails) for n in range(n_episodes)))
    return run


def done(service: Service, n_episodes: int, fails: int, **more: object) -> str:
    run = learned(service, n_episodes, fails, **more)
    service.learner.patch(run, state="finished")
    return run


def forecast(service: Service, run: str, target: str = "0.9") -> Json:
    return dict(service.viewer.get(f"/runs/{run}/forecast?target={target}"))


def test_finished_runs_of_the_configuration_say_what_a_run_still_needs(service: Service) -> None:
    for fails in (28, 30, 32):
        done(service, 150, fails)
    done(service, 150, 90, config={"preset": "paper"})
    done(service, 150, 5, algorithm="h-bc")  # another algorithm
    learned(service, 140, 6)  # not finished
    done(service, 40, 2)  # no window of tests
    run = learned(service, 20, 1_000, active=3.0)
    found = forecast(service, run)
    assert (found["target"], found["reached"], found["too_early"]) == ("0.9", None, None)
    assert (found["same_configuration"], found["other_configurations"]) == (3, 1)
    units = found["more_units"]
    assert 0 < units["low"] < units["median"] < units["high"]
    assert units["median"] == pytest.approx(2 * 120 - 40, rel=0.2)  # the window of tests is 90 % after episode 119
    assert found["more_seconds"] == {name: pytest.approx(3 * amount) for name, amount in units.items()}
    assert found["missed"] < 0.1
    later = forecast(service, run, "0.99")["more_units"]
    assert later["median"] > units["median"]


def test_a_target_that_was_reached_says_when(service: Service) -> None:
    run = learned(service, 130, 20)
    found = forecast(service, run)
    assert found["reached"] == {"episode": 109, "cost": 220}
    assert found["reached"] == service.learner.costs(run)["first_at"]["0.9"]
    assert (found["more_units"], found["too_early"], found["missed"]) == (None, None, None)


def test_without_anything_to_go_by_it_says_why_not(service: Service) -> None:
    run = service.learner.create_run()
    found = forecast(service, run)
    assert "There is no finished run" in found["too_early"]
    assert (found["more_units"], found["more_seconds"], found["missed"]) == (None, None, None)
    service.viewer.get(f"/runs/{run}/forecast?target=0.5", expect=422)
    service.viewer.get("/runs/000000000000/forecast", expect=404)


def test_the_pace_of_a_program_is_no_pace_of_people(service: Service) -> None:
    done(service, 150, 30)
    run = learned(service, 20, 1_000, active=0.01)
    found = forecast(service, run)
    assert found["more_units"]["median"] > 0
    assert found["more_seconds"] is None


def test_runs_of_other_domains_are_not_compared(lite: Service) -> None:
    done(lite, 150, 30, vocabulary={"domain": "corridor", "subgoals": [], "actions": ["left"], "renderer": "text"})
    run = learned(lite, 20, 1_000)
    assert "There is no finished run" in forecast(lite, run)["too_early"]
