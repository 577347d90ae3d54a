"""The play socket: on one end the annotator who holds a demonstration, on the other the learner, with its environment.

Whoever is refused, even before the first message, finds the socket closed with 4000 + the status and words that say
why: of a refused handshake a browser tells its page nothing.
"""

import asyncio
import time

from fastapi import APIRouter, WebSocket, WebSocketDisconnect

from waypost import wire
from waypost_server import errors
from waypost_server.auth import permissions
from waypost_server.http.context import Context, Ctx
from waypost_server.play import protocol
from waypost_server.play.relay import close
from waypost_server.queries import service as queries

router = APIRouter()

RECHECK_SECONDS = 5.0  # how old the knowledge may be that a lease is still live


@router.websocket("/queries/{query}/play")
async def play(socket: WebSocket, query: queries.QueryId, context: Ctx) -> None:
    """Relay between the page and the learner's environment until one leaves."""
    await socket.accept()
    try:
        caller = await permissions.on_socket(socket, context)
        match await _hello(socket, context.settings.body_seconds):
            case wire.PlayTake() as hello:
                await _annotate(socket, query, context, caller, hello)
            case wire.PlayOffer():
                await _offer(socket, query, context, caller)
    except WebSocketDisconnect:
        pass
    except errors.Refusal as refusal:
        await close(socket, refusal)


async def _hello(socket: WebSocket, seconds: float) -> wire.PlayHello:
    try:
        async with asyncio.timeout(seconds):
            return protocol.read(protocol.HELLO, await _receive(socket))
    except TimeoutError:
        raise errors.BodyTooSlow(f"Nothing was said for {seconds:g} seconds.") from None


async def _annotate(
    socket: WebSocket, query: int, context: Context, caller: permissions.Caller, hello: wire.PlayTake
) -> None:
    """Pass an annotator's moves on, for as long as it holds the query."""
    permissions.refuse_role(caller, permissions.ANNOTATORS)
    demonstration = await context.db.read(lambda tx: protocol.taken(tx, query, caller.user, hello))
    checked_at, pace = time.monotonic(), protocol.Pace()
    async with context.relay.seat(query, "annotator", socket):
        while True:
            text = await _receive(socket)
            pace.count()
            protocol.check_moves(demonstration, protocol.read(protocol.MOVES, text))
            if time.monotonic() > checked_at + RECHECK_SECONDS:
                await context.db.read(lambda tx: protocol.taken(tx, query, caller.user, hello))
                checked_at = time.monotonic()
            await context.relay.forward(query, "learner", text)


async def _offer(socket: WebSocket, query: int, context: Context, caller: permissions.Caller) -> None:
    """Pass on what a learner's environment makes of the moves."""
    permissions.refuse_role(caller, permissions.LEARNERS)
    is_admin = caller.role == "admin"
    await context.db.read(lambda tx: protocol.offered(tx, query, caller.user, is_admin))
    pace = protocol.Pace()
    async with context.relay.seat(query, "learner", socket):
        while True:
            text = await _receive(socket)
            pace.count()
            protocol.read(protocol.STATES, text)
            await context.relay.forward(query, "annotator", text)


async def _receive(socket: WebSocket) -> str:
    message = await socket.receive()
    if message["type"] == "websocket.disconnect":
        raise WebSocketDisconnect(message.get("code", 1005))
    text = message.get("text")
    if not isinstance(text, str):
        raise errors.Unprocessable(["message"], "is not text; messages are JSON")
    return text
