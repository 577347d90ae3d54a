"""Serves with several processes on one socket, on PostgreSQL. They accept connections as they have time."""

import logging
import os
import signal
import socket
import threading
import time
from functools import partial
from multiprocessing import get_context, parent_process
from multiprocessing.connection import wait
from multiprocessing.process import BaseProcess
from types import FrameType

from uvicorn.config import STARTUP_FAILURE

from waypost import tracing
from waypost_server import serving
from waypost_server.app import create_app
from waypost_server.db.engine import parse
from waypost_server.http import logs
from waypost_server.settings import Settings

PAUSE_SECONDS = 1.0  # before a process that died is replaced

log = logging.getLogger("waypost")


def check(settings: Settings, n: int) -> None:
    """Refuse several processes where the store cannot serve them.

    Raises:
        CannotServe: the store is SQLite.
        BadDatabase: the store's address is none.
    """
    if n > 1 and parse(settings.database).get_backend_name() == "sqlite":
        raise serving.CannotServe(
            "An SQLite store is for one process, which groups its writes and wakes whoever waits. Leave out "
            "--processes, or give --database postgresql://USER@HOST/NAME."
        )


def serve(settings: Settings, bound: socket.socket, n: int) -> None:
    """Serve with `n` processes until told to stop, and end as a process that was told so.

    SIGTERM and SIGINT reach all processes. One that dies is replaced.

    Raises:
        CannotServe: a process could not start.
    """
    Processes(settings, bound, n).run()


class Processes:
    """The processes that serve."""

    def __init__(self, settings: Settings, bound: socket.socket, n: int) -> None:
        self._start = partial(get_context("spawn").Process, target=_work, args=(settings, bound))
        self._n = n
        self._running: list[BaseProcess] = []
        self._told: list[int] = []  # the signals, in their order

    def run(self) -> None:
        """Serve until told to stop."""
        before = {one: signal.signal(one, self._tell) for one in (signal.SIGTERM, signal.SIGINT)}
        try:
            for _ in range(self._n):
                self._add()
            self._watch()
        finally:
            for one, handler in before.items():
                signal.signal(one, handler)
        if self._told:
            signal.raise_signal(self._told[0])

    def _add(self) -> None:
        process = self._start()
        process.start()
        self._running.append(process)
        if self._told:  # while it started
            _send(process, self._told[-1])

    def _tell(self, sig: int, _frame: FrameType | None) -> None:
        self._told.append(sig)
        for process in self._running:
            _send(process, sig)

    def _watch(self) -> None:
        while self._running:
            wait([one.sentinel for one in self._running])
            for process in [one for one in self._running if not one.is_alive()]:
                self._running.remove(process)
                if self._told:
                    continue
                if process.exitcode == STARTUP_FAILURE:
                    self._tell(signal.SIGTERM, None)
                    self._told.clear()
                    for other in self._running:
                        other.join()
                    raise serving.CannotServe("A server process did not start; see its log.")
                log.warning("A server process ended (%s); another one takes its place.", process.exitcode)
                time.sleep(PAUSE_SECONDS)
                self._add()


def _send(process: BaseProcess, sig: int) -> None:
    if process.is_alive() and process.pid is not None:
        os.kill(process.pid, sig)


def _work(settings: Settings, bound: socket.socket) -> None:
    """Serve in one of the processes."""
    os.setsid()  # Ctrl-C in a terminal reaches the first process alone, which passes it on once
    threading.Thread(target=_end_with_parent, daemon=True).start()
    logs.install(settings.log_format, with_requests=settings.log_requests)
    tracing.install("waypost-server")
    serving.foreground(create_app(settings), bound, settings.drain_seconds)


def _end_with_parent() -> None:
    parent = parent_process()
    if parent is not None:
        parent.join()
        os.kill(os.getpid(), signal.SIGTERM)
