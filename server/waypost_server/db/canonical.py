"""Canonical JSON: equal values give the same text and the same digest, so contents can be compared."""

import hashlib
import json
from typing import Any

from waypost_server import errors


def text(value: Any) -> str:
    """Return a JSON value as canonical ASCII text.

    Raises:
        Unprocessable: the value has a number that JSON cannot express, such as infinity.
    """
    try:
        return json.dumps(value, allow_nan=False, sort_keys=True, separators=(",", ":"))
    except ValueError:
        raise errors.Unprocessable(["body"], "has a number that JSON cannot express, such as infinity") from None


def digest(content: str) -> str:
    """Return the SHA-256 of a canonical text."""
    return hashlib.sha256(content.encode()).hexdigest()
