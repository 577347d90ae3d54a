"""Symmetries that nobody told are found where moves and labels fit them, and nowhere else."""

import numpy as np
import pytest
import torch
from hypothesis import given
from hypothesis import strategies as st
from tests.learner.policies.fields_kit import briefly, maze, seen, taught

from waypost_learner.policies.fields.field_net import FieldSpec
from waypost_learner.policies.fields.symmetry_finder import NO_SYMMETRY, find_symmetries, symmetries_in
from waypost_learner.rollout.policy_keys import META, pi

SQUARE, OBLONG = (3, 9, 9), (3, 9, 12)
COMPASS = ((-1, 0), (1, 0), (0, -1), (0, 1))  # up, down, left, right: row and column


def moves(*displacements: tuple[int, int]) -> torch.Tensor:
    shares = torch.zeros(len(displacements), 9)
    shares[range(len(displacements)), [3 * row + column + 4 for row, column in displacements]] = 1
    return shares


def found(
    displacements: torch.Tensor, actions_of: list[list[int]], shape: tuple[int, ...] = SQUARE
) -> list[tuple[tuple[int, ...], tuple[int, ...]]]:
    table = find_symmetries(shape, displacements, [torch.tensor(actions_of)])
    return [(one.subgoals, one.actions) for one in symmetries_in(table, len(actions_of))]


TOWARD = [[30, 0, 4, 5], [0, 25, 3, 2], [6, 4, 33, 0], [2, 5, 0, 19]]  # the expert's actions toward up, down, ...


@pytest.mark.parametrize("seed", [0, 1, 2])
def test_those_of_the_maze_follow_from_its_demonstrations(seed: int) -> None:
    learner = taught(briefly(0, symmetries=False), 6, first=100 * seed, seed=seed)
    assert learner.shared is not None
    declared = {(one.subgoals, one.actions) for one in maze.symmetries}
    assert {(one.subgoals, one.actions) for one in learner.shared.symmetries} == declared
    picture = seen(1)[0][0]
    by_choices = {one.actions: one for one in maze.symmetries}
    for one in learner.shared.symmetries:
        np.testing.assert_array_equal(one.observe(picture), by_choices[one.actions].observe(picture))


def test_a_learner_that_found_them_chooses_alike_in_all_of_them() -> None:
    learner = taught(briefly(5, symmetries=False), 6)
    assert learner.shared is not None
    pictures = seen(1)[0]
    for one in learner.shared.symmetries:
        turned = np.stack([one.observe(picture) for picture in pictures])
        np.testing.assert_allclose(
            learner.policies[META](turned).logits[:, list(one.subgoals)],
            learner.policies[META](pictures).logits,
            atol=1e-3,
        )
        for subgoal in range(len(maze.subgoals)):
            before, after = learner.policies[pi(subgoal)](pictures), learner.policies[pi(one.subgoals[subgoal])](turned)
            np.testing.assert_allclose(after.logits[:, list(one.actions)], before.logits, atol=1e-3)
            np.testing.assert_allclose(after.termination, before.termination, atol=1e-4)


def test_a_learner_can_do_without_looking_for_them() -> None:
    learner = taught(briefly(0, symmetries=False, fields=FieldSpec(symmetries=False)), 4)
    assert learner.shared is not None
    assert learner.shared.symmetries == ()


def test_all_turns_fit_moves_and_labels_that_are_the_same_in_each_direction() -> None:
    table = find_symmetries(SQUARE, moves(*COMPASS), [torch.tensor(TOWARD)])
    assert (table != NO_SYMMETRY).all()
    assert len({tuple(row) for row in table.tolist()}) == 7


def test_pictures_that_are_no_squares_have_no_quarter_turns() -> None:
    assert found(moves(*COMPASS), TOWARD, OBLONG) == [
        ((1, 0, 3, 2), (1, 0, 3, 2)),
        ((0, 1, 3, 2), (0, 1, 3, 2)),
        ((1, 0, 2, 3), (1, 0, 2, 3)),
    ]


def test_what_can_jump_but_not_fall_has_only_a_left_and_a_right() -> None:
    assert found(moves((-1, 0), (0, -1), (0, 1)), [[30, 3, 3], [0, 30, 0], [0, 0, 30]]) == [((0, 2, 1), (0, 2, 1))]


def test_a_turn_that_the_experts_actions_contradict_is_none() -> None:
    """Both subgoals are to the top right: only the reflection that swaps up with right fits."""
    assert found(moves(*COMPASS), [[300, 0, 0, 100], [100, 0, 0, 300]]) == [((1, 0), (3, 2, 1, 0))]


def test_a_domain_without_any_has_none() -> None:
    assert found(moves((-1, 0), (0, 1), (1, 1)), [[30, 30, 30]]) == []  # no turn of these moves gives them again
    assert found(moves(*COMPASS), [[400, 0, 100, 700]]) == []  # the expert prefers some of them


def test_actions_that_do_not_move_the_agent_stay_themselves() -> None:
    displacements = moves(*COMPASS, (0, 0), (0, 0))
    toward = [[*row, 1, 0] for row in TOWARD] + [[0, 0, 0, 0, 20, 0], [0, 0, 0, 0, 0, 20]]
    some = found(displacements, toward)
    assert len(some) == 7
    assert all(subgoals[4:] == actions[4:] == (4, 5) for subgoals, actions in some)


def test_subgoals_that_few_actions_could_mean_alike_wait_for_more() -> None:
    """The third and the fourth subgoal were never seen, so nothing tells which is the partner of the first."""
    assert found(moves((-1, 0), (1, 0)), [[30, 0], [20, 20], [0, 0], [0, 0]]) == [((0, 1, 2, 3), (0, 1))]
    assert found(moves((-1, 0), (1, 0)), [[30, 0], [20, 20], [0, 30], [0, 0]])[-1] == ((2, 1, 0, 3), (1, 0))


@given(st.permutations(range(4)), st.permutations(range(4)))
def test_the_order_of_subgoals_and_actions_changes_nothing(subgoals: list[int], actions: list[int]) -> None:
    """What a choice becomes does not depend on the choices' numbers."""
    reordered = found(moves(*[COMPASS[a] for a in actions]), [[TOWARD[g][a] for a in actions] for g in subgoals])
    for (after_g, after_a), (of_g, of_a) in zip(reordered, found(moves(*COMPASS), TOWARD), strict=True):
        assert [subgoals[after_g[i]] for i in range(4)] == [of_g[subgoals[i]] for i in range(4)]
        assert [actions[after_a[i]] for i in range(4)] == [of_a[actions[i]] for i in range(4)]
