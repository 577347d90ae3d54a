"""Encode pictures of states as PNG files, and identify each file by its SHA-256."""

import hashlib
import io
from typing import Any

Picture = Any
"""A PNG file as bytes, or an array uint8[rows, columns, 3] (also [rows, columns] for gray, [rows, columns, 4])."""

_SIGNATURE = b"\x89PNG\r\n\x1a\n"


def png(picture: Picture) -> bytes:
    """Return a picture as a PNG file. Only arrays need the package Pillow.

    Raises:
        ValueError: it is neither a PNG file nor an array of this type and shape.
    """
    if isinstance(picture, bytes):
        if not picture.startswith(_SIGNATURE):
            raise ValueError("a picture in bytes must be a PNG file; give other formats as an array of pixels")
        return picture
    dtype, shape = str(getattr(picture, "dtype", type(picture).__name__)), tuple(getattr(picture, "shape", ()))
    if dtype != "uint8" or not (len(shape) == 2 or (len(shape) == 3 and shape[2] in (3, 4))):
        raise ValueError(
            f"a picture is {dtype}{list(shape)}; give a PNG file in bytes, or an array uint8[rows, columns, 3]"
        )
    from PIL import Image

    file = io.BytesIO()
    Image.fromarray(picture).save(file, "PNG")
    return file.getvalue()


def digest(file: bytes) -> str:
    """Return the SHA-256 of a file in hexadecimal, which identifies it at the server."""
    return hashlib.sha256(file).hexdigest()
