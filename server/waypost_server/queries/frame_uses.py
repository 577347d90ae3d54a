"""Which frames the queries, answers and gold queries of a run show. They stay stored as long as the run."""

from collections.abc import Iterable, Iterator, Sequence

from sqlalchemy import select

from waypost import wire
from waypost_server.db.tables import frame_uses, frames
from waypost_server.db.transaction import Tx
from waypost_server.errors import Unprocessable
from waypost_server.queries.frames import in_parts


def check_stored(tx: Tx, run: str, asks: Sequence[wire.Ask]) -> None:
    """Record that a run's queries show their frames, which stay stored as long as the run.

    Raises:
        Unprocessable: a frame was not uploaded; names the first.
    """
    absent = show(tx, run, of_asks(asks))
    if absent:
        raise Unprocessable(["body", "queries"], f"frame {absent[0]} is not stored; upload it before asking")


def of_asks(asks: Iterable[wire.Ask]) -> Iterator[str]:
    """Yield the frames that queries show."""
    for ask in asks:
        for segment in (*getattr(ask, "segments", ()), *ask.context):
            yield from segment.frames


def of_answer(answer: wire.Answer) -> Sequence[str]:
    """Return the frames that an answer shows: those of a demonstration, as its annotator saw it."""
    return answer.replay.frames if isinstance(answer, wire.HierDemoAnswer) and answer.replay is not None else ()


def show(tx: Tx, run: str, hashes: Iterable[str]) -> list[str]:
    """Record that a run shows frames, as far as they are stored; return the hashes that no stored frame has.

    On PostgreSQL, the frames are locked: whoever deletes another run at this moment leaves them, or they are missing.
    """
    wanted = list(dict.fromkeys(hashes))
    stored: set[str] = set()
    for some in in_parts(wanted):
        found = select(frames.c.hash).where(frames.c.hash.in_(some)).with_for_update(read=True, key_share=True)
        stored |= set(tx.conn.execute(found).scalars())
    if stored:
        rows = [{"run_id": run, "hash": one} for one in sorted(stored)]
        tx.conn.execute(tx.upsert(frame_uses).on_conflict_do_nothing(), rows)
    return [one for one in wanted if one not in stored]
