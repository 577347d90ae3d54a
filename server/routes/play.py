"""The play socket: on one end the annotator who holds a demonstration, on the other the learner, with its environment.

Whoever is refused, even before the first message, finds the socket closed with 4000 + the status and words that say
why: of a refused handshake a browser tells its page nothing.
"""

import asyncio
import time

from fastapi import APIRouter, WebSocket, WebSocketDisconnect

from server import access, errors, playing, queries, wire
from server.context import Context, Ctx
from server.relay import close

router = APIRouter()

RECHECK_SECONDS = 5.0  # how old the knowledge may be that a lease is still live


@router.websocket("/queries/{query}/play")
async def play(socket: WebSocket, query: queries.QueryId, context: Ctx) -> None:
    """Relay between the page and the learner's environment until one leaves."""
    await socket.accept()
    try:
        caller = await access.on_socket(socket, context)
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
            return playing.read(playing.HELLO, await _receive(socket))
    except TimeoutError:
        raise errors.BodyTooSlow(f"Nothing was said for {seconds:g} seconds.") from None


async def _annotate(
    socket: WebSocket, query: int, context: Context, caller: access.Caller, hello: wire.PlayTake
) -> None:
    """Pass an annotator's moves on, for as long as it holds the query."""
    access.refuse_role(caller, access.ANNOTATORS)
    demonstration = await context.db.read(lambda tx: playing.taken(tx, query, caller.user, hello))
    checked_at, pace = time.monotonic(), playing.Pace()
    async with context.relay.seat(query, "annotator", socket):
        while True:
            text = await _receive(socket)
            pace.count()
            playing.check_moves(demonstration, playing.read(playing.MOVES, text))
            if time.monotonic() > checked_at + RECHECK_SECONDS:
                await context.db.read(lambda tx: playing.taken(tx, query, caller.user, hello))
                checked_at = time.monotonic()
            await context.relay.forward(query, "learner", text)


async def _offer(socket: WebSocket, query: int, context: Context, caller: access.Caller) -> None:
    """Pass on what a learner's environment makes of the moves."""
    access.refuse_role(caller, access.LEARNERS)
    is_admin = caller.role == "admin"
    await context.db.read(lambda tx: playing.offered(tx, query, caller.user, is_admin))
    pace = playing.Pace()
    async with context.relay.seat(query, "learner", socket):
        while True:
            text = await _receive(socket)
            pace.count()
            playing.read(playing.STATES, text)
            await context.relay.forward(query, "annotator", text)


async def _receive(socket: WebSocket) -> str:
    message = await socket.receive()
    if message["type"] == "websocket.disconnect":
        raise WebSocketDisconnect(message.get("code", 1005))
    text = message.get("text")
    if not isinstance(text, str):
        raise errors.Unprocessable(["message"], "is not text; messages are JSON")
    return text
