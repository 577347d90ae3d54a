"""What holds for the domain of every example."""

import pytest
from gymnasium.utils.env_checker import check_env
from tests.examples.kit import DOMAINS, queries_of_every_kind

from waypost import wire
from waypost.domains import find_domain
from waypost.domains.conformance import check_domain
from waypost_learner.experts.oracle import OracleExpert
from waypost_learner.remote.translation import Translator
from waypost_learner.rollout.simulator import Simulator

pytestmark = pytest.mark.parametrize("place", DOMAINS)


def test_it_keeps_the_contract(place: str) -> None:
    results = check_domain(place)
    assert len(results) > 10
    assert [result for result in results if result.failures] == []


@pytest.mark.filterwarnings("ignore:.*infinity:UserWarning")  # observations of any domain may be any numbers
def test_its_environment_passes_gymnasiums_checker(place: str) -> None:
    check_env(find_domain(place).make_env(), skip_render_check=True)


def test_the_oracle_answers_every_kind_of_query_and_its_demonstration_succeeds(place: str) -> None:
    domain, instance = find_domain(place), 5
    translator, expert = Translator(domain, instance), OracleExpert(domain)
    asks = [translator.ask(query, 0, n) for n, query in enumerate(queries_of_every_kind(domain, instance))]
    demonstration, full, hi, _, lo, flat = (expert(ask) for ask in asks)
    assert isinstance(demonstration, wire.HierDemoAnswer)
    simulator = Simulator(domain)
    simulator.reset(instance)
    for action in [action for segment in demonstration.segments for action in segment.actions]:
        simulator.step(domain.actions.index(action))
    assert simulator.succeeded
    assert isinstance(full, wire.InspectAnswer)
    assert full.verdict == "fail"
    assert isinstance(hi, wire.LabelHiAnswer)
    assert set(hi.subgoals) <= set(domain.subgoals)
    assert isinstance(lo, wire.LabelLoAnswer)
    assert isinstance(flat, wire.LabelFullAnswer)
    assert len(flat.actions) == sum(len(segment.actions) for segment in asks[-1].segments)


@pytest.mark.parametrize("instances", ["train", "test"])
def test_the_oracle_solves_instances_within_the_horizons(place: str, instances: str) -> None:
    domain = find_domain(place)
    expert, horizons = OracleExpert(domain), domain.horizons
    for instance in getattr(domain.instances("random"), instances)[:50]:
        simulator = Simulator(domain)
        segments = expert.demonstrate(instance, simulator.reset(instance).view).segments
        for action in [action for segment in segments for action in segment.actions]:
            simulator.step(domain.actions.index(action))
        assert simulator.succeeded
        assert simulator.steps <= horizons.full
        assert len(segments) <= horizons.hi
        assert max(len(segment.actions) for segment in segments) <= horizons.lo
