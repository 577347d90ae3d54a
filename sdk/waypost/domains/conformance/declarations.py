"""Checks of what a domain declares: names, numbers, spaces and optional parts."""

from collections.abc import Hashable, Iterator, Mapping, Sequence
from typing import Any

import gymnasium
import numpy as np
from gymnasium import spaces

from waypost.domains.conformance.episodes import trials
from waypost.domains.contract import Domain, Horizons
from waypost.domains.parts import (
    ActionLandmarked,
    Centered,
    Cropped,
    Ending,
    Gridded,
    Landmarked,
    Pictured,
    Placed,
    Tested,
    View,
    Viewed,
    symmetries_of,
)

LONGEST_NAME = 100  # characters; the server refuses longer names
LARGEST_PICTURE = 4_096  # pixels per side
SMALLEST_PICTURE = 10  # rows and columns that the network of Table 1 needs


def names_are_valid(domain: Domain) -> Iterator[str]:
    """Names are distinct short texts."""
    own: Any = domain.name
    if not isinstance(own, str) or not own:
        yield f"name is {own!r}; it must be a text that is not empty."
    for what in ("subgoals", "actions"):
        names = getattr(domain, what)
        if isinstance(names, str) or not isinstance(names, Sequence):
            yield f"{what} is {names!r}; it must be a tuple of names."
        elif what == "actions" and not names:
            yield "actions is empty; a learner needs at least one action."
        elif wrong := [name for name in names if not isinstance(name, str) or not 0 < len(name) <= LONGEST_NAME]:
            yield f"{what} contains {wrong[0]!r}; a name is a text of 1 to {LONGEST_NAME} characters."
        elif len(set(names)) != len(names):
            yield f"{what} contains a name twice; each needs its own."


def numbers_are_valid(domain: Domain) -> Iterator[str]:
    """Horizons, the observation's shape and the sets of instances make sense."""
    horizons: Any = domain.horizons
    if not isinstance(horizons, Horizons):
        yield f"horizons is {horizons!r}; write Horizons(lo=..., hi=..., full=...)."
    elif min(horizons.lo, horizons.hi, horizons.full) < 1:
        yield f"horizons is {horizons}; each must be at least 1."
    shape = domain.observation_shape
    if not isinstance(shape, tuple) or len(shape) not in (1, 3) or not all(isinstance(n, int) and n > 0 for n in shape):
        yield f"observation_shape is {shape!r}; write (features,) or (channels, rows, columns)."
    elif len(shape) == 3 and min(shape[1:]) < SMALLEST_PICTURE:
        yield (
            f"observation_shape is {shape}; pictures need at least {SMALLEST_PICTURE} rows and columns, "
            "so flatten smaller ones into a vector."
        )
    if isinstance(domain, Tested) and (not isinstance(domain.test_every, int) or domain.test_every < 1):
        yield f"test_every is {domain.test_every!r}; it must be a number of episodes, at least 1."
    sets = domain.instances("random")
    for name in ("train", "test"):
        if not len(getattr(sets, name)):
            yield f'instances("random").{name} is empty; it needs at least one instance.'


def spaces_fit(domain: Domain) -> Iterator[str]:
    """The environment is one of Gymnasium, with one numbered action for each name."""
    env: Any = domain.make_env()
    if not isinstance(env, gymnasium.Env):
        yield f"make_env returns {type(env).__name__}; return a gymnasium.Env."
        return
    space = env.action_space
    if not isinstance(space, spaces.Discrete) or space.start != 0:
        yield f"action_space is {space}; it must be Discrete({len(domain.actions)}), starting at 0."
    elif space.n != len(domain.actions):
        yield f"action_space has {space.n} actions, but actions has {len(domain.actions)} names; make them equal."


def parts_fit(domain: Domain) -> Iterator[str]:
    """Each optional part returns what its protocol says."""
    env = domain.make_env()
    instance, actions = next(trials(domain))
    observation, _ = env.reset(options={"instance": instance})
    start = domain.state_view(env)
    env.step(np.int64(actions[0]))
    if isinstance(domain, Pictured):
        yield from _picture(domain.frame(env))
    if isinstance(domain, Landmarked):
        boxes = domain.landmarks(domain.instance_view(instance), start)
        yield from _boxes("landmarks", boxes, "subgoal", len(domain.subgoals))
    if isinstance(domain, ActionLandmarked):
        boxes = domain.action_landmarks(domain.instance_view(instance), start)
        yield from _boxes("action_landmarks", boxes, "action", len(domain.actions))
    if isinstance(domain, Ending):
        for subgoal in range(len(domain.subgoals)):
            found = domain.outcome(instance, start, domain.state_view(env), subgoal)
            if found not in ("reached", "failed", None):
                yield f'outcome returns {found!r}; return "reached", "failed" or None.'
                break
    if isinstance(domain, Placed) and not isinstance(domain.place(start), Hashable):
        yield "place returns what cannot be a key; return a tuple instead of a list."
    if isinstance(domain, Viewed):
        for name in ("hi_view", "lo_view", "flat_view"):
            yield from _view(name, getattr(domain, name), observation)
    if isinstance(domain, Gridded) and domain.flat_grid.agent is None:
        yield "flat_grid does not say which channel shows the agent; give it agent=CHANNEL."
    if isinstance(domain, Centered):
        yield from _view("centered_view", domain.centered_view, observation)
    if isinstance(domain, Cropped):
        yield from _view("crop_view", domain.crop_view, observation)
    for number, symmetry in enumerate(symmetries_of(domain)):
        for what, names in (("subgoals", domain.subgoals), ("actions", domain.actions)):
            if sorted(getattr(symmetry, what)) != list(range(len(names))):
                yield f"The {what} of symmetry {number} are no reordering of all {len(names)} {what}."
        if np.shape(symmetry.observe(observation)) != observation.shape:
            yield f"Symmetry {number} changes the shape of an observation; it must keep it."


def _picture(pixels: Any) -> Iterator[str]:
    if not isinstance(pixels, np.ndarray) or pixels.dtype != np.uint8 or pixels.ndim != 3 or pixels.shape[2] != 3:
        seen = f"{pixels.dtype}{pixels.shape}" if isinstance(pixels, np.ndarray) else type(pixels).__name__
        yield f"frame returns {seen}; return uint8 of the shape (rows, columns, 3)."
    elif max(pixels.shape) > LARGEST_PICTURE:
        yield f"frame returns a picture of {pixels.shape[:2]} pixels; at most {LARGEST_PICTURE} per side are possible."


def _boxes(member: str, boxes: Any, what: str, choices: int) -> Iterator[str]:
    """Check the boxes that a member of the domain returns for some of its choices: subgoals or actions."""
    if not isinstance(boxes, Mapping) or not set(boxes) <= set(range(choices)):
        yield f"{member} returns {boxes!r}; return boxes by the numbers of {what}s, 0 to {choices - 1}."
        return
    for choice, box in boxes.items():
        left, top, right, bottom = box if np.shape(box) == (4,) else (0, 0, 0, 0)
        if not (0 <= left < right <= 1 and 0 <= top < bottom <= 1):
            yield (
                f"{member} returns {box!r} for {what} {choice}; return its left, upper, right and lower side, as "
                "shares of the picture's width and height, 0 to 1."
            )


def _view(name: str, view: View, observation: Any) -> Iterator[str]:
    seen = np.shape(view.observe(observation))
    if seen != tuple(view.shape):
        yield f"{name}.observe returns the shape {seen}, but {name}.shape is {tuple(view.shape)}; make them equal."
