"""The files of the web app. Files with a hash in their name are cached forever; other paths get index.html."""

import gzip
from functools import cache
from mimetypes import guess_type
from pathlib import Path

from fastapi import FastAPI, HTTPException, Request
from fastapi.responses import PlainTextResponse, Response

from waypost_server.http.ahead import ahead

MISSING = (
    "Waypost is running, but its web app is not built; `make web` builds it. The API is at /api/v1; "
    "/api/docs describes it.\n"
)


COMPRESSED = {".js", ".css"}


def find() -> Path | None:
    """Return the folder of the built web app: inside the installed package, or in web/dist of a checkout."""
    package = Path(__file__).resolve().parents[1]
    for folder in (package / "static", package.parents[1] / "web" / "dist"):
        if (folder / "index.html").is_file():
            return folder
    return None


def install(app: FastAPI, folder: Path | None) -> None:
    """Serve the web app on every GET that no other route handles."""

    @app.get("/{path:path}", include_in_schema=False)
    async def web_app(request: Request, path: str) -> Response:
        if path == "api" or path.startswith("api/"):
            raise HTTPException(404, f"There is no {request.url.path}; /api/docs lists every path.")
        root = folder or find()
        if root is None or not (root / "index.html").is_file():
            return PlainTextResponse(MISSING, 200 if path == "" else 404)
        found = _file(root, path)
        if found is not None:
            if not path.startswith("assets/"):
                return _reply(found, found.read_bytes(), {"Cache-Control": "no-cache"})
            headers = {"Cache-Control": "public, max-age=31536000, immutable"}
            if found.suffix in COMPRESSED and "gzip" in request.headers.get("Accept-Encoding", ""):
                headers |= {"Content-Encoding": "gzip", "Vary": "Accept-Encoding"}
                return _reply(found, _gzipped(found), headers)
            return _reply(found, found.read_bytes(), headers)
        if path.startswith("assets/"):
            raise HTTPException(404, f"There is no {request.url.path}.")
        headers = {"Cache-Control": "no-cache"}
        may_be_known = "cookie" in request.headers or "authorization" in request.headers
        if hints := ahead(root, path, may_be_known):
            headers["Link"] = hints
        page = root / "index.html"
        return _reply(page, page.read_bytes(), headers)


def _reply(file: Path, content: bytes, headers: dict[str, str]) -> Response:
    """Return a whole file. The files are small: to read one takes less time than to wake a thread that reads it."""
    kind = guess_type(file)[0] or "application/octet-stream"
    return Response(content, headers=headers, media_type=kind)


@cache
def _gzipped(file: Path) -> bytes:
    """Compress a file once for all requests: with a hash in its name, it never changes."""
    return gzip.compress(file.read_bytes())


def _file(root: Path, path: str) -> Path | None:
    """Return a file of the web app; never a file outside its folder."""
    if "\x00" in path:
        return None
    found = (root / path).resolve()
    return found if found.is_relative_to(root.resolve()) and found.is_file() else None
