"""The relay of the play socket: it passes messages between the annotator and the learner of a demonstration.

Both must be connected to the same server process. The relay stores only who is connected.
"""

from collections.abc import AsyncIterator
from contextlib import asynccontextmanager, suppress
from typing import Annotated, Literal, cast

from fastapi import Depends
from starlette.requests import HTTPConnection
from starlette.websockets import WebSocket, WebSocketDisconnect

from waypost import wire
from waypost_server.errors import Displaced, Refusal

Side = Literal["annotator", "learner"]

REASON_BYTES = 123  # the longest reason that a close frame can carry


class Relay:
    """The connections to demonstrations: at most one annotator and one learner each."""

    def __init__(self) -> None:
        self._seats: dict[tuple[int, Side], WebSocket] = {}

    @asynccontextmanager
    async def seat(self, query: int, side: Side, socket: WebSocket) -> AsyncIterator[None]:
        """Connect one side for as long as the context lasts. An earlier connection of that side is closed."""
        before = self._seats.get((query, side))
        self._seats[query, side] = socket
        try:
            if before is not None:
                await close(before, Displaced("A newer connection has replaced this one."))
            await self._tell(query)
            yield
        finally:
            if self._seats.get((query, side)) is socket:
                del self._seats[query, side]
                if side == "learner":
                    await self._tell(query)

    async def forward(self, query: int, side: Side, text: str) -> None:
        """Send a message to one side, if it is connected."""
        socket = self._seats.get((query, side))
        if socket is not None:
            with suppress(WebSocketDisconnect, RuntimeError):  # it has just disconnected; its own route handles this
                await socket.send_text(text)

    async def _tell(self, query: int) -> None:
        """Tell the annotator whether the learner is connected."""
        stage = wire.PlayStage(type="stage", present=(query, "learner") in self._seats)
        await self.forward(query, "annotator", stage.model_dump_json())


async def close(socket: WebSocket, refusal: Refusal) -> None:
    """Close a socket with a refusal: the close code is 4000 + its status, the reason its name and its text."""
    reason = f"{refusal.name}: {refusal.detail}".encode()[:REASON_BYTES].decode(errors="ignore")
    with suppress(WebSocketDisconnect, RuntimeError):  # closed already
        await socket.close(4_000 + refusal.status, reason)


async def relay_of(connection: HTTPConnection) -> Relay:
    """Return the relay of the app that serves a socket."""
    return cast(Relay, connection.app.state.relay)


Sockets = Annotated[Relay, Depends(relay_of)]
