"""Content as bytes: the same JSON value always gives the same text and the same digest."""

import hashlib
import json
from typing import Any

from waypost_server import errors


def text(value: Any) -> str:
    """Return a JSON value as canonical ASCII text.

    Raises:
        Unprocessable: for a number that JSON cannot hold, such as one that overflowed to infinity.
    """
    try:
        return json.dumps(value, allow_nan=False, sort_keys=True, separators=(",", ":"))
    except ValueError:
        raise errors.Unprocessable(["body"], "holds a number outside of what JSON can carry") from None


def digest(content: str) -> str:
    """Return the SHA-256 of a canonical text."""
    return hashlib.sha256(content.encode()).hexdigest()
