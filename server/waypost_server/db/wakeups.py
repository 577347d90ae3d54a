"""Wake-ups: requests that wait for a change continue as soon as it is committed."""

import asyncio
from weakref import WeakValueDictionary

Topics = set[str]
"""Names of things that can change: the queue, a query, the answers or the events of a run."""

QUEUE = "queue"


class Hub:
    """The topics that requests wait on. A wake-up carries no data; the waiter reads the store again."""

    def __init__(self) -> None:
        self._loop: asyncio.AbstractEventLoop | None = None
        # Weak: a topic is dropped when no request waits on it any more.
        self._events: WeakValueDictionary[str, asyncio.Event] = WeakValueDictionary()
        self.closed = False

    def open(self) -> None:
        """Bind to the running event loop."""
        self._loop = asyncio.get_running_loop()
        self.closed = False

    def watch(self, topic: str) -> asyncio.Event:
        """Return the event that the next change of a topic sets. Get it before reading, so that no change is missed."""
        changed = self._events.get(topic)
        if changed is None:
            changed = self._events[topic] = asyncio.Event()
        return changed

    def committed(self, topics: Topics) -> None:
        """Wake the waiters of these topics. Called from the writer's thread."""
        if self._loop is not None and not self._loop.is_closed():
            self._loop.call_soon_threadsafe(self.wake, topics)

    def wake(self, topics: Topics) -> None:
        """Wake the waiters of these topics. Called on the event loop."""
        for topic in topics:
            changed = self._events.pop(topic, None)
            if changed is not None:
                changed.set()

    def close(self) -> None:
        """Wake all waiters for the last time, because the server stops."""
        self.closed = True
        self.wake(set(self._events))


async def pause(changed: asyncio.Event, seconds: float) -> None:
    """Wait for a change, at most `seconds`."""
    try:
        async with asyncio.timeout(seconds):
            await changed.wait()
    except TimeoutError:
        pass
