"""The play socket's two ends brought together: what the annotator sends goes to the learner, and back.

Both ends have to be connected to the same server process; the relay keeps nothing but who is there.
"""

from collections.abc import AsyncIterator
from contextlib import asynccontextmanager, suppress
from typing import Literal

from starlette.websockets import WebSocket, WebSocketDisconnect

from waypost import wire
from waypost_server.errors import Displaced, Refusal

Side = Literal["annotator", "learner"]

REASON_BYTES = 123  # the most a close frame has room for


class Relay:
    """Who is connected to which demonstration: at most one annotator and one learner each."""

    def __init__(self) -> None:
        self._seats: dict[tuple[int, Side], WebSocket] = {}

    @asynccontextmanager
    async def seat(self, query: int, side: Side, socket: WebSocket) -> AsyncIterator[None]:
        """Take one end for as long as the context lasts; who had it before was cut off and did not notice yet."""
        before = self._seats.get((query, side))
        self._seats[query, side] = socket
        try:
            if before is not None:
                await close(before, Displaced("Another connection has taken this place."))
            await self._tell(query)
            yield
        finally:
            if self._seats.get((query, side)) is socket:
                del self._seats[query, side]
                if side == "learner":
                    await self._tell(query)

    async def forward(self, query: int, side: Side, text: str) -> None:
        """Send to one end, if it is there."""
        socket = self._seats.get((query, side))
        if socket is not None:
            with suppress(WebSocketDisconnect, RuntimeError):  # it left just now, which its own route notices
                await socket.send_text(text)

    async def _tell(self, query: int) -> None:
        """Tell the annotator whether the learner is there."""
        stage = wire.PlayStage(type="stage", present=(query, "learner") in self._seats)
        await self.forward(query, "annotator", stage.model_dump_json())


async def close(socket: WebSocket, refusal: Refusal) -> None:
    """Close a socket with a refusal: its status as the code 4000 + status, and its words."""
    reason = refusal.detail.encode()[:REASON_BYTES].decode(errors="ignore")
    with suppress(WebSocketDisconnect, RuntimeError):  # closed already
        await socket.close(4_000 + refusal.status, reason)
