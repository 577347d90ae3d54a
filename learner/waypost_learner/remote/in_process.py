"""An HTTP transport to an ASGI app in this process, without a socket.

`waypost train --store FILE` uses it, so that the same code writes every store, with and without a server.
"""

import asyncio
import threading
from collections.abc import Coroutine
from contextlib import AbstractAsyncContextManager
from types import TracebackType
from typing import Any, TypeVar

import httpx2
from fastapi import FastAPI

T = TypeVar("T")


class InProcessTransport(httpx2.BaseTransport):
    """Runs an app in an event loop on its own thread. Use it as a context manager.

    Args:
        app: answers the requests.
    """

    def __init__(self, app: FastAPI) -> None:
        self._app = app
        self._loop = asyncio.new_event_loop()
        self._thread = threading.Thread(target=self._loop.run_forever, name="server", daemon=True)
        self._lifespan: AbstractAsyncContextManager[Any] = app.router.lifespan_context(app)
        self._asgi = httpx2.ASGITransport(app)

    def __enter__(self) -> "InProcessTransport":
        """Start the event loop and the app."""
        self._thread.start()
        self._run(self._lifespan.__aenter__())
        return self

    def __exit__(
        self,
        exc_type: type[BaseException] | None = None,
        exc_value: BaseException | None = None,
        traceback: TracebackType | None = None,
    ) -> None:
        """Stop the app and the event loop."""
        self._run(self._lifespan.__aexit__(None, None, None))
        self._loop.call_soon_threadsafe(self._loop.stop)
        self._thread.join()
        self._loop.close()

    def handle_request(self, request: httpx2.Request) -> httpx2.Response:
        """Return the app's response to a request."""
        return self._run(self._handle(request))

    async def _handle(self, request: httpx2.Request) -> httpx2.Response:
        response = await self._asgi.handle_async_request(request)
        body = b"".join([part async for part in response.aiter_raw()])  # still compressed, as its headers say
        return httpx2.Response(response.status_code, headers=response.headers, content=body)

    def _run(self, work: Coroutine[Any, Any, T]) -> T:
        return asyncio.run_coroutine_threadsafe(work, self._loop).result()
