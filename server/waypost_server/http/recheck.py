"""Checks that are repeated while a stream or a socket is open, because a session can end and a role can change."""

import time
from collections.abc import Awaitable, Callable

from waypost_server import errors

RECHECK_SECONDS = 2.0


class Recheck:
    """A check that was just made, and is due again every `RECHECK_SECONDS`."""

    def __init__(self, check: Callable[[], Awaitable[object]], clock: Callable[[], float] = time.monotonic) -> None:
        self._check, self._clock = check, clock
        self._due = clock() + RECHECK_SECONDS

    @property
    def seconds_left(self) -> float:
        """The time until the check is due."""
        return max(0.0, self._due - self._clock())

    async def when_due(self) -> None:
        """Check, if it is due.

        Raises:
            Refusal: the check failed.
        """
        if not self.seconds_left:
            await self._check()
            self._due = self._clock() + RECHECK_SECONDS

    async def holds(self) -> bool:
        """Check, if it is due; return whether what was checked still holds."""
        try:
            await self.when_due()
        except errors.Refusal:
            return False
        return True
