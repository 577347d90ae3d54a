"""Wake-ups: nobody misses a change, and nothing is kept for those who left."""

import asyncio

from waypost_server.db.wakeups import Hub, pause


def test_a_change_after_the_watch_is_not_missed() -> None:
    async def scene() -> bool:
        hub = Hub()
        hub.open()
        changed = hub.watch("queue")
        hub.committed({"queue"})
        await pause(changed, 5)
        return changed.is_set()

    assert asyncio.run(scene())


def test_everybody_who_waits_is_woken_once() -> None:
    async def scene() -> tuple[bool, bool, bool]:
        hub = Hub()
        one, two, other = hub.watch("a"), hub.watch("a"), hub.watch("b")
        hub.wake({"a"})
        return one.is_set() and two.is_set(), other.is_set(), hub.watch("a").is_set()

    assert asyncio.run(scene()) == (True, False, False)


def test_closing_wakes_all() -> None:
    async def scene() -> bool:
        hub = Hub()
        waits = [hub.watch(str(n)) for n in range(3)]
        hub.close()
        return hub.closed and all(one.is_set() for one in waits)

    assert asyncio.run(scene())


def test_a_topic_nobody_waits_on_is_forgotten() -> None:
    async def scene() -> int:
        hub = Hub()
        for n in range(1_000):
            hub.watch(str(n))
        return len(hub._events)

    assert asyncio.run(scene()) == 0
