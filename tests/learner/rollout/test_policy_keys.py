"""The numbers of policies, which seeds and checkpoints are made of."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from waypost_learner.rollout.policy_keys import FLAT, META, PolicyKey, pi

keys = st.one_of(st.just(META), st.just(FLAT), st.integers(0, 99).map(pi))


@given(keys)
def test_a_key_is_found_again_by_its_number(key: PolicyKey) -> None:
    assert PolicyKey.of_number(key.number) == key


def test_the_numbers_are_those_of_checkpoints_that_were_written_before() -> None:
    assert (META.number, FLAT.number, pi(0).number, pi(4).number) == (-1, -2, 0, 4)


@pytest.mark.parametrize(("level", "subgoal"), [("hi", 0), ("flat", 1), ("lo", None)])
def test_only_a_subpolicy_has_a_subgoal(level: str, subgoal: int | None) -> None:
    with pytest.raises(ValueError, match="cannot have the subgoal"):
        PolicyKey(level, subgoal)  # type: ignore[arg-type]
