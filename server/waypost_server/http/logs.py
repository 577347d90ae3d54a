"""The log: what its lines look like, the request that each line belongs to, and what they must not hold.

No line holds a secret or an answer. Nobody logs a header, a body or the query of an address. Messages of exceptions are
cut after their first line, because databases and pydantic show values in the others.
"""

import json
import logging
import random
import re
import sys
import traceback
from contextvars import ContextVar
from types import TracebackType
from typing import Literal

from pythonjsonlogger.json import JsonFormatter
from starlette.datastructures import Headers
from starlette.types import Scope

LogFormat = Literal["text", "json"]

HEADER = "X-Request-ID"
ACCEPTED = re.compile(r"[A-Za-z0-9._-]{1,64}")
SECRET = re.compile(r"wp_[A-Za-z0-9_-]{20,}")  # as `auth.credentials.issue` makes them; in an address by mistake
FIELDS = {"levelname": "level", "name": "logger", "message": "message", "request_id": "request_id"}
TEXT = "%(asctime)s %(levelname)s %(request_id)s %(message)s"

Raised = tuple[type[BaseException], BaseException, TracebackType | None] | tuple[None, None, None]

requests = logging.getLogger("waypost.requests")
_request: ContextVar[str | None] = ContextVar("request", default=None)


def begin(scope: Scope) -> str:
    """Give a request its id: the one that it brings, if it is well-formed, or a new one."""
    given = Headers(scope=scope).get(HEADER, "")
    # An id is no secret. Whoever asks the operating system for random bytes lets another thread go first.
    chosen = given if ACCEPTED.fullmatch(given) else f"{random.getrandbits(64):016x}"
    _request.set(chosen)
    return chosen


def request_id() -> str | None:
    """Return the id of the request that is being handled; None if there is none."""
    return _request.get()


def answered(scope: Scope, status: int, seconds: float) -> None:
    """Log the head of a reply, if requests are logged."""
    if not requests.isEnabledFor(logging.INFO):
        return
    caller = scope.get("state", {}).get("caller")
    fields = {
        "method": scope["method"],
        "path": scope["path"],
        "operation": getattr(scope.get("route"), "operation_id", None),
        "status": status,
        "milliseconds": round(seconds * 1_000, 1),
        "user": getattr(caller, "user", None),
        "address": scope["client"][0] if scope.get("client") else None,
    }
    requests.info("%s %s: %d", scope["method"], json.dumps(scope["path"]), status, extra=fields)


class _Text(logging.Formatter):
    """Lines for people."""

    def __init__(self) -> None:
        super().__init__(TEXT)

    def format(self, record: logging.LogRecord) -> str:
        return SECRET.sub("wp_...", super().format(record))

    def formatException(self, ei: Raised) -> str:  # noqa: N802 - logging's name
        return told(ei[1])


class _Json(JsonFormatter):
    """One JSON object per line."""

    def __init__(self) -> None:
        super().__init__(list(FIELDS), rename_fields=FIELDS, timestamp="at", json_ensure_ascii=True)

    def format(self, record: logging.LogRecord) -> str:
        return SECRET.sub("wp_...", super().format(record))

    def formatException(self, ei: Raised) -> str:  # noqa: N802 - logging's name
        return told(ei[1])


def told(error: BaseException | None) -> str:
    """Return the traceback of an exception and of its causes, newest first, each with the first line of its message."""
    parts: list[str] = []
    while error is not None:
        frames = "".join(traceback.format_tb(error.__traceback__))
        parts.append(f"{frames}{type(error).__name__}: {str(error).partition(chr(10))[0]}")
        error = error.__cause__ or (None if error.__suppress_context__ else error.__context__)
    return "\nbecause of:\n".join(parts)


def _add_request(record: logging.LogRecord) -> bool:
    record.request_id = _request.get()
    return True


def install(format_: LogFormat, *, with_requests: bool) -> None:
    """Write the log of this process to standard error: warnings and errors, and with `with_requests` each request."""
    handler = logging.StreamHandler(sys.stderr)
    handler.setFormatter(_Json() if format_ == "json" else _Text())
    handler.addFilter(_add_request)
    logging.basicConfig(handlers=[handler], level=logging.WARNING, force=True)
    requests.setLevel(logging.INFO if with_requests else logging.WARNING)
