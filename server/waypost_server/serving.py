"""Runs the app with uvicorn, in the foreground or on a thread, on a socket that is bound beforehand."""

import asyncio
import gc
import signal
import socket
import threading
import time
from collections.abc import Iterator
from contextlib import closing, contextmanager
from dataclasses import dataclass
from types import FrameType

import uvicorn
from fastapi import FastAPI

from waypost_server.app import create_app
from waypost_server.db.engine import Database, migrate
from waypost_server.play.protocol import MESSAGE_BYTES
from waypost_server.settings import Settings

GRACE_SECONDS = 2
TICK_SECONDS = 0.1
YOUNG_OBJECTS = 10_000  # that are made before the garbage collector looks at them; 700 by default


class CannotServe(Exception):
    """The server cannot start. The message says why and what to do."""


class Server(uvicorn.Server):
    """Uvicorn, but before it stops, it says that it is not ready, waits a while, and ends streams and long polls.

    It waits only after SIGTERM, which a supervisor sends, and until a second signal. It serves meanwhile, because a
    proxy sends requests until it has asked again whether the server is ready.
    """

    def __init__(self, app: FastAPI, log_level: str, drain_seconds: float = 0.0) -> None:
        config = uvicorn.Config(
            app,
            lifespan="on",
            log_config=None,
            log_level=log_level,
            access_log=False,
            server_header=False,
            proxy_headers=False,
            ws_max_size=MESSAGE_BYTES,
            timeout_graceful_shutdown=GRACE_SECONDS,
        )
        super().__init__(config)
        self._app = app
        self._drain_seconds = drain_seconds
        self._drains = False

    def handle_exit(self, sig: int, frame: FrameType | None) -> None:
        """Stop because of a signal."""
        self._drains = sig == signal.SIGTERM and not self.should_exit
        super().handle_exit(sig, frame)

    async def main_loop(self) -> None:
        """Serve until told to stop, and on until the server is no longer asked."""
        await super().main_loop()
        self._app.state.readiness.stop()
        until = time.monotonic() + self._drain_seconds
        while self._drains and time.monotonic() < until:
            await asyncio.sleep(TICK_SECONDS)

    async def shutdown(self, sockets: list[socket.socket] | None = None) -> None:
        """Wake all waiting requests, so that they end, and shut down."""
        self._app.state.context.hub.close()
        await super().shutdown(sockets)


@dataclass(frozen=True)
class Served:
    """A running server: its address and its store."""

    url: str
    db: Database


def bind(host: str, port: int) -> socket.socket:
    """Return a listening socket. Port 0 means any free port.

    Raises:
        CannotServe: the address is not available.
    """
    family = socket.AF_INET6 if ":" in host else socket.AF_INET
    bound = socket.socket(family, socket.SOCK_STREAM)
    bound.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
    try:
        bound.bind((host, port))
        bound.listen(1_024)
    except OSError as error:
        bound.close()
        raise CannotServe(f"Cannot listen on {host}:{port} ({error.strerror}); choose another --port.") from None
    return bound


def url_of(bound: socket.socket) -> str:
    """Return the address that a browser on this machine can open."""
    host, port = bound.getsockname()[:2]
    host = {"0.0.0.0": "127.0.0.1", "::": "::1"}.get(host, host)  # noqa: S104 - compared, not bound
    return f"http://[{host}]:{port}" if ":" in host else f"http://{host}:{port}"


@contextmanager
def background(settings: Settings, host: str = "127.0.0.1", port: int = 0) -> Iterator[Served]:
    """Serve on a thread for as long as the context lasts.

    Raises:
        CannotServe, BadDatabase, NewerStore: with one sentence for the user.
    """
    migrate(settings.database)  # also so that its errors are raised here, not in the thread
    app = create_app(settings)
    server = Server(app, "warning")
    with closing(bind(host, port)) as bound:
        thread = threading.Thread(target=server.run, args=([bound],), name="waypost-serve", daemon=True)
        thread.start()
        try:
            _wait_for_start(server, thread)
            yield Served(url_of(bound), app.state.context.db)
        finally:
            server.should_exit = True
            thread.join()


def _wait_for_start(server: Server, thread: threading.Thread) -> None:
    while not server.started:
        thread.join(0.01)
        if not thread.is_alive():
            raise CannotServe("The server did not start; see its log.")


def foreground(app: FastAPI, bound: socket.socket, drain_seconds: float) -> None:
    """Serve until the process is told to stop, and after SIGTERM for `drain_seconds` more."""
    _collect_less()
    Server(app, "warning", drain_seconds).run([bound])


def _collect_less() -> None:
    """Let the garbage collector leave alone what lives as long as the process, and run less often.

    By default it stops the server again and again to look through hundreds of thousands of objects of the app, which
    took a tenth of its CPU time and made the slowest replies twice as slow (bench/RESULTS.md).
    """
    gc.collect()
    gc.freeze()
    gc.set_threshold(YOUNG_OBJECTS)
