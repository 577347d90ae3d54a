"""The dialogue example: its simulated user, its oracle, and what is learned from it."""

from pathlib import Path
from typing import Any

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from tests.examples.kit import success_after
from tests.learner.kit import examples
from waypost_dialogue import ACTIONS, PATIENCE, SLOTS, FlightDialogue, flight_dialogue

from waypost_learner.experts.oracle import OracleExpert
from waypost_learner.rollout.simulator import Simulator

DOMAIN = "waypost_dialogue:flight_dialogue"
HORIZONS = flight_dialogue.horizons
seeds = st.integers(0, 2**31 - 1)
acts = st.lists(st.sampled_from(ACTIONS), max_size=20)


def after(seed: int, said: list[str]) -> FlightDialogue:
    """A dialogue with the user of a seed, after these acts; none follows its end."""
    env = FlightDialogue()
    env.reset(seed=seed)
    for act in said:
        if env.state["end"] is None:
            env.step(np.int64(ACTIONS.index(act)))
    return env


def demonstrated(seed: int, state: Any = None) -> list[str]:
    """The acts with which the oracle books a flight for the user of a seed."""
    start = Simulator(flight_dialogue).reset(seed).view if state is None else state
    return [act for one in OracleExpert(flight_dialogue).demonstrate(seed, start).segments for act in one.actions]


@examples
@given(seeds, acts)
def test_the_same_acts_to_the_same_user_give_the_same_dialogue(seed: int, said: list[str]) -> None:
    first, second = after(seed, said), after(seed, said)
    assert first.state == second.state


def test_users_differ() -> None:
    dialogues = {str(after(seed, [f"request_{slot}" for slot in SLOTS]).state["turns"]) for seed in range(30)}
    assert len(dialogues) > 20


@examples
@given(seeds, acts)
def test_the_tracker_knows_only_wishes_that_the_user_told(seed: int, said: list[str]) -> None:
    state = after(seed, said).state
    told = " ".join(turn["text"] for turn in state["turns"] if turn["speaker"] == "user")
    verified = " ".join(turn["text"] for turn in state["turns"] if turn["text"].startswith("Did you say"))
    assert all(value in told or value in verified for value in state["known"].values())


@examples
@given(seeds, acts)
def test_the_oracle_books_a_flight_from_every_state_that_has_not_ended(seed: int, said: list[str]) -> None:
    env = after(seed, said)
    oracle, steps = flight_dialogue.oracle, 0
    while env.state["end"] is None:
        subgoal = oracle.good_subgoals(seed, env.state)[-1]
        action = oracle.good_actions(seed, env.state, env.state, subgoal)[0]
        env.step(np.int64(action))
        steps += 1
        assert steps < HORIZONS.full
    assert env.state["end"] == "booked" or steps == 0


def test_the_user_leaves_after_useless_turns() -> None:
    env = after(0, ["propose"] * (PATIENCE - 1))
    assert env.state["end"] is None
    _, reward, terminated, _, _ = env.step(np.int64(ACTIONS.index("propose")))
    assert (env.state["end"], reward, terminated) == ("left", 0, True)


def test_a_booking_needs_the_users_agreement() -> None:
    said = demonstrated(0)
    assert said[-2:] == ["summarize", "book"]
    assert after(0, said).state["end"] == "booked"
    assert after(0, [*said[:-2], "book"]).state["end"] == "refused"


def test_a_short_run_learns_to_book_flights(tmp_path: Path) -> None:
    assert success_after(0, DOMAIN, tmp_path) < 0.1
    assert success_after(20, DOMAIN, tmp_path) > 0.3
