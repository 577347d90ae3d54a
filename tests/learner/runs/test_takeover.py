"""Experts play on from where a learner failed: from the very state, at a demonstration's price, in a whole run."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from tests.learner import domains_kit
from tests.learner.kit import TINY, corridor, drawn_mazes, examples, outcome, store

from waypost import prices as pricing
from waypost import wire
from waypost.domains import DomainFailed, find_domain
from waypost.trajectory import Segment, Trajectory, n_steps
from waypost_learner.algorithms.learner import Learner
from waypost_learner.algorithms.queries import HierDemo
from waypost_learner.domains.corridor import Corridor, CorridorDomain
from waypost_learner.domains.maze.domain import MazeDomain
from waypost_learner.domains.maze.lasting_lava import LastingLavaMazeDomain
from waypost_learner.domains.maze.maze import Maze
from waypost_learner.experts.oracle import OracleExpert
from waypost_learner.remote.camera import Camera
from waypost_learner.remote.stage import Stage
from waypost_learner.remote.translation import Translator, vocabulary
from waypost_learner.rollout.simulator import Simulator
from waypost_learner.runs.setup import set_up
from waypost_learner.runs.training import train
from waypost_server.queries import checks

HERE = domains_kit.__name__


def walked(domain: Any, instance: Any, *segments: list[int], pictures: bool = False) -> Trajectory:
    """Segments of these actions from the start of an instance, toward subgoal 0; none after the end."""
    simulator, sigma = Simulator(domain, pictures=pictures), list[Segment]()
    state = simulator.reset(instance)
    for actions in segments:
        states, taken = [state], list[int]()
        while not simulator.ended and len(taken) < len(actions):
            taken.append(actions[len(taken)])
            states.append(simulator.step(taken[-1]))
        if taken:
            sigma.append(Segment(0, tuple(states), tuple(taken), terminated=True, final=simulator.final))
        state = states[-1]
    return tuple(sigma)


def takeover(sigma: Trajectory) -> HierDemo:
    return HierDemo(sigma[-1].states[-1], before=sigma, max_segments=1)


def demonstration_of(*actions: str, subgoal: str = "west") -> wire.HierDemoAnswer:
    return wire.HierDemoAnswer(kind="hier_demo", segments=[wire.DemoSegment(subgoal=subgoal, actions=list(actions))])


segments_of_a_maze = st.lists(st.lists(st.integers(0, 3), min_size=1, max_size=6), min_size=1, max_size=4)


@examples
@given(st.sampled_from([MazeDomain(), LastingLavaMazeDomain()]), drawn_mazes(), segments_of_a_maze)
def test_what_an_expert_shows_begins_in_the_state_in_which_the_learner_failed(
    domain: Any, maze: Maze, segments: list[list[int]]
) -> None:
    sigma = walked(domain, maze, *segments)
    assume(not sigma[-1].final)
    translator = Translator(domain, maze)
    ask: Any = translator.ask(takeover(sigma), 0, 3)
    checks.check_ask(ask, checks.Names.of(vocabulary(domain)), [])
    answer: Any = OracleExpert(domain)(ask)
    checks.check_answer(checks.Outline.of(ask), answer, checks.Names.of(vocabulary(domain)), [])
    (shown,) = translator.answer(answer)  # type: ignore[misc]
    failed = sigma[-1].states[-1]
    assert shown.start.view == failed.view
    assert np.array_equal(shown.start.observation, failed.observation), "with the trail of the learner's path"
    assert shown.terminated == (len(shown.actions) < domain.horizons.lo or shown.outcome == "reached")


@examples
@given(drawn_mazes(), segments_of_a_maze, st.lists(st.integers(0, 3), max_size=5))
def test_a_demonstration_that_is_played_on_is_performed_from_there(
    maze: Maze, segments: list[list[int]], then: list[int]
) -> None:
    domain = MazeDomain()
    sigma = walked(domain, maze, *segments)
    assume(not sigma[-1].final)
    translator = Translator(domain, maze)
    translator.ask(takeover(sigma), 0, 0)
    stage = Stage(translator, lambda frames: None)
    names = [domain.actions[action] for action in then]
    played = [wire.DemoSegment(subgoal="north", actions=names)] if names else []
    states = stage.perform(wire.PlayMoves(type="moves", number=1, segments=played, known=0)).states
    views = [sigma[-1].states[-1].view] + [
        state.view for one in walked(domain, maze, *segments, then)[len(sigma) :] for state in one.states[1:]
    ]
    assert states == views


def test_pictures_of_a_demonstration_that_is_played_on_are_those_of_its_own_states() -> None:
    domain, instance = CorridorDomain(), Corridor(0, 6)
    sigma = walked(domain, instance, [1, 1], [1, 0])
    translator = Translator(domain, instance, Camera(domain, instance))
    ask: Any = translator.ask(takeover(sigma), 0, 0)
    stage = Stage(translator, lambda frames: None)
    moves = wire.PlayMoves(type="moves", number=1, segments=demonstration_of("east").segments, known=0)
    performed = stage.perform(moves)
    assert performed.states == [2, 3]
    assert performed.frames == [ask.context[1].frames[2], ask.context[1].frames[1]]
    assert [segment.states for segment in ask.context] == [[0, 1, 2], [2, 3, 2]]
    assert ask.question == "It failed at “west”. Play on from here, until a subgoal is reached."


def test_a_takeover_is_one_segment_of_at_most_h_lo_actions_and_of_what_is_left_of_h_full() -> None:
    domain = CorridorDomain()
    ask: Any = Translator(domain, Corridor(0, 6)).ask(takeover(walked(domain, Corridor(0, 6), [1, 0])), 0, 0)
    assert (ask.max_segments, ask.max_actions) == (1, domain.horizons.lo)
    prices = wire.Prices()
    assert pricing.highest_cost(ask, prices).units == pricing.to_micro(domain.horizons.lo + 2)
    assert pricing.cost(OracleExpert(domain)(ask), prices).units == pricing.to_micro(4 + 2)  # to the door at cell 4

    long = walked(domain, Corridor(0, 6), [1, 0] * 14, [1])
    ask = Translator(domain, Corridor(0, 6)).ask(takeover(long), 0, 0)
    assert ask.max_actions == domain.horizons.full - 29 < domain.horizons.lo


def test_an_oracle_that_cannot_predict_plays_on_after_the_actions_so_far() -> None:
    domain: Any = find_domain(f"{HERE}:rarely_tested")
    assert not hasattr(domain.oracle, "successor")
    sigma = walked(domain, 3, [1])
    ask: Any = Translator(domain, 3).ask(takeover(sigma), 0, 0)
    answer: Any = OracleExpert(domain)(ask)
    assert len(answer.segments) == 1
    elsewhere = ask.model_copy(update={"context": []})
    assert OracleExpert(domain)(elsewhere) != answer


def test_an_oracle_stops_where_the_query_allows_no_more() -> None:
    domain = CorridorDomain()
    ask: Any = Translator(domain, Corridor(0, 6)).ask(takeover(walked(domain, Corridor(0, 6), [1, 0])), 0, 0)
    shorter: Any = OracleExpert(domain)(ask.model_copy(update={"max_actions": 2}))
    assert [segment.actions for segment in shorter.segments] == [["east", "east"]]
    longer: Any = OracleExpert(domain)(ask.model_copy(update={"max_actions": 20, "max_segments": 2}))
    assert [segment.subgoal for segment in longer.segments] == ["east", "target"]


def test_a_takeover_in_snapshots_goes_on_from_the_state_itself() -> None:
    domain = find_domain(f"{HERE}:restorable")
    sigma = walked(domain, 3, [1, 0, 0])
    translator = Translator(domain, 3)
    translator.ask(takeover(sigma), 0, 0)
    stage = Stage(translator, lambda frames: None)
    moves = wire.PlayMoves(type="moves", number=1, segments=demonstration_of("forth", subgoal="last").segments, known=0)
    for _ in range(2):
        assert stage.perform(moves).states[0] == sigma[-1].states[-1].view


def test_a_domain_that_cannot_return_to_a_state_is_refused_before_the_run_begins() -> None:
    with pytest.raises(ValueError, match=r"cannot return to a state .*snapshots"):
        set_up(corridor(algorithm="hg-takeover", domain=f"{HERE}:recorded"), threads=1)


def test_a_domain_that_is_random_and_does_not_say_so_is_refused_before_anybody_answers() -> None:
    domain: Any = CorridorDomain()
    sigma = walked(domain, Corridor(0, 6), [1, 1])
    with pytest.raises(DomainFailed, match="does not come back to a state"):
        Translator(domain, Corridor(1, 6)).ask(takeover(sigma), 0, 0)


def test_a_run_whose_expert_takes_over_pays_and_learns_what_was_shown(tmp_path: Path) -> None:
    with store(tmp_path) as (connection, options):
        summary = train(corridor(algorithm="hg-takeover", episodes=40), connection, options)
        _, cost, ended, _, asked = outcome(connection, summary)
    assert ended == "finished"
    late = [(ask, answer, units) for episode, _, ask, answer, units in asked if episode >= TINY.warm_start]
    shown = [(ask, answer, units) for ask, answer, units in late if ask["kind"] == "hier_demo"]
    assert shown, "nothing failed"
    for ask, answer, units in shown:
        (segment,) = answer.segments
        assert units == len(segment.actions) + 2
        assert ask["context"][-1]["states"][-1] == ask["state"]
    for ask in (ask for ask, _, _ in late if ask["kind"] == "label_lo"):
        steps = sum(len(one["actions"]) for one in [*ask["context"], *ask["segments"]])
        assert steps == CorridorDomain.horizons.full, "only where the episode had ended"
    assert cost["total"] == sum(units for *_, units in asked)


@pytest.mark.parametrize("domain", [CorridorDomain(), MazeDomain(), LastingLavaMazeDomain()])
def test_an_episode_goes_on_after_a_segment_unless_it_ended_there(domain: Any) -> None:
    learner = Learner(domain, TINY, seed=0, threads=1)
    found = set[bool]()
    for draw, instance in enumerate(domain.instances("random").train[:20]):
        s = learner.start(instance, draw)
        sigma = learner.roll_out(s)
        for h in range(len(sigma)):
            simulator = Simulator(domain)
            simulator.reset(instance)
            for action in (action for segment in sigma[: h + 1] for action in segment.actions):
                simulator.step(action)
            assert learner.goes_on(s, sigma[: h + 1]) == (not simulator.ended)
            found.add(simulator.ended)
    assert found == {True, False}


class Tired(domains_kit.Walk):
    """A walk whose episodes end after three steps, long before H_FULL."""

    def reset(self, **given: Any) -> Any:
        self.steps = 0
        return super().reset(**given)

    def step(self, action: Any) -> Any:
        self.steps += 1
        observation, reward, terminated, _, info = super().step(action)
        return observation, reward, terminated, self.steps == 3, info


def test_an_episode_that_its_environment_cut_off_does_not_go_on() -> None:
    learner = Learner(domains_kit.walk(environment=Tired), TINY, seed=0, threads=1)
    s = learner.start(3, 0)
    sigma = learner.roll_out(s)
    assert not sigma[-1].final
    assert n_steps(sigma) == 3
    assert not learner.goes_on(s, sigma)
