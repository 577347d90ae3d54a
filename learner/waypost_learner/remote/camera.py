"""Take pictures of the states in a query, for domains that draw their own states (`Pictured`).

Pictures are taken when a query is asked, not during the rollout: the camera returns to the states in its own
environment. If a domain cannot return to a state, its states already have pictures. A frame is identified by the
SHA-256 of its PNG.
"""

import hashlib
import io
from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np
from PIL import Image

from waypost.domains import Domain, Pictured, Restorable, replay_of
from waypost.trajectory import Action, Segment, State


class Camera:
    """Takes pictures of the states along trajectories of one instance, each state once.

    Args:
        domain: the domain; if it is not `Pictured`, there are no pictures.
        instance: the instance of all trajectories.
    """

    def __init__(self, domain: Domain, instance: Any) -> None:
        self._domain, self._instance = domain, instance
        self._pictured = domain if isinstance(domain, Pictured) else None
        self._env = domain.make_env() if self._pictured else None
        self._replay = replay_of(domain)
        self._hashes: dict[tuple[Action, ...] | int, str] = {}  # by the actions that lead to the state, or by its id
        self._kept: list[State] = []  # the states whose ids are in use
        self._new: dict[str, bytes] = {}

    def frames(self, segments: Sequence[Segment]) -> list[list[str]]:
        """Return the hashes of the frames of each segment's states. The segments begin at the start of an episode."""
        actions = [action for segment in segments for action in segment.actions]
        states = [state for segment in segments for state in segment.states[:-1]]
        hashes = self.along(actions, [*states, segments[-1].states[-1]] if segments else [])
        ends, frames = 0, []
        for segment in segments:
            first, ends = ends, ends + len(segment.actions)
            frames.append(hashes[first : ends + 1])
        return frames

    def along(self, actions: Sequence[Action], states: Sequence[State]) -> list[str]:
        """Return the hashes of the frames along a trajectory from the start of the episode; [] without pictures.

        Args:
            actions: the actions of the trajectory.
            states: its states, one more than actions.
        """
        if self._pictured is None:
            return []
        if self._replay == "actions":
            keys: list[Any] = [tuple(actions[:n]) for n in range(len(actions) + 1)]
        else:
            keys = [id(state) for state in states]
            self._kept += states
        if any(key not in self._hashes for key in keys):
            for key, pixels in zip(keys, self._pixels(actions, states), strict=True):
                self._keep(key, pixels)
        return [self._hashes[key] for key in keys]

    def developed(self) -> dict[str, bytes]:
        """Return the PNG files of all frames taken since the last call, by their hashes."""
        new, self._new = self._new, {}
        return new

    def _keep(self, key: Any, pixels: Any) -> None:
        if key not in self._hashes:
            png = encoded(pixels)
            self._hashes[key] = hashlib.sha256(png).hexdigest()
            self._new[self._hashes[key]] = png

    def _pixels(self, actions: Sequence[Action], states: Sequence[State]) -> Iterator[Any]:
        """Yield the picture of each state, uint8[rows, columns, 3]."""
        assert self._pictured is not None
        assert self._env is not None
        if self._replay == "recorded":
            yield from (state.picture for state in states)
            return
        self._env.reset(options={"instance": self._instance})
        if isinstance(self._domain, Restorable) and self._replay == "snapshots":
            for state in states:
                self._domain.restore(self._env, state.snapshot)
                yield self._pictured.frame(self._env)
            return
        yield self._pictured.frame(self._env)
        for action in actions:
            self._env.step(np.int64(action))
            yield self._pictured.frame(self._env)


def encoded(pixels: Any) -> bytes:
    """Return a picture uint8[rows, columns, 3] as a PNG file."""
    file = io.BytesIO()
    Image.fromarray(pixels).save(file, "PNG")
    return file.getvalue()
