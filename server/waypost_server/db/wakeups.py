"""Wake-ups: whoever waits for a change is told the moment it is committed."""

import asyncio
from weakref import WeakValueDictionary

from waypost_server.db.writer import Topics

QUEUE = "queue"


class Hub:
    """Topics to wait on. A wake-up carries nothing: the waiter looks at the store again."""

    def __init__(self) -> None:
        self._loop: asyncio.AbstractEventLoop | None = None
        # Weak: a topic lives as long as somebody waits on it.
        self._events: WeakValueDictionary[str, asyncio.Event] = WeakValueDictionary()
        self.closed = False

    def open(self) -> None:
        """Bind to the running event loop."""
        self._loop = asyncio.get_running_loop()
        self.closed = False

    def watch(self, topic: str) -> asyncio.Event:
        """Return what the next change of a topic sets. Take it before looking, so that no change is missed."""
        changed = self._events.get(topic)
        if changed is None:
            changed = self._events[topic] = asyncio.Event()
        return changed

    def committed(self, topics: Topics) -> None:
        """Wake the waiters of these topics; called from the writer's thread."""
        if self._loop is not None and not self._loop.is_closed():
            self._loop.call_soon_threadsafe(self.wake, topics)

    def wake(self, topics: Topics) -> None:
        """Wake the waiters of these topics; called on the event loop."""
        for topic in topics:
            changed = self._events.pop(topic, None)
            if changed is not None:
                changed.set()

    def close(self) -> None:
        """Wake everybody for the last time: the server stops."""
        self.closed = True
        self.wake(set(self._events))


async def pause(changed: asyncio.Event, seconds: float) -> None:
    """Wait for a change, but only so long."""
    try:
        async with asyncio.timeout(seconds):
            await changed.wait()
    except TimeoutError:
        pass
