"""The built page: its files, cached for good when their names carry a hash, and index.html for every other address."""

from pathlib import Path

from fastapi import FastAPI, HTTPException, Request
from fastapi.responses import FileResponse, PlainTextResponse, Response

MISSING = (
    "Waypost is running; its page is not built. `make web` builds it; the API is under /api/v1 and described in "
    "/api/v1/openapi.json.\n"
)


def find() -> Path | None:
    """Return the folder of the built page: packaged with the server, or built beside it in a checkout."""
    package = Path(__file__).resolve().parents[1]
    for folder in (package / "static", package.parents[1] / "web" / "dist"):
        if (folder / "index.html").is_file():
            return folder
    return None


def install(app: FastAPI, folder: Path | None) -> None:
    """Serve the page on every GET that no other route takes."""

    @app.get("/{path:path}", include_in_schema=False)
    async def page(request: Request, path: str) -> Response:
        if path == "api" or path.startswith("api/"):
            raise HTTPException(404, f"There is no {request.url.path}; /api/v1/openapi.json lists what there is.")
        root = folder or find()
        if root is None or not (root / "index.html").is_file():
            return PlainTextResponse(MISSING, 200 if path == "" else 404)
        found = _file(root, path)
        if found is not None:
            hashed = path.startswith("assets/")
            caching = "public, max-age=31536000, immutable" if hashed else "no-cache"
            return FileResponse(found, headers={"Cache-Control": caching})
        if path.startswith("assets/"):
            raise HTTPException(404, f"There is no {request.url.path}.")
        return FileResponse(root / "index.html", headers={"Cache-Control": "no-cache"})


def _file(root: Path, path: str) -> Path | None:
    """Return a file of the page, and never one from outside of its folder."""
    if "\x00" in path:
        return None
    found = (root / path).resolve()
    return found if found.is_relative_to(root.resolve()) and found.is_file() else None
