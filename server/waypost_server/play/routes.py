"""The route of the play socket, which connects the annotator of a demonstration with the learner's environment.

Every refusal of this route closes the socket with the code 4000 + its status and a reason, even before the first
message, because a browser does not tell the web app why a handshake was refused.
"""

import asyncio
import time

from fastapi import APIRouter, WebSocket, WebSocketDisconnect

from waypost import wire
from waypost_server import errors
from waypost_server.auth.access import ACCESS, check_role
from waypost_server.auth.lookup import Cached
from waypost_server.auth.permissions import Caller, authenticate_socket
from waypost_server.http.context import Context, Ctx
from waypost_server.http.parameters import RowPath
from waypost_server.play import protocol
from waypost_server.play.relay import Relay, Sockets, close

router = APIRouter()

RECHECK_SECONDS = 5.0  # the interval between two checks that the lease is still live


@router.websocket("/queries/{query}/play")
async def play(socket: WebSocket, query: RowPath, context: Ctx, cache: Cached, relay: Sockets) -> None:
    """Relay messages between the web app and the learner's environment until one disconnects."""
    await socket.accept()
    try:
        caller = await authenticate_socket(socket, cache)
        match await _hello(socket, context.settings.body_seconds):
            case wire.PlayTake() as hello:
                await _annotate(socket, query, context, relay, caller, hello)
            case wire.PlayOffer():
                await _offer(socket, query, context, relay, caller)
    except WebSocketDisconnect:
        pass
    except errors.Refusal as refusal:
        await close(socket, refusal)


async def _hello(socket: WebSocket, seconds: float) -> wire.PlayHello:
    try:
        async with asyncio.timeout(seconds):
            return protocol.read(protocol.HELLO, await _receive(socket))
    except TimeoutError:
        raise errors.BodyTooSlow(f"There was no message for {seconds:g} seconds.") from None


async def _annotate(
    socket: WebSocket, query: int, context: Context, relay: Relay, caller: Caller, hello: wire.PlayTake
) -> None:
    """Forward an annotator's moves for as long as the lease is live."""
    check_role(ACCESS["playTake"], caller.name, caller.role)
    demonstration = await context.db.read(lambda tx: protocol.check_taken(tx, query, caller.user, hello))
    checked_at, limit = time.monotonic(), protocol.RateLimit()
    async with relay.seat(query, "annotator", socket):
        while True:
            text = await _receive(socket)
            limit.count()
            protocol.check_moves(demonstration, protocol.read(protocol.MOVES, text))
            if time.monotonic() > checked_at + RECHECK_SECONDS:
                await context.db.read(lambda tx: protocol.check_taken(tx, query, caller.user, hello))
                checked_at = time.monotonic()
            await relay.forward(query, "learner", text)


async def _offer(socket: WebSocket, query: int, context: Context, relay: Relay, caller: Caller) -> None:
    """Forward the states that a learner's environment returns."""
    check_role(ACCESS["playOffer"], caller.name, caller.role)
    await context.db.read(lambda tx: protocol.check_offer(tx, query, caller.user, caller.role))
    limit = protocol.RateLimit()
    async with relay.seat(query, "learner", socket):
        while True:
            text = await _receive(socket)
            limit.count()
            protocol.read(protocol.STATES, text)
            await relay.forward(query, "annotator", text)


async def _receive(socket: WebSocket) -> str:
    message = await socket.receive()
    if message["type"] == "websocket.disconnect":
        raise WebSocketDisconnect(message.get("code", 1005))
    text = message.get("text")
    if not isinstance(text, str):
        raise errors.Unprocessable(["message"], "is not text; messages are JSON")
    return text
