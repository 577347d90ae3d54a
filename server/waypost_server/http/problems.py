"""Errors over HTTP: RFC 9457 problem documents, and their description for OpenAPI."""

import http
import json
import logging
import math
from collections.abc import Mapping
from typing import Any

from fastapi import FastAPI, Request
from fastapi.exceptions import RequestValidationError
from fastapi.responses import JSONResponse
from starlette.exceptions import HTTPException

from waypost import wire
from waypost_server import errors
from waypost_server.errors import Refusal
from waypost_server.http import logs

log = logging.getLogger("waypost")

MEDIA_TYPE = "application/problem+json"
INTERNAL = (500, "internal-error", "Internal error")
"""The status, name and title of a failure of the server itself."""


def document(status: int, name: str, title: str, detail: str, **more: Any) -> dict[str, Any]:
    """Return the body of a problem document. A failure of the server has the id of its request, for the log."""
    if status >= 500 and (request := logs.request_id()) is not None:
        more["request_id"] = request
    return {"type": f"/problems/{name}", "title": title, "status": status, "detail": detail, **more}


def render(refusal: Refusal, instance: str | None = None) -> JSONResponse:
    """Return a refusal as a response."""
    headers = {}
    if refusal.retry_after is not None:
        headers["Retry-After"] = str(math.ceil(refusal.retry_after))
    if isinstance(refusal, errors.Unauthenticated):
        headers["WWW-Authenticate"] = "Bearer"
    body = document(refusal.status, refusal.name, refusal.title, refusal.detail, instance=instance, **refusal.members)
    return JSONResponse(body, refusal.status, headers, MEDIA_TYPE)


def problem(refusal: Refusal) -> wire.Problem:
    """Return a refusal as a part of a reply."""
    body = document(refusal.status, refusal.name, refusal.title, refusal.detail, **refusal.members)
    return wire.Problem.model_validate(body)


def failed(method: str, path: str, error: Exception) -> JSONResponse:
    """Log a failure of the server, and return the response, which says nothing about its cause."""
    log.error("%s %s failed", method, json.dumps(path), exc_info=error)
    body = document(*INTERNAL, "The server failed; its log says why, under the id of the request.", instance=path)
    return JSONResponse(body, 500, media_type=MEDIA_TYPE)


def field_path(location: tuple[str | int, ...]) -> list[str | int]:
    """Return the path of a field, without the tags that pydantic adds for members of a union."""
    last = len(location) - 1
    return [part for place, part in enumerate(location) if place == last or part not in wire.KINDS]


def invalid(error: RequestValidationError) -> dict[str, Any]:
    """Return the problem document for a request that does not match its schema."""
    faults = [
        {"loc": field_path(fault["loc"]), "msg": fault["msg"], "type": fault["type"]} for fault in error.errors()[:100]
    ]
    first = faults[0] if faults else {"loc": [], "msg": "invalid"}
    detail = f"{'.'.join(str(part) for part in first['loc'])}: {first['msg']}"
    return document(422, errors.Unprocessable.name, errors.Unprocessable.title, detail, errors=faults)


def install(app: FastAPI) -> None:
    """Make the app answer every error of a request with a problem document. `http.guard` answers its own failures."""

    @app.exception_handler(Refusal)
    async def refused(request: Request, error: Refusal) -> JSONResponse:
        if isinstance(error, errors.StorageFailed) and not isinstance(error, errors.StoreBusy):
            log.warning("%s %s failed: %s", request.method, json.dumps(request.url.path), error.detail)
        return render(error, request.url.path)

    @app.exception_handler(RequestValidationError)
    async def unprocessable(request: Request, error: RequestValidationError) -> JSONResponse:
        return JSONResponse(invalid(error) | {"instance": request.url.path}, 422, media_type=MEDIA_TYPE)

    @app.exception_handler(HTTPException)
    async def http_error(request: Request, error: HTTPException) -> JSONResponse:
        title = http.HTTPStatus(error.status_code).phrase
        body = document(error.status_code, title.lower().replace(" ", "-"), title, str(error.detail))
        headers: Mapping[str, str] | None = error.headers
        return JSONResponse(body | {"instance": request.url.path}, error.status_code, headers, MEDIA_TYPE)


def refusals(*kinds: type[Refusal]) -> dict[int | str, dict[str, Any]]:
    """Return the `responses=` of a route with these refusals. `http.description` adds the refusals of every route."""
    responses: dict[int | str, dict[str, Any]] = {}
    for kind in kinds:
        example = document(kind.status, kind.name, kind.title, (kind.__doc__ or "").split("\n")[0])
        response = responses.setdefault(
            kind.status, {"model": wire.Problem, "description": "", "content": {MEDIA_TYPE: {"examples": {}}}}
        )
        response["content"][MEDIA_TYPE]["examples"][kind.name] = {"summary": kind.title, "value": example}
        response["description"] = "; ".join(filter(None, [response["description"], kind.title])) + ""
    return responses
