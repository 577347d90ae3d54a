"""Frames: pictures of states, for domains without a renderer. A frame is identified by the SHA-256 of its PNG."""

import base64
import binascii
import hashlib
from collections.abc import Iterable, Iterator
from itertools import islice

from sqlalchemy import func, select, update

from waypost import wire
from waypost_server import errors
from waypost_server.db.tables import frames
from waypost_server.db.transaction import Tx
from waypost_server.errors import Unprocessable

MOST_PIXELS = 4_096  # on a side
_SIGNATURE = b"\x89PNG\r\n\x1a\n\x00\x00\x00\rIHDR"
_END = b"\x00\x00\x00\x00IEND\xaeB`\x82"
_AT_ONCE = 500  # hashes in one statement


def decode(uploaded: Iterable[wire.Frame], most_bytes: int) -> dict[str, bytes]:
    """Return the PNG files of frames by their hashes.

    Raises:
        Unprocessable: a file is not a PNG, is too large, or does not match its hash.
    """
    return {frame.hash: _decode(frame, place, most_bytes) for place, frame in enumerate(uploaded)}


def _decode(frame: wire.Frame, place: int, most_bytes: int) -> bytes:
    at: list[str | int] = ["body", "frames", place]
    try:
        png = base64.b64decode(frame.png, validate=True)
    except binascii.Error as error:
        raise Unprocessable([*at, "png"], f"is not base64: {error}") from None
    if len(png) > most_bytes:
        raise Unprocessable([*at, "png"], f"has {len(png)} bytes; a frame may have at most {most_bytes}")
    if not png.startswith(_SIGNATURE) or not png.endswith(_END):
        raise Unprocessable([*at, "png"], "is not a PNG")
    width, height = int.from_bytes(png[16:20]), int.from_bytes(png[20:24])
    if not (1 <= width <= MOST_PIXELS and 1 <= height <= MOST_PIXELS):
        raise Unprocessable([*at, "png"], f"is {width} x {height} pixels; at most {MOST_PIXELS} on a side")
    if hashlib.sha256(png).hexdigest() != frame.hash:
        raise Unprocessable([*at, "hash"], "is not the SHA-256 of this file")
    return png


def missing(tx: Tx, hashes: Iterable[str]) -> list[str]:
    """Return the hashes that no stored frame has, each once, in the given order."""
    wanted = list(dict.fromkeys(hashes))
    stored: set[str] = set()
    for some in in_parts(wanted):
        stored |= set(tx.conn.execute(select(frames.c.hash).where(frames.c.hash.in_(some))).scalars())
    return [one for one in wanted if one not in stored]


def store(tx: Tx, files: dict[str, bytes], user: int | None = None) -> int:
    """Store frames; return the size of those that were not stored before. The others do not change.

    Args:
        tx: the transaction.
        files: PNG files by hash.
        user: who uploads them; None if they belong to nobody.
    """
    rows = [{"hash": one, "png": files[one], "created_at": tx.now, "user_id": user} for one in missing(tx, files)]
    if not rows:
        return 0
    # Another learner may be storing the same frame.
    new = tx.upsert(frames).on_conflict_do_nothing().returning(func.length(frames.c.png))
    return sum(tx.conn.execute(new, rows).scalars())


def pin(tx: Tx, hashes: Iterable[str]) -> None:
    """Keep stored frames also if no run shows them."""
    for some in in_parts(hashes):
        tx.conn.execute(update(frames).where(frames.c.hash.in_(some)).values(pinned=True))


def find(tx: Tx, frame: str) -> bytes:
    """Return a frame's PNG.

    Raises:
        NotFound: it is not stored.
    """
    png = tx.conn.execute(select(frames.c.png).where(frames.c.hash == frame)).scalar_one_or_none()
    if png is None:
        raise errors.NotFound(f"There is no frame {frame}.")
    return bytes(png)


def in_parts(hashes: Iterable[str]) -> Iterator[list[str]]:
    """Yield the hashes in parts that fit into a statement."""
    rest = iter(hashes)
    while some := list(islice(rest, _AT_ONCE)):
        yield some
