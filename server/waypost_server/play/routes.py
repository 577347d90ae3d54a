"""The route of the play socket, which connects the annotator of a demonstration with the learner's environment.

Every refusal of this route closes the socket with the code 4000 + its status and a reason, even before the first
message, because a browser does not tell the web app why a handshake was refused.
"""

import asyncio

from fastapi import APIRouter, WebSocket, WebSocketDisconnect

from waypost import wire
from waypost_server import errors
from waypost_server.auth import refusals
from waypost_server.auth.lookup import Cached, CredentialCache
from waypost_server.auth.permissions import Caller, authenticate_socket, check_call
from waypost_server.http.context import Context, Ctx
from waypost_server.http.parameters import RowPath
from waypost_server.http.recheck import Recheck
from waypost_server.play import protocol
from waypost_server.play.relay import Relay, Sockets, close

router = APIRouter()


@router.websocket("/queries/{query}/play")
async def play(socket: WebSocket, query: RowPath, context: Ctx, cache: Cached, relay: Sockets) -> None:
    """Relay messages between the web app and the learner's environment until one disconnects."""
    await socket.accept()
    try:
        caller = await authenticate_socket(socket, cache)
        match await _hello(socket, context.settings.body_seconds):
            case wire.PlayTake() as hello:
                await _annotate(socket, query, context, cache, relay, caller, hello)
            case wire.PlayOffer():
                await _offer(socket, query, context, cache, relay, caller)
    except WebSocketDisconnect:
        pass
    except errors.Refusal as refusal:
        await refusals.record(socket, "play", refusal.status, refusal.name)
        await close(socket, refusal)


async def _hello(socket: WebSocket, seconds: float) -> wire.PlayHello:
    try:
        async with asyncio.timeout(seconds):
            return protocol.read(protocol.HELLO, await _receive(socket))
    except TimeoutError:
        raise errors.BodyTooSlow(f"There was no message for {seconds:g} seconds.") from None


async def _next(socket: WebSocket, recheck: Recheck) -> str:
    """Return the next message. Meanwhile, check again and again that the socket may stay open."""
    while True:
        await recheck.when_due()
        try:
            async with asyncio.timeout(recheck.seconds_left):
                return await _receive(socket)
        except TimeoutError:
            continue


async def _annotate(
    socket: WebSocket,
    query: int,
    context: Context,
    cache: CredentialCache,
    relay: Relay,
    caller: Caller,
    hello: wire.PlayTake,
) -> None:
    """Forward an annotator's moves for as long as the annotator is logged in and the lease is live."""

    async def check(caller: Caller) -> protocol.Demonstration:
        check_call(caller, "playTake")
        return await context.db.read(lambda tx: protocol.check_taken(tx, query, caller.user, hello))

    async def check_again() -> None:
        await check(await authenticate_socket(socket, cache))

    demonstration = await check(caller)
    recheck, limit = Recheck(check_again), protocol.RateLimit()
    async with relay.seat(query, "annotator", socket):
        while True:
            text = await _next(socket, recheck)
            limit.count()
            protocol.check_moves(demonstration, protocol.read(protocol.MOVES, text))
            await relay.forward(query, "learner", text)


async def _offer(
    socket: WebSocket, query: int, context: Context, cache: CredentialCache, relay: Relay, caller: Caller
) -> None:
    """Forward the states that a learner's environment returns, for as long as the learner may change the run."""

    async def check(caller: Caller) -> None:
        check_call(caller, "playOffer")
        await context.db.read(lambda tx: protocol.check_offer(tx, query, caller.user, caller.role))

    async def check_again() -> None:
        await check(await authenticate_socket(socket, cache))

    await check(caller)
    recheck = Recheck(check_again)
    limit = protocol.RateLimit()
    async with relay.seat(query, "learner", socket):
        while True:
            text = await _next(socket, recheck)
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
