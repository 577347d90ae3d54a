"""Take pictures of the states in a query, for domains that draw their own states (`Pictured`).

Pictures are taken when a query is asked, not during the rollout. The camera repeats the actions in its own environment;
domains are deterministic, so it visits the same states. A frame is identified by the SHA-256 of its PNG.
"""

from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np

from waypost.domains import Domain, Pictured
from waypost.runs.pictures import digest, png
from waypost.trajectory import Action, Segment


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
        self._hashes: dict[tuple[Action, ...], str] = {}  # by the actions that lead to the state
        self._new: dict[str, bytes] = {}

    def frames(self, segments: Sequence[Segment]) -> list[list[str]]:
        """Return the hashes of the frames of each segment's states. The segments begin at the start of an episode."""
        hashes = self.along([action for segment in segments for action in segment.actions])
        ends, frames = 0, []
        for segment in segments:
            first, ends = ends, ends + len(segment.actions)
            frames.append(hashes[first : ends + 1])
        return frames

    def along(self, actions: Sequence[Action]) -> list[str]:
        """Return the hashes of the frames along actions from the start of the episode; [] if there are no pictures."""
        if self._pictured is None:
            return []
        prefixes = [tuple(actions[:n]) for n in range(len(actions) + 1)]
        if any(prefix not in self._hashes for prefix in prefixes):
            self._take(prefixes[-1])
        return [self._hashes[prefix] for prefix in prefixes]

    def developed(self) -> dict[str, bytes]:
        """Return the PNG files of all frames taken since the last call, by their hashes."""
        new, self._new = self._new, {}
        return new

    def _take(self, actions: tuple[Action, ...]) -> None:
        for n, pixels in enumerate(self._along(actions)):
            if actions[:n] not in self._hashes:
                file = png(pixels)
                self._hashes[actions[:n]] = digest(file)
                self._new[digest(file)] = file

    def _along(self, actions: Sequence[Action]) -> Iterator[Any]:
        """Yield the picture of each state, uint8[rows, columns, 3]."""
        assert self._pictured is not None
        assert self._env is not None
        self._env.reset(options={"instance": self._instance})
        yield self._pictured.frame(self._env)
        for action in actions:
            self._env.step(np.int64(action))
            yield self._pictured.frame(self._env)
