"""Notifications: server processes on one PostgreSQL database tell each other what they committed.

A notification that is a part of a transaction takes a lock of the whole database at its commit, so commits would wait
for each other's disk syncs. So it is sent just after the commit, by a connection of its own. A process that stops in
between has told nothing, and a lost connection loses some: waiting requests read the store now and then anyway
(`Settings.poll_seconds`).
"""

import json
import logging
import secrets
import threading
from collections.abc import Callable, Iterator
from queue import Empty, SimpleQueue
from typing import Any

import psycopg
from psycopg import Connection, Notify
from sqlalchemy.engine import URL

from waypost_server.db.wakeups import Topics

CHANNEL = "waypost"
MOST_TOPICS = 100  # in one notification, which PostgreSQL limits to 8,000 bytes
PAUSE_SECONDS = 0.005  # between two notifications: each makes every process look; what comes meanwhile goes together
AGAIN_SECONDS = 1.0  # between two attempts to connect
LOOK_SECONDS = 1.0  # how long a listener that hears nothing takes to see that it should end

log = logging.getLogger("waypost")


class Notifications:
    """Two threads: one tells the other processes which topics changed here, one hears what changed there."""

    def __init__(self, url: URL, heard: Callable[[Topics], None]) -> None:
        self._connect_to = url.get_dialect()().create_connect_args(url)
        self._heard = heard
        self._name = secrets.token_hex(8)
        self._topics: SimpleQueue[Topics | None] = SimpleQueue()  # None: there will be no more
        self._closing = threading.Event()
        self._threads = [
            threading.Thread(target=self._keep, args=[work], name=f"waypost-{work.__name__.strip('_')}", daemon=True)
            for work in (self._tell, self._listen)
        ]
        for thread in self._threads:
            thread.start()

    def committed(self, topics: Topics) -> None:
        """Tell the other processes that these topics changed, soon."""
        self._topics.put(topics)

    def close(self) -> None:
        """Tell what is left, and end."""
        self._closing.set()
        self._topics.put(None)
        for thread in self._threads:
            thread.join()

    def _keep(self, work: Callable[[Connection[Any]], None]) -> None:
        """Do the work until the end, on a new connection whenever one is lost."""
        while not self._closing.is_set():
            try:
                arguments, options = self._connect_to
                with psycopg.connect(*arguments, **options, autocommit=True) as conn:
                    work(conn)
            except psycopg.Error as error:
                log.warning("Other server processes may notice changes late: %s", str(error).partition("\n")[0])
                self._closing.wait(AGAIN_SECONDS)

    def _tell(self, conn: Connection[Any]) -> None:
        ends = False
        while not ends:
            told, ends = self._next()
            topics = sorted(told)
            for first in range(0, len(topics), MOST_TOPICS):
                self._notify(conn, topics[first : first + MOST_TOPICS])
            self._closing.wait(PAUSE_SECONDS)
        self._notify(conn, [])  # wakes this process's own listener, which ends then

    def _next(self) -> tuple[Topics, bool]:
        """Return the topics of all commits since the last call, and whether there will be no more; wait for one."""
        topics: Topics = set()
        found = self._topics.get()
        try:
            while found is not None:
                topics |= found
                found = self._topics.get_nowait()
        except Empty:
            return topics, False
        return topics, True

    def _notify(self, conn: Connection[Any], topics: list[str]) -> None:
        conn.execute("SELECT pg_notify(%s, %s)", [CHANNEL, json.dumps([self._name, *topics])])

    def _listen(self, conn: Connection[Any]) -> None:
        conn.execute(f"LISTEN {CHANNEL}")
        while not self._closing.is_set():
            notes: Iterator[Notify] = conn.notifies(timeout=LOOK_SECONDS, stop_after=1)
            for note in notes:
                name, *topics = json.loads(note.payload)
                if name != self._name:
                    self._heard(set(topics))
