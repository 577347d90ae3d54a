"""A network between clients and a server that breaks connections: before, within and after requests."""

import random
from collections import Counter
from collections.abc import AsyncIterator, Iterator
from contextlib import asynccontextmanager, contextmanager, suppress

import anyio
from anyio.abc import SocketAttribute, SocketStream
from anyio.from_thread import start_blocking_portal

HOST = "127.0.0.1"
PLACES = ("before the request", "within the request", "before the reply", "within the reply")


class Link:
    """Passes on what clients and a server send each other, and cuts some of the connections.

    Args:
        port: of the server, on this machine.
        rate: the share of the requests at which it cuts the connection.
        seed: decides at which requests, and where. It does not decide how connections take turns.
    """

    def __init__(self, port: int, rate: float, seed: int) -> None:
        self.cuts: Counter[str] = Counter()
        self._port, self._rate, self._choose = port, rate, random.Random(seed)

    @contextmanager
    def serving(self) -> Iterator[str]:
        """Listen until the context ends; yields the address."""
        with start_blocking_portal() as portal, portal.wrap_async_context_manager(self._listening()) as address:
            yield address

    @asynccontextmanager
    async def _listening(self) -> AsyncIterator[str]:
        async with (
            await anyio.create_tcp_listener(local_host=HOST) as listener,
            anyio.create_task_group() as tasks,
        ):
            tasks.start_soon(listener.serve, self._pass_on)
            yield f"http://{HOST}:{listener.extra(SocketAttribute.local_port)}"
            tasks.cancel_scope.cancel()

    async def _pass_on(self, client: SocketStream) -> None:
        """Pass on what comes through one connection, until one side ends it or it is cut."""
        cut = ""  # where

        async def requests() -> None:
            nonlocal cut
            with suppress(anyio.BrokenResourceError):
                async for chunk in client:
                    cut = self._choose.choice(PLACES) if self._choose.random() < self._rate else ""
                    if cut in PLACES[:2]:
                        await server.send(_part(chunk, cut))
                        break
                    await server.send(chunk)
            both.cancel_scope.cancel()

        async def replies() -> None:
            with suppress(anyio.BrokenResourceError):
                async for chunk in server:
                    if cut:
                        await client.send(_part(chunk, cut))
                        break
                    await client.send(chunk)
            both.cancel_scope.cancel()

        async with client, await anyio.connect_tcp(HOST, self._port) as server, anyio.create_task_group() as both:
            both.start_soon(requests)
            both.start_soon(replies)
        self.cuts.update([cut] if cut else [])


def _part(chunk: bytes, cut: str) -> bytes:
    return chunk[: len(chunk) // 2] if cut.startswith("within") else b""
